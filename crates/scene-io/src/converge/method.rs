//! What is compared: a sampler, the points that drive it, and how light is found.

use crate::scene::{PointsName, SamplerName};
use std::fmt;
use std::str::FromStr;
use tracer::{PointSet, Strategy};

/// A way to render: `hvt+sobol+mis`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Method {
    /// How directions are chosen.
    pub sampler: SamplerName,
    /// Where random numbers come from.
    pub points: PointsName,
    /// How light is found.
    pub strategy: Strategy,
}

/// The names of strategies.
const STRATEGIES: &[(&str, Strategy)] = &[
    ("mis", Strategy::Mis),
    ("ris", Strategy::Ris),
    ("light", Strategy::LightOnly),
    ("bsdf", Strategy::BsdfOnly),
];

/// The names of point sets; the last of a kind is another word for it.
const POINTS: &[(&str, PointsName)] = &[
    ("sobol", PointsName::Sobol),
    ("halton", PointsName::Halton),
    ("random", PointsName::Independent),
    ("independent", PointsName::Independent),
];

impl Method {
    /// The tracer's name of the points.
    #[must_use]
    pub fn point_set(&self) -> PointSet {
        match self.points {
            PointsName::Sobol => PointSet::Sobol,
            PointsName::Halton => PointSet::Halton,
            PointsName::Independent => PointSet::Independent,
        }
    }
}

impl FromStr for Method {
    type Err = String;

    /// `SAMPLER`, `SAMPLER+POINTS`, `SAMPLER+LIGHT` or all three in any order after the first; what is left out is
    /// `sobol` and `mis`.
    fn from_str(text: &str) -> Result<Self, String> {
        let mut words = text.split('+');
        let mut method = Self {
            sampler: words.next().unwrap_or_default().parse()?,
            points: PointsName::Sobol,
            strategy: Strategy::Mis,
        };
        for word in words {
            if let Some((_, points)) = POINTS.iter().find(|(name, _)| *name == word) {
                method.points = *points;
            } else if let Some((_, strategy)) = STRATEGIES.iter().find(|(name, _)| *name == word) {
                method.strategy = *strategy;
            } else {
                let names: Vec<&str> = (POINTS.iter().map(|(n, _)| *n))
                    .chain(STRATEGIES.iter().map(|(n, _)| *n))
                    .collect();
                return Err(format!(
                    "expected points or a light strategy ({}), found \"{}\"",
                    names.join(", "),
                    word.chars().take(40).collect::<String>()
                ));
            }
        }
        Ok(method)
    }
}

impl fmt::Display for Method {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let points = POINTS.iter().find(|(_, p)| *p == self.points);
        let strategy = STRATEGIES.iter().find(|(_, s)| *s == self.strategy);
        write!(
            f,
            "{}+{}+{}",
            self.sampler,
            points.map_or("?", |(name, _)| name),
            strategy.map_or("?", |(name, _)| name)
        )
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_are_read_back() {
        for (text, full) in [
            ("hvt", "hvt+sobol+mis"),
            ("cosine+random", "cosine+random+mis"),
            ("hvt-fine+bsdf", "hvt-fine+sobol+bsdf"),
            ("native+light+halton", "native+halton+light"),
            ("rejection+independent+mis", "rejection+random+mis"),
        ] {
            let method: Method = text.parse().unwrap();
            assert_eq!(method.to_string(), full);
            assert_eq!(full.parse::<Method>().unwrap(), method);
        }
    }

    #[test]
    fn wrong_words_are_named() {
        let wrong = |text: &str| text.parse::<Method>().unwrap_err();
        assert!(wrong("hvd").contains("\"hvd\""), "{}", wrong("hvd"));
        assert!(
            wrong("hvt+sobl").contains("\"sobl\""),
            "{}",
            wrong("hvt+sobl")
        );
        assert!(wrong("").contains("expected a sampler"), "{}", wrong(""));
    }
}
