//! Bidirectional path tracing (Lafortune & Willems 1993; Veach & Guibas 1994): all samplers but merging.
use super::{
    Entry,
    engine::{Engine, Merge, PARAMS, Techniques},
};

pub(super) const ENTRY: Entry = Entry {
    name: "bdpt",
    about: "bidirectional path tracing: paths from both ends, joined every way; interiors",
    params: &PARAMS,
    mergeable: true,
    make: |p| Ok(Box::new(Engine::new(ON).with_params(p)?)),
};

pub(super) const ON: Techniques =
    Techniques { hit: true, nee: true, light_image: true, connect: true, merge: Merge::Off };
