//! Mitsuba 3: a blend of a diffuse and a rough conductor.

use super::{MetalMix, rgb};

pub(super) fn text(mix: &MetalMix) -> String {
    format!(
        "<!-- Mitsuba 3, RGB mode -->
<bsdf type=\"blendbsdf\" id=\"fit\" version=\"3.0.0\">
    <float name=\"weight\" value=\"{:.7}\"/>
    <bsdf type=\"diffuse\">
        <rgb name=\"reflectance\" value=\"{}\"/>
    </bsdf>
    <bsdf type=\"roughconductor\">
        <string name=\"distribution\" value=\"ggx\"/>
        <float name=\"alpha\" value=\"{:.7}\"/>
        <rgb name=\"eta\" value=\"1, 1, 1\"/>
        <rgb name=\"k\" value=\"{}\"/>
    </bsdf>
</bsdf>
",
        mix.amount,
        rgb(mix.diffuse, ", "),
        mix.alpha,
        rgb(mix.extinction(), ", ")
    )
}
