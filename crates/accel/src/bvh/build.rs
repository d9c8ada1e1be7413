//! The binary hierarchy: split ranges of references until each fits a block.

use super::{
    Geometry, Quality,
    binning::ObjectSplit,
    collapse::{Forest, Plan},
    few,
    refs::{Bounds, CHUNK, Owner, Ref},
    simd::SimdLevel,
    spatial::SpatialSplit,
    tree::{Binary, Content, NO_TRIANGLE, Words},
    triangle::LANES,
};
use rayon::prelude::*;

/// Below this depth ranges are halved by count, so that no input makes a deep tree.
const FAIR_DEPTH: usize = 40;
/// No path from the root is longer: what is left after `FAIR_DEPTH` has at most 2^28 references, is halved at most 26 times, and four
/// references take three splits.
pub(super) const MAX_DEPTH: usize = FAIR_DEPTH + 29;
/// Ranges longer than this are built in parallel.
const PARALLEL: usize = 4096;

/// A range of references with its boxes.
struct Range<'a> {
    refs: &'a mut [Ref],
    side: Side,
    surfaces: Surfaces,
    depth: usize,
    /// How many references may be added by cutting.
    budget: usize,
}

impl Range<'_> {
    /// The nodes a range can need at most.
    fn room(&self) -> usize {
        2 * (self.refs.len() + self.budget) - 1
    }
}

/// What is the same for all ranges.
struct Builder<'a> {
    geometries: &'a [Geometry<'a>],
    /// The number of each geometry's first triangle.
    firsts: &'a [u32],
    level: SimdLevel,
    /// Surface beyond which a reference is not cut. Walls stay whole, near the root, where a ray that asks for any hit
    /// finds them at once.
    largest: f32,
    /// Spatial splits are looked for where the references' surfaces add up to this many times that of their box: in a
    /// smooth mesh to about 3, among long slivers to hundreds.
    crowd: f32,
}

/// A subtree that has been built.
struct Built {
    forest: Forest,
    /// The nodes it took.
    nodes: usize,
}

/// The binary hierarchy over `refs`, which are reordered; empty if there are none. The root comes first. `firsts` are the first
/// numbers of the geometries' triangles.
pub(super) fn build(refs: &mut [Ref], geometries: &[Geometry], firsts: &[u32], quality: Quality) -> Vec<Words> {
    build_with(SimdLevel::detect(), refs, geometries, firsts, quality)
}

fn build_with(
    level: SimdLevel,
    refs: &mut [Ref],
    geometries: &[Geometry],
    firsts: &[u32],
    quality: Quality,
) -> Vec<Words> {
    if refs.is_empty() {
        return Vec::new();
    }
    let side = refs.par_chunks(CHUNK).map(Side::measure).reduce(|| Side::EMPTY, Side::union);
    let (extra, crowd) = quality.spatial();
    let largest = side.bounds.half_area() * 0.02;
    let builder = Builder { geometries, firsts, level, largest, crowd };
    let budget = (refs.len() as f32 * extra) as usize;
    let surfaces = if budget > 0 { Surfaces::measure(refs) } else { Surfaces::default() };
    let mut range = Range { refs, side, surfaces, depth: 0, budget };
    let mut nodes = vec![[0; 12]; range.room()];
    builder.subdivide(&mut range, &mut nodes);
    nodes
}

/// What is known about one side of a split.
#[derive(Clone, Copy)]
struct Side {
    bounds: Bounds,
    /// The box around the doubled centres.
    centres: Bounds,
}

impl Side {
    const EMPTY: Self = Self { bounds: Bounds::EMPTY, centres: Bounds::EMPTY };

    fn measure(refs: &[Ref]) -> Self {
        let mut side = Self::EMPTY;
        for reference in refs {
            side.bounds.grow(&reference.bounds());
            side.centres.grow_point(reference.centre2());
        }
        side
    }

    fn union(self, other: Self) -> Self {
        Self { bounds: self.bounds.union(&other.bounds), centres: self.centres.union(&other.centres) }
    }
}

/// The half surfaces of references; only taken where references may be cut.
#[derive(Clone, Copy, Default)]
struct Surfaces {
    /// By this the budget is shared.
    sum: f32,
    largest: f32,
}

