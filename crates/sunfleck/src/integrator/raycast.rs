//! NRenderer's Ray Cast: one ray through the corner of a pixel, the first point light, Phong's formula, no falloff.
//! A picture for comparison, not an estimate of light.
use super::{Entry, Integrator, Pass, PassRenderer};
use crate::{
    bsdf::{Diffuse, Transport},
    camera::Project,
    film::{FilmSpec, Filter, PassImage, Sample},
    light::Light,
    sampler::{Domain, Sampler},
    scene::{Interaction, Scene, World},
    spectrum::{Illuminant, Rgb, Spectrum},
};
use glam::{Vec2, Vec3};
use std::f32::consts::PI;

pub(super) const ENTRY: Entry = Entry {
    name: "raycast",
    about: "NRenderer's Ray Cast: direct light of the first point light by Phong's formula, without falloff",
    params: &[],
    mergeable: true,
    // The common settings are accepted, so that switching algorithms needs no other change of a command line.
    make: |p| p.limits().map(|_| Box::new(RayCast) as Box<dyn Integrator>),
};

/// Ray casting has no settings.
#[derive(Clone, Copy, Debug, Default)]
pub struct RayCast;

impl Integrator for RayCast {
    fn prepare<'s>(&'s self, scene: &'s Scene, _: FilmSpec, _: u64) -> Box<dyn PassRenderer + 's> {
        let lamp = scene
            .lights()
            .iter()
            .find_map(|l| if let Light::Point(p) = l { Some((p.p, p.intensity.clone())) } else { None });
        Box::new(Prepared { scene, lamp })
    }
}

struct Prepared<'s> {
    scene: &'s Scene,
    /// Position and intensity; without a point light, a white lamp at the camera's eye shows the shapes.
    lamp: Option<(Vec3, Illuminant)>,
}

impl PassRenderer for Prepared<'_> {
    fn render_pass(&self, pass: &Pass, image: &mut PassImage) {
        let world = self.scene.world(pass.lambda, pass.time);
        let spec = image.spec();
        image.fill(|x, y, counts| {
            // NRenderer looks through the pixel's lower left corner; a filtered picture looks anywhere in the pixel.
            let pixel = u64::from(y) * u64::from(spec.width) + u64::from(x);
            let u = match spec.filter {
                Filter::NRenderer | Filter::Middle => Vec2::splat(0.5),
                Filter::Box | Filter::Shaped(_) => Sampler::new(pass.seed, Domain::Camera, pass.index, pixel).next_2d(),
            };
            let Sample { raster, weight } = spec.sample(x, y, u);
            let ray = world.camera().ray(raster, Vec2::splat(0.5)).ray;
            counts.rays += 2;
            let Some(at) = world.intersect(&ray) else { return Rgb::ZERO };
            self.shade(&world, &at, ray.o).to_rgb(pass.lambda) * weight
        });
    }
}

impl Prepared<'_> {
    /// `(kd·N·L + ks·|V·R|ⁿ)·I`, which is π·f·cos·I for the material models made for it; shadowed, no 1/r².
    fn shade(&self, world: &World, at: &Interaction, eye: Vec3) -> Spectrum {
        let (lamp, intensity) = match &self.lamp {
            Some((p, intensity)) => (*p, intensity.at(world.lambda())),
            None => (eye, Spectrum::emission(Rgb::ONE, world.lambda())),
        };
        let Some(wi) = (lamp - at.p).try_normalize() else { return Spectrum::BLACK };
        // Mirrors and glass are shaded as white paper.
        let specular = at.sample(0.5, Vec2::splat(0.5), Transport::Radiance).is_some_and(|s| s.delta);
        let paper = Interaction { bsdf: Diffuse { reflectance: Spectrum::ONE }.into(), ..*at };
        let f_cos = if specular { paper } else { *at }.f_cos(wi, Transport::Radiance);
        if f_cos.is_black() || world.occluded(&at.spawn_to(wi, lamp)) {
            return Spectrum::BLACK;
        }
        f_cos * intensity * PI
    }
}
