//! What weights are told: the densities where a path ends on a light and where two subpaths are joined.
use super::{
    mis::{LightStart, Rule, Sums},
    vertex::{self, LightSums},
    weights::Joint,
};
use crate::{
    camera::CameraSample,
    light::{Emitter, EmitterHit, LeOrigin, LightEnd, LightId},
    photon::Source,
    scene::{DirectSample, Interaction, Sky, World},
};
use glam::Vec3;

/// What all weights of one camera path have in common.
#[derive(Clone, Copy)]
pub(super) struct Joins<'w> {
    pub(super) world: &'w World<'w>,
    pub(super) source: &'w Source,
    pub(super) rule: &'w Rule,
    /// [`Rule::eta`] of the radius.
    pub(super) eta: f32,
    /// Probability of walking on to a hit where next-event estimation was tried (see [`World::hit_share`]).
    pub(super) hit_share: f32,
}

/// The last leg of a camera path that met a light.
#[derive(Clone, Copy)]
pub(super) struct LastLeg {
    /// Where it began.
    pub(super) from: Vec3,
    /// Density (1/sr) of its direction; `None` from a delta lobe.
    pub(super) pdf: Option<f32>,
}

impl LastLeg {
    pub(super) fn new(from: Vec3, pdf: f32, delta: bool) -> Self {
        Self { from, pdf: (!delta).then_some(pdf) }
    }
}

impl Joins<'_> {
    /// Weight of meeting the surface `at`, a light.
    #[inline]
    pub(super) fn hit(&self, sums: &Sums, leg: LastLeg, at: &Interaction) -> f32 {
        let direct = leg.pdf.map_or(0.0, |pdf| self.world.pdf_direct(leg.from, -at.wo, at) / (pdf * self.hit_share));
        let emitted = |light| self.source.pdf(self.world, light, Some(&at.emitter_hit()), at.p, at.wo);
        let light = at.light.filter(|_| self.rule.needs_sums());
        self.rule.hit_weight(sums, direct, light.map_or(0.0, emitted), self.eta)
    }
    /// Weight of leaving the scene toward `d`, where `sky` is.
    #[inline]
    pub(super) fn sky(&self, sums: &Sums, leg: LastLeg, d: Vec3, sky: &Sky) -> f32 {
        let direct = leg.pdf.map_or(0.0, |pdf| sky.pdf_direct / (pdf * self.hit_share));
        let emitted = self.source.pdf(self.world, sky.light, None, leg.from, -d);
        self.rule.hit_weight(sums, direct, emitted, self.eta)
    }
    /// Weight of the light's point `d` chosen from `at`.
    #[inline]
    pub(super) fn nee(&self, sums: &Sums, at: &Interaction, d: &DirectSample) -> f32 {
        let li = &d.li;
        let hit_over_pdf =
            if self.world.light(d.light).is_delta() { 0.0 } else { self.hit_share * at.pdf(li.wi) / li.pdf };
        if !self.rule.needs_sums() {
            return self.rule.nee_weight(sums, at, hit_over_pdf, 0.0, 0.0, self.eta);
        }
        // Per area at the vertex, over the choice of the light's point in the measure of the emission.
        let (hit, to_emission) = match &li.end {
            LightEnd::Infinite => (None, 1.0),
            LightEnd::Point(p) => (None, p.distance_squared(at.p)),
            LightEnd::Surface(q) => (Some(EmitterHit { p: q.p, ng: q.ng }), q.ng.dot(li.wi).abs()),
        };
        let emitted = self.source.pdf(self.world, d.light, hit.as_ref(), at.p, -li.wi);
        let emitted_over_pdf = emitted * at.true_cos(li.wi) / (li.pdf * to_emission);
        self.rule.nee_weight(sums, at, hit_over_pdf, emitted_over_pdf, at.pdf_back(li.wi), self.eta)
    }
    /// Weight of the connection from `at` toward `wi` to `v`, the square of `d2` away.
    #[inline]
    pub(super) fn connect(&self, sums: &Sums, at: &Interaction, v: &vertex::LightEnd, wi: Vec3, d2: f32) -> f32 {
        // Photons of the camera vertex come from the light vertex.
        let merges = self.rule.merges(at, 1, !v.at.gathers(self.rule.least));
        let camera = Joint { sums, area: v.at.pdf(-wi) * at.true_cos(wi) / d2, back: at.pdf_back(wi), merges };
        let (area, merges) = (at.pdf(wi) * v.at.true_cos(wi) / d2, v.merges);
        let light = Joint { sums: v.sums, area, back: v.at.pdf_back(-wi), merges };
        self.rule.connect_weight(&camera, &light, self.eta)
    }
}

/// The start of a light subpath, as weights need it.
#[derive(Clone, Copy)]
pub(super) struct Departed<'e> {
    pub(super) light: LightId,
    pub(super) origin: &'e LeOrigin,
    /// Cosine at the light; 1 where there is no surface.
    pub(super) cos: f32,
    /// Density of the emitted ray, choice of the light included.
    pub(super) pdf: f32,
}

impl Rule {
    /// The sums of a light subpath at its first vertex, `at`.
    pub(super) fn reach(&self, world: &World, from: Departed, at: &Interaction) -> Sums {
        if !self.needs_sums() {
            return Sums::ALONE;
        }
        let (light, prob) = (world.light(from.light), world.light_prob(from.light));
        // Density of next-event estimation, in the measure of the emission.
        let direct = match from.origin {
            LeOrigin::Surface(hit) => light.pdf_li(at.p, at.wo, Some(hit)) * from.cos,
            LeOrigin::Infinite if !light.is_delta() => light.pdf_li(at.p, at.wo, None),
            LeOrigin::Infinite => 1.0,
            LeOrigin::Point => at.distance * at.distance,
        };
        self.leave_light(&LightStart {
            direct: direct * prob,
            emitted: from.pdf,
            cos_light: from.cos,
            hittable: !light.is_delta(),
            cos: at.true_cos(at.wo),
        })
    }
    /// Weight of the connection of the light vertex `at` to the lens, of a picture of so many pixels. `merges`:
    /// [`Rule::merges`] of it.
    pub(super) fn lens(
        &self,
        sums: &LightSums,
        at: &Interaction,
        c: &CameraSample,
        pixels: usize,
        merges: f32,
        eta: f32,
    ) -> f32 {
        // `importance` is 1 / (solid angle per unit of raster area · squared distance), and a pixel has its share of that area.
        let camera_area = pixels as f32 * c.importance * at.true_cos(c.wi);
        self.light_image_weight(sums, camera_area, at.pdf_back(c.wi), merges, eta)
    }
}
