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
    pub(crate) build: fn(&Case) -> Box<dyn DirectionSampler>,
}

/// All of them. The test `every_sampler_is_listed` compares the names with the source.
pub(crate) const ALL: &[Entry] = &[
    Entry {
        name: "Uniform",
        build: |_| Box::new(Uniform),
    },
    Entry {
        name: "Cosine",
        build: |_| Box::new(Cosine),
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
            Box::new(Inversion::new(target(case), options))
        },
    },
    Entry {
        name: "Hvt tiny",
        build: |case| Box::new(Hvt::new(target(case), Preset::Tiny.options())),
    },
    Entry {
        name: "Hvt default",
        build: |case| Box::new(Hvt::new(target(case), Preset::Default.options())),
    },
    Entry {
        name: "Dictionary",
        build: |case| Box::new(Dictionary::new(target(case))),
    },
    Entry {
        name: "Dictionary single",
        build: |case| Box::new(Dictionary::single(target(case))),
    },
    Entry {
        name: "Rejection uniform",
        build: |case| Box::new(rejection(case, Proposal::Uniform)),
    },
    Entry {
        name: "Rejection cosine",
        build: |case| Box::new(rejection(case, Proposal::Cosine)),
    },
];

pub(crate) fn target(case: &Case) -> Target<'_> {
    Target {
        f: &*case.f,
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
