//! What is fitted: lobes whose shapes are found by iteration and whose weights follow from them.

use brdf::Brdf;
use glam::DVec3;

/// How a shape parameter is mapped to the unbounded-looking variable the iteration works in.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Scale {
    /// ln x: roughnesses and exponents, whose steps are ratios.
    Log,
    /// ln(x / (1 - x)): reflectances.
    Logit,
    /// x itself.
    Linear,
}

impl Scale {
    /// The iteration's variable.
    #[must_use]
    pub fn to_variable(self, x: f64) -> f64 {
        match self {
            Self::Log => x.ln(),
            Self::Logit => (x / (1.0 - x)).ln(),
            Self::Linear => x,
        }
    }

    /// The parameter, the inverse of [`Self::to_variable`].
    #[must_use]
    pub fn to_parameter(self, u: f64) -> f64 {
        match self {
            Self::Log => u.exp(),
            Self::Logit => 1.0 / (1.0 + (-u).exp()),
            Self::Linear => u,
        }
    }

    /// d parameter / d variable at the parameter `x`.
    #[must_use]
    pub fn slope(self, x: f64) -> f64 {
        match self {
            Self::Log => x,
            Self::Logit => x * (1.0 - x),
            Self::Linear => 1.0,
        }
    }
}

/// A parameter of the shape of the lobes.
#[derive(Clone, Debug, PartialEq)]
pub struct ShapeParameter {
    /// Its name in the model's text; lobes after the first append their number.
    pub name: String,
    /// Where it is searched for.
    pub range: (f64, f64),
    /// How it is searched for.
    pub scale: Scale,
    /// Where the search starts: the starts of one parameter are combined with those of the others.
    pub starts: Vec<f64>,
}

/// A weight, one number a channel, in which the model is linear.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Weight {
    /// Its name in the model's text.
    pub name: String,
    /// Whether it may be negative (basis functions), or not (energies).
    pub signed: bool,
}

/// The lobes at one shape: what each weight multiplies.
pub trait Lobes: Send + Sync {
    /// The value of every lobe, 1/sr, into `out` (one entry a weight). Both directions are above the horizon.
    fn eval(&self, wi: DVec3, wo: DVec3, out: &mut [f64]);
}

/// A model as a fit sees it: m = sum over k of `coefficient_k(weights)` times lobe k(shape).
pub trait Family: Send + Sync {
    /// What is typed.
    fn name(&self) -> &str;
    /// The parameters searched for.
    fn shape(&self) -> &[ShapeParameter];
    /// The weights solved for.
    fn weights(&self) -> &[Weight];
    /// How many lobes there are; as many as weights unless [`Self::coefficients`] says otherwise.
    fn lobe_count(&self) -> usize {
        self.weights().len()
    }
    /// The factor of every lobe for the weights of one channel, and whether that is more than the weights themselves.
    fn coefficients(&self, weights: &[f64], out: &mut [f64]) {
        out.copy_from_slice(weights);
    }
    /// Whether [`Self::coefficients`] hands on the weights as they are.
    fn is_linear(&self) -> bool {
        true
    }
    /// The lobes at a shape inside the ranges.
    fn lobes(&self, shape: &[f64]) -> Box<dyn Lobes>;
    /// The fitted model in the notation of `brdf_models::parse_model`, as a sum of parts.
    fn parts(&self, shape: &[f64], weights: &[Vec<f64>]) -> Vec<Part>;
}

/// One model of a sum, `scale * model`.
#[derive(Clone, Debug, PartialEq)]
pub struct Part {
    /// Name and parameters, `ward:alpha=0.1,ks=0.2/0.1/0.1,kd=0.3`.
    pub text: String,
    /// Factor per channel, at most one entry that is not 1 where weights leave the range of the model's text.
    pub scale: Vec<f64>,
}

/// A reflectance of `K` channels seen as `K` lobes: channel k was given weight k alone.
pub(crate) struct Channels<const K: usize>(pub(crate) std::sync::Arc<dyn Brdf<K>>);

impl<const K: usize> Lobes for Channels<K> {
    fn eval(&self, wi: DVec3, wo: DVec3, out: &mut [f64]) {
        out.copy_from_slice(&self.0.eval(wi, wo));
    }
}

#[cfg(test)]
mod tests {
    use super::Scale;

    #[test]
    fn variables_and_parameters_are_inverse() {
        for (scale, x) in [
            (Scale::Log, 1e-4),
            (Scale::Logit, 0.04),
            (Scale::Linear, -0.3),
        ] {
            let u = scale.to_variable(x);
            assert!((scale.to_parameter(u) - x).abs() < 1e-15, "{scale:?}");
            let h = 1e-5;
            let numeric = (scale.to_parameter(u + h) - scale.to_parameter(u - h)) / (2.0 * h);
            // central difference: h^2/6 of the third derivative
            assert!(
                (numeric - scale.slope(x)).abs() < 1e-10,
                "{scale:?} {numeric}"
            );
        }
    }
}
