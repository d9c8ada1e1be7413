//! Cutting long slanted triangles before building, so that their boxes hold less empty space.
//!
//! As Karras & Aila 2013, "Fast Parallel Construction of High-Quality Bounding Volume Hierarchies", section 4: each
//! triangle gets a number of cuts by how much of its box's surface it leaves empty, and is cut where the planes of a grid
//! of the whole scene lie, so that neighbours are cut alike.

use super::{
    Geometry,
    clip::cut,
    refs::{Bounds, CHUNK, Owner, Ref},
};
use glam::Vec4;
use rayon::prelude::*;

/// Boxes with more of the scene's surface than this are not cut: walls stay whole, near the root, where a ray that asks
/// for any hit finds them at once.
const LARGEST: f32 = 0.02;
/// One cut is worth this waste, in mean surfaces of a box, and triangles are cut if they waste twice as much.
const WORTH_A_CUT: f32 = 0.5;
/// Grid planes must leave this much of a box on either side.
const MARGIN: f32 = 0.2;

/// A reference that is to be cut.
struct Candidate {
    /// Where it lies in its chunk.
    index: usize,
    /// The cuts that would spend the same on each surface saved.
    cuts: f32,
}

/// Cuts references, which have so much half surface together; this adds at most `share` times as many as there are.
pub(super) fn presplit(refs: &mut Vec<Ref>, geometries: &[Geometry], bounds: &Bounds, surface: f64, share: f32) {
    let unit = (surface / refs.len() as f64) as f32 * WORTH_A_CUT;
    let candidate = |(index, reference): (usize, &Ref)| {
        let waste = waste(reference, geometries, bounds.half_area() * LARGEST);
        // Among n parts of a long triangle the waste falls as 1/n, so that the next cut saves about waste/n².
        (waste > 2.0 * unit).then(|| Candidate { index, cuts: (waste / unit).sqrt() })
    };
    let find = |chunk: &[Ref]| chunk.iter().enumerate().filter_map(candidate).collect();
    let candidates: Vec<Vec<Candidate>> = refs.par_chunks(CHUNK).with_max_len(1).map(find).collect();
    let scale = affordable(&candidates, (refs.len() as f32 * share) as usize);
    let grid = Grid { scene: *bounds, geometries };
    let divide = |(chunk, candidates): (&mut [Ref], &Vec<Candidate>)| {
        let mut parts = Vec::new();
        for candidate in candidates {
            let reference = &mut chunk[candidate.index];
            grid.divide(*reference, (candidate.cuts * scale) as usize, &mut parts);
            *reference = parts.pop().unwrap_or(*reference);
        }
        parts
    };
    let parts: Vec<_> = refs.par_chunks_mut(CHUNK).zip(&candidates).with_max_len(1).map(divide).collect();
    parts.iter().for_each(|parts| refs.extend_from_slice(parts));
}

/// How much more half surface the box of a triangle has than the best boxes around its parts would have: those of very
/// small parts have together twice the surface of the triangle's three projections.
fn waste(reference: &Ref, geometries: &[Geometry], largest: f32) -> f32 {
    let Owner::Triangle { geometry, primitive } = reference.owner() else { return 0.0 };
    let half_area = reference.bounds().half_area();
    if half_area > largest {
        return 0.0;
    }
    let [a, b, c] = geometries[geometry as usize].corners(primitive);
    half_area - (b - a).cross(c - a).abs().element_sum()
}

/// The factor, at most 1, by which cuts must be multiplied so that they are at most `budget`.
fn affordable(candidates: &[Vec<Candidate>], budget: usize) -> f32 {
    let count = |scale: f32| {
        let of_chunk = |chunk: &Vec<Candidate>| chunk.iter().map(|c| (c.cuts * scale) as usize).sum::<usize>();
        candidates.par_iter().map(of_chunk).sum::<usize>()
    };
    if count(1.0) <= budget {
        return 1.0;
    }
    let (mut low, mut high) = (0.0, 1.0);
    for _ in 0..16 {
        let middle = f32::midpoint(low, high);
        *(if count(middle) <= budget { &mut low } else { &mut high }) = middle;
    }
    low
}

/// The scene's box, halved again and again on each axis.
struct Grid<'a> {
    scene: Bounds,
    geometries: &'a [Geometry<'a>],
}

