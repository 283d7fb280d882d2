//! Significance levels when several hypotheses are tested at once.

/// The level each of `n` independent tests must use so that all together have level `level`
/// [Sidak1967]: 1 - (1 - level)^(1/n).
///
/// `level` in (0, 1); `n` = 0 counts as 1.
#[must_use]
pub fn sidak(level: f64, n: usize) -> f64 {
    -((-level).ln_1p() / n.max(1) as f64).exp_m1()
}

/// The index of the smallest of `p_values` if it is significant at the joint `level`, `None` if all
/// agree with their hypothesis. A NaN counts as significant.
#[must_use]
pub fn significant(p_values: &[f64], level: f64) -> Option<usize> {
    let each = sidak(level, p_values.len());
    let worst = |p: &f64| if p.is_nan() { -1.0 } else { *p };
    let (k, p) = p_values
        .iter()
        .map(worst)
        .enumerate()
        .min_by(|a, b| a.1.total_cmp(&b.1))?;
    (p < each).then_some(k)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn joint_level_is_kept() {
        for n in [1, 7, 1000, 10_000_000] {
            let each = sidak(0.01, n);
            let joint = -(n as f64 * (-each).ln_1p()).exp_m1();
            assert!((joint - 0.01).abs() < 1e-12, "{n}: {joint}");
        }
    }

    #[test]
    fn finds_the_worst_and_only_when_it_is_bad_enough() {
        assert_eq!(significant(&[0.3, 0.004, 0.9], 0.01), None);
        assert_eq!(significant(&[0.3, 0.003, 0.9], 0.01), Some(1));
        assert_eq!(significant(&[0.3, f64::NAN], 0.01), Some(1));
        assert_eq!(significant(&[], 0.01), None);
    }
}
