//! `cargo xtask interpolation`: how well each scheme predicts rows it has not seen, on the Cornell files at hand.

use anyhow::{Context, Result};
use brdf_formats::AstmFile;
use brdf_table::SampleCloud;
use brdf_table::scattered::validation::{
    SCHEMES, Scheme, Scores, leave_one_ring_out, leave_tenth_out,
};
use std::path::PathBuf;

type Measure = fn(&SampleCloud, Scheme) -> Result<Scores, brdf_table::CloudError>;

const MEASURES: [(&str, Measure); 2] = [
    ("one ring of incidence left out", leave_one_ring_out),
    ("every tenth row left out", leave_tenth_out),
];

pub(crate) fn run(args: &[String]) -> Result<()> {
    let folder = match args.first() {
        Some(folder) => PathBuf::from(folder),
        None => PathBuf::from(
            std::env::var_os("GONIO_DATA")
                .context("usage: cargo xtask interpolation [DIR], or set GONIO_DATA")?,
        )
        .join("cornell"),
    };
    let mut files: Vec<PathBuf> = std::fs::read_dir(&folder)
        .with_context(|| folder.display().to_string())?
        .filter_map(|e| Some(e.ok()?.path()))
        .filter(|p| p.extension().is_some_and(|e| e == "astm"))
        .collect();
    files.sort();
    for file in files {
        let bytes = std::fs::read(&file).with_context(|| file.display().to_string())?;
        let cloud = SampleCloud::from_astm(&AstmFile::from_bytes(&bytes)?)?;
        println!("\n{}", file.display());
        for (what, measure) in MEASURES {
            println!("  {what}: median |log|, near-specular RMS log, RMS log, relative L2");
            for (name, scheme) in SCHEMES {
                let s = measure(&cloud, scheme)?;
                println!(
                    "    {name:<16} {:.3}  {:.3}  {:.3}  {:.3}",
                    s.median_log, s.specular_rms_log, s.rms_log, s.relative_l2
                );
            }
        }
    }
    Ok(())
}
