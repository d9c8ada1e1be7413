//! What lies between surfaces: which interior a ray is in, what it takes, and which surfaces are none within it.
use super::{Interaction, World};
use crate::{
    bsdf::cover::Coin,
    camera::Project,
    light::{Emitter, LightId},
    math::Ray,
    medium::{Inside, InteriorId, Medium, Seen},
    spectrum::Spectrum,
};
use accel::Hit;
use glam::{Vec2, Vec3};
use std::sync::atomic::Ordering;

/// The interiors of a scene as one pass sees them. Empty if there are none.
#[derive(Debug, Default)]
pub(super) struct Filled {
    media: Vec<Seen>,
    /// Some interior has a priority, so that surfaces may be hidden.
    ranked: bool,
    /// Where camera paths start, and those of each light.
    camera: Inside,
    lights: Vec<Inside>,
}

/// Directions of the rays that look for what a point is in; none is likely to run along a surface.
const PROBES: [Vec3; 3] =
    [Vec3::new(0.267, 0.802, 0.534), Vec3::new(-0.707, -0.121, 0.697), Vec3::new(0.312, -0.937, -0.156)];
/// Surfaces that such a ray crosses at most.
const CROSSINGS: u32 = 256;

impl World<'_> {
    /// Prepares what interiors need; does nothing where there are none.
    pub(super) fn fill(&mut self) {
        if self.scene.interiors.is_empty() {
            return;
        }
        let media = self.scene.interiors.iter().map(|i| Seen::new(i, self.around.lambda)).collect();
        let ranked = self.scene.interiors.iter().any(|i| i.priority > 0);
        self.filled = Filled { media, ranked, ..Filled::default() };
        let middle = Vec2::splat(0.5);
        self.filled.camera = self.inside_at(self.camera().ray(middle, middle).ray.o);
        self.filled.lights = (self.lights())
            .map(|light| {
                let le = if light.is_infinite() { None } else { light.sample_le(middle, middle, &self.around) };
                le.map_or(Inside::NOTHING, |le| self.inside_at(le.ray.o))
            })
            .collect();
    }
    /// Whether surfaces have interiors at all.
    #[inline]
    pub(crate) fn is_filled(&self) -> bool {
        !self.filled.media.is_empty()
    }
    /// The interiors that camera paths start in.
    #[inline]
    pub fn camera_inside(&self) -> Inside {
        self.filled.camera
    }
    /// The interiors that paths from the light `id` start in.
    #[inline]
    pub fn light_inside(&self, id: LightId) -> Inside {
        self.filled.lights.get(id.0 as usize).copied().unwrap_or(Inside::NOTHING)
    }
    /// What is left of light after `distance` (world units) in `medium`.
    #[inline]
    pub fn transmittance(&self, medium: Medium, distance: f32) -> Spectrum {
        medium.interior().map_or(Spectrum::ONE, |id| self.filled.media[usize::from(id.0)].transmittance(distance))
    }
    /// What passes along the shadow ray `ray` from `at`: `None` if something blocks it.
    #[inline]
    pub fn passed(&self, at: &Interaction, ray: &Ray) -> Option<Spectrum> {
        if self.is_filled() { self.passed_within(at, ray) } else { (!self.occluded(ray)).then_some(Spectrum::ONE) }
    }
    #[inline(never)]
    fn passed_within(&self, at: &Interaction, ray: &Ray) -> Option<Spectrum> {
        let medium = at.medium_toward(ray.d);
        let blocked = if self.filled.ranked {
            let coin = Coin::new(ray);
            self.moment.bvh.occluded_filtered(ray, |hit| {
                (self.scene.porous.is_empty() || self.meets(hit, ray, coin)) && !self.is_hidden(hit, ray, medium)
            })
        } else {
            self.occluded(ray)
        };
        let distance = if ray.tmax.is_finite() { ray.d.length() } else { f32::INFINITY };
        (!blocked).then(|| self.transmittance(medium, distance))
    }
    /// Whether the surface of `hit` is none for a ray within `medium`.
    fn is_hidden(&self, hit: &Hit, ray: &Ray, medium: Medium) -> bool {
        let (surface, _) = self.surface(hit);
        let Some(id) = self.scene.looks[surface.material.0 as usize].interior else { return false };
        let (_, point) = self.locate(hit, ray);
        medium.hides(id, self.priority(id), ray.d.dot(point.ng) < 0.0)
    }
    fn priority(&self, id: InteriorId) -> u16 {
        self.filled.media[usize::from(id.0)].priority
    }

    /// Goes on from `hit` to the first surface that a path in `inside` meets, past those that are hidden, and tells it the media on
    /// both sides. In place: a copy of a hit is dear.
    #[inline(never)]
    pub(crate) fn within(&self, hit: &mut Option<Interaction>, inside: &mut Inside) {
        let mut before = 0.0;
        while let Some(at) = hit {
            let near = inside.medium();
            (at.near, at.far) = (near, near);
            at.distance += before;
            let Some((id, entering)) = self.boundary(at) else { return };
            let priority = self.priority(id);
            if near.hides(id, priority, entering) {
                self.cross(at, inside);
                before = at.distance;
                let on = at.spawn(-at.wo);
                *hit = self.intersect(&on);
                continue;
            }
            let past = inside.past(id, priority, entering);
            at.far = past.medium();
            let other = if entering { near } else { at.far };
            if let Some(other) = other.interior().filter(|_| priority > 0) {
                at.bsdf = at.bsdf.immersed(self.filled.media[usize::from(other.0)].ior);
            }
            return;
        }
    }
    /// The interior behind the surface at `at`, and whether a path that goes on through it enters it.
    #[inline]
    fn boundary(&self, at: &Interaction) -> Option<(InteriorId, bool)> {
        self.scene.looks[at.material.0 as usize].interior.map(|id| (id, at.ng.dot(at.wo) > 0.0))
    }
    /// Takes a path through the surface at `at`.
    #[inline]
    pub(crate) fn cross(&self, at: &Interaction, inside: &mut Inside) {
        match self.boundary(at) {
            Some((id, false)) => inside.leave(id),
            Some((id, true)) if inside.enter(id, self.priority(id)) => {}
            Some(_) => self.scene.crowded.store(true, Ordering::Relaxed),
            None => {}
        }
    }

    /// The interiors around `p`, as most rays that leave it tell.
    fn inside_at(&self, p: Vec3) -> Inside {
        let told = PROBES.map(|d| self.inside_by(Ray::new(p, d.normalize())));
        if told[1] == told[2] { told[1] } else { told[0] }
    }
    /// The interiors around the origin of `ray`: those that it leaves without having entered them, the last one first.
    fn inside_by(&self, mut ray: Ray) -> Inside {
        let (mut entered, mut left) = (Vec::new(), Vec::new());
        for _ in 0..CROSSINGS {
            let Some(at) = self.intersect(&ray) else { break };
            match self.boundary(&at) {
                Some((id, true)) => entered.push(id),
                Some((id, false)) => match entered.iter().rposition(|e| *e == id) {
                    Some(i) => drop(entered.remove(i)),
                    None => left.push(id),
                },
                None => {}
            }
            ray = at.spawn(ray.d);
        }
        left.iter().rev().fold(Inside::NOTHING, |inside, id| inside.past(*id, self.priority(*id), true))
    }
}
