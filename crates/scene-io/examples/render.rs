//! The smallest renderer on top of this library: `render SCENE.ron OUT.exr [SPP] [DATA_DIR]`.

use scene_io::image::{Metadata, Picture, write_exr, write_png};
use scene_io::{DataDirs, Overrides, Places, SceneFile, build_scene};
use std::path::{Path, PathBuf};
use std::time::Instant;
use tracer::{Film, render};

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let arguments: Vec<String> = std::env::args().collect();
    let [_, scene, out, rest @ ..] = arguments.as_slice() else {
        return Err("usage: render SCENE.ron OUT.exr [SPP] [DATA_DIR]".into());
    };
    let overrides = Overrides {
        spp: rest.first().map(|n| n.parse()).transpose()?,
        ..Overrides::default()
    };
    let places = Places {
        data: DataDirs::new(rest.get(1).map(PathBuf::from)),
        ..Places::default()
    };
    let built = build_scene(SceneFile::load(Path::new(scene))?, &overrides, &places)?;
    let (width, height) = built.size;
    let mut film = Film::<3>::new(width, height, 8);
    let start = Instant::now();
    render(&built.scene, &built.settings, &mut film, &())?;
    let mut picture = Picture::of_film(&film)?;
    picture.metadata = Metadata {
        scene: Some(scene.clone()),
        seed: Some(built.settings.seed),
        spp: Some(u64::from(film.spp())),
        seconds: Some(start.elapsed().as_secs_f64()),
        version: Some(env!("CARGO_PKG_VERSION").into()),
        sampler: built.materials.first().map(|m| m.sampler.name.to_string()),
    };
    write_exr(Path::new(out), &picture)?;
    let png = Path::new(out).with_extension("png");
    write_png(&png, &picture, built.tone_map(&picture))?;
    Ok(())
}
