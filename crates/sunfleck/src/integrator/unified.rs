//! Path tracing and photons in one, each where it is better (after Grittmann et al. 2018, "Efficient Caustic Rendering with
//! Lightweight Photon Mapping", and Šik & Křivánek 2019, "Implementing One-Click Caustics in Corona Renderer").
//!
//! A short training decides for each part of the picture between a path tracer with photons for caustics alone, both weighed
//! against each other, and photons for all that is not direct light; how many photons there are, down to none; and how far
//! gathers reach (see [`super::engine`]'s `plan`).
use super::{
    Entry,
    engine::{Engine, Fit, Merge, PARAMS, Techniques},
};
use crate::{bsdf::Lobes, walk::Limits};

pub(super) const ENTRY: Entry = Entry {
    name: "unified",
    about: "path tracing and photons in one, each where it is better; for everything",
    params: &PARAMS,
    mergeable: true,
    make: |p| {
        Ok(Box::new(Engine { planned: true, fit: Fit::Error, limits: LIMITS, ..Engine::new(ON) }.with_params(p)?))
    },
};

/// Narrow lobes are left to the walks: of the photons on hazy glass or metal hardly one in a hundred is scattered to the eye,
/// while a walk goes on from there as from clear glass, to where gathers are worth more.
const LIMITS: Limits = Limits { scatterings: 64, roulette_after: 3, gathers: Lobes::Wide, filter: true };

pub(super) const ON: Techniques =
    Techniques { hit: true, nee: true, light_image: false, connect: false, merge: Merge::Caustic };
