//! The binary hierarchy: split ranges of references until each holds one.

use super::{
    Geometry, Quality,
    binning::ObjectSplit,
    collapse::{Forest, Plan, Size},
    refs::{Bounds, Owner, Ref},
    spatial::SpatialSplit,
};
use crate::memory::large_vec;

/// Below this depth ranges are halved by count, so that no input makes a deep tree.
const FAIR_DEPTH: usize = 40;
/// No path from the root is longer: what is left after `FAIR_DEPTH` has at most 2^28 references.
pub(super) const MAX_DEPTH: usize = FAIR_DEPTH + 29;
/// Ranges longer than this are built in parallel.
const PARALLEL: usize = 4096;

/// A node of the binary hierarchy, stored before its descendants; the left child follows directly.
#[derive(Clone, Copy)]
pub(super) struct Binary {
    /// The box; of a primitive also its owner, else the distance from this node to its right child.
    pub(super) entry: Ref,
    /// How to make it wide.
    pub(super) plan: Plan,
    /// What it takes as one root.
    pub(super) size: Size,
    /// What a ray that enters the box is expected to spend below, in visits of nodes.
    pub(super) cost: f32,
}

/// A range of references with its boxes.
struct Range<'a> {
    refs: &'a mut [Ref],
    side: Side,
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
    /// Surface beyond which a reference is not cut. Walls stay whole, near the root, where a ray that asks for any hit
    /// finds them at once.
    largest: f32,
    /// Spatial splits are looked for where the references' surfaces add up to this many times that of their box: in a
    /// smooth mesh to about 3, among long slivers to hundreds.
    crowd: f32,
}

/// The binary hierarchy over `refs`, which are reordered; empty if there are none.
pub(super) fn build(refs: &mut [Ref], geometries: &[Geometry], quality: Quality) -> Vec<Binary> {
    if refs.is_empty() {
        return Vec::new();
    }
    let side = Side::measure(refs);
    let (extra, crowd) = quality.spatial();
    let builder = Builder { geometries, largest: side.bounds.half_area() * 0.02, crowd };
    let budget = (refs.len() as f32 * extra) as usize;
    let mut range = Range { refs, side, depth: 0, budget };
    let blank = Binary { entry: range.refs[0], plan: Plan::PRIMITIVE, size: Size::default(), cost: 0.0 };
    let mut nodes = large_vec(range.room());
    nodes.resize(range.room(), blank);
    builder.subdivide(&mut range, &mut nodes);
    nodes
}

/// What is known about one side of a split.
#[derive(Clone, Copy)]
struct Side {
    bounds: Bounds,
    /// The box around the doubled centres.
    centres: Bounds,
    /// Sum of the references' half surfaces, by which the budget is shared.
    weight: f32,
    /// The greatest of them.
    largest: f32,
}

impl Side {
    const EMPTY: Self = Self { bounds: Bounds::EMPTY, centres: Bounds::EMPTY, weight: 0.0, largest: 0.0 };

    #[inline(always)]
    fn add(&mut self, reference: &Ref) {
        let bounds = reference.bounds();
        self.bounds.grow(&bounds);
        self.centres.grow_point(reference.centre2());
        let half_area = bounds.half_area();
        self.weight += half_area;
        self.largest = self.largest.max(half_area);
    }

    fn measure(refs: &[Ref]) -> Self {
        refs.iter().fold(Self::EMPTY, |mut side, reference| {
            side.add(reference);
            side
        })
    }
}

impl Builder<'_> {
    fn subdivide(&self, range: &mut Range, nodes: &mut [Binary]) -> Forest {
        let bounds = range.side.bounds;
        if let &mut [reference] = &mut *range.refs {
            let is_triangle = matches!(reference.owner(), Owner::Triangle { .. });
            let forest = Forest::primitive(bounds.half_area(), is_triangle);
            nodes[0] = Binary {
                entry: reference,
                plan: Plan::PRIMITIVE,
                size: forest.size(),
                cost: forest.cost(bounds.half_area()),
            };
            return forest;
        }
        let splittable = range.refs.len() > 2 && range.depth < FAIR_DEPTH;
        let object = if splittable { ObjectSplit::find(range.refs, &range.side.centres) } else { None };
        if let Some((mut left, mut right)) = self.spatial(range, object.as_ref()) {
            let budget = range.budget + range.refs.len() - left.len() - right.len();
            let sides = [Side::measure(&left), Side::measure(&right)];
            return self.join(children(&mut left, &mut right, sides, range.depth, budget), &bounds, nodes);
        }
        let (middle, sides) = match object {
            Some(split) => partition(range.refs, &split),
            None => (0, [Side::EMPTY; 2]),
        };
        let halve = middle == 0 || middle == range.refs.len();
        let middle = if halve { range.refs.len() / 2 } else { middle };
        let (left, right) = range.refs.split_at_mut(middle);
        let sides = if halve { [Side::measure(left), Side::measure(right)] } else { sides };
        self.join(children(left, right, sides, range.depth, range.budget), &bounds, nodes)
    }

    /// Both sides of a spatial split, if one is worth looking for and cheaper than the object split.
    fn spatial(&self, range: &Range, object: Option<&ObjectSplit>) -> Option<(Vec<Ref>, Vec<Ref>)> {
        let object = object?;
        let Side { bounds, weight, largest, .. } = range.side;
        if range.budget == 0 || largest > self.largest || weight < self.crowd * bounds.half_area() {
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
    fn join(&self, [mut left, mut right]: [Range; 2], bounds: &Bounds, nodes: &mut [Binary]) -> Forest {
        let (node, below) = nodes.split_first_mut().expect("a range has a node");
        let (left_nodes, right_nodes) = below.split_at_mut(left.room());
        let right_at = left_nodes.len() as u32 + 1;
        let (left, right) = if left.refs.len() + right.refs.len() > PARALLEL {
            rayon::join(|| self.subdivide(&mut left, left_nodes), || self.subdivide(&mut right, right_nodes))
        } else {
            (self.subdivide(&mut left, left_nodes), self.subdivide(&mut right, right_nodes))
        };
        let (forest, plan) = Forest::join(&left, &right, bounds.half_area());
        *node = Binary {
            entry: Ref::numbered(bounds, right_at),
            plan,
            size: forest.size(),
            cost: forest.cost(bounds.half_area()),
        };
        forest
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
    let share = f64::from(sides[0].weight) / (f64::from(sides[0].weight) + f64::from(sides[1].weight));
    let left_budget = ((budget as f64 * share) as usize).min(budget);
    let range = |refs, side, budget| Range { refs, side, depth: depth + 1, budget };
    [range(left, sides[0], left_budget), range(right, sides[1], budget - left_budget)]
}

/// Moves the left side to the front; returns its length and what is known about both sides.
fn partition(refs: &mut [Ref], split: &ObjectSplit) -> (usize, [Side; 2]) {
    let (mut left, mut right) = (Side::EMPTY, Side::EMPTY);
    let (mut i, mut j) = (0, refs.len());
    while i < j {
        let reference = refs[i];
        if split.is_left(&reference) {
            left.add(&reference);
            i += 1;
        } else {
            right.add(&reference);
            j -= 1;
            refs.swap(i, j);
        }
    }
    (i, [left, right])
}
