//! One material or another.
use super::{MaterialId, Site, opacity};
use crate::{
    bsdf::{Lookup, Material, MaterialEntry},
    texture::Scalar,
};

/// Each path meets the second material with probability `amount`, and otherwise the first.
#[derive(Clone, Copy, Debug)]
pub struct MixMaterial {
    /// Where `amount` is 0, and where it is 1.
    pub of: [MaterialId; 2],
    /// Share of the second, in [0, 1].
    pub amount: Scalar,
}

impl MixMaterial {
    pub(super) const ENTRY: MaterialEntry = MaterialEntry {
        name: "mix",
        about: "two materials, the second with the share `amount`, which may be a texture",
    };

    /// Share of each times its opacity.
    pub(super) fn opacities(&self, materials: &[Material], at: &Lookup) -> [f32; 2] {
        let amount = at.scalar(self.amount).clamp(0.0, 1.0);
        [(1.0 - amount) * opacity(self.of[0], materials, at), amount * opacity(self.of[1], materials, at)]
    }
    /// The one that this path meets, in proportion to what is not let through.
    pub(super) fn choose(&self, id: MaterialId, site: &Site) -> MaterialId {
        let [first, second] = self.opacities(site.materials, &site.at);
        self.of[usize::from(site.coin.toss(u64::from(id.0)) * (first + second) >= first)]
    }
}
