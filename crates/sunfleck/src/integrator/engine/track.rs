//! The sums of [`super::mis`] along a walk, from vertex to vertex.
use super::mis::{Leg, Rule, Sums, Turn};
use crate::{
    camera::Spread,
    scene::{Interaction, Scattered},
};

/// Sums of a walk: those at its last vertex, and what happened there.
#[derive(Clone, Copy)]
pub(super) struct Track {
    /// At the last vertex.
    pub(super) sums: Sums,
    departure: Departure,
}

/// How a walk left its last vertex.
#[derive(Clone, Copy)]
enum Departure {
    /// Along a direction with a density; `merges` and `sharing` as [`Rule::scatter`] takes them.
    Scattered { turn: Turn, merges: f32, sharing: f32 },
    /// Along a delta lobe, under this cosine.
    Passed { cos: f32 },
}

impl Track {
    /// Before the first vertex.
    pub(super) fn new() -> Self {
        Self { sums: Sums::default(), departure: Departure::Passed { cos: 0.0 } }
    }
    /// Leaves `at`, the vertex of [`Track::sums`]. `sharing` turns the density of the way back into a correlation factor.
    #[inline]
    fn depart(&mut self, at: &Interaction, s: &Scattered, merges: f32, sharing: impl Fn(f32) -> f32) {
        let cos = at.true_cos(s.wi);
        self.departure = if s.delta {
            Departure::Passed { cos }
        } else {
            let back = at.pdf_back(s.wi);
            Departure::Scattered { turn: Turn { forward: s.pdf, back, cos }, merges, sharing: sharing(back) }
        };
    }
    /// The sums of a camera subpath at `at`, reached after so many scatterings. `pixel`: what one covers.
    #[inline]
    pub(super) fn arrive_from_camera(&self, rule: &Rule, pixel: Spread, scatterings: u32, at: &Interaction) -> Sums {
        if !rule.needs_sums() {
            return Sums::ALONE;
        }
        let leg = Leg::to(at);
        if scatterings == 0 { rule.leave_camera(pixel.area_at(at.distance), leg.cos) } else { self.after(rule, leg) }
    }
    /// [`Track::depart`] of a camera subpath.
    #[inline]
    pub(super) fn depart_from_camera(&mut self, rule: &Rule, at: &Interaction, s: &Scattered) {
        if !rule.needs_sums() {
            return;
        }
        // Photons gathered here will have been scattered at the next vertex, by a delta lobe for all that is known: `rough`
        // takes it back if not, and `hit_weight` if that vertex is the light.
        let merges = rule.merges(at, 1, true) * self.sums.shared;
        if !s.delta {
            self.sums = rule.rough(&self.sums, at);
        }
        self.depart(at, s, merges, |_| 1.0);
    }
    /// [`Track::depart`] of a light subpath. `merges`: [`Rule::merges`] of `at`.
    #[inline]
    pub(super) fn depart_from_light(&mut self, rule: &Rule, at: &Interaction, s: &Scattered, merges: f32) {
        if !rule.needs_sums() {
            return;
        }
        let geometry = self.sums.geometry;
        self.depart(at, s, merges, |back| rule.sharing(back * geometry));
    }
    /// The sums one leg on.
    #[inline]
    pub(super) fn after(&self, rule: &Rule, to: Leg) -> Sums {
        if !rule.needs_sums() {
            return Sums::ALONE;
        }
        match &self.departure {
            Departure::Scattered { turn, merges, sharing } => rule.scatter(&self.sums, turn, *merges, *sharing, to),
            Departure::Passed { cos } => rule.pass_through(&self.sums, *cos, to),
        }
    }
}

impl Leg {
    /// The leg that led to `at`.
    #[inline]
    pub(super) fn to(at: &Interaction) -> Self {
        Self { d2: at.distance * at.distance, cos: at.true_cos(at.wo) }
    }
    /// The leg of a ray that leaves the scene, where densities stay those of directions.
    pub(super) const AWAY: Self = Self { d2: 1.0, cos: 1.0 };
}
