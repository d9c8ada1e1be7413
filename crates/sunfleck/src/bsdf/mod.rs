//! Scattering at a surface: how much of the light from `wi` leaves to `wo`, and where to look next.
//!
//! A *material* is what the scene stores (colours are textures); at a hit it is resolved to a *closure*, a small `Copy`
//! value with the textures looked up, which a light vertex or a gather point may keep for a whole pass.
//! To add a model: write `bsdf/<name>.rs` with its material and its closure (implementing [`Scatter`] and [`Model`]), and
//! add one line to `models!` below; the contract tests run over the whole list.
//!
//! Materials may also be laid over others, to choose between them, hide them or bend their normals: see [`cover`].
//!
//! The mathematics that models share is in [`fresnel`] (how much a boundary reflects), [`ggx`] (rough boundaries),
//! `beckmann` and `facets` (other ones), and `cosine_lobe` (Phong's highlights).
mod albedo;
mod beckmann;
mod black;
mod burley;
mod coated_conductor;
mod conductor;
mod cook_torrance;
mod cosine_lobe;
pub mod cover;
mod dielectric;
mod diffuse;
mod diffuse_transmission;
mod disney;
mod disney_thin;
mod facets;
mod film;
pub mod fresnel;
pub mod ggx;
mod mirror;
mod nrenderer_phong;
mod outlook;
mod packed;
mod phong;
mod plastic;
mod principled;
mod rough_conductor;
mod rough_dielectric;
mod rough_plastic;
mod roughness;
mod sheen;
mod thin_dielectric;

pub use black::{Black, BlackMaterial};
pub use coated_conductor::{CoatedConductor, CoatedConductorMaterial};
pub use conductor::{Conductor, ConductorMaterial};
pub use cook_torrance::{CookTorrance, CookTorranceMaterial};
pub use dielectric::{Dielectric, DielectricMaterial};
pub use diffuse::{Diffuse, DiffuseMaterial};
pub use diffuse_transmission::{DiffuseTransmission, DiffuseTransmissionMaterial};
pub use disney::{Disney, DisneyMaterial};
pub use disney_thin::{DisneyThin, DisneyThinMaterial};
pub use facets::{Facets, Landscape};
pub use film::FilmMaterial;
pub use mirror::{Mirror, MirrorMaterial};
pub use nrenderer_phong::{NRendererPhong, NRendererPhongMaterial};
pub use outlook::Outlook;
pub use phong::{Phong, PhongMaterial};
pub use plastic::{Plastic, PlasticMaterial};
pub use principled::{Principled, PrincipledMaterial};
pub use rough_conductor::{RoughConductor, RoughConductorMaterial};
pub use rough_dielectric::{RoughDielectric, RoughDielectricMaterial};
pub use rough_plastic::{RoughBoundary, RoughPlastic, RoughPlasticMaterial};
pub use roughness::Roughness;
pub use thin_dielectric::{ThinDielectric, ThinDielectricMaterial};

pub use crate::texture::{Lookup, Scalar, TextureId};
pub use cover::{
    BumpMapMaterial, COVERINGS, Covering, MaskMaterial, MaterialId, MixMaterial, NormalMapMaterial, NullMaterial,
    TurnedMaterial, TwoSidedMaterial,
};

use crate::{math::Local, spectrum::Spectrum};
use glam::Vec2;

/// What travels from `wo`: radiance on camera paths, flux on light paths. Only refraction differs: radiance is
/// compressed by (η of `wo`'s side / η of `wi`'s side)², flux is not (Veach 1997, section 5.2).
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Transport {
    /// Camera path: `wi` points where the light comes from.
    Radiance,
    /// Light path: `wi` points where the light goes.
    Flux,
}

/// A sampled direction.
#[derive(Clone, Copy, Debug)]
pub struct BsdfSample {
    /// Sampled direction, away from the surface.
    pub wi: Local,
    /// `f(wo, wi)·|cos θi| / pdf`: multiply the throughput by this.
    pub weight: Spectrum,
    /// Density of `wi` (1/sr) over all lobes; for a delta lobe, the discrete probability of the lobe.
    pub pdf: f32,
    /// From a Dirac delta lobe: no density, so neither next-event estimation nor photons can meet it.
    pub delta: bool,
    /// η of `wi`'s side over η of `wo`'s side; 1 for a reflection. Russian roulette undoes the η² of radiance with it.
    pub eta: f32,
    /// `wi` is right for the hero alone, and so is `weight`: other wavelengths are bent elsewhere. See [`crate::spectrum`].
    pub disperses: bool,
}

