//! The one traversal, for every kind of leaf and every instruction set.

use super::{
    Bvh, Tables,
    cells::{self, Stored},
    node::{Child, Leaf, Node, WIDTH},
    simd::{Simd, SimdLevel, portable::Portable},
    slabs::Slabs,
    stack::Stack,
    triangle::{self, Block, Shear},
};
use crate::{Hit, Ray};

impl Bvh {
    /// The nearest accepted hit, or with `ANY` the first one found.
    #[inline]
    pub(super) fn trace<const ANY: bool, F: Fn(&Hit) -> bool>(&self, ray: &Ray, accept: F) -> Option<Hit> {
        match self.level {
            // SAFETY: `Bvh` only holds a level that the processor was found to have.
            #[cfg(target_arch = "x86_64")]
            SimdLevel::Avx512 => unsafe { trace_avx512::<ANY, F>(self, ray, accept) },
            // SAFETY: as above.
            #[cfg(target_arch = "x86_64")]
            SimdLevel::Avx2 => unsafe { trace_avx2::<ANY, F>(self, ray, accept) },
            _ => walk::<_, ANY, F>(Portable, self, ray, accept),
        }
    }
}

#[cfg(target_arch = "x86_64")]
#[target_feature(enable = "avx2,fma,bmi1,bmi2,lzcnt,popcnt")]
fn trace_avx2<const ANY: bool, F: Fn(&Hit) -> bool>(bvh: &Bvh, ray: &Ray, accept: F) -> Option<Hit> {
    // SAFETY: this function is only entered on a processor with these features.
    let token = unsafe { super::simd::x86::Avx2::new_unchecked() };
    walk::<_, ANY, F>(token, bvh, ray, accept)
}

#[cfg(target_arch = "x86_64")]
#[target_feature(enable = "avx512f,avx512vl,avx512dq,avx2,fma,bmi1,bmi2,lzcnt,popcnt")]
fn trace_avx512<const ANY: bool, F: Fn(&Hit) -> bool>(bvh: &Bvh, ray: &Ray, accept: F) -> Option<Hit> {
    // SAFETY: this function is only entered on a processor with these features.
    let token = unsafe { super::simd::x86::Avx512::new_unchecked() };
    walk::<_, ANY, F>(token, bvh, ray, accept)
}

/// The state of one query.
struct Walk<'a, S, F> {
    s: S,
    bvh: &'a Bvh,
    /// The tables of the space that is being walked.
    tables: &'a Tables,
    accept: F,
    /// The ray in the space that is being walked: the world's, or that of an instance's object.
    ray: Ray,
    instance: u32,
    tmin: f32,
    /// Where the nearest hit so far lies, or the end of the ray.
    tmax: f32,
    best: Option<Hit>,
}

/// A depth-first walk, nearest child first. Each round of the outer loop is a stretch in one space, for which the ray
/// is prepared once.
#[inline(always)]
fn walk<S: Simd, const ANY: bool, F: Fn(&Hit) -> bool>(s: S, bvh: &Bvh, ray: &Ray, accept: F) -> Option<Hit> {
    if !ray.is_usable() {
        return None;
    }
    let tmin = if ray.tmin > 0.0 { ray.tmin } else { 0.0 };
    let instance = Hit::NO_INSTANCE;
    let tables = &bvh.world;
    let mut walk = Walk { s, bvh, tables, accept, ray: *ray, instance, tmin, tmax: ray.tmax, best: None };
    let mut stack = Stack::new();
    let mut child = Child::inner(0);
    'space: loop {
        let slabs = Slabs::new(s, walk.ray.o, walk.ray.d);
        let shear = Shear::new(s, walk.ray.o, walk.ray.d);
        loop {
            match walk.descend::<ANY>(&mut stack, &slabs, child).map(Child::leaf) {
                None => {}
                Some(Leaf::Blocks { first, count }) => walk.blocks::<ANY>(&shear, first, count),
                Some(Leaf::Sphere(index)) => walk.sphere(index),
                Some(Leaf::Instance(index)) => {
                    if let Some(root) = walk.enter(index) {
                        stack.push(0.0, Child::LEAVE_INSTANCE);
                        child = root;
                        continue 'space;
                    }
                }
                Some(Leaf::LeaveInstance) => {
                    (walk.tables, walk.ray, walk.instance) = (&bvh.world, *ray, Hit::NO_INSTANCE);
                    match pop::<ANY>(&mut stack, walk.tmax) {
                        Some(next) => child = next,
                        None => return walk.best,
                    }
                    continue 'space;
                }
            }
            if ANY && walk.best.is_some() {
                return walk.best;
            }
            match pop::<ANY>(&mut stack, walk.tmax) {
                Some(next) => child = next,
                None => return walk.best,
            }
        }
    }
}

