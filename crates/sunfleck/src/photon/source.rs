//! The start of a light path: which light, from where on it, in which direction, and how dense such starts are.
use crate::{
    bsdf::Transport,
    light::{Emitter, EmitterHit, LeSample, LightId},
    sampler::Sampler,
    scene::World,
    spectrum::Spectrum,
    walk::Start,
};
use glam::Vec3;

/// Where light paths start: a light in proportion to its power, a ray in proportion to what the light emits.
#[derive(Clone, Debug, Default)]
#[non_exhaustive]
pub struct Source {}

/// The start of one light path.
#[derive(Clone, Copy, Debug)]
pub struct Emission {
    /// The first ray. `beta` is the flux (W) that it stands for if it is the only one; divide by the number of paths
    /// *emitted*, those that came to nothing included.
    pub start: Start,
    /// The light it leaves.
    pub light: LightId,
    /// What is emitted; the densities are those of this source, given the light.
    pub le: LeSample,
    /// Density of the start, choice of the light included: 1/(m²·sr), 1/sr for a light without extent, 1/m² for one
    /// without solid angle.
    pub pdf: f32,
}

impl Source {
    /// In proportion to power, and to what each light emits.
    pub fn plain() -> Self {
        Self {}
    }
    /// Starts one light path. `None` if the scene has no light, or if the light emits nothing there; such a path counts as
    /// emitted. Draws one number and two pairs.
    #[inline]
    pub fn emit(&self, world: &World, sampler: &mut Sampler) -> Option<Emission> {
        let (light, prob, _) = world.choose_light(sampler.next_1d())?;
        let (u_area, u_dir) = (sampler.next_2d(), sampler.next_2d());
        let le = world.light(light).sample_le(u_area, u_dir, world.around())?;
        let beta: Spectrum = le.flux() / prob;
        let start = Start { ray: le.ray, beta, mode: Transport::Flux, dispersed: false };
        let pdf = prob * le.pdf_area * le.pdf_dir;
        (beta.is_finite() && !beta.is_black()).then_some(Emission { start, light, le, pdf })
    }
    /// The density [`Emission::pdf`] with which [`Source::emit`] starts the ray that leaves `light` in the unit direction
    /// `d`: from `hit` if it has a surface, else from its place, or from infinity along the line through `through`. Zero
    /// where it never does.
    #[inline]
    pub fn pdf(&self, world: &World, light: LightId, hit: Option<&EmitterHit>, _through: Vec3, d: Vec3) -> f32 {
        let (pdf_area, pdf_dir) = world.light(light).pdf_le(hit, d, world.around());
        world.light_prob(light) * pdf_area * pdf_dir
    }
}
