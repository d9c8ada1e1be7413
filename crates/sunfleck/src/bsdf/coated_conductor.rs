//! Metal under lacquer.
use super::{
    BsdfSample, Conductor, ConductorMaterial, Lobes, Lookup, Model, Principled, Roughness, Scalar, Scatter, TextureId,
    Transport, ggx::Ggx, packed::Unit, principled::f0_of,
};
use crate::{math::Local, spectrum::Spectrum};
use glam::Vec2;

/// Metal under a clear coat, two-sided.
#[derive(Clone, Copy, Debug)]
pub struct CoatedConductorMaterial {
    /// The metal, its index over that of the air.
    pub metal: ConductorMaterial,
    /// GGX roughness in [0, 1] of the metal, at least [`Ggx::MIN_ALPHA`].
    pub alpha: Roughness,
    /// Index of refraction of the coat, > 1.
    pub coat_ior: f32,
    /// GGX roughness in [0, 1] of the coat, at least [`Ggx::MIN_ALPHA`].
    pub coat_alpha: Scalar,
}

impl Model for CoatedConductorMaterial {
    type Closure = CoatedConductor;
    const NAME: &'static str = "coatedconductor";
    const ABOUT: &'static str = "metal of GGX roughness `alpha` under a clear coat of index `coat_ior`";
    fn resolve(&self, at: &Lookup) -> CoatedConductor {
        // The metal meets the coat, not the air.
        let Conductor { eta, k, reflectance } = self.metal.resolve(at);
        let ior = self.coat_ior.max(1.0 + 1e-4);
        let metal = Conductor { eta: eta / ior, k: k / ior, reflectance };
        let [u, v] = self.alpha.at(at);
        CoatedConductor(Principled {
            base: metal.fresnel(1.0),
            metallic: Unit::new(1.0),
            ggx: Ggx::aligned(u, v),
            coat: Unit::new(1.0),
            coat_f0: Unit::new(f0_of(ior)),
            coat_alpha: Unit::new(at.scalar(self.coat_alpha).max(Ggx::MIN_ALPHA)),
            ..Principled::BARE
        })
    }
    fn textures(&self) -> Vec<TextureId> {
        self.metal.textures().into_iter().chain(self.alpha.textures()).chain(self.coat_alpha.texture()).collect()
    }
    fn is_aligned(&self) -> bool {
        self.alpha.is_aligned()
    }
}

/// [`Principled`] with a metal whose reflectance along the normal is exact, and Schlick's factor beyond.
#[derive(Clone, Copy, Debug)]
pub struct CoatedConductor(pub(super) Principled);

impl Scatter for CoatedConductor {
    fn eval(&self, wo: Local, wi: Local, mode: Transport) -> Spectrum {
        self.0.eval(wo, wi, mode)
    }
    fn pdf(&self, wo: Local, wi: Local) -> f32 {
        self.0.pdf(wo, wi)
    }
    fn sample(&self, wo: Local, u_lobe: f32, u: Vec2, mode: Transport) -> Option<BsdfSample> {
        self.0.sample(wo, u_lobe, u, mode)
    }
    fn lobes(&self) -> Lobes {
        self.0.lobes()
    }
}
