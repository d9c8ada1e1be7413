//! Vertex connection and merging (Georgiev et al. 2012; Hachisuka et al. 2012): every sampler, the hardest scenes.
use super::{
    Entry,
    engine::{Engine, Merge, PARAMS, Techniques},
};

pub(super) const ENTRY: Entry = Entry {
    name: "vcm",
    about: "vertex connection and merging: every sampler at once; the hardest scenes",
    params: &PARAMS,
    mergeable: true,
    make: |p| Ok(Box::new(Engine::new(ON).with_params(p)?)),
};

pub(super) const ON: Techniques =
    Techniques { hit: true, nee: true, light_image: true, connect: true, merge: Merge::Scattered };
