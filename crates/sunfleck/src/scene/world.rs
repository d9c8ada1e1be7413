//! The scene as one pass sees it: at one set of wavelengths and at one time.
use super::{Interaction, Looks, Scene, filled::Filled, moment::Moment};
use crate::{
    bsdf::{Bsdf, Lobes, Lookup, Material, Scatter},
    camera::{Camera, Project},
    light::{Emitter, LiSample, Light, LightId, Surroundings},
    sampler::Sampler,
    spectrum::{Spectrum, Wavelengths},
};
use glam::{Vec2, Vec3};
use std::{borrow::Cow, sync::Arc};

/// What algorithms ask: rays, lights, materials.
pub struct World<'s> {
    pub(super) scene: &'s Scene,
    pub(super) around: Surroundings,
    time: f32,
    pub(super) moment: Arc<Moment>,
    pub(super) filled: Filled,
    /// What materials are that are the same everywhere, by material.
    pub(super) even: Vec<Option<Even>>,
    camera: Cow<'s, Camera>,
}

/// A material that is the same everywhere, as one pass sees it: looked up once, not at every hit.
#[derive(Clone, Copy, Debug)]
pub(super) struct Even {
    pub(super) bsdf: Bsdf,
    /// [`Interaction::widest`].
    pub(super) widest: Lobes,
}

/// A light drawn for next-event estimation, with all probabilities multiplied in.
#[derive(Clone, Copy, Debug)]
pub struct DirectSample {
    /// The connection; its `pdf` includes the choice of the light.
    pub li: LiSample,
    /// Which light.
    pub light: LightId,
}

/// A light outside the scene, seen by a ray that leaves it.
#[derive(Clone, Copy, Debug)]
pub struct Sky {
    /// Which light.
    pub light: LightId,
    /// Radiance.
    pub le: Spectrum,
    /// Density (1/sr, choice of the light included) with which [`World::sample_direct`] finds it.
    pub pdf_direct: f32,
}

impl Scene {
    /// See [`World::even`].
    fn even(&self, lambda: Wavelengths) -> Vec<Option<Even>> {
        let at = Lookup::new(&self.textures, Vec2::ZERO, Vec3::ZERO, lambda);
        let one = |(m, looks): (&Material, &Looks)| {
            looks.is_even.then(|| {
                let bsdf = m.resolve(&at);
                Even { bsdf, widest: bsdf.lobes() }
            })
        };
        self.materials.iter().zip(&self.looks).map(one).collect()
    }
}

impl<'s> World<'s> {
    pub(super) fn new(scene: &'s Scene, lambda: Wavelengths, time: f32) -> Self {
        let around = scene.surroundings(lambda);
        let camera = match &scene.camera_to {
            None => Cow::Borrowed(&scene.camera),
            Some(to) => Cow::Owned(scene.camera.between(to, time).expect("a way that was found when it was built")),
        };
        let moment = scene.geometry.at(&scene.lights, &around, time);
        let even = scene.even(lambda);
        let mut world = Self { scene, around, time, moment, filled: Filled::default(), even, camera };
        world.fill();
        world
    }
    /// The scene behind it.
    pub fn scene(&self) -> &'s Scene {
        self.scene
    }
    /// What the lanes mean.
    pub fn lambda(&self) -> Wavelengths {
        self.around.lambda
    }
    /// When, in [0, 1] while the shutter is open.
    pub fn time(&self) -> f32 {
        self.time
    }
    /// The eye.
    #[inline]
    pub fn camera(&self) -> &Camera {
        &self.camera
    }
    /// What lights may know of the scene.
    pub fn around(&self) -> &Surroundings {
        &self.around
    }

    /// The light with handle `id`.
    #[inline]
    pub fn light(&self, id: LightId) -> &Light {
        let (id, still) = (id.0 as usize, &self.scene.lights);
        still.get(id).unwrap_or_else(|| &self.moment.moved_lights[id - still.len()])
    }
    /// All lights, by [`LightId`].
    pub fn lights(&self) -> impl Iterator<Item = &Light> {
        self.scene.lights.iter().chain(&self.moment.moved_lights)
    }
    /// Probability with which light `id` is chosen, for connections and for emission.
    #[inline]
    pub fn light_prob(&self, id: LightId) -> f32 {
        self.moment.light_table.prob(id)
    }
    /// The number for [`World::choose_light`] and [`World::sample_direct`], drawn if there is a choice.
    #[inline]
    pub fn light_number(&self, sampler: &mut Sampler) -> f32 {
        if self.moment.light_table.is_one() { sampler.skip() } else { sampler.next_1d() }
    }
    /// Chooses a light in proportion to power: `(id, probability, fresh uniform number)`. `None` if there is none.
    #[inline]
    pub fn choose_light(&self, u: f32) -> Option<(LightId, f32, f32)> {
        self.moment.light_table.sample(u)
    }
    /// Draws a light and a direction toward it as seen from `from`; unshadowed.
    #[inline]
    pub fn sample_direct(&self, from: Vec3, u_light: f32, u: Vec2) -> Option<DirectSample> {
        let (light, prob, _) = self.choose_light(u_light)?;
        let mut li = self.light(light).sample_li(from, u, &self.around)?;
        li.pdf *= prob;
        Some(DirectSample { li, light })
    }
    /// With which probability a walk should go on from `at` if all it can still find is a light that
    /// [`World::sample_direct`] was asked for already: 1 where a ray may well meet one, little where lights are small and far,
    /// which light samples find with hardly any noise. A function of the place alone, for weights to count with.
    #[inline]
    pub fn hit_share(&self, at: &Interaction) -> f32 {
        if let Bsdf::Diffuse(_) = at.bsdf { self.moment.light_table.chance(at.p) } else { 1.0 }
    }
    /// Radiance leaving `at` toward where the path came from, if that surface emits.
    #[inline]
    pub fn emitted(&self, at: &Interaction) -> Spectrum {
        at.light.map_or(Spectrum::BLACK, |id| self.light(id).le(&at.emitter_hit(), at.wo, self.around.lambda))
    }
    /// Density (1/sr, choice of the light included) with which [`World::sample_direct`] at `from` finds the emitter `at`
    /// in direction `wi`.
    #[inline]
    pub fn pdf_direct(&self, from: Vec3, wi: Vec3, at: &Interaction) -> f32 {
        at.light.map_or(0.0, |id| self.light(id).pdf_li(from, wi, Some(&at.emitter_hit())) * self.light_prob(id))
    }
    /// What a ray in direction `d` sees outside the scene, light by light.
    #[inline]
    pub fn escaped(&self, from: Vec3, d: Vec3) -> impl Iterator<Item = Sky> + '_ {
        self.moment.light_table.infinite().iter().map(move |&id| {
            let light = self.light(id);
            let pdf_direct = light.pdf_li(from, d, None) * self.light_prob(id);
            Sky { light: id, le: light.le_escaped(d, self.around.lambda), pdf_direct }
        })
    }
}
