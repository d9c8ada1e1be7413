//! Solid patterns out of noise (Perlin 1985, "An Image Synthesizer"; 2002, "Improving Noise").
use super::{Lookup, Value};
use crate::spectrum::Rgb;
use glam::{Affine3A, Vec3};

/// Which pattern.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum NoiseKind {
    /// Noise at several scales, as clouds have it.
    Fbm {
        /// Scales, each half as large as the last.
        octaves: u32,
        /// Share of each scale in the last.
        roughness: f32,
    },
    /// The absolute value at several scales: creases.
    Wrinkled {
        /// Scales.
        octaves: u32,
        /// Share of each scale in the last.
        roughness: f32,
    },
    /// Waves in gusts of wind.
    Windy,
    /// Veins.
    Marble {
        /// Scales.
        octaves: u32,
        /// Share of each scale in the last.
        roughness: f32,
        /// How far veins wander.
        variation: f32,
    },
}

/// A pattern in space.
#[derive(Clone, Copy, Debug)]
pub struct Noise {
    /// Which one.
    pub kind: NoiseKind,
    /// From the world to the pattern, whose features have about size 1.
    pub pattern_from_world: Affine3A,
}

/// More scales than that are finer than f32.
const MAX_OCTAVES: u32 = 16;

impl Noise {
    pub(super) fn value<V: Value>(&self, at: &Lookup) -> V {
        V::pixel(self.eval(self.pattern_from_world.transform_point3(at.p)), at.lambda)
    }
    /// The value at a point of the pattern; not negative.
    pub fn eval(&self, p: Vec3) -> Rgb {
        match self.kind {
            NoiseKind::Fbm { octaves, roughness } => Rgb::splat(fbm(p, octaves, roughness).max(0.0)),
            NoiseKind::Wrinkled { octaves, roughness } => {
                Rgb::splat(scales(octaves, roughness, |scale| value(p * scale).abs()))
            }
            NoiseKind::Windy => Rgb::splat(fbm(0.1 * p, 3, 0.5).abs() * fbm(p, 6, 0.5).max(0.0)),
            NoiseKind::Marble { octaves, roughness, variation } => {
                marble(0.5 + 0.5 * (p.y + variation * fbm(p, octaves, roughness)).sin())
            }
        }
    }
}

/// Sum over scales, the first with weight 1. Scales are not quite halves, so that lattices do not meet.
fn scales(octaves: u32, roughness: f32, one: impl Fn(f32) -> f32) -> f32 {
    let (mut sum, mut scale, mut weight) = (0.0, 1.0, 1.0);
    for _ in 0..octaves.min(MAX_OCTAVES) {
        sum += weight * one(scale);
        scale *= 1.99;
        weight *= roughness;
    }
    sum
}

fn fbm(p: Vec3, octaves: u32, roughness: f32) -> f32 {
    scales(octaves, roughness, |scale| value(p * scale))
}

/// The colours of marble for `t` in [0, 1]: a curve through whites, greys and a blue (Pharr, Jakob & Humphreys 2016,
/// section 10.6.5).
fn marble(t: f32) -> Rgb {
    const LIGHT: Rgb = Rgb::new(0.58, 0.58, 0.6);
    const COLOURS: [Rgb; 9] = [
        LIGHT,
        LIGHT,
        LIGHT,
        Rgb::splat(0.5),
        Rgb::new(0.6, 0.59, 0.58),
        LIGHT,
        LIGHT,
        Rgb::new(0.2, 0.2, 0.33),
        LIGHT,
    ];
    let pieces = COLOURS.len() - 3;
    let piece = ((t * pieces as f32) as usize).min(pieces - 1);
    let t = t * pieces as f32 - piece as f32;
    let [a, b, c, d] = [0, 1, 2, 3].map(|i| COLOURS[piece + i]);
    let (ab, bc, cd) = (a.lerp(b, t), b.lerp(c, t), c.lerp(d, t));
    1.5 * ab.lerp(bc, t).lerp(bc.lerp(cd, t), t)
}

/// Gradient noise: smooth, about in [−1, 1], 0 at points with whole coordinates.
pub(super) fn value(p: Vec3) -> f32 {
    let cell = p.floor();
    let f = p - cell;
    let fade = f * f * f * (f * (f * 6.0 - 15.0) + 10.0);
    let corner = |dx: f32, dy: f32, dz: f32| {
        let offset = Vec3::new(dx, dy, dz);
        gradient(cell + offset).dot(f - offset)
    };
    let lerp = |a: f32, b: f32, t: f32| a + t * (b - a);
    let row = |dy: f32, dz: f32| lerp(corner(0.0, dy, dz), corner(1.0, dy, dz), fade.x);
    lerp(lerp(row(0.0, 0.0), row(1.0, 0.0), fade.y), lerp(row(0.0, 1.0), row(1.0, 1.0), fade.y), fade.z)
}

/// One of the twelve directions to the edges of a cube, by a hash of the lattice point.
fn gradient(lattice: Vec3) -> Vec3 {
    let mut h = 0x9E37_79B9_u32;
    for c in lattice.to_array() {
        h = (h ^ (c as i32 as u32)).wrapping_mul(0x85EB_CA6B);
        h ^= h >> 15;
    }
    h = h.wrapping_mul(0xC2B2_AE35);
    let sign = |bit: u32| if h >> bit & 1 == 0 { 1.0 } else { -1.0 };
    let (a, b) = (sign(8), sign(9));
    match (h >> 16) % 3 {
        0 => Vec3::new(a, b, 0.0),
        1 => Vec3::new(a, 0.0, b),
        _ => Vec3::new(0.0, a, b),
    }
}
