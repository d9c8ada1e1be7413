//! Patterns of two textures.
use super::{Footprint, Lookup, Texture, TextureId, UvMap, Value, noise::value};
use crate::spectrum::Rgb;
use glam::{Vec2, Vec3};

/// Two textures in turn, in squares of side 1.
#[derive(Clone, Copy, Debug)]
pub struct Checkerboard {
    /// Where the numbers of the square across and up are both even or both odd, and elsewhere.
    pub of: [TextureId; 2],
    /// Coordinates of the squares.
    pub map: UvMap,
}

impl Checkerboard {
    pub(super) fn value<V: Value>(&self, at: &Lookup) -> V {
        if !at.footprint.is_point() {
            return self.mean(at);
        }
        let cell = self.map.at(at.uv).floor();
        let is_odd = (cell.x + cell.y).rem_euclid(2.0) >= 1.0;
        at.value(self.of[usize::from(is_odd)])
    }
    /// The mean over the footprint of `at`, if the squares are even.
    #[inline(never)]
    fn mean<V: Value>(&self, at: &Lookup) -> V {
        let point = Lookup { footprint: Footprint::POINT, ..*at };
        if !self.of.iter().all(|id| matches!(at.textures[id.0 as usize], Texture::Constant(_))) {
            return self.value(&point);
        }
        let sides = at.footprint.sides.map(|s| s * self.map.scale);
        let pieces = Footprint { sides }.pieces(LEAST);
        let odd = pieces.mean(self.map.at(at.uv), |st| odd_share(st, pieces.width.max(LEAST)));
        let odd = V::pixel(Rgb::splat(odd), at.lambda);
        point.value::<V>(self.of[0]) * (V::ONE - odd) + point.value::<V>(self.of[1]) * odd
    }
}

/// Narrower means are those of points.
const LEAST: f32 = 1e-3;

/// How much of the square of side `width` around `st` lies on odd squares of the board.
fn odd_share(st: Vec2, width: f32) -> f32 {
    // The mean of a wave that is 1 on even and −1 on odd cells, by its integral, which goes up and down.
    let integral = |t: f32| 1.0 - (t.rem_euclid(2.0) - 1.0).abs();
    let wave = |t: f32| (integral(t + 0.5 * width) - integral(t - 0.5 * width)) / width;
    0.5 - 0.5 * wave(st.x) * wave(st.y)
}

/// One texture in dots on another: in every second square of side 1 or so, a dot of radius 0.35 at a random place
/// (Pharr, Jakob & Humphreys 2016, section 10.5.2).
#[derive(Clone, Copy, Debug)]
pub struct Dots {
    /// In the dots.
    pub inside: TextureId,
    /// Around them.
    pub outside: TextureId,
    /// Coordinates of the squares.
    pub map: UvMap,
}

impl Dots {
    pub(super) fn value<V: Value>(&self, at: &Lookup) -> V {
        let at = Lookup { footprint: Footprint::POINT, ..*at };
        at.value(if is_in_dot(self.map.at(at.uv)) { self.inside } else { self.outside })
    }
}

fn is_in_dot(st: Vec2) -> bool {
    const RADIUS: f32 = 0.35;
    let cell = (st + 0.5).floor();
    let random = |x: f32, y: f32| value(Vec3::new(cell.x + x, cell.y + y, 0.5));
    let centre = cell + (0.5 - RADIUS) * Vec2::new(random(1.5, 2.8), random(4.5, 9.8));
    random(0.5, 0.5) > 0.0 && st.distance_squared(centre) < RADIUS * RADIUS
}
