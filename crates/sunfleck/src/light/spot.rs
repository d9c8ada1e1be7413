//! A light without extent that shines into a cone with a soft edge.
use super::{Emitter, EmitterHit, LeOrigin, LeSample, LiSample, LightEnd, Surroundings};
use crate::{
    math::{Frame, Local, Ray},
    spectrum::{Illuminant, Rgb},
};
use glam::{Vec2, Vec3};
use std::f32::consts::{PI, TAU};

/// A spot light.
///
/// Full intensity up to the half-angle `hot_spot` from the axis and none beyond `fall_out`; in between it falls by
/// `s²(3 − 2s)`, where s runs from 0 to 1 linearly in the *cosine* of the angle (Pharr, Jakob & Humphreys 2023, section
/// 12.1.1, have the same).
#[derive(Clone, Debug)]
pub struct SpotLight {
    p: Vec3,
    axis: Frame,
    intensity: Illuminant,
    /// 1 − cos of `hot_spot` and of `fall_out`: exact for narrow beams too.
    hot: f32,
    out: f32,
    /// Both in radians.
    angles: [f32; 2],
    rim: Rim,
}

/// How the intensity falls from `hot_spot` to `fall_out`; s runs from 0 at the latter to 1, linearly in the cosine.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Rim {
    /// By `s²(3 − 2s)`.
    #[default]
    Smooth,
    /// By `s²`, as glTF advises.
    Square,
    /// By `s⁴`, as in pbrt up to version 3.
    Fourth,
    /// Linearly in the angle itself, as in Mitsuba.
    Even,
}

impl Rim {
    /// At `s`, between cones of the half-angles `[hot, out]`.
    #[inline]
    fn falloff(self, s: f32, [hot, out]: [f32; 2]) -> f32 {
        match self {
            Self::Smooth => s * s * (3.0 - 2.0 * s),
            Self::Square => s * s,
            Self::Fourth => (s * s) * (s * s),
            Self::Even => {
                let v = versine(out) - s * (versine(out) - versine(hot));
                ((out - angle(v)) / (out - hot)).clamp(0.0, 1.0)
            }
        }
    }
    /// Integral of the falloff over s in [0, 1].
    fn share(self, [hot, out]: [f32; 2]) -> f32 {
        match self {
            Self::Smooth => 0.5,
            Self::Square => 1.0 / 3.0,
            Self::Fourth => 0.2,
            Self::Even if out > hot => {
                let [hot, out] = [hot, out].map(f64::from);
                (beyond(hot, out) / ((out - hot) * (hot.cos() - out.cos()))) as f32
            }
            Self::Even => 0.0,
        }
    }
    /// Draws s in proportion to the falloff.
    #[inline]
    fn sample(self, u: f32, [hot, out]: [f32; 2]) -> f32 {
        match self {
            Self::Smooth => sample_smoothstep(u),
            Self::Square => u.cbrt(),
            Self::Fourth => u.powf(0.2),
            Self::Even => {
                let [low, high] = [hot, out].map(f64::from);
                let theta = sample_even(f64::from(u), low, high) as f32;
                let (hot, out) = (versine(hot), versine(out));
                ((out - versine(theta)) / (out - hot)).clamp(0.0, 1.0)
            }
        }
    }
}

/// The angle whose versine is `v`.
#[inline]
fn angle(v: f32) -> f32 {
    2.0 * (0.5 * v).max(0.0).sqrt().min(1.0).asin()
}

/// `∫ (out − θ) sin θ dθ` from `theta` to `out`.
fn beyond(theta: f64, out: f64) -> f64 {
    (out - theta) * theta.cos() - (out.sin() - theta.sin())
}

/// The angle beyond which lies the share `u` of `(out − θ) sin θ`, `hot ≤ θ ≤ out`; halving finds it.
fn sample_even(u: f64, hot: f64, out: f64) -> f64 {
    let (mut low, mut high) = (hot, out);
    let wanted = u * beyond(hot, out);
    for _ in 0..40 {
        let middle = 0.5 * (low + high);
        if beyond(middle, out) > wanted { low = middle } else { high = middle }
    }
    0.5 * (low + high)
}

