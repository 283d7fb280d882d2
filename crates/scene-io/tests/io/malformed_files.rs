//! Broken images, meshes and caches and the one line each of them is answered with.

use brdf_sampling::{Proposal, RejectionCache};
use scene_io::image::read_exr_bytes;
use scene_io::{Cache, mesh, write};

const TETRAHEDRON: &str =
    "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 2 3 4\nf 1 4 3\n";

const PLY: &str = "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\n\
    element face 1\nproperty list uchar int vertex_indices\nend_header\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n";

#[test]
fn sound_meshes_are_read() {
    let obj = mesh::from_bytes(TETRAHEDRON.as_bytes()).unwrap();
    assert_eq!(
        (obj.positions.len(), obj.triangles.len(), obj.dropped),
        (4, 4, 0)
    );
    let ply = mesh::from_bytes(PLY.as_bytes()).unwrap();
    assert_eq!(
        (ply.positions.len(), ply.triangles, ply.normals),
        (3, vec![[0, 1, 2]], None)
    );
}

#[test]
fn degenerate_faces_are_dropped_and_counted() {
    let text = format!("{TETRAHEDRON}f 1 1 2\nf 1 2 1\n");
    let obj = mesh::from_bytes(text.as_bytes()).unwrap();
    assert_eq!((obj.triangles.len(), obj.dropped), (4, 2));
}

#[test]
fn normals_and_polygons_of_both_formats_are_kept() {
    let obj = "v 0 0 0\nv 2 0 0\nv 2 2 0\nv 0 2 0\nvn 0 0 3\nf 1//1 2//1 3//1 4//1\n";
    let ply = PLY
        .replace(
            "property float z\n",
            "property float z\nproperty float nx\nproperty float ny\nproperty float nz\n",
        )
        .replace(
            "0 0 0\n1 0 0\n0 1 0\n",
            "0 0 0 0 0 2\n1 0 0 0 0 2\n0 1 0 0 0 2\n",
        );
    for (text, triangles) in [(obj, 2), (&ply, 1)] {
        let mesh = mesh::from_bytes(text.as_bytes()).unwrap();
        assert_eq!(mesh.triangles.len(), triangles, "{text}");
        assert!(
            mesh.normals.unwrap().iter().all(|n| *n == glam::Vec3::Z),
            "{text}"
        );
    }
}

#[test]
fn broken_meshes_are_refused_in_one_line() {
    let swap = |from: &str, to: &str| PLY.replace(from, to);
    let cases: Vec<(String, &str)> = vec![
        (
            String::new(),
            "expected a mesh in OBJ or PLY, found neither",
        ),
        (
            "solid name\nfacet normal".into(),
            "expected a mesh in OBJ or PLY, found neither",
        ),
        (
            "v 0 0 0\nv 1 0 0\nv 0 1 0\n".into(),
            "expected triangles, found none (0 without area)",
        ),
        (
            "v 0 0 0\nf 1 1 1\n".into(),
            "expected triangles, found none (1 without area)",
        ),
        (
            "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 9\n".into(),
            "broken OBJ file: ",
        ),
        ("v 0 0 zero\nf 1 1 1\n".into(), "broken OBJ file: "),
        (
            "v nan 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n".into(),
            "expected finite coordinates, found ",
        ),
        (
            swap("3 0 1 2", "3 0 1 7"),
            "expected indices below 3 (the vertices), found 7 in triangle 0",
        ),
        (
            swap("3 0 1 2", "3 0 1 -1"),
            "expected indices below 3 (the vertices), found 4294967295 in triangle 0",
        ),
        (swap("0 1 0\n3 0 1 2\n", ""), "broken PLY file: "),
        (
            swap("element vertex 3", "element vertex 4000000000"),
            "broken PLY file: expected at most ",
        ),
        (
            swap("property list uchar int vertex_indices\n", ""),
            "broken PLY file: expected properties of element \"face\", found none",
        ),
        (
            swap("format ascii 1.0", "format morse 1.0"),
            "broken PLY file: ",
        ),
        (swap("0 0 0\n", "inf 0 0\n"), "broken PLY file: Line 10: "),
        (swap("float x", "list uchar float x"), "broken PLY file: "),
    ];
    for (text, expected) in cases {
        let error = mesh::from_bytes(text.as_bytes())
            .expect_err(&text)
            .to_string();
        assert!(error.starts_with(expected), "{text:?}: {error}");
        assert!(!error.contains('\n'), "{error}");
    }
}

