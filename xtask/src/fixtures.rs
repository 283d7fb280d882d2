//! `cargo xtask fixtures [--check]`: the files below data-fixtures/, made from models with known truth.
//!
//! A folder is the verdict its files are tested for: valid/ must be read, invalid/ must be refused.

use crate::repo;
use anyhow::{Context, Result, bail};
use brdf_measure::{Bracketing, Instrument, measure_astm, measure_merl};
use brdf_models::parse_model;
use spectrum::{Basis, RgbSpace};

/// A fixture: where it goes, and its content.
type Fixture = (&'static str, Vec<u8>);

pub(crate) fn run(args: &[String]) -> Result<()> {
    let check = match args {
        [] => false,
        [flag] if flag == "--check" => true,
        _ => bail!("usage: cargo xtask fixtures [--check]"),
    };
    for (name, content) in fixtures()? {
        let path = repo::root().join("data-fixtures").join(name);
        if check {
            let found = std::fs::read(&path).with_context(|| repo::shown(&path))?;
            if found != content {
                bail!(
                    "{}: differs from what `cargo xtask fixtures` makes",
                    repo::shown(&path)
                );
            }
        } else {
            std::fs::create_dir_all(path.parent().context("no folder")?)?;
            std::fs::write(&path, content).with_context(|| repo::shown(&path))?;
            println!("wrote {}", repo::shown(&path));
        }
    }
    Ok(())
}

fn fixtures() -> Result<Vec<Fixture>> {
    let perfect = Instrument::default();
    let noisy = Instrument {
        noise: 0.05,
        bracketing: Some(Bracketing::MERL),
        blind_spot_deg: Instrument::CORNELL_BLIND_SPOT_DEG,
    };
    let rgb = Basis::Rgb(RgbSpace::trinitron());
    let ward = parse_model("ward:alpha=0.2,kd=0.3/0.1/0.05,ks=0.1")?
        .built
        .brdf;
    let lambert = parse_model("lambert:kd=0.5")?.built.brdf;
    let merl = measure_merl(&*ward, [12, 10, 16], &perfect, 0)?.into_bytes();
    let full = measure_merl(&*ward, [6, 5, 20], &noisy, 1)?.into_bytes();
    let astm = measure_astm(&*ward, &rgb, "ward with noise", &noisy, 2)?.to_bytes();
    let xyz = measure_astm(&*lambert, &Basis::Xyz, "lambert", &perfect, 0)?.to_bytes();
    let text = String::from_utf8(xyz.clone())?;
    Ok(vec![
        (
            "invalid/merl-truncated.binary",
            merl[..merl.len() - 5].to_vec(),
        ),
        (
            "invalid/astm-degrees.astm",
            text.replacen("\n0.174533,", "\n10.000000,", 1).into_bytes(),
        ),
        (
            "invalid/astm-no-vars.astm",
            text.replacen("VARS", "VAR", 1).into_bytes(),
        ),
        ("valid/ward-12x10x16.binary", merl),
        ("valid/ward-noisy-6x5x20.binary", full),
        ("valid/ward-noisy-rgb.astm", astm),
        ("valid/lambert-xyz.astm", xyz),
    ])
}

#[cfg(test)]
mod tests {
    #[test]
    fn committed_fixtures_are_what_the_verb_makes() {
        super::run(&["--check".into()]).unwrap();
    }

    #[test]
    fn folders_are_verdicts() {
        for (name, content) in super::fixtures().unwrap() {
            let read = brdf_formats::read(content);
            assert_eq!(
                read.is_ok(),
                name.starts_with("valid/"),
                "{name}: {:?}",
                read.err().map(|e| e.to_string())
            );
        }
    }
}
