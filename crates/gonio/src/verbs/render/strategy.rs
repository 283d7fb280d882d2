//! `--light-strategy`: how light is found.

use crate::output::say;
use anyhow::Result;
use clap::ValueEnum;
use scene_io::BuiltScene;
use scene_io::spectral::AnyScene;
use tracer::{Strategy, Trial};

/// How light is found.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, ValueEnum)]
pub(crate) enum LightStrategy {
    /// `mis` or `ris`, whichever a pilot finds cheaper for this scene.
    #[default]
    Auto,
    /// One point on a light and one direction of the material, weighed by the balance heuristic.
    Mis,
    /// Eight points on lights, one shadow ray toward one of them chosen by what it would carry.
    Ris,
    /// Lights alone.
    Light,
    /// The material alone.
    Bsdf,
}

/// Puts the strategy into the settings; what the pilot found, if there was one.
pub(super) fn settle(
    built: &mut BuiltScene<AnyScene>,
    asked: LightStrategy,
) -> Result<Option<[Trial; 2]>> {
    built.settings.strategy = match asked {
        LightStrategy::Mis => Strategy::Mis,
        LightStrategy::Ris => Strategy::Ris,
        LightStrategy::Light => Strategy::LightOnly,
        LightStrategy::Bsdf => Strategy::BsdfOnly,
        LightStrategy::Auto => {
            let (better, trials) = built.scene.choose_strategy(&built.settings, built.size)?;
            built.settings.strategy = better;
            return Ok(Some(trials));
        }
    };
    Ok(None)
}

/// The name of a strategy on the command line.
pub(super) fn name(strategy: Strategy) -> &'static str {
    match strategy {
        Strategy::Mis => "mis",
        Strategy::Ris => "ris",
        Strategy::LightOnly => "light",
        Strategy::BsdfOnly => "bsdf",
    }
}

/// Which it is, and why.
pub(super) fn explain(built: &BuiltScene<AnyScene>, trials: Option<[Trial; 2]>) {
    let name_of = |t: &Trial| name(t.strategy);
    let chosen = name(built.settings.strategy);
    match trials {
        None => say(format_args!("light strategy {chosen}: asked for")),
        Some([a, b]) => say(format_args!(
            "light strategy {chosen}: in a pilot, {} had relative RMSE {:.2} % for work 1, {} {:.2} % for {:.2}: squared error times work {:.2} against 1",
            name_of(&a),
            100.0 * a.rel_rmse,
            name_of(&b),
            100.0 * b.rel_rmse,
            b.work / a.work,
            b.cost() / a.cost()
        )),
    }
}
