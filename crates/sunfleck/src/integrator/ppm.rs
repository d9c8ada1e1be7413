//! Progressive photon mapping: every pass shoots its own photons and gathers them where a camera path first scatters by
//! a lobe with a density; the radius shrinks from pass to pass, so that the mean over passes has neither noise nor bias
//! in the end (Hachisuka, Ogaki & Jensen 2008, in the memoryless form of Knaus & Zwicker 2011).
//!
//! Paths by Heckbert's letters (D stands for any lobe with a density), each found once:
//!
//! | path | found by |
//! |---|---|
//! | `L S* E` | the camera walk hitting the light |
//! | `L D S* E` | a light connection and one ray past the gather point, weighed against each other (`direct=connect`), or photons (`direct=photons`) |
//! | `L S⁺ D S* E`, `L S* D (S\|D)* D S* E` | photons |
use super::{
    Entry, ParamInfo,
    engine::{Engine, Merge, PARAMS, Techniques},
};

pub(super) const ENTRY: Entry = Entry {
    name: "ppm",
    about: "progressive photon mapping: finds caustics seen through glass and in mirrors; noise and blur both vanish",
    params: &ALL,
    mergeable: true,
    make: |p| {
        let merge = [Merge::First, Merge::FirstAll][p.word("direct", 0, &["connect", "photons"])?];
        let connect = merge == Merge::First;
        let on = Techniques { hit: true, nee: connect, light_image: false, connect: false, merge };
        Ok(Box::new(Engine::new(on).with_params(p)?))
    },
};

const ALL: [ParamInfo; PARAMS.len() + 1] = {
    let direct = "light that comes straight from a light: connect or photons (default connect)";
    let mut all = [ParamInfo { name: "direct", about: direct }; PARAMS.len() + 1];
    let mut i = 0;
    while i < PARAMS.len() {
        all[i + 1] = PARAMS[i];
        i += 1;
    }
    all
};
