//! Coverings: materials that are laid over others. They choose between them, let rays through, or bend the normal.
//!
//! A [`Site`] is a hit before scattering is known; `cover` follows coverings down to a model. The choice between mixed
//! materials and the chance of a ray to pass a mask are tossed by a [`Coin`] that depends on the ray and on nothing else:
//! each ray sees one material, in proportion to the shares. That is right for all algorithms alike. Camera paths,
//! light paths and shadow rays meet a mask with the same probability, so densities that are weighed against each
//! other lack the same factor; and what a path meets at a mixed surface is one model, for which all weights sum to one.
//! The one thing that may not depend on the toss is where photons are left ([`Covered::widest`]): whether they
//! count is the camera's toss.
mod coin;
mod mask;
mod mix;
mod relief;
mod turned;
mod two_sided;

pub use coin::Coin;
pub use mask::{MaskMaterial, NullMaterial};
pub use mix::MixMaterial;
pub use relief::{BumpMapMaterial, NormalMapMaterial};
pub use turned::TurnedMaterial;
pub use two_sided::TwoSidedMaterial;

use super::{Black, Bsdf, Lobes, Lookup, Material, MaterialEntry, Scatter, TextureId};
use crate::{math::Frame, shape::Tangents};
use glam::Vec3;

/// Handle of a material of the scene.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct MaterialId(pub u32);

/// A hit whose scattering is to be found.
#[derive(Clone, Copy)]
pub struct Site<'s> {
    /// All materials of the scene.
    pub materials: &'s [Material],
    /// Where textures look.
    pub at: Lookup<'s>,
    /// Geometric normal, unit, on the outer side.
    pub ng: Vec3,
    /// Shading normal, unit, in the hemisphere of `ng`.
    pub n: Vec3,
    /// How the point moves with the texture coordinates, if they say.
    pub tangents: Option<Tangents>,
    /// The path comes from the outer side.
    pub outside: bool,
    /// Decides what is left to chance.
    pub coin: Coin,
}

/// What a path meets.
#[derive(Clone, Copy, Debug)]
pub struct Covered {
    /// Scattering.
    pub bsdf: Bsdf,
    /// Shading frame.
    pub frame: Frame,
    /// The widest lobes that `bsdf`, or what another toss of the coin would have met, has.
    pub widest: Lobes,
}

impl Covered {
    /// A model by itself, under the shading normal `n`.
    pub(crate) fn plain(bsdf: Bsdf, n: Vec3) -> Self {
        Self { bsdf, frame: Frame::from_normal(n), widest: bsdf.lobes() }
    }
}

/// One of the materials of this room.
#[derive(Clone, Debug)]
pub enum Covering {
    /// See [`MixMaterial`].
    Mix(MixMaterial),
    /// See [`MaskMaterial`].
    Mask(MaskMaterial),
    /// See [`NullMaterial`].
    Null(NullMaterial),
    /// See [`TwoSidedMaterial`].
    TwoSided(TwoSidedMaterial),
    /// See [`NormalMapMaterial`].
    NormalMap(NormalMapMaterial),
    /// See [`BumpMapMaterial`].
    BumpMap(BumpMapMaterial),
    /// See [`TurnedMaterial`].
    Turned(TurnedMaterial),
}

/// Every covering, for `sunfleck list materials`.
pub const COVERINGS: &[MaterialEntry] = &[
    MixMaterial::ENTRY,
    MaskMaterial::ENTRY,
    NullMaterial::ENTRY,
    TwoSidedMaterial::ENTRY,
    NormalMapMaterial::ENTRY,
    BumpMapMaterial::ENTRY,
    TurnedMaterial::ENTRY,
];

macro_rules! into_material {
    ($($variant:ident($material:ident)),*) => { $(impl From<$material> for Material {
        fn from(m: $material) -> Self {
            Self::Covering(Covering::$variant(m))
        }
    })* };
}
into_material!(
    Mix(MixMaterial),
    Mask(MaskMaterial),
    Null(NullMaterial),
    TwoSided(TwoSidedMaterial),
    NormalMap(NormalMapMaterial),
    BumpMap(BumpMapMaterial),
    Turned(TurnedMaterial)
);

