//! pbrt-v4: a mixture of a diffuse and a conductor.

use super::{MetalMix, rgb};

pub(super) fn text(mix: &MetalMix) -> String {
    format!(
        "# pbrt-v4; what pbrt calls roughness is alpha here, not remapped
MakeNamedMaterial \"fit-diffuse\" \"string type\" \"diffuse\" \"rgb reflectance\" [{}]
MakeNamedMaterial \"fit-metal\" \"string type\" \"conductor\" \"rgb reflectance\" [{}] \"float roughness\" [{:.7}] \"bool remaproughness\" false
MakeNamedMaterial \"fit\" \"string type\" \"mix\" \"string materials\" [\"fit-diffuse\" \"fit-metal\"] \"float amount\" [{:.7}]
",
        rgb(mix.diffuse, " "),
        rgb(mix.reflectance, " "),
        mix.alpha,
        mix.amount
    )
}
