//! Patterns of two textures.
use super::{Lookup, TextureId, UvMap, Value, noise::value};
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
        let cell = self.map.at(at.uv).floor();
        let is_odd = (cell.x + cell.y).rem_euclid(2.0) >= 1.0;
        at.value(self.of[usize::from(is_odd)])
    }
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