/// Why numbers do not make a spot light.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum SpotError {
    /// A zero or non-finite direction.
    #[error("a spot light cannot shine along {0}")]
    Direction(Vec3),
    /// Angles out of range or in the wrong order.
    #[error(
        "a spot light's angles are {hot_spot} and {fall_out}, but must be 0 <= hot spot <= fall-out <= pi, fall-out > 0"
    )]
    Angles {
        /// Half-angle of full intensity, radians.
        hot_spot: f32,
        /// Half-angle of no intensity, radians.
        fall_out: f32,
    },
}

/// `1 − cos a` without cancellation.
fn versine(a: f32) -> f32 {
    let s = (0.5 * a).sin();
    2.0 * s * s
}

impl SpotLight {
    /// A light at `p` that shines along `direction` (of any length) with `intensity` (W/sr) on the axis; half-angles in
    /// radians.
    ///
    /// # Errors
    /// A zero direction, or angles that are not `0 <= hot_spot <= fall_out <= π` with `fall_out > 0`.
    pub fn new(
        p: Vec3,
        direction: Vec3,
        intensity: impl Into<Illuminant>,
        [hot_spot, fall_out]: [f32; 2],
    ) -> Result<Self, SpotError> {
        let axis = direction.try_normalize().ok_or(SpotError::Direction(direction))?;
        // Angles given in degrees and converted may pass π by a rounding.
        let in_order = 0.0 <= hot_spot && hot_spot <= fall_out && 0.0 < fall_out && fall_out <= 1.000_001 * PI;
        if !in_order {
            return Err(SpotError::Angles { hot_spot, fall_out });
        }
        Ok(Self {
            p,
            axis: Frame::from_normal(axis),
            intensity: intensity.into(),
            hot: versine(hot_spot),
            out: versine(fall_out),
            angles: [hot_spot, fall_out],
            rim: Rim::Smooth,
        })
    }
    /// The same light with another rim.
    pub fn with_rim(self, rim: Rim) -> Self {
        Self { rim, ..self }
    }
    /// Position.
    pub fn position(&self) -> Vec3 {
        self.p
    }
    /// Unit direction of the cone's axis.
    pub fn direction(&self) -> Vec3 {
        self.axis.n
    }
    /// Radiant intensity (W/sr) on the axis.
    pub fn intensity(&self) -> &Illuminant {
        &self.intensity
    }
    /// Angles (radians) with the axis where the intensity begins to fall and where it is gone.
    pub fn angles(&self) -> [f32; 2] {
        [self.hot, self.out].map(|v| 2.0 * (0.5 * v).sqrt().min(1.0).asin())
    }
    /// How it falls in between.
    pub fn rim(&self) -> Rim {
        self.rim
    }
    /// Share of the intensity that leaves in the unit direction `d`.
    #[inline]
    pub fn falloff(&self, d: Vec3) -> f32 {
        let v = 0.5 * d.distance_squared(self.axis.n);
        if v <= self.hot {
            return 1.0;
        }
        if v >= self.out {
            return 0.0;
        }
        let s = (self.out - v) / (self.out - self.hot);
        self.rim.falloff(s, self.angles)
    }
    /// Integral of [`SpotLight::falloff`] over directions (sr): the inner cone's solid angle and a share of the rim's.
    fn solid_angle(&self) -> f32 {
        TAU * (self.hot + self.rim.share(self.angles) * (self.out - self.hot))
    }
    /// `1 − cos` of the angle of a direction drawn in proportion to the falloff.
    #[inline]
    fn sample_versine(&self, u: f32) -> f32 {
        let inner = self.hot / (self.hot + self.rim.share(self.angles) * (self.out - self.hot));
        if u < inner {
            self.hot * (u / inner)
        } else {
            self.out - (self.out - self.hot) * self.rim.sample((u - inner) / (1.0 - inner), self.angles)
        }
    }
}