impl BsdfSample {
    /// The mirror reflection of `wo` as the only lobe; `None` if it carries nothing or `wo` lies in the plane.
    #[inline]
    fn specular(wo: Local, weight: Spectrum) -> Option<Self> {
        let carries = wo.cos_theta() != 0.0 && !weight.is_black();
        carries.then(|| Self { wi: wo.mirrored(), weight, pdf: 1.0, delta: true, eta: 1.0, disperses: false })
    }
    /// A direction from lobes with a density, on `wo`'s side; `None` if it carries nothing.
    #[inline]
    fn scattered(wi: Local, weight: Spectrum, pdf: f32) -> Option<Self> {
        let carries = pdf > 0.0 && !weight.is_black();
        carries.then_some(Self { wi, weight, pdf, delta: false, eta: 1.0, disperses: false })
    }
}

/// The contract of every closure; checked for each model in `tests/bsdf_contract`.
pub trait Scatter {
    /// `f(wo, wi)` in 1/sr, *without* the cosine. Zero for delta lobes, and so for a closure that has no others and says nothing
    /// here.
    #[inline]
    fn eval(&self, _wo: Local, _wi: Local, _mode: Transport) -> Spectrum {
        Spectrum::BLACK
    }
    /// Density (1/sr) with which [`Scatter::sample`] draws `wi` given `wo`. Zero for delta lobes, as [`Scatter::eval`].
    #[inline]
    fn pdf(&self, _wo: Local, _wi: Local) -> f32 {
        0.0
    }
    /// Draws `wi`; `None` when the sample carries nothing. `u_lobe` picks the lobe.
    fn sample(&self, wo: Local, u_lobe: f32, u: Vec2, mode: Transport) -> Option<BsdfSample>;
    /// The widest of the lobes, seen from any direction.
    #[inline]
    fn lobes(&self) -> Lobes {
        Lobes::Delta
    }
    /// True if some lobe has a density, so that photons may be stored and lights connected here.
    #[inline]
    fn is_connectible(&self) -> bool {
        self.lobes() > Lobes::Delta
    }
}

/// How far the lobes of a closure spread.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Lobes {
    /// Into single directions, or nowhere.
    Delta,
    /// Around single directions, as on glass or metal with a haze: of many photons there, few are scattered to any one eye.
    Narrow,
    /// Over a good part of the hemisphere.
    Wide,
}

impl Lobes {
    /// Facets of at most this roughness make narrow lobes. At 0.1, light within 11° of the mirror direction is half of all.
    const NARROW: f32 = 0.1;

    /// Of one that is wide, or black.
    #[inline]
    fn wide_if(scatters: bool) -> Self {
        if scatters { Self::Wide } else { Self::Delta }
    }
    /// Of facets of this roughness, the larger if there are two.
    #[inline]
    fn of_facets(alpha: f32) -> Self {
        if alpha <= Self::NARROW { Self::Narrow } else { Self::Wide }
    }
}

/// A material as the scene stores it.
pub trait Model {
    /// What it is at a hit: its own closure, or [`Bsdf`] if it is one of several.
    type Closure: Scatter + Copy + Into<Bsdf>;
    /// Word for lists and messages.
    const NAME: &'static str;
    /// One line for help and manual.
    const ABOUT: &'static str;
    /// Looks the textures up.
    fn resolve(&self, at: &Lookup) -> Self::Closure;
    /// The textures it refers to, so that the builder can check them.
    fn textures(&self) -> Vec<TextureId>;
    /// Whether it bends each wavelength differently.
    fn is_dispersive(&self) -> bool {
        false
    }
    /// Whether it scatters light so evenly that it makes no caustics.
    fn is_matt(&self) -> bool {
        false
    }
    /// Whether it asks where the texture coordinates grow.
    fn is_aligned(&self) -> bool {
        false
    }
}

/// Name and purpose of a material model, for `sunfleck list materials` and the manual.
#[derive(Clone, Copy, Debug)]
pub struct MaterialEntry {
    /// Word for lists and messages.
    pub name: &'static str,
    /// One line.
    pub about: &'static str,
}

