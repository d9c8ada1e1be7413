//! The start of a light path: which light, from where on it, in which direction, and how dense such starts are.
use super::aim::{Mixture, Training};
use crate::{
    bsdf::Transport,
    film::FilmSpec,
    light::{Emitter, EmitterHit, LeSample, LightId},
    sampler::Sampler,
    scene::{Scene, World},
    texture::Cone,
    walk::Start,
};
use glam::Vec3;

/// Where light paths start: in proportion to power and to what each light emits, or aimed at what the camera needs.
#[derive(Clone, Debug, Default)]
pub struct Source {
    aim: Option<Box<Mixture>>,
}

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

impl Emission {
    /// A ray of `light`, which was chosen with probability `prob`. `None` if it carries nothing.
    #[inline]
    pub(super) fn new(world: &World, light: LightId, prob: f32, le: LeSample) -> Option<Self> {
        let beta = le.flux() / prob;
        let inside = world.light_inside(light);
        let start = Start { ray: le.ray, beta, mode: Transport::Flux, dispersed: false, inside, cone: Cone::RAY };
        let pdf = prob * le.pdf_area * le.pdf_dir;
        (beta.is_finite() && !beta.is_black()).then_some(Self { start, light, le, pdf })
    }
}

impl Source {
    /// In proportion to power, and to what each light emits.
    pub fn plain() -> Self {
        Self::default()
    }
    /// Aimed at what the camera needs, where that helps. Trains for a fraction of a second.
    pub fn aimed(scene: &Scene, spec: FilmSpec, training: &Training) -> Self {
        Self { aim: training.train(scene, spec).map(Box::new) }
    }
    /// How it is aimed; `None` if it is plain.
    pub fn aim(&self) -> Option<&Mixture> {
        self.aim.as_deref()
    }
    /// Starts one light path. `None` if the scene has no light, or if the light emits nothing there; such a path counts as
    /// emitted. Draws one number and two pairs.
    #[inline]
    pub fn emit(&self, world: &World, sampler: &mut Sampler) -> Option<Emission> {
        if let Some(mixture) = &self.aim {
            let (u, u_area, u_dir) = (sampler.next_1d(), sampler.next_2d(), sampler.next_2d());
            let drawn = mixture.sample(world, u, u_area, u_dir)?;
            return Emission::new(world, drawn.light, drawn.prob, drawn.le);
        }
        let (u, u_area, u_dir) = (world.light_number(sampler), sampler.next_2d(), sampler.next_2d());
        let (light, prob, _) = world.choose_light(u)?;
        Emission::new(world, light, prob, world.light(light).sample_le(u_area, u_dir, world.around())?)
    }
    /// The density [`Emission::pdf`] with which [`Source::emit`] starts the ray that leaves `light` in the unit direction
    /// `d`: from `hit` if it has a surface, else from its place, or from infinity along the line through `through`. Zero
    /// where it never does.
    #[inline]
    pub fn pdf(&self, world: &World, light: LightId, hit: Option<&EmitterHit>, through: Vec3, d: Vec3) -> f32 {
        if let Some(mixture) = &self.aim {
            return mixture.pdf(world, light, hit, through, d);
        }
        let (pdf_area, pdf_dir) = world.light(light).pdf_le(hit, d, world.around());
        world.light_prob(light) * pdf_area * pdf_dir
    }
}
