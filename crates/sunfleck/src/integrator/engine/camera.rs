//! Camera subpaths: each sampler that is on, at every vertex.
use super::{
    gather::gather,
    joins::{Joins, LastLeg},
    lamps::{First, Lamps},
    light::Subpaths,
    mis::{Leg, Rule, Sums},
    plan::Plan,
    techniques::Technique,
    track::Track,
    vertex::Photon,
};
use crate::{
    bsdf::Transport,
    camera::Spread,
    film::Counts,
    photon::{CameraEnd, Disc, Kernel, Radii, RadiusMap, Source},
    sampler::Sampler,
    scene::{Interaction, Scattered, World},
    spectrum::Spectrum,
    walk::{Arrival, Escape, Limits, Step, Visit},
};
use glam::Vec3;

/// What all camera paths of a pass share.
pub(super) struct Eye<'w> {
    pub(super) world: &'w World<'w>,
    pub(super) rule: Rule,
    pub(super) source: &'w Source,
    pub(super) limits: Limits,
    pub(super) kernel: Kernel,
    /// Photons, if they are gathered.
    pub(super) map: Option<RadiusMap<Photon>>,
    pub(super) subpaths: Subpaths,
    pub(super) radii: &'w Radii,
    /// What is merged where, if it is not the same everywhere.
    pub(super) plan: Option<&'w Plan>,
    /// Radius of this pass over the first.
    pub(super) shrink: f32,
    /// Set to see one sampler alone.
    pub(super) only: Option<Only>,
}

/// One sampler seen alone.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Only {
    pub(super) technique: Technique,
    /// As it counts in the picture; otherwise as if it were the only one.
    pub(super) weighted: bool,
}

/// Adds up what one camera path finds.
pub(super) struct Look<'w> {
    eye: &'w Eye<'w>,
    /// [`Eye::rule`], with the merging of this place on the picture.
    rule: Rule,
    /// What the path's pixel covers.
    pixel: Spread,
    radius: f32,
    /// [`Rule::eta`] of the radius.
    eta: f32,
    /// Which light path is connected to; drawn once.
    partner: usize,
    track: Track,
    /// Only surfaces without other than delta lobes so far: the lights that are met are left to [`Lamps`].
    mirrors_only: bool,
    /// The first surface, if it was a mirror or glass.
    mirror: Option<First>,
    /// The last vertex gathered all but direct light.
    gathered: bool,
    /// [`Joins::hit_share`] of the last vertex.
    hit_share: f32,
    /// Where the current leg began.
    from: Vec3,
    sum: Spectrum,
    rays: u64,
    counts: &'w mut Counts,
}

impl<'w> Look<'w> {
    pub(super) fn new(eye: &'w Eye<'w>, start: EyeStart, counts: &'w mut Counts) -> Self {
        let radius = eye.shrink * eye.radii.at(start.raster);
        let mut rule = eye.rule;
        if let Some(plan) = eye.plan {
            rule.on.merge = plan.at(start.raster);
        }
        Self {
            eye,
            rule,
            pixel: start.pixel,
            radius,
            eta: rule.eta(radius),
            partner: start.partner,
            track: Track::new(),
            mirrors_only: true,
            mirror: None,
            gathered: false,
            hit_share: 1.0,
            from: start.from,
            sum: Spectrum::BLACK,
            rays: 0,
            counts,
        }
    }
    /// Adds the lights that are seen through mirrors and glass alone; `sampler` goes on from the walk.
    pub(super) fn add_lamps(&mut self, sampler: &mut Sampler) {
        let Some(first) = self.mirror.take() else { return };
        let lamps = Lamps::look(self.eye.world, &first, self.eye.limits, sampler);
        self.rays += u64::from(lamps.rays);
        self.add(Technique::Hit, lamps.sum, 1.0);
    }
    /// What the path found; `rays` were traced by its walk.
    #[inline]
    pub(super) fn finish(self, rays: u64) -> Spectrum {
        self.counts.rays += rays + self.rays;
        self.sum
    }
    #[inline]
    fn add(&mut self, technique: Technique, value: Spectrum, weight: f32) {
        match self.eye.only {
            None => self.sum += value * weight,
            Some(o) if o.technique == technique => self.sum += value * if o.weighted { weight } else { 1.0 },
            Some(_) => {}
        }
    }
}