/// Declares the closed set of models: the enums [`Material`] and [`Bsdf`] and the list [`MATERIALS`].
macro_rules! models {
    ($($closure:ident / $material:ident),* $(,)?) => {
        /// One of the material models of this room.
        #[derive(Clone, Debug)]
        pub enum Material {
            $(#[doc = concat!("See [`", stringify!($material), "`].")] $closure($material),)*
            /// Something laid over other materials.
            Covering(Covering),
        }
        /// One of the closures of this room.
        #[derive(Clone, Copy, Debug)]
        pub enum Bsdf { $(#[doc = concat!("See [`", stringify!($closure), "`].")] $closure($closure)),* }
        /// Every material model.
        pub const MATERIALS: &[MaterialEntry] =
            &[$(MaterialEntry { name: <$material as Model>::NAME, about: <$material as Model>::ABOUT }),*];
        $(impl From<$material> for Material { fn from(m: $material) -> Self { Self::$closure(m) } })*
        $(impl From<$closure> for Bsdf { fn from(b: $closure) -> Self { Self::$closure(b) } })*
        impl Material {
            /// The closure at a hit; black for coverings, which scatter nothing themselves.
            #[inline]
            pub fn resolve(&self, at: &Lookup) -> Bsdf {
                match self { $(Self::$closure(m) => m.resolve(at).into(),)* Self::Covering(_) => Black.into() }
            }
            /// Whether [`Material::resolve`] says all about it, in any frame around the normal.
            #[inline]
            pub(crate) fn is_plain(&self) -> bool {
                match self { $(Self::$closure(m) => !m.is_aligned(),)* Self::Covering(_) => false }
            }
            /// The model's word.
            pub fn name(&self) -> &'static str {
                match self { $(Self::$closure(_) => <$material as Model>::NAME,)* Self::Covering(c) => c.name() }
            }
            /// The textures it refers to.
            pub fn textures(&self) -> Vec<TextureId> {
                match self { $(Self::$closure(m) => m.textures(),)* Self::Covering(c) => c.textures() }
            }
            /// The materials that it is laid over.
            pub fn parts(&self) -> Vec<MaterialId> {
                if let Self::Covering(c) = self { c.parts() } else { Vec::new() }
            }
            /// Whether it makes no caustics; coverings leave that to what they are laid over.
            pub fn is_matt(&self) -> bool {
                match self { $(Self::$closure(m) => m.is_matt(),)* Self::Covering(_) => true }
            }
            /// Whether it bends each wavelength differently.
            pub fn is_dispersive(&self) -> bool {
                match self { $(Self::$closure(m) => m.is_dispersive(),)* Self::Covering(_) => false }
            }
        }
        impl Scatter for Bsdf {
            #[inline]
            fn eval(&self, wo: Local, wi: Local, mode: Transport) -> Spectrum {
                match self { $(Self::$closure(b) => b.eval(wo, wi, mode)),* }
            }
            #[inline]
            fn pdf(&self, wo: Local, wi: Local) -> f32 {
                match self { $(Self::$closure(b) => b.pdf(wo, wi)),* }
            }
            #[inline]
            fn sample(&self, wo: Local, u_lobe: f32, u: Vec2, mode: Transport) -> Option<BsdfSample> {
                match self { $(Self::$closure(b) => b.sample(wo, u_lobe, u, mode)),* }
            }
            #[inline]
            fn lobes(&self) -> Lobes {
                match self { $(Self::$closure(b) => b.lobes()),* }
            }
        }
    };
}

impl Bsdf {
    /// True where [`Scatter::sample`] surely does not look at `u_lobe`.
    #[inline]
    pub fn has_one_lobe(&self) -> bool {
        matches!(self, Self::Diffuse(_) | Self::Mirror(_) | Self::Black(_))
    }
    /// The same boundary where what lies above it has the index of refraction `outer`, instead of empty space: for glass. Other
    /// models stay as they are.
    #[must_use]
    pub(crate) fn immersed(self, outer: Spectrum) -> Self {
        match self {
            Self::Dielectric(b) => b.immersed(outer).into(),
            Self::RoughDielectric(b) => b.immersed(outer),
            other => other,
        }
    }
    /// True where [`Scatter::sample`] surely does not look at `u`.
    #[inline]
    pub fn is_polished(&self) -> bool {
        matches!(
            self,
            Self::Dielectric(_) | Self::ThinDielectric(_) | Self::Mirror(_) | Self::Conductor(_) | Self::Black(_)
        )
    }
}

models![
    Diffuse / DiffuseMaterial,
    DiffuseTransmission / DiffuseTransmissionMaterial,
    Mirror / MirrorMaterial,
    Dielectric / DielectricMaterial,
    RoughDielectric / RoughDielectricMaterial,
    ThinDielectric / ThinDielectricMaterial,
    Conductor / ConductorMaterial,
    RoughConductor / RoughConductorMaterial,
    CoatedConductor / CoatedConductorMaterial,
    Phong / PhongMaterial,
    NRendererPhong / NRendererPhongMaterial,
    CookTorrance / CookTorranceMaterial,
    Plastic / PlasticMaterial,
    RoughPlastic / RoughPlasticMaterial,
    Principled / PrincipledMaterial,
    Disney / DisneyMaterial,
    DisneyThin / DisneyThinMaterial,
    Black / BlackMaterial,
];

/// `w` in the frame of a surface turned over, if need be, so that `wo` is on its upper side. Models that look the same from
/// both sides work in this frame; it is its own inverse.
#[inline]
fn seen_from(wo: Local, w: Local) -> Local {
    Local(w.0.with_z(w.0.z * 1f32.copysign(wo.0.z)))
}