impl Surfaces {
    fn measure(refs: &[Ref]) -> Self {
        refs.iter().map(|reference| reference.bounds().half_area()).fold(Self::default(), |all, half_area| Self {
            sum: all.sum + half_area,
            largest: all.largest.max(half_area),
        })
    }
}

impl Builder<'_> {
    /// Builds the subtree over a range and writes it to the first of `nodes`.
    fn subdivide(&self, range: &mut Range, nodes: &mut [Words]) -> Built {
        let bounds = range.side.bounds;
        if let Some(content) = self.content(range.refs) {
            if let Some(middle) = few::divide(range.refs, self.level) {
                let (left, right) = range.refs.split_at_mut(middle);
                let sides = [Side::measure(left), Side::measure(right)];
                return self.join(children(left, right, sides, range.depth, 0), &bounds, nodes);
            }
            let forest =
                Forest::primitive(bounds.half_area(), range.refs.len() as u32, matches!(content, Content::Row(_)));
            let cost = forest.cost(bounds.half_area());
            nodes[0] = Binary::new(&bounds, content, Plan::PRIMITIVE, cost).pack();
            return Built { forest, nodes: 1 };
        }
        let splittable = range.refs.len() > 2 && range.depth < FAIR_DEPTH;
        let object = if splittable { ObjectSplit::find(range.refs, &range.side.centres, self.level) } else { None };
        if let Some((mut left, mut right)) = self.spatial(range, object.as_ref()) {
            let budget = range.budget + range.refs.len() - left.len() - right.len();
            let sides = [Side::measure(&left), Side::measure(&right)];
            return self.join(children(&mut left, &mut right, sides, range.depth, budget), &bounds, nodes);
        }
        let (middle, sides) = match object {
            Some(split) => {
                let (middle, [left, right]) = split.partition(range.refs, self.level);
                let side = |bounds, centres| Side { bounds, centres };
                (middle, [side(split.sides[0], left), side(split.sides[1], right)])
            }
            None => (0, [Side::EMPTY; 2]),
        };
        let halve = middle == 0 || middle == range.refs.len();
        let middle = if halve { range.refs.len() / 2 } else { middle };
        let (left, right) = range.refs.split_at_mut(middle);
        let sides = if halve { [Side::measure(left), Side::measure(right)] } else { sides };
        self.join(children(left, right, sides, range.depth, range.budget), &bounds, nodes)
    }

    /// What a range becomes that is not split: so few triangles that they fit a block, or anything else alone.
    fn content(&self, refs: &[Ref]) -> Option<Content> {
        let mut numbers = [NO_TRIANGLE; LANES];
        if refs.len() > LANES {
            return None;
        }
        for (reference, number) in refs.iter().zip(&mut numbers) {
            *number = match reference.owner() {
                Owner::Triangle { geometry, primitive } => self.firsts[geometry as usize] + primitive,
                Owner::Sphere(index) if refs.len() == 1 => return Some(Content::Sphere(index)),
                Owner::Instance(index) if refs.len() == 1 => return Some(Content::Instance(index)),
                Owner::Sphere(_) | Owner::Instance(_) => return None,
            };
        }
        Some(Content::Row(numbers))
    }

    /// Both sides of a spatial split, if one is worth looking for and cheaper than the object split.
    fn spatial(&self, range: &Range, object: Option<&ObjectSplit>) -> Option<(Vec<Ref>, Vec<Ref>)> {
        let object = object?;
        let (bounds, Surfaces { sum, largest }) = (range.side.bounds, range.surfaces);
        if range.budget == 0 || largest > self.largest || sum < self.crowd * bounds.half_area() {
            return None;
        }
        let split = SpatialSplit::find(range.refs, &bounds, self.geometries, range.budget)?;
        if split.cost >= object.cost {
            return None;
        }
        let (left, right) = split.divide(range.refs, self.geometries);
        let fits = left.len() + right.len() <= range.refs.len() + range.budget;
        (fits && !left.is_empty() && !right.is_empty()).then_some((left, right))
    }

    /// Builds both sides and writes the node above them.
    fn join(&self, [mut left, mut right]: [Range; 2], bounds: &Bounds, nodes: &mut [Words]) -> Built {
        let (node, below) = nodes.split_first_mut().expect("a range has a node");
        let (right_at, left, right) = if left.refs.len() + right.refs.len() > PARALLEL {
            let (left_nodes, right_nodes) = below.split_at_mut(left.room());
            let right_at = left_nodes.len();
            let left = || self.subdivide(&mut left, left_nodes);
            let (left, right) = rayon::join(left, || self.subdivide(&mut right, right_nodes));
            (right_at, left, right)
        } else {
            let left = self.subdivide(&mut left, below);
            let right = self.subdivide(&mut right, &mut below[left.nodes..]);
            (left.nodes, left, right)
        };
        let half_area = bounds.half_area();
        let (forest, plan) = Forest::join(&left.forest, &right.forest, half_area);
        let content = Content::Pair { right: right_at as u32 + 1, size: forest.size() };
        *node = Binary::new(bounds, content, plan, forest.cost(half_area)).pack();
        Built { forest, nodes: 1 + right_at + right.nodes }
    }
}

