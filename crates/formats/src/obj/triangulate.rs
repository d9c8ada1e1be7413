//! Polygons to triangles by ear clipping (Meisters 1975, "Polygons have ears").

use super::Corner;
use glam::{Vec2, Vec3};

/// Tests of a point against an ear that one file may cost; beyond that, polygons are cut into fans.
const BUDGET: u64 = 200_000_000;

/// Cuts the polygons of one file.
pub(crate) struct Triangulator<'p> {
    positions: &'p [[f32; 3]],
    budget: u64,
    exhausted: bool,
    flat: Vec<Vec2>,
    ring: Vec<usize>,
}

impl<'p> Triangulator<'p> {
    pub(crate) fn new(positions: &'p [[f32; 3]]) -> Self {
        Self { positions, budget: BUDGET, exhausted: false, flat: Vec::new(), ring: Vec::new() }
    }

    /// Whether some polygon was cut without care.
    pub(crate) fn is_exhausted(&self) -> bool {
        self.exhausted
    }

    /// Appends `corners.len() - 2` triangles that keep the polygon's orientation.
    pub(crate) fn triangulate(&mut self, corners: &[Corner], out: &mut Vec<[Corner; 3]>) {
        if corners.len() == 3 || self.flatten(corners) {
            return fan(corners, out);
        }
        self.clip_ears(corners, out);
    }

    /// Projects the polygon along the largest component of its normal, so that it runs counter-clockwise.
    /// True if a fan will do: it is convex, or has no area.
    fn flatten(&mut self, corners: &[Corner]) -> bool {
        let point = |c: &Corner| Vec3::from_array(self.positions[c.position as usize]);
        let origin = point(&corners[0]);
        let edges = corners.windows(2).map(|w| (point(&w[0]) - origin).cross(point(&w[1]) - origin));
        let normal: Vec3 = edges.sum();
        let a = normal.abs();
        let drop = |p: Vec3| match () {
            () if a.x >= a.y && a.x >= a.z => Vec2::new(p.y, p.z) * Vec2::new(normal.x.signum(), 1.0),
            () if a.y >= a.z => Vec2::new(p.z, p.x) * Vec2::new(normal.y.signum(), 1.0),
            () => Vec2::new(p.x, p.y) * Vec2::new(normal.z.signum(), 1.0),
        };
        self.flat.clear();
        self.flat.extend(corners.iter().map(|c| drop(point(c) - origin)));
        let n = self.flat.len();
        let turn = |i: usize| turn(self.flat[i], self.flat[(i + 1) % n], self.flat[(i + 2) % n]);
        !normal.is_finite() || normal == Vec3::ZERO || (0..n).all(|i| turn(i) >= 0.0)
    }

    fn clip_ears(&mut self, corners: &[Corner], out: &mut Vec<[Corner; 3]>) {
        self.ring.clear();
        self.ring.extend(0..corners.len());
        let mut at = 0;
        let mut tries = 0;
        while self.ring.len() > 3 {
            let n = self.ring.len();
            let [a, b, c] = [0, 1, 2].map(|k| self.ring[(at + k) % n]);
            // A polygon that crosses itself may have no ear; then any corner is cut.
            if self.is_ear(a, b, c) || tries >= n {
                out.push([corners[a], corners[b], corners[c]]);
                self.ring.remove((at + 1) % n);
                at %= n - 1;
                tries = 0;
            } else {
                at = (at + 1) % n;
                tries += 1;
            }
        }
        out.push([0, 1, 2].map(|k| corners[self.ring[k]]));
    }

    /// Whether the triangle lies inside of the polygon: it turns left and no other vertex is in it.
    fn is_ear(&mut self, a: usize, b: usize, c: usize) -> bool {
        let cost = self.ring.len() as u64;
        if self.budget < cost {
            self.exhausted = true;
            return true;
        }
        self.budget -= cost;
        let (pa, pb, pc) = (self.flat[a], self.flat[b], self.flat[c]);
        turn(pa, pb, pc) > 0.0
            && self.ring.iter().all(|&i| {
                let p = self.flat[i];
                let is_corner = p == pa || p == pb || p == pc;
                is_corner || turn(pa, pb, p) < 0.0 || turn(pb, pc, p) < 0.0 || turn(pc, pa, p) < 0.0
            })
    }
}

/// Twice the signed area of a triangle: positive when it turns left.
fn turn(a: Vec2, b: Vec2, c: Vec2) -> f32 {
    (b - a).perp_dot(c - a)
}

fn fan(corners: &[Corner], out: &mut Vec<[Corner; 3]>) {
    out.extend(corners.windows(2).skip(1).map(|w| [corners[0], w[0], w[1]]));
}