impl<S: Simd, F: Fn(&Hit) -> bool> Walk<'_, S, F> {
    /// Follows the nearest child from `child` down to a leaf and leaves the others on the stack; `None` at a node that
    /// the ray misses.
    #[inline(always)]
    fn descend<const ANY: bool>(&self, stack: &mut Stack, slabs: &Slabs<S>, mut child: Child) -> Option<Child> {
        let s = self.s;
        let (tmin, tmax) = (s.splat8(self.tmin), s.splat8(self.tmax));
        while child.is_inner() {
            // SAFETY: the builder only writes cells of nodes that exist.
            let node: &Node = unsafe { cells::get(&self.tables.cells, child.index()) };
            let (near, mask) = slabs.enter(s, node, tmin, tmax);
            if mask == 0 {
                return None;
            }
            if mask.is_power_of_two() {
                child = node.children[mask.trailing_zeros() as usize % WIDTH];
                continue;
            }
            self.prefetch(&node.children, mask);
            child = if ANY {
                s.push_any(stack, &node.children, mask)
            } else {
                s.push_sorted(stack, &node.children, near, mask)
            };
        }
        Some(child)
    }

    /// Asks for the memory of the children in `mask`, most of which will be visited. Spheres and instances, whose
    /// tables are small, are taken for blocks.
    #[inline(always)]
    fn prefetch(&self, children: &[Child; WIDTH], mut mask: u32) {
        while mask != 0 {
            let child = children[mask.trailing_zeros() as usize % WIDTH];
            mask &= mask - 1;
            let start: *const u8 = self.tables.cells.as_ptr().wrapping_add(child.index() as usize).cast();
            for line in 0..4 {
                self.s.prefetch(start.wrapping_add(64 * line));
            }
        }
    }

    #[inline(always)]
    fn blocks<const ANY: bool>(&mut self, shear: &Shear<S>, first: u32, count: u32) {
        for index in 0..count {
            // SAFETY: the builder only writes cells of blocks that exist.
            let block: &Block = unsafe { cells::get(&self.tables.cells, first + index * Block::CELLS) };
            let Some(lanes) = triangle::intersect(self.s, block, shear, self.tmin, self.tmax) else { continue };
            let mut mask = lanes.mask;
            while mask != 0 {
                let lane = mask.trailing_zeros() as usize % triangle::LANES;
                mask &= mask - 1;
                if lanes.t[lane] < self.tmax {
                    self.offer(lanes.hit(lane, self.tables.names.of(block.numbers[lane]), self.instance));
                    if ANY && self.best.is_some() {
                        return;
                    }
                }
            }
        }
    }

    #[inline(always)]
    fn sphere(&mut self, index: u32) {
        let sphere = &self.tables.spheres[index as usize];
        let Some(roots) = sphere.roots(&self.ray) else { return };
        for t in roots {
            if t > self.tmin && t < self.tmax {
                self.offer(sphere.hit(t, self.instance));
            }
        }
    }

    /// Takes a hit that is nearer than all before, if the caller lets it count.
    #[inline(always)]
    fn offer(&mut self, hit: Hit) {
        if (self.accept)(&hit) {
            self.tmax = hit.t;
            self.best = Some(hit);
        }
    }

    /// Moves the ray into an instance and gives the root of its object; `None` if the ray does not survive that.
    #[inline(always)]
    fn enter(&mut self, index: u32) -> Option<Child> {
        let placed = &self.bvh.world.instances[index as usize];
        let local = placed.localise(&self.ray);
        local.is_usable().then(|| {
            (self.tables, self.ray, self.instance) = (&self.bvh.objects, local, placed.id);
            Child::inner(placed.root)
        })
    }
}

/// The next child that may still hold a nearer hit.
#[inline(always)]
fn pop<const ANY: bool>(stack: &mut Stack, tmax: f32) -> Option<Child> {
    loop {
        let (key, child) = stack.pop()?;
        if ANY || key <= tmax {
            return Some(child);
        }
    }
}
