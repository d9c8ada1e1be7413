//! Path tracing and photons in one, each where it is better (after Grittmann et al. 2018 and Šik & Křivánek 2019).
use super::{
    Entry,
    engine::{Engine, Merge, PARAMS, Techniques},
};

pub(super) const ENTRY: Entry = Entry {
    name: "unified",
    about: "path tracing and photons in one, each where it is better; for everything",
    params: &PARAMS,
    mergeable: true,
    make: |p| Ok(Box::new(Engine::from_params(ON, p)?)),
};

const ON: Techniques = Techniques { hit: true, nee: true, light_image: false, connect: false, merge: Merge::Scattered };
