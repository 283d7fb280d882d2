//! Which render this is: what a checkpoint must have in common with the render that goes on from it.

use crate::build::Places;
use crate::load;
use crate::scene::{FormSpec, LightSpec, MaterialSpec, SceneFile};
use crate::sealed::content_hash;
use std::fmt::Write as _;
use std::path::{Path, PathBuf};
use tracer::Settings;

/// Largest file that is looked into, bytes: 4 GiB.
const MAX_BYTES: u64 = 4 << 30;

/// A hash of everything the samples of a render depend on but their number: the scene with all overrides, the way light
/// is found, the content of every file it names, and the version of this program.
///
/// It does not depend on where files lie, so that parts of a picture can be rendered on several machines. Files that
/// can't be read count as empty: a render that needs them has failed before.
#[must_use]
pub fn fingerprint(file: &SceneFile, settings: &Settings, places: &Places) -> u64 {
    let mut file = file.clone();
    let mut text = format!(
        "{} {:?} {} ",
        env!("CARGO_PKG_VERSION"),
        settings.strategy,
        settings.seed
    );
    let mut swap = |path: &mut PathBuf, home: &mut PathBuf| {
        let found = places.data.find(path, home);
        let bytes = found.and_then(|p: PathBuf| load::bytes(Path::new(&p), MAX_BYTES));
        let hash = content_hash(&bytes.unwrap_or_default());
        let written = write!(text, "{hash:x} ");
        debug_assert!(written.is_ok(), "a string takes all");
        *path = PathBuf::new();
        *home = PathBuf::new();
    };
    for material in file.materials.values_mut() {
        if let MaterialSpec::File(m) = material {
            swap(&mut m.path, &mut m.home);
        }
    }
    for shape in &mut file.shapes {
        if let FormSpec::Mesh { path, home, .. } = &mut shape.form {
            swap(path, home);
        }
    }
    for light in &mut file.lights {
        if let LightSpec::Image { path, home, .. } = light {
            swap(path, home);
        }
    }
    file.path = PathBuf::new();
    file.about = String::new();
    file.render.spp = 0;
    content_hash(format!("{text}{file:?}").as_bytes())
}