impl Covering {
    /// The model's word.
    pub fn name(&self) -> &'static str {
        match self {
            Self::Mix(_) => MixMaterial::ENTRY.name,
            Self::Mask(_) => MaskMaterial::ENTRY.name,
            Self::Null(_) => NullMaterial::ENTRY.name,
            Self::TwoSided(_) => TwoSidedMaterial::ENTRY.name,
            Self::NormalMap(_) => NormalMapMaterial::ENTRY.name,
            Self::BumpMap(_) => BumpMapMaterial::ENTRY.name,
            Self::Turned(_) => TurnedMaterial::ENTRY.name,
        }
    }
    /// The textures it looks at itself.
    pub fn textures(&self) -> Vec<TextureId> {
        match self {
            Self::Mix(m) => m.amount.texture().into_iter().collect(),
            Self::Mask(m) => m.opacity.texture().into_iter().collect(),
            Self::Null(_) | Self::TwoSided(_) => Vec::new(),
            Self::NormalMap(m) => vec![m.map],
            Self::BumpMap(m) => m.height.texture().into_iter().collect(),
            Self::Turned(m) => m.direction.into_iter().collect(),
        }
    }
    /// The materials it is laid over.
    pub fn parts(&self) -> Vec<MaterialId> {
        match self {
            Self::Mix(m) => m.of.to_vec(),
            Self::Mask(m) => vec![m.of],
            Self::Null(_) => Vec::new(),
            Self::TwoSided(m) => [m.front, m.back].into_iter().flatten().collect(),
            Self::NormalMap(m) => vec![m.of],
            Self::BumpMap(m) => vec![m.of],
            Self::Turned(m) => vec![m.of],
        }
    }
}

/// Follows coverings from `id` down to a model.
pub(crate) fn cover(id: MaterialId, mut site: Site) -> Covered {
    let mut next = Some(id);
    let mut first_mix = None;
    while let Some(id) = next {
        next = match &site.materials[id.0 as usize] {
            Material::Covering(Covering::Mix(m)) => {
                first_mix = first_mix.or(Some(id));
                Some(m.choose(id, &site))
            }
            Material::Covering(Covering::Mask(m)) => Some(m.of),
            Material::Covering(Covering::Null(_)) => None,
            Material::Covering(Covering::TwoSided(m)) => m.side(site.outside),
            Material::Covering(Covering::NormalMap(m)) => {
                site.n = m.normal(&site);
                Some(m.of)
            }
            Material::Covering(Covering::BumpMap(m)) => {
                site.n = m.normal(&site);
                Some(m.of)
            }
            Material::Covering(Covering::Turned(m)) => {
                site.tangents = Some(m.tangents(&site));
                Some(m.of)
            }
            model => {
                let bsdf = model.resolve(&site.at);
                let others = first_mix.map_or(Lobes::Delta, |id| widest(id, &site));
                return Covered { bsdf, frame: site.frame(), widest: bsdf.lobes().max(others) };
            }
        };
    }
    let widest = first_mix.map_or(Lobes::Delta, |id| widest(id, &site));
    Covered { bsdf: Black.into(), frame: site.frame(), widest }
}

/// The widest lobes that some toss of the coin finds under `id`.
fn widest(id: MaterialId, site: &Site) -> Lobes {
    match &site.materials[id.0 as usize] {
        Material::Covering(Covering::TwoSided(m)) => m.side(site.outside).map_or(Lobes::Delta, |id| widest(id, site)),
        Material::Covering(c) => c.parts().iter().map(|id| widest(*id, site)).max().unwrap_or(Lobes::Delta),
        model => model.resolve(&site.at).lobes(),
    }
}

/// Probability with which a ray meets the material `id` where textures look `at`: the rest of the rays pass as if there were
/// nothing.
pub(crate) fn opacity(id: MaterialId, materials: &[Material], at: &Lookup) -> f32 {
    match &materials[id.0 as usize] {
        Material::Covering(Covering::Null(_)) => 0.0,
        Material::Covering(Covering::Mask(m)) => at.scalar(m.opacity).clamp(0.0, 1.0) * opacity(m.of, materials, at),
        Material::Covering(Covering::Mix(m)) => m.opacities(materials, at).iter().sum(),
        Material::Covering(c) => c.parts().first().map_or(1.0, |id| opacity(*id, materials, at)),
        _ => 1.0,
    }
}

/// Whether some ray may pass the material `id`; `earlier` says so of those before it.
pub(crate) fn is_porous(material: &Material, earlier: &[bool]) -> bool {
    match material {
        Material::Covering(Covering::Null(_)) => true,
        Material::Covering(Covering::Mask(m)) if m.opacity != 1.0.into() => true,
        Material::Covering(c) => c.parts().iter().any(|id| earlier[id.0 as usize]),
        _ => false,
    }
}

impl Site<'_> {
    /// The shading frame: its first tangent is where the texture coordinate u grows, if that is known.
    fn frame(&self) -> Frame {
        self.tangents.map_or_else(|| Frame::from_normal(self.n), |[u, _]| Frame::along(self.n, u))
    }
}