/// How a camera path begins.
#[derive(Clone, Copy)]
pub(super) struct EyeStart {
    /// Place on the picture.
    pub(super) raster: glam::Vec2,
    /// Point on the lens.
    pub(super) from: Vec3,
    /// What its pixel covers.
    pub(super) pixel: Spread,
    /// Light path to connect to.
    pub(super) partner: usize,
}

impl Visit for Look<'_> {
    #[inline]
    fn surface(&mut self, a: &Arrival, sampler: &mut Sampler) -> Step {
        let eye = self.eye;
        if a.scatterings == 0 && eye.rule.on.hit && !a.at.is_connectible() {
            self.mirror = Some(First::new(a));
        }
        let sums = self.track.arrive_from_camera(&self.rule, self.pixel, a.scatterings, a.at);
        self.meet(a, &sums);
        let first_only = self.rule.on.merge.at_first_only();
        if self.gathered {
            return Step::Stop;
        }
        self.track.sums = sums;
        self.from = a.at.p;
        // What is not drawn is skipped, so that the dimensions of what follows do not depend on the material.
        if a.scatterings >= eye.limits.scatterings || !a.at.is_connectible() {
            sampler.skip_many(2);
            return Step::On;
        }
        let rough = self.rule.rough(&sums, a.at);
        let gathers = a.at.gathers(self.rule.least);
        self.gathered = first_only && gathers;
        self.hit_share = if self.gathered { eye.world.hit_share(a.at) } else { 1.0 };
        if self.rule.on.nee {
            let (u_light, u) = (eye.world.light_number(sampler), sampler.next_2d());
            self.choose_light(a, &rough, u_light, u);
        } else {
            sampler.skip_many(2);
        }
        if self.rule.on.connect {
            self.connect(a, &rough);
        }
        if gathers && self.rule.on.merge.is_on() && sums.shared > 0.0 {
            self.gather(a, &rough);
        }
        // Past the first gather, the walk goes on for lights that next-event estimation finds badly, and for nothing else.
        let goes_on =
            !self.gathered || (self.rule.on.nee && (self.hit_share >= 1.0 || sampler.next_1d() < self.hit_share));
        if goes_on { Step::On } else { Step::OnIfDelta }
    }
    #[inline]
    fn scatter(&mut self, at: &Interaction, s: &Scattered) {
        self.mirrors_only &= !at.is_connectible();
        // What delta lobes bring was not gathered.
        self.gathered &= !s.delta;
        self.track.depart_from_camera(&self.rule, at, s);
    }
    #[inline]
    fn escape(&mut self, e: &Escape) {
        let eye = self.eye;
        if e.scatterings > 0 && (self.mirrors_only || !self.rule.on.hit) {
            return;
        }
        let sums = if e.scatterings == 0 { Sums::default() } else { self.track.after(&self.rule, Leg::AWAY) };
        for sky in eye.world.escaped(self.from, e.ray.d) {
            let weight = if e.scatterings == 0 {
                1.0
            } else {
                self.joins().sky(&sums, LastLeg::new(self.from, e.pdf, e.delta), e.ray.d, &sky)
            };
            self.add(Technique::Hit, e.beta * sky.le * self.rarity(e.delta), weight);
        }
    }
}

