//! What is answered where nothing was measured, by name.

/// What negative values become.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum NegativePolicy {
    /// They stay: colours outside the RGB gamut are data.
    #[default]
    Keep,
    /// They become 0, which shifts the hue of saturated colours.
    Clamp,
}

impl NegativePolicy {
    /// Applies the choice to an answer.
    #[inline]
    pub(crate) fn apply(self, values: &mut [f64]) {
        if self == Self::Clamp {
            values.iter_mut().for_each(|v| *v = v.max(0.0));
        }
    }
}

/// What lies beyond the most grazing directions measured (for Cornell, 80 degrees).
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum BeyondPolicy {
    /// The surface at the edge, reached by shrinking theta_h and theta_d by one factor at constant phi_d, times the
    /// rise of Fresnel reflection after [Schlick1994] from there. How strong the rise is, a smooth function of
    /// theta_h, is fitted to the measured rise toward the edge: never falling, no steeper than F0 = 0.04 allows,
    /// and without rise where the rows do not show one. Continuous everywhere.
    #[default]
    Schlick,
    /// The nearest row: the policy of the thesis.
    Nearest,
}

/// What lies in the hole around the incident direction, and above the steepest incidence measured.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum GapPolicy {
    /// The interpolant's own smooth continuation.
    #[default]
    Extend,
    /// The nearest row: the policy of the thesis.
    Nearest,
}

/// What happens to rows that contradict all their neighbours (a shadowed detector reads almost zero).
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum DeadRows {
    /// They are answered at their own angles only and bend nothing around them.
    #[default]
    Isolate,
    /// They take part like all others.
    Keep,
}

/// One choice of each kind.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Policies {
    /// Negative values.
    pub negative: NegativePolicy,
    /// Grazing directions.
    pub beyond: BeyondPolicy,
    /// Hole around the incident direction and steep incidence.
    pub gap: GapPolicy,
    /// Rows without signal.
    pub dead: DeadRows,
}
