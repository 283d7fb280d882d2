//! A GLSL function of the fitted model.

use super::rgb;
use crate::Part;
use brdf_models::{Values, parse_model};

/// `vec3 brdf(vec3 wi, vec3 wo)` in the local frame, z the normal; `None` if a part has no GLSL.
pub(super) fn text(parts: &[Part]) -> Option<String> {
    let mut body = String::new();
    for part in parts {
        let parsed = parse_model(&part.text).ok()?;
        let scale = <[f64; 3]>::try_from(&part.scale[..]).ok()?;
        let weight = |name: &str| -> [f64; 3] {
            let v = parsed.values.get(name);
            std::array::from_fn(|c| scale[c] * v.get(c).or(v.first()).copied().unwrap_or(0.0))
        };
        let name = parsed.info.name;
        let kd = rgb(weight("kd").map(|k| k * std::f64::consts::FRAC_1_PI), ", ");
        body.push_str(&format!("    f += vec3({kd});\n"));
        match name {
            "lambert" => {}
            "lafortune" => lafortune(&parsed.values, weight, &mut body),
            _ => {
                let lobe = lobe(name, &parsed.values)?;
                let ks = rgb(weight("ks"), ", ");
                body.push_str(&format!("    f += vec3({ks}) * {lobe};\n"));
            }
        }
    }
    Some(format!("{HEAD}{body}    return f;\n}}\n"))
}

fn lafortune(values: &Values, weight: impl Fn(&str) -> [f64; 3], body: &mut String) {
    for j in 1.. {
        let of = |name: &str| {
            if j == 1 {
                name.to_owned()
            } else {
                format!("{name}{j}")
            }
        };
        let at = |name: &str| values.get(&of(name)).first().copied();
        let (Some(n), Some(cx), Some(cy), Some(cz)) = (at("n"), at("cx"), at("cy"), at("cz"))
        else {
            return;
        };
        let ks = weight(&of("ks")).map(|k| k * (n + 2.0) / std::f64::consts::TAU);
        body.push_str(&format!(
            "    f += vec3({}) * pow(max(dot(wi * wo, vec3({cx:.7}, {cy:.7}, {cz:.7})), 0.0), {n:.7});\n",
            rgb(ks, ", ")
        ));
    }
}

/// The lobe of unit weight as an expression of the variables of [`HEAD`].
fn lobe(name: &str, values: &Values) -> Option<String> {
    let at = |name: &str| values.get(name).first().copied();
    let n = || at("n");
    Some(match name {
        "phong" => format!("pow(r, {:.7}) / ci", n()?),
        "lewis" => format!(
            "{:.7} * pow(r, {:.7})",
            (n()? + 2.0) / std::f64::consts::TAU,
            n()?
        ),
        "blinn-phong" => {
            let n = n()?;
            let scale =
                (n + 2.0) * (n + 4.0) / (8.0 * std::f64::consts::PI * ((-0.5 * n).exp2() + n));
            format!("{scale:.7} * pow(hz, {n:.7})")
        }
        "ward" => format!("ward(tan2, {:.7}) / (4.0 * sqrt(ci * co))", at("alpha")?),
        "ward-duer" => format!("ward(tan2, {:.7}) / (4.0 * ci * co)", at("alpha")?),
        "ward-gmd" => format!(
            "ward(tan2, {:.7}) * dot(H, H) / (H.z * H.z * H.z * H.z)",
            at("alpha")?
        ),
        "cook-torrance" => {
            let (m, index) = (at("m")?, index(at("f0")?));
            format!(
                "fresnel(cd, {index:.7}) * beckmann(tan2, {m:.7}) * min(1.0, 2.0 * hz * min(ci, co) / cd) / (4.0 * ci * co)"
            )
        }
        "ggx" => {
            let (a, index) = (at("alpha")?, index(at("f0")?));
            format!("fresnel(cd, {index:.7}) * ggx(wi, wo, h, {a:.7})")
        }
        "ashikhmin-lobe" => {
            let (n, f0) = (n()?, at("f0")?);
            let scale = (n + 1.0) / (8.0 * std::f64::consts::PI);
            format!(
                "{scale:.7} * pow(hz, {n:.7}) * ({f0:.7} + {:.7} * pow(1.0 - cd, 5.0)) / (cd * max(ci, co))",
                1.0 - f0
            )
        }
        _ => return None,
    })
}

/// Refractive index of a reflectance at normal incidence.
fn index(f0: f64) -> f64 {
    let s = f0.sqrt();
    (1.0 + s) / (1.0 - s)
}

const HEAD: &str = "\
// f_r in 1/sr, without the cosine. wi toward the light, wo toward the viewer, unit, z along the normal.
const float PI = 3.14159265;

float ward(float tan2, float a) { return exp(-tan2 / (a * a)) / (PI * a * a); }

float beckmann(float tan2, float m) {
    float sec2 = 1.0 + tan2;
    return exp(-tan2 / (m * m)) * sec2 * sec2 / (PI * m * m);
}

float fresnel(float c, float n) {
    float g = sqrt(n * n + c * c - 1.0);
    float a = (g - c) / (g + c);
    float b = (c * (g + c) - 1.0) / (c * (g - c) + 1.0);
    return 0.5 * a * a * (1.0 + b * b);
}

float ggx(vec3 wi, vec3 wo, vec3 h, float a) {
    vec3 s = vec3(a, a, 1.0);
    float q = dot(h.xy, h.xy) / (a * a) + h.z * h.z;
    float d = 1.0 / (PI * a * a * q * q);
    return 0.5 * d / (length(s * wi) * wo.z + length(s * wo) * wi.z);
}

vec3 brdf(vec3 wi, vec3 wo) {
    float ci = wi.z, co = wo.z;
    if (ci <= 0.0 || co <= 0.0) return vec3(0.0);
    vec3 H = wi + wo, h = normalize(H);
    float hz = h.z, cd = dot(h, wi), tan2 = dot(H.xy, H.xy) / (H.z * H.z);
    float r = max(dot(vec3(-wo.xy, wo.z), wi), 0.0);
    vec3 f = vec3(0.0);
";
