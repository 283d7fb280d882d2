//! What a case has seen: the worst relative error and where, and what must never come out of a function.

use rayon::prelude::*;

/// Counts over the grid of one case.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Tally {
    /// Comparisons and checks made.
    pub count: u64,
    /// Largest relative error; infinite where anything was not a number.
    pub worst: f64,
    /// Where that was.
    pub place: String,
    /// Results that are no number.
    pub nan: u64,
    /// Infinite results.
    pub inf: u64,
    /// Results below zero where none may be.
    pub negative: u64,
    /// Results so small that their digits are cut (subnormal); counted, not wrong.
    pub denormal: u64,
    /// The first result that is not a finite number of the right sign.
    pub broken: String,
}

impl Tally {
    /// What `f` sees of every item, in parallel, added up in their order.
    pub fn each<T: Sync>(&mut self, items: &[T], f: impl Fn(&T, &mut Self) + Sync) {
        let seen = items.par_iter().with_max_len(1).map(|item| {
            let mut own = Self::default();
            f(item, &mut own);
            own
        });
        for own in seen.collect::<Vec<_>>() {
            self.add(own);
        }
    }

    /// Adds what was seen later.
    fn add(&mut self, later: Self) {
        self.count += later.count;
        self.nan += later.nan;
        self.inf += later.inf;
        self.negative += later.negative;
        self.denormal += later.denormal;
        if later.worst > self.worst {
            (self.worst, self.place) = (later.worst, later.place);
        }
        if self.broken.is_empty() {
            self.broken = later.broken;
        }
    }

    /// Compares a result that must not be negative with its reference: |value - reference| / max(reference, floor).
    ///
    /// The floor is where digits stop to matter: values below it need only be as small.
    pub fn value(&mut self, value: f64, reference: f64, floor: f64, place: impl Fn() -> String) {
        if value < 0.0 {
            self.negative += 1;
            self.breaks(&place, value);
        }
        self.signed(value, reference, floor, place);
    }

    /// [`Self::value`] for results of either sign.
    pub fn signed(&mut self, value: f64, reference: f64, floor: f64, place: impl Fn() -> String) {
        if self.finite(value, &place) {
            let error = (value - reference).abs() / reference.abs().max(floor);
            self.error(error, || {
                format!("{}: {value:e} for {reference:e}", place())
            });
        }
    }

    /// An error worked out elsewhere.
    pub fn error(&mut self, error: f64, place: impl Fn() -> String) {
        self.count += 1;
        // a reference that is no number must not pass
        let error = if error.is_nan() { f64::INFINITY } else { error };
        if error > self.worst {
            self.worst = error;
            self.place = place();
        }
    }

    /// Checks that a result is finite and not negative.
    pub fn sound(&mut self, value: f64, place: impl Fn() -> String) {
        self.count += 1;
        if self.finite(value, &place) && value < 0.0 {
            self.negative += 1;
            self.breaks(&place, value);
        }
    }

    /// Checks that a result of either sign is finite.
    pub fn number(&mut self, value: f64, place: impl Fn() -> String) {
        self.count += 1;
        self.finite(value, &place);
    }

    /// Counts what is not finite, and subnormal numbers of either precision.
    fn finite(&mut self, value: f64, place: &impl Fn() -> String) -> bool {
        self.denormal += u64::from(value.is_subnormal());
        if value.is_nan() {
            self.nan += 1;
        } else if value.is_infinite() {
            self.inf += 1;
        } else {
            return true;
        }
        self.breaks(place, value);
        false
    }

    fn breaks(&mut self, place: &impl Fn() -> String, value: f64) {
        if self.broken.is_empty() {
            self.broken = format!("{}: {value:e}", place());
        }
    }
}

#[cfg(test)]
mod tests {
    use super::Tally;

    #[test]
    fn items_in_parallel_are_seen_in_their_order() {
        let items: Vec<u32> = (0..100).collect();
        let see = |k: &u32, tally: &mut Tally| {
            let value = if *k == 40 || *k == 70 { f64::NAN } else { 1.0 };
            let reference = 1.0 - f64::from(*k % 50) * 1e-3;
            tally.value(value, reference, 0.0, || format!("item {k}"));
        };
        let (mut parallel, mut serial) = (Tally::default(), Tally::default());
        parallel.each(&items, see);
        items.iter().for_each(|k| see(k, &mut serial));
        assert_eq!(parallel, serial);
        assert!(
            parallel.broken.starts_with("item 40"),
            "{}",
            parallel.broken
        );
    }

    #[test]
    fn the_worst_is_kept_with_its_place() {
        let mut tally = Tally::default();
        tally.value(1.0, 1.0, 0.0, || "fine".into());
        tally.value(1.1, 1.0, 0.0, || "off".into());
        tally.value(1.01, 1.0, 0.0, || "near".into());
        assert!(
            (tally.worst - 0.1).abs() < 1e-12 && tally.place.starts_with("off"),
            "{tally:?}"
        );
        assert_eq!(tally.count, 3);
    }

    #[test]
    fn whatever_must_not_be_is_counted() {
        let mut tally = Tally::default();
        for value in [f64::NAN, f64::INFINITY, -1.0, 1e-310, 1.0] {
            tally.sound(value, || "x".into());
        }
        assert_eq!(
            [tally.nan, tally.inf, tally.negative, tally.denormal],
            [1; 4]
        );
        assert!(tally.broken.contains("NaN"), "{tally:?}");
        tally.value(1.0, f64::NAN, 0.0, || "y".into());
        assert!(
            tally.worst.is_infinite(),
            "a reference that is no number: {tally:?}"
        );
    }

    #[test]
    fn below_the_floor_only_the_size_counts() {
        let mut tally = Tally::default();
        tally.value(0.0, 1e-300, 1e-290, || "small".into());
        assert!(tally.worst < 1e-9, "{tally:?}");
    }
}