/// The ranges below one at `depth`, which share its budget by the surface of their references.
fn children<'a>(
    left: &'a mut [Ref],
    right: &'a mut [Ref],
    sides: [Side; 2],
    depth: usize,
    budget: usize,
) -> [Range<'a>; 2] {
    let (mut surfaces, mut left_budget) = ([Surfaces::default(); 2], 0);
    if budget > 0 {
        surfaces = [Surfaces::measure(left), Surfaces::measure(right)];
        let [left, right] = surfaces.map(|surfaces| f64::from(surfaces.sum));
        left_budget = ((budget as f64 * (left / (left + right))) as usize).min(budget);
    }
    let range = |refs, side, surfaces, budget| Range { refs, side, surfaces, depth: depth + 1, budget };
    [range(left, sides[0], surfaces[0], left_budget), range(right, sides[1], surfaces[1], budget - left_budget)]
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::Vec3;

    /// Boxes of all sizes, on a plane and in a heap, from a fixed formula.
    fn boxes(count: u32) -> Vec<Ref> {
        let wave = |i: u32, k: f32| ((i as f32 + 1.0) * k).sin();
        let reference = |i: u32| {
            let height = if i.is_multiple_of(3) { 0.0 } else { wave(i, 3.7) };
            let lo = Vec3::new(wave(i, 1.3), height, wave(i, 2.1));
            let size = Vec3::new(wave(i, 5.3), wave(i, 6.1), wave(i, 7.9)).abs() * 0.01;
            Ref::new(lo, lo + size, Owner::Triangle { geometry: 0, primitive: i })
        };
        (0..count).map(reference).collect()
    }

    #[test]
    fn the_tree_depends_neither_on_threads_nor_on_vectors() {
        let tree = |threads: usize, level: SimdLevel| {
            let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
            pool.install(|| build_with(level, &mut boxes(70_000), &[], &[0], Quality::Default))
        };
        let expected = tree(1, SimdLevel::Portable);
        assert!(tree(1, SimdLevel::detect()) == expected, "vectors");
        assert!(tree(3, SimdLevel::detect()) == expected, "threads");
    }

    #[test]
    fn both_sides_of_a_split_are_measured_while_it_is_made() {
        for level in [SimdLevel::Portable, SimdLevel::detect()] {
            for count in [5, 20, 300, 50_000] {
                let mut refs = boxes(count);
                let split = ObjectSplit::find(&refs, &Side::measure(&refs).centres, level).unwrap();
                let (middle, centres) = split.partition(&mut refs, level);
                let (left, right) = refs.split_at(middle);
                for (side, refs) in [left, right].into_iter().enumerate() {
                    let expected = Side::measure(refs);
                    assert!(!refs.is_empty());
                    assert_eq!((split.sides[side].lo, split.sides[side].hi), (expected.bounds.lo, expected.bounds.hi));
                    assert_eq!((centres[side].lo, centres[side].hi), (expected.centres.lo, expected.centres.hi));
                }
            }
        }
    }
}