#[test]
fn broken_images_are_refused_in_one_line() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("a.exr");
    let picture = scene_io::image::Picture::new(64, 64, vec![[1.5; 3]; 64 * 64]).unwrap();
    scene_io::image::write_exr(&path, &picture).unwrap();
    let sound = scene_io::load::bytes(&path, 1 << 20).unwrap();
    let mut huge = sound.clone();
    let window = sound.windows(10).position(|w| w == b"dataWindow").unwrap() + 10 + 1 + 6 + 4;
    for at in [window + 8, window + 12] {
        huge[at..at + 4].copy_from_slice(&1_000_000_i32.to_le_bytes());
    }
    let grey = {
        use exr::prelude::{Image, SpecificChannels, WritableImage};
        let channels = SpecificChannels::build()
            .with_channel("depth")
            .with_pixel_fn(|_| (1.0_f32,));
        let mut file = std::io::Cursor::new(Vec::new());
        Image::from_channels((2, 2), channels)
            .write()
            .to_buffered(&mut file)
            .unwrap();
        file.into_inner()
    };
    let cases: Vec<(&[u8], &str)> = vec![
        (b"", "broken EXR file: "),
        (b"\x89PNG\r\n\x1a\n", "broken EXR file: "),
        (&sound[..100], "broken EXR file: "),
        (&sound[..sound.len() - 20], "broken EXR file: "),
        (
            &huge,
            "expected 1 to 67108864 pixels, found 1000001 x 1000001",
        ),
        (&grey, "expected channels R, G, B or Y, found none of them"),
    ];
    for (k, (bytes, expected)) in cases.into_iter().enumerate() {
        let error = read_exr_bytes(bytes).expect_err(expected).to_string();
        assert!(error.starts_with(expected), "case {k}: {error}");
        assert!(!error.contains('\n'), "{error}");
    }
}

#[test]
fn a_broken_cache_costs_time_and_a_note_but_nothing_else() {
    let folder = tempfile::tempdir().unwrap();
    let cache = Cache::at(folder.path().join("made/when/needed"));
    let truth = RejectionCache {
        n_theta: 3,
        n_phi: 1,
        proposal: Proposal::Uniform,
        maxima: vec![1.0, 2.0, 3.0],
        integrals: vec![0.5, 0.25, 0.125],
    };
    let mut notes = Vec::new();
    let first = cache.rejection(5, &mut notes, || truth.clone());
    let again = cache.rejection(5, &mut notes, || panic!("expected the stored cache"));
    assert_eq!((&first, &again, notes.len()), (&truth, &truth, 0));

    let path = cache.rejection_path(5).unwrap();
    let sound = scene_io::load::bytes(&path, 1 << 20).unwrap();
    let mut flipped = sound.clone();
    flipped[40] ^= 1;
    for (broken, why) in [
        (&flipped[..], "the checksum does not match"),
        (&sound[..sound.len() - 1], "expected 108 bytes, found 107"),
        (b"not a cache", "expected a file of this kind"),
        (b"", "expected a file of this kind"),
    ] {
        write::bytes(&path, broken).unwrap();
        let mut notes = Vec::new();
        assert_eq!(cache.rejection(5, &mut notes, || truth.clone()), truth);
        assert_eq!(notes.len(), 1, "{notes:?}");
        assert!(notes[0].contains(why), "{notes:?}");
        let rebuilt = scene_io::load::bytes(&path, 1 << 20).unwrap();
        assert_eq!(rebuilt, sound, "not rebuilt after: {why}");
    }
    // another key never finds this file's content, even under its name
    std::fs::rename(&path, cache.rejection_path(6).unwrap()).unwrap();
    let mut notes = Vec::new();
    cache.rejection(6, &mut notes, || truth.clone());
    assert!(notes[0].contains("belongs to other input"), "{notes:?}");
}
