//! `gonio compare A.exr B.exr`.

use super::Context;
use crate::args::Compare;
use anyhow::{Context as _, Result};
use scene_io::image::read_exr;
use serde::Serialize;
use std::fmt::{self, Write};

#[derive(Serialize)]
struct Report {
    rmse: f64,
    rel_mse: f64,
    rel_rmse: f64,
    mae: f64,
    mean_a: f64,
    mean_b: f64,
    not_finite: usize,
    #[serde(skip_serializing_if = "Option::is_none")]
    z: Option<Z>,
}

#[derive(Serialize)]
struct Z {
    count: usize,
    mean: f64,
    mean_square: f64,
    max_abs: f64,
    share_above_3: f64,
    of_means: f64,
}

pub(crate) fn run(context: &Context, args: &Compare) -> Result<()> {
    let m = scene_io::compare(&read_exr(&args.a)?, &read_exr(&args.b)?)
        .with_context(|| format!("{} and {}", args.a.display(), args.b.display()))?;
    let report = Report {
        rmse: m.rmse,
        rel_mse: m.rel_mse,
        rel_rmse: m.rel_rmse,
        mae: m.mae,
        mean_a: m.mean_a,
        mean_b: m.mean_b,
        not_finite: m.not_finite,
        z: m.z.map(|z| Z {
            count: z.count,
            mean: z.mean,
            mean_square: z.mean_square,
            max_abs: z.max_abs,
            share_above_3: z.share_above_3,
            of_means: z.of_means,
        }),
    };
    context.report(&report, |out| print(&report, out))
}

fn print(r: &Report, out: &mut String) -> fmt::Result {
    writeln!(out, "rmse      {:.6e}", r.rmse)?;
    writeln!(out, "rel_mse   {:.6e}", r.rel_mse)?;
    writeln!(out, "rel_rmse  {:.6e}", r.rel_rmse)?;
    writeln!(out, "mae       {:.6e}", r.mae)?;
    writeln!(
        out,
        "mean      {:.6e} (a), {:.6e} (b), ratio {:.6}",
        r.mean_a,
        r.mean_b,
        r.mean_a / r.mean_b
    )?;
    if r.not_finite > 0 {
        writeln!(out, "not finite: {} values", r.not_finite)?;
    }
    match &r.z {
        Some(z) => writeln!(
            out,
            "z         of means {:.2}; per pixel: mean {:.3}, mean square {:.3}, |z| > 3 in {:.2} %, largest {:.1}",
            z.of_means,
            z.mean,
            z.mean_square,
            100.0 * z.share_above_3,
            z.max_abs
        ),
        None => writeln!(out, "z         needs variances in both images"),
    }
}