impl Look<'_> {
    #[inline]
    fn joins(&self) -> Joins<'_> {
        Joins {
            world: self.eye.world,
            source: self.eye.source,
            rule: &self.rule,
            eta: self.eta,
            hit_share: self.hit_share,
        }
    }

    /// What a light is multiplied by that the last leg met: walks along other than delta lobes may have been let go on rarely.
    #[inline]
    fn rarity(&self, delta: bool) -> f32 {
        if delta { 1.0 } else { self.hit_share.recip() }
    }

    /// The surface may be a light.
    #[inline]
    fn meet(&mut self, a: &Arrival, sums: &Sums) {
        let eye = self.eye;
        let le = eye.world.emitted(a.at);
        // Lights seen directly are left to this sampler, whatever is on.
        if le.is_black() || (a.scatterings > 0 && (self.mirrors_only || !self.rule.on.hit)) {
            return;
        }
        let weight = if a.scatterings == 0 {
            1.0
        } else {
            self.joins().hit(sums, LastLeg::new(self.from, a.pdf, a.delta), a.at)
        };
        self.add(Technique::Hit, a.beta * le * self.rarity(a.delta), weight);
    }

    /// Next-event estimation.
    #[inline]
    fn choose_light(&mut self, a: &Arrival, sums: &Sums, u_light: f32, u: glam::Vec2) {
        let (world, at) = (self.eye.world, a.at);
        let Some(d) = world.sample_direct(at.p, u_light, u) else { return };
        let li = &d.li;
        let f = at.f_cos(li.wi, Transport::Radiance);
        if f.is_black() {
            return;
        }
        self.rays += 1;
        let Some(passed) = world.passed(at, &at.spawn_toward(li.wi, &li.end)) else { return };
        let weight = self.joins().nee(sums, at, &d);
        self.add(Technique::Nee, a.beta * f * li.li * passed * (1.0 / li.pdf), weight);
    }

    /// Connections to the vertices of one light path.
    #[inline]
    fn connect(&mut self, a: &Arrival, sums: &Sums) {
        let eye = self.eye;
        let (among, path) = eye.subpaths.path(self.partner);
        for v in path {
            if a.scatterings + v.scatterings() + 2 > eye.limits.scatterings {
                break;
            }
            let to = v.place.p - a.at.p;
            let d2 = to.length_squared();
            let Some(wi) = to.try_normalize() else { continue };
            if !v.place.sides_agree(-wi) {
                continue;
            }
            let f = a.at.f_cos(wi, Transport::Radiance);
            if f.is_black() {
                continue;
            }
            let end = among.end(eye.world, v);
            let f = f * end.at.f_cos(-wi, Transport::Flux);
            if f.is_black() {
                continue;
            }
            self.rays += 1;
            let Some(passed) = eye.world.passed(a.at, &a.at.spawn_to_surface(wi, &end.at)) else { continue };
            let weight = self.joins().connect(sums, a.at, &end, wi, d2);
            let join = Spectrum::join(a.dispersed, v.dispersed());
            self.add(Technique::Connect, a.beta * f * v.flux() * passed * (join / d2), weight);
        }
    }

    /// Photons around the vertex.
    #[inline]
    fn gather(&mut self, a: &Arrival, sums: &Sums) {
        let eye = self.eye;
        let Some(map) = &eye.map else { return };
        let Some(most) = eye.limits.scatterings.checked_sub(a.scatterings + 1) else { return };
        let disc = Disc { radius: self.radius, kernel: eye.kernel };
        let unweighted = self.rule.on.merge.at_first_only() || eye.only.is_some_and(|o| !o.weighted);
        let end = CameraEnd { most, dispersed: a.dispersed };
        let (rule, eta) = (&self.rule, self.eta);
        let weigh = |photon: &Photon, at| rule.merge_weight(sums, &photon.sums, u32::from(photon.scatterings), at, eta);
        let takes = |photon: &Photon| rule.gathers(photon.caustic);
        let value = gather(map, a.at, disc, end, takes, (!unweighted).then_some(&weigh));
        self.add(Technique::Merge, a.beta * value, 1.0);
    }
}