/// Inverts `2s³ − s⁴`, the distribution of the density `2s²(3 − 2s)` on [0, 1].
fn sample_smoothstep(u: f32) -> f32 {
    // The distribution is convex and at least s³: Newton's method started at the cube root comes down on the root.
    let mut s = u.cbrt();
    for _ in 0..5 {
        let slope = s * s * (6.0 - 4.0 * s);
        if slope <= 0.0 {
            break;
        }
        s = (s - (s * s * s * (2.0 - s) - u) / slope).clamp(0.0, 1.0);
    }
    s
}

impl Emitter for SpotLight {
    fn name(&self) -> &'static str {
        "spot"
    }
    /// I times the solid angle; with a smooth rim 2πI(1 − (cos hot + cos out)/2).
    fn power(&self, _: &Surroundings) -> Rgb {
        self.intensity.rgb() * self.solid_angle()
    }
    #[inline]
    fn sample_li(&self, from: Vec3, _: Vec2, around: &Surroundings) -> Option<LiSample> {
        let to = self.p - from;
        let wi = to.try_normalize()?;
        let falloff = self.falloff(-wi);
        (falloff > 0.0).then(|| LiSample {
            wi,
            li: self.intensity.at(around.lambda) * (falloff / to.length_squared()),
            pdf: 1.0,
            delta: true,
            end: LightEnd::Point(self.p),
        })
    }
    #[inline]
    fn sample_le(&self, _: Vec2, u_dir: Vec2, around: &Surroundings) -> Option<LeSample> {
        let v = self.sample_versine(u_dir.x);
        let sin = (v * (2.0 - v)).max(0.0).sqrt();
        let (sin_phi, cos_phi) = (TAU * u_dir.y).sin_cos();
        let d = self.axis.to_world(Local(Vec3::new(sin * cos_phi, sin * sin_phi, 1.0 - v)));
        self.le_along(&LightEnd::Point(self.p), d, around)
    }
    #[inline]
    fn start_le(&self, _: Vec2) -> LightEnd {
        LightEnd::Point(self.p)
    }
    #[inline]
    fn le_along(&self, _: &LightEnd, d: Vec3, around: &Surroundings) -> Option<LeSample> {
        let falloff = self.falloff(d);
        (falloff > 0.0).then(|| LeSample {
            ray: Ray { o: self.p, d, tmin: 0.0, tmax: f32::INFINITY },
            le: self.intensity.at(around.lambda) * falloff,
            pdf_area: 1.0,
            pdf_dir: falloff / self.solid_angle(),
            cos: 1.0,
            origin: LeOrigin::Point,
        })
    }
    #[inline]
    fn pdf_le(&self, hit: Option<&EmitterHit>, d: Vec3, _: &Surroundings) -> (f32, f32) {
        if hit.is_some() { (0.0, 0.0) } else { (1.0, self.falloff(d) / self.solid_angle()) }
    }
    fn is_delta(&self) -> bool {
        true
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_rim_is_inverted_to_float_precision() {
        for i in 0..=1000u16 {
            let u = f32::from(i) / 1000.0;
            let s = f64::from(sample_smoothstep(u));
            assert!((s * s * s * (2.0 - s) - f64::from(u)).abs() < 3e-7, "{u}");
        }
    }

    #[test]
    fn nonsense_is_refused() {
        let spot = |d, angles| SpotLight::new(Vec3::ZERO, d, Rgb::ONE, angles);
        assert_eq!(spot(Vec3::ZERO, [0.1, 0.2]).unwrap_err(), SpotError::Direction(Vec3::ZERO));
        for angles in [[0.3, 0.2], [-0.1, 0.2], [0.0, 0.0], [0.1, 3.2], [f32::NAN, 1.0], [0.0, f32::NAN]] {
            assert!(matches!(spot(Vec3::Z, angles), Err(SpotError::Angles { .. })), "{angles:?}");
        }
        assert!(spot(Vec3::Z, [0.5, 0.5]).is_ok() && spot(Vec3::Z, [PI, PI]).is_ok());
    }
}
