//! Holes: surfaces that let rays pass.
use super::MaterialId;
use crate::{bsdf::MaterialEntry, texture::Scalar};

/// A material with holes: leaves, fences, lace. Of the rays that come, the share `opacity` meets the material, and the others
/// pass as if there were nothing; where it is 0 or 1 nothing is left to chance.
///
/// Rays decide while they are traced: a pass counts as no scattering, takes no part in any density, and lets shadow rays
/// through like all others. A surface that emits has no holes.
#[derive(Clone, Copy, Debug)]
pub struct MaskMaterial {
    /// What is there where there is no hole.
    pub of: MaterialId,
    /// In [0, 1].
    pub opacity: Scalar,
}

impl MaskMaterial {
    pub(super) const ENTRY: MaterialEntry =
        MaterialEntry { name: "mask", about: "another material with holes: rays meet it with probability `opacity`" };
}

/// No material at all: the boundary of a medium with the index of its surroundings, which no ray notices. Black if it emits.
#[derive(Clone, Copy, Debug)]
pub struct NullMaterial;

impl NullMaterial {
    pub(super) const ENTRY: MaterialEntry =
        MaterialEntry { name: "null", about: "nothing: rays pass as if the surface were not there" };
}
