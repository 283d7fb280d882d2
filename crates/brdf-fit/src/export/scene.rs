//! gonio's own scenes.

use super::rgb;
use crate::Part;

/// A scene of a ball of the fit under a small sun.
pub(super) fn text(parts: &[Part]) -> String {
    format!(
        "(
    about: \"a fitted material\",
    camera: (position: (0, 1.6, 6), target: (0, 1, 0), fov_y_deg: 28),
    main_material: \"fit\",
    materials: {{
{}        \"ground\": Lambert(reflectance: 0.4),
    }},
    shapes: [
        (form: Sphere(center: (0, 1, 0), radius: 1), material: \"fit\"),
        (form: Quad(corner: (-20, 0, 20), edge_u: (40, 0, 0), edge_v: (0, 0, -40)), material: \"ground\"),
    ],
    lights: [Constant(radiance: 0.4), Directional(direction: (-1, -1.5, -1), irradiance: 2)],
)
",
        materials("fit", parts)
    )
}

/// One line a material; the last is `name`. What is not one model with factor 1 becomes a mixture, which is tabulated.
pub(super) fn materials(name: &str, parts: &[Part]) -> String {
    let model = |part: &Part| {
        let scale = <[f64; 3]>::try_from(&part.scale[..]).unwrap_or([1.0; 3]);
        let is_one = scale.iter().all(|s| (s - 1.0).abs() <= 0.0);
        let scale = if is_one {
            String::new()
        } else {
            format!(", scale: ({})", rgb(scale, ", "))
        };
        format!("Model(model: \"{}\"{scale})", part.text)
    };
    if let [part] = parts {
        return format!("        \"{name}\": {},\n", model(part));
    }
    let mut text = String::new();
    let mut names = Vec::new();
    for (k, part) in parts.iter().enumerate() {
        text.push_str(&format!("        \"{name}-{}\": {},\n", k + 1, model(part)));
        names.push(format!("(\"{name}-{}\", 1)", k + 1));
    }
    text.push_str(&format!(
        "        \"{name}\": Mix(parts: [{}]),\n",
        names.join(", ")
    ));
    text
}
