//! A surface that emits the same radiance in all directions of one side, or of both.
use super::{Emitter, EmitterHit, LeOrigin, LeSample, LiSample, LightEnd, Surroundings};
use crate::{
    math::{Frame, warp::square_to_cosine_hemisphere},
    shape::{AreaSample, Shape},
    spectrum::{Illuminant, Rgb, Spectrum, Wavelengths},
};
use glam::{Vec2, Vec3};
use std::f32::consts::{FRAC_1_PI, PI};

/// Which sides of a surface emit.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Default)]
pub enum Sides {
    /// The outer side only.
    #[default]
    One,
    /// Both, each with the full radiance, as in NRenderer.
    Two,
}

/// A diffuse emitter.
#[derive(Clone, Debug)]
pub struct AreaLight {
    /// The emitting surface, in world space.
    pub shape: Shape,
    /// Emitted radiance, W/(m²·sr).
    pub radiance: Illuminant,
    /// Sides that emit.
    pub sides: Sides,
}

impl AreaLight {
    /// Cosine at the emitter toward `d` if that side emits, else 0.
    #[inline]
    fn emission_cos(&self, ng: Vec3, d: Vec3) -> f32 {
        let cos = ng.dot(d);
        if self.sides == Sides::Two { cos.abs() } else { cos.max(0.0) }
    }
    /// Draws a point as seen from `from`, its direction and the density of that: by solid angle where the shape can, else by
    /// area.
    #[inline]
    fn sample_point(&self, from: Vec3, u: Vec2) -> Option<(AreaSample, Vec3, f32)> {
        if let Shape::Sphere(s) = &self.shape
            && let Some((q, pdf)) = s.sample_visible(from, u)
        {
            return Some((q, (q.p - from).try_normalize()?, pdf));
        }
        let q = self.shape.sample_area(u);
        let to = q.p - from;
        let d2 = to.length_squared();
        let wi = to * d2.sqrt().recip();
        let cos = q.ng.dot(wi).abs();
        let pdf = d2 / (cos * self.shape.area());
        (pdf.is_finite() && cos > 0.0).then_some((q, wi, pdf))
    }
}

impl Emitter for AreaLight {
    fn name(&self) -> &'static str {
        "area"
    }
    /// π·A·L for one side, twice that for two.
    fn power(&self, _: &Surroundings) -> Rgb {
        let sides = if self.sides == Sides::Two { 2.0 } else { 1.0 };
        self.radiance.rgb() * (sides * PI * self.shape.area())
    }
    #[inline]
    fn sample_li(&self, from: Vec3, u: Vec2, around: &Surroundings) -> Option<LiSample> {
        let (q, wi, pdf) = self.sample_point(from, u)?;
        (self.emission_cos(q.ng, -wi) > 0.0).then(|| LiSample {
            wi,
            li: self.radiance.at(around.lambda),
            pdf,
            delta: false,
            end: LightEnd::Surface(q),
        })
    }
    #[inline]
    fn pdf_li(&self, from: Vec3, wi: Vec3, hit: Option<&EmitterHit>) -> f32 {
        let Some(hit) = hit else { return 0.0 };
        if self.emission_cos(hit.ng, -wi) <= 0.0 {
            return 0.0;
        }
        if let Shape::Sphere(s) = &self.shape
            && let Some(pdf) = s.visible_pdf(from)
        {
            return pdf;
        }
        hit.p.distance_squared(from) / (hit.ng.dot(wi).abs() * self.shape.area())
    }
    #[inline]
    fn sample_le(&self, u_area: Vec2, u_dir: Vec2, around: &Surroundings) -> Option<LeSample> {
        let q = self.shape.sample_area(u_area);
        // Two sides share the first direction coordinate.
        let (side, u_dir, prob) = match self.sides {
            Sides::One => (1.0, u_dir, 1.0),
            Sides::Two if u_dir.x < 0.5 => (1.0, Vec2::new(2.0 * u_dir.x, u_dir.y), 0.5),
            Sides::Two => (-1.0, Vec2::new(2.0 * u_dir.x - 1.0, u_dir.y), 0.5),
        };
        let w = square_to_cosine_hemisphere(u_dir);
        let d = Frame::from_normal(side * q.ng).to_world(w);
        let cos = w.cos_theta();
        Some(LeSample {
            ray: q.emit(d),
            le: self.radiance.at(around.lambda),
            pdf_area: 1.0 / self.shape.area(),
            pdf_dir: prob * cos * FRAC_1_PI,
            cos,
            origin: LeOrigin::Surface(EmitterHit { p: q.p, ng: q.ng }),
        })
    }
    #[inline]
    fn start_le(&self, u_area: Vec2) -> LightEnd {
        LightEnd::Surface(self.shape.sample_area(u_area))
    }
    #[inline]
    fn le_along(&self, start: &LightEnd, d: Vec3, around: &Surroundings) -> Option<LeSample> {
        let LightEnd::Surface(q) = start else { return None };
        let cos = self.emission_cos(q.ng, d);
        let hit = EmitterHit { p: q.p, ng: q.ng };
        let (pdf_area, pdf_dir) = self.pdf_le(Some(&hit), d, around);
        let le = self.radiance.at(around.lambda);
        (cos > 0.0).then(|| LeSample { ray: q.emit(d), le, pdf_area, pdf_dir, cos, origin: LeOrigin::Surface(hit) })
    }
    #[inline]
    fn pdf_le(&self, hit: Option<&EmitterHit>, d: Vec3, _: &Surroundings) -> (f32, f32) {
        let Some(hit) = hit else { return (0.0, 0.0) };
        let prob = if self.sides == Sides::Two { 0.5 } else { 1.0 };
        (1.0 / self.shape.area(), prob * self.emission_cos(hit.ng, d) * FRAC_1_PI)
    }
    #[inline]
    fn le(&self, hit: &EmitterHit, wo: Vec3, lambda: Wavelengths) -> Spectrum {
        if self.emission_cos(hit.ng, wo) > 0.0 { self.radiance.at(lambda) } else { Spectrum::BLACK }
    }
    fn le_escaped(&self, _: Vec3, _: Wavelengths) -> Spectrum {
        Spectrum::BLACK
    }
    fn is_infinite(&self) -> bool {
        false
    }
    fn is_delta(&self) -> bool {
        false
    }
}