impl Grid<'_> {
    /// The parts of a reference after `cuts` cuts.
    fn divide(&self, reference: Ref, cuts: usize, parts: &mut Vec<Ref>) {
        let bounds = reference.bounds();
        let axis = longest(bounds.hi - bounds.lo);
        let halves =
            if cuts > 0 { cut(&reference, axis, self.plane(&bounds, axis), self.geometries) } else { (None, None) };
        let (Some(below), Some(above)) = halves else { return parts.push(reference) };
        let [low, high] = [&below, &above].map(|part| (part.bounds().hi - part.bounds().lo).max_element());
        let cuts = cuts - 1;
        let cuts_below = ((cuts as f32 * low / (low + high)).round() as usize).min(cuts);
        self.divide(below, cuts_below, parts);
        self.divide(above, cuts - cuts_below, parts);
    }

    /// The coarsest plane of the grid that meets the box, or the box's middle if that plane only cuts off an edge.
    fn plane(&self, bounds: &Bounds, axis: usize) -> f32 {
        let (lo, hi, start) = (bounds.lo[axis], bounds.hi[axis], self.scene.lo[axis]);
        let mut step = self.scene.hi[axis] - start;
        let mut plane = hi;
        // The step is below the box's length when this ends, so after at most as many rounds as f32 has exponents.
        while plane >= hi && step > 0.0 {
            step *= 0.5;
            plane = start + ((lo - start) / step).floor() * step + step;
        }
        let margin = (hi - lo) * MARGIN;
        if plane > lo + margin && plane < hi - margin { plane } else { f32::midpoint(lo, hi) }
    }
}

/// The axis along which a vector is longest.
fn longest(v: Vec4) -> usize {
    if v.x >= v.y && v.x >= v.z {
        0
    } else if v.y >= v.z {
        1
    } else {
        2
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::bvh::refs;
    use glam::{Vec3, Vec3Swizzles, Vec4Swizzles};

    /// Two hundred slivers across a cube and as many small triangles, from a fixed formula.
    fn mesh() -> Vec<Vec3> {
        let wave = |i: usize, k: f32| ((i as f32 + 1.0) * k).sin();
        let triangle = |i: usize| {
            let at = Vec3::new(wave(i, 1.3), wave(i, 2.1), wave(i, 3.7));
            let size = if i < 200 { 0.25 } else { 0.01 };
            let along = Vec3::new(wave(i, 5.3), wave(i, 6.1), wave(i, 7.9)) * size;
            [at, at + along, at + along + along.yzx() * (0.001 / size)]
        };
        (0..400).flat_map(triangle).collect()
    }

    #[test]
    fn parts_cover_their_triangles_with_less_surface_within_the_budget() {
        let positions = mesh();
        let indices: Vec<[u32; 3]> = (0..400).map(|i| [3 * i, 3 * i + 1, 3 * i + 2]).collect();
        let geometries = [Geometry::Triangles { positions: &positions, indices: &indices }];
        let whole = refs::collect(&geometries, &[], 0.0).refs;
        let (bounds, before) = refs::measure(&whole);
        let surface = |refs: &[Ref]| refs.iter().map(|r| r.bounds().half_area()).sum::<f32>();
        for share in [0.0, 0.1, 0.3] {
            let mut refs = whole.clone();
            presplit(&mut refs, &geometries, &bounds, before, share);
            let added = refs.len() - whole.len();
            assert!(added <= (400.0 * share) as usize && added >= (350.0 * share) as usize, "{added} added");
            assert!(surface(&refs) <= surface(&whole) * (1.0 - share), "share {share}");
            for (triangle, corners) in indices.iter().enumerate() {
                let [a, b, c] = corners.map(|i| positions[i as usize]);
                let owner = Owner::Triangle { geometry: 0, primitive: triangle as u32 };
                for k in 0..50 {
                    let (u, v) = (k as f32 / 49.0, (k * 7 % 50) as f32 / 49.0);
                    let point = a.lerp(b, u).lerp(c, v);
                    let slack = Vec3::splat(1e-6);
                    let covered = refs.iter().filter(|r| r.owner() == owner).any(|r| {
                        let bounds = r.bounds();
                        (bounds.lo.xyz() - slack).cmple(point).all() && (bounds.hi.xyz() + slack).cmpge(point).all()
                    });
                    assert!(covered, "{point} of {triangle}");
                }
            }
        }
    }
}
