//! One descent of the tree.

use glam::Vec3;

use super::KdTree;
use super::neighbours::{Neighbours, d2_of, index_of, key};
use crate::points::lanes::{LANES, Lanes, Task};

/// Levels of the largest tree: sixteen to the eighth is all of `u32`.
const LEVELS: usize = 8;

/// Elements are named by their level above so many bits, and their number in it below.
const NUMBER_BITS: u32 = 28;

/// A place to search from, and the best found.
pub(super) struct Query<'t> {
    tree: &'t KdTree,
    p: Vec3,
    best: &'t mut Neighbours,
}

impl<'t> Query<'t> {
    pub(super) fn new(tree: &'t KdTree, p: Vec3, best: &'t mut Neighbours) -> Self {
        Self { tree, p, best }
    }

    /// Whether what is at least `d2` away can no longer hold a wanted point. Among equals the lowest index decides,
    /// without which every one of a million identical points would be looked at.
    #[inline(always)]
    fn is_beyond(&self, d2: f32, level: usize, number: usize) -> bool {
        let worst = self.best.worst();
        if d2 != d2_of(worst) {
            return d2 > d2_of(worst);
        }
        let Some(above) = self.tree.levels.get(level + 1) else { return false };
        let parent = &self.tree.nodes[above.first + number / LANES];
        key(d2, parent.lowest[number % LANES]) >= worst
    }

    #[inline(always)]
    fn leaf<L: Lanes>(&mut self, lanes: L, number: usize) {
        let leaf = &self.tree.leaves[number];
        let mut d2 = [0.0; LANES];
        let mut near = lanes.points(leaf.at.each_ref(), self.p, d2_of(self.best.worst()), &mut d2);
        while near != 0 {
            let i = near.trailing_zeros() as usize;
            self.best.offer(key(d2[i], leaf.index[i]));
            near &= near - 1;
        }
    }

    /// Writes the children that may hold wanted points to `out`, the farthest first; returns how many.
    #[inline(always)]
    fn children<L: Lanes>(&self, lanes: L, level: usize, number: usize, out: &mut [u64; LANES]) -> usize {
        let node = &self.tree.nodes[self.tree.levels[level].first + number];
        let mut d2 = [0.0; LANES];
        let bound = d2_of(self.best.worst());
        let present = self.tree.levels[level - 1].count - number * LANES;
        let mut near = lanes.boxes(node.lo.each_ref(), node.hi.each_ref(), self.p, bound, &mut d2)
            & (u32::MAX >> (32 - present.min(LANES)));
        let mut count = 0;
        while near != 0 {
            let i = near.trailing_zeros() as usize;
            let child = key(d2[i], ((level - 1) << NUMBER_BITS | (number * LANES + i)) as u32);
            let mut place = count;
            while place > 0 && out[place - 1] < child {
                out[place] = out[place - 1];
                place -= 1;
            }
            out[place] = child;
            count += 1;
            near &= near - 1;
        }
        count
    }
}

impl Task for Query<'_> {
    #[inline(always)]
    fn run<L: Lanes>(mut self, lanes: L) {
        let mut stack = [0; LEVELS * LANES];
        stack[0] = key(0.0, ((self.tree.levels.len() - 1) << NUMBER_BITS) as u32);
        let mut height = 1;
        while height > 0 {
            height -= 1;
            let (d2, name) = (d2_of(stack[height]), index_of(stack[height]));
            let (level, number) = ((name >> NUMBER_BITS) as usize, (name & ((1 << NUMBER_BITS) - 1)) as usize);
            if self.is_beyond(d2, level, number) {
                continue;
            }
            if level == 0 {
                self.leaf(lanes, number);
            } else {
                let room = stack[height..].first_chunk_mut().expect("room for the children of each level");
                height += self.children(lanes, level, number, room);
            }
        }
    }
}
