//! Every sampler of the crate, built for a target: the list the conformance tests run over.

use crate::targets::Case;
use brdf::DirectionSampler;
use brdf_sampling::{
    Cosine, Dictionary, Hvt, Inversion, InversionOptions, Preset, Proposal, Rejection,
    RejectionOptions, Target, Uniform,
};

/// A sampler with a name; names begin with the type's.
pub(crate) struct Entry {
    pub(crate) name: &'static str,
    /// `None` where the sampler does not go with the case.
    pub(crate) build: fn(&Case) -> Option<Box<dyn DirectionSampler>>,
    /// Looks at the target some 10^6 times, or in every call of `pdf`.
    pub(crate) evaluates_often: bool,
}

/// All of them. The test `every_sampler_is_listed` compares the names with the source.
pub(crate) const ALL: &[Entry] = &[
    Entry {
        name: "Uniform",
        build: |_| Some(Box::new(Uniform)),
        evaluates_often: false,
    },
    Entry {
        name: "Cosine",
        build: |_| Some(Box::new(Cosine)),
        evaluates_often: false,
    },
    Entry {
        name: "Inversion",
        build: |case| {
            let options = InversionOptions {
                n_theta: 16,
                n_phi: 8,
                n_a: 24,
                n_b: 12,
                ..InversionOptions::default()
            };
            Some(Box::new(Inversion::new(target(case), options)))
        },
        evaluates_often: false,
    },
    Entry {
        name: "Hvt tiny",
        build: |case| Some(Box::new(Hvt::new(target(case), Preset::Tiny.options()))),
        evaluates_often: false,
    },
    Entry {
        name: "Hvt default",
        build: |case| Some(Box::new(Hvt::new(target(case), Preset::Default.options()))),
        evaluates_often: false,
    },
    Entry {
        name: "Dictionary",
        build: |case| Some(Box::new(Dictionary::new(target(case)))),
        evaluates_often: false,
    },
    Entry {
        name: "Dictionary single",
        build: |case| Some(Box::new(Dictionary::single(target(case)))),
        evaluates_often: false,
    },
    Entry {
        name: "Rejection uniform",
        build: |case| Some(Box::new(rejection(case, Proposal::Uniform))),
        evaluates_often: true,
    },
    Entry {
        name: "Rejection cosine",
        build: |case| Some(Box::new(rejection(case, Proposal::Cosine))),
        evaluates_often: true,
    },
    Entry {
        name: "RglTable",
        build: |case| {
            let own = case.own.clone()?;
            Some(Box::new(own))
        },
        evaluates_often: false,
    },
];

/// Samplers that may decline: lobes, and visible normals, reach below the horizon.
pub(crate) fn may_waste(name: &str) -> bool {
    name.starts_with("Dictionary") || name.starts_with("RglTable")
}

pub(crate) fn target(case: &Case) -> Target<'_> {
    Target {
        f: &*case.f,
        lanes: None,
        symmetry: case.symmetry,
    }
}

/// Few slices and few tries: cheap, and the fallback is exercised.
pub(crate) fn rejection(case: &Case, proposal: Proposal) -> Rejection {
    let options = RejectionOptions {
        proposal,
        n_theta: 7,
        n_phi: 6,
        max_tries: 60,
    };
    Rejection::new(case.f.clone(), case.symmetry, options)
}
