//! The binary hierarchy: split ranges of references until each holds one.

use super::{
    binning::ObjectSplit,
    collapse::{Forest, Plan, Size},
    refs::{Bounds, Owner, Ref},
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
}

/// A range of references with its boxes.
struct Range<'a> {
    refs: &'a mut [Ref],
    bounds: Bounds,
    centres: Bounds,
    depth: usize,
}

/// The binary hierarchy over `refs`, which are reordered; empty if there are none.
pub(super) fn build(refs: &mut [Ref]) -> Vec<Binary> {
    if refs.is_empty() {
        return Vec::new();
    }
    let blank = Binary { entry: refs[0], plan: Plan::PRIMITIVE, size: Size::default() };
    let mut nodes = large_vec(2 * refs.len() - 1);
    nodes.resize(2 * refs.len() - 1, blank);
    let (bounds, centres) = measure(refs);
    subdivide(Range { refs, bounds, centres, depth: 0 }, &mut nodes);
    nodes
}

/// The box around the references and the box around their doubled centres.
fn measure(refs: &[Ref]) -> (Bounds, Bounds) {
    refs.iter().fold((Bounds::EMPTY, Bounds::EMPTY), |(mut bounds, mut centres), r| {
        bounds.grow(&r.bounds());
        centres.grow_point(r.centre2());
        (bounds, centres)
    })
}

fn subdivide(range: Range, nodes: &mut [Binary]) -> Forest {
    let half_area = range.bounds.half_area();
    let (node, below) = nodes.split_first_mut().expect("a range has a node");
    if let &mut [reference] = range.refs {
        let forest = Forest::primitive(half_area, matches!(reference.owner(), Owner::Triangle { .. }));
        *node = Binary { entry: reference, plan: Plan::PRIMITIVE, size: forest.size() };
        return forest;
    }
    let bounds = range.bounds;
    let (left, right) = split(range);
    let (left_nodes, right_nodes) = below.split_at_mut(2 * left.refs.len() - 1);
    let right_at = left_nodes.len() as u32 + 1;
    let (left, right) = if left.refs.len() + right.refs.len() > PARALLEL {
        rayon::join(|| subdivide(left, left_nodes), || subdivide(right, right_nodes))
    } else {
        (subdivide(left, left_nodes), subdivide(right, right_nodes))
    };
    let (forest, plan) = Forest::join(&left, &right, half_area);
    *node = Binary { entry: Ref::numbered(&bounds, right_at), plan, size: forest.size() };
    forest
}

/// Divides a range of at least two references into two that hold at least one each.
fn split(range: Range<'_>) -> (Range<'_>, Range<'_>) {
    let Range { refs, centres, depth, .. } = range;
    let depth = depth + 1;
    let found = if depth < FAIR_DEPTH { ObjectSplit::find(refs, &centres) } else { None };
    if let Some(split) = found {
        let (middle, left_centres, right_centres) = partition(refs, &split);
        if middle > 0 && middle < refs.len() {
            let (left, right) = refs.split_at_mut(middle);
            return (
                Range { refs: left, bounds: split.left, centres: left_centres, depth },
                Range { refs: right, bounds: split.right, centres: right_centres, depth },
            );
        }
    }
    let (left, right) = refs.split_at_mut(refs.len() / 2);
    let sides = [measure(left), measure(right)];
    (
        Range { refs: left, bounds: sides[0].0, centres: sides[0].1, depth },
        Range { refs: right, bounds: sides[1].0, centres: sides[1].1, depth },
    )
}

/// Moves the left side to the front; returns its length and the boxes around the doubled centres of both sides.
fn partition(refs: &mut [Ref], split: &ObjectSplit) -> (usize, Bounds, Bounds) {
    let (mut left, mut right) = (Bounds::EMPTY, Bounds::EMPTY);
    let (mut i, mut j) = (0, refs.len());
    while i < j {
        let reference = refs[i];
        if split.is_left(&reference) {
            left.grow_point(reference.centre2());
            i += 1;
        } else {
            right.grow_point(reference.centre2());
            j -= 1;
            refs.swap(i, j);
        }
    }
    (i, left, right)
}
