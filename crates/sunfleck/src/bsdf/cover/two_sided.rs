//! Different materials on the two sides of a surface.
use super::MaterialId;
use crate::bsdf::MaterialEntry;

/// A material for each side; a side without one is black. Models here look the same from both sides, so this is for what
/// differs, and for files in which a surface has one side only. Not for what lets light through.
#[derive(Clone, Copy, Debug)]
pub struct TwoSidedMaterial {
    /// On the outer side, where the normal points.
    pub front: Option<MaterialId>,
    /// On the inner side.
    pub back: Option<MaterialId>,
}

impl TwoSidedMaterial {
    pub(super) const ENTRY: MaterialEntry = MaterialEntry {
        name: "twosided",
        about: "one material on the outer side and another, or none, on the inner side of a surface",
    };
    #[inline]
    pub(super) fn side(self, outside: bool) -> Option<MaterialId> {
        if outside { self.front } else { self.back }
    }
}
