//! The one traversal, for every kind of leaf and every instruction set.

use super::{
    Tables,
    node::{Child, Leaf},
    simd::{Simd, SimdLevel, portable::Portable},
    slabs::Slabs,
    stack::Stack,
    triangle::{self, Shear},
};
use crate::{Hit, Ray};

impl Tables {
    /// The nearest accepted hit, or with `ANY` the first one found.
    pub(super) fn trace<const ANY: bool, F: Fn(&Hit) -> bool>(
        &self,
        level: SimdLevel,
        ray: &Ray,
        accept: F,
    ) -> Option<Hit> {
        match level {
            SimdLevel::Portable => traverse::<_, ANY, F>(Portable, self, ray, accept),
            // SAFETY: `Bvh` only holds a level that the processor was found to have.
            #[cfg(target_arch = "x86_64")]
            SimdLevel::Avx2 => unsafe { trace_avx2::<ANY, F>(self, ray, accept) },
            // SAFETY: as above.
            #[cfg(target_arch = "x86_64")]
            SimdLevel::Avx512 => unsafe { trace_avx512::<ANY, F>(self, ray, accept) },
            #[cfg(not(target_arch = "x86_64"))]
            SimdLevel::Avx2 | SimdLevel::Avx512 => traverse::<_, ANY, F>(Portable, self, ray, accept),
        }
    }
}

#[cfg(target_arch = "x86_64")]
#[target_feature(enable = "avx2,fma,bmi1,bmi2,lzcnt,popcnt")]
fn trace_avx2<const ANY: bool, F: Fn(&Hit) -> bool>(tables: &Tables, ray: &Ray, accept: F) -> Option<Hit> {
    // SAFETY: this function is only entered on a processor with these features.
    let token = unsafe { super::simd::x86::Avx2::new_unchecked() };
    traverse::<_, ANY, F>(token, tables, ray, accept)
}

#[cfg(target_arch = "x86_64")]
#[target_feature(enable = "avx512f,avx512vl,avx512dq,avx2,fma,bmi1,bmi2,lzcnt,popcnt")]
fn trace_avx512<const ANY: bool, F: Fn(&Hit) -> bool>(tables: &Tables, ray: &Ray, accept: F) -> Option<Hit> {
    // SAFETY: this function is only entered on a processor with these features.
    let token = unsafe { super::simd::x86::Avx512::new_unchecked() };
    traverse::<_, ANY, F>(token, tables, ray, accept)
}

/// A depth-first walk, nearest child first. Each round of the outer loop is a stretch in one space: the world, or an
/// object entered through an instance.
#[inline(always)]
fn traverse<S: Simd, const ANY: bool, F: Fn(&Hit) -> bool>(
    s: S,
    tables: &Tables,
    world_ray: &Ray,
    accept: F,
) -> Option<Hit> {
    if !world_ray.is_usable() {
        return None;
    }
    let tmin = if world_ray.tmin > 0.0 { world_ray.tmin } else { 0.0 };
    let tmin8 = s.splat8(tmin);
    let mut tmax = world_ray.tmax;
    let mut best = None;
    let mut stack = Stack::new();
    let mut child = Child::inner(0);
    let mut ray = *world_ray;
    let mut instance = Hit::NO_INSTANCE;
    'space: loop {
        let slabs = Slabs::new(s, ray.o, ray.d);
        let shear = Shear::new(s, ray.o, ray.d);
        let mut tmax8 = s.splat8(tmax);
        loop {
            if child.is_inner() {
                debug_assert!(child.node() < tables.nodes.len());
                // SAFETY: the builder only writes indices of nodes that exist.
                let node = unsafe { tables.nodes.get_unchecked(child.node()) };
                let (near, mask) = slabs.enter(s, node, tmin8, tmax8);
                if mask != 0 {
                    if mask & (mask - 1) == 0 {
                        child = node.children[mask.trailing_zeros() as usize & 7];
                    } else if ANY {
                        child = s.push_any(&mut stack, &node.children, mask);
                    } else {
                        child = s.push_sorted(&mut stack, &node.children, near, mask);
                    }
                    continue;
                }
            } else if child == Child::LEAVE_INSTANCE {
                ray = *world_ray;
                instance = Hit::NO_INSTANCE;
                match pop::<ANY>(&mut stack, tmax) {
                    Some(next) => child = next,
                    None => return best,
                }
                continue 'space;
            } else {
                match child.leaf() {
                    Leaf::Blocks { first, count } => {
                        for index in first..first + count {
                            debug_assert!((index as usize) < tables.blocks.len());
                            // SAFETY: the builder only writes ranges of blocks that exist.
                            let block = unsafe { tables.blocks.get_unchecked(index as usize) };
                            let Some(lanes) = triangle::intersect(s, block, &shear, tmin, tmax) else { continue };
                            let mut mask = lanes.mask;
                            while mask != 0 {
                                let lane = mask.trailing_zeros() as usize & 3;
                                mask &= mask - 1;
                                if lanes.t[lane] < tmax {
                                    let hit = lanes.hit(block, lane, instance);
                                    if accept(&hit) {
                                        if ANY {
                                            return Some(hit);
                                        }
                                        tmax = hit.t;
                                        best = Some(hit);
                                    }
                                }
                            }
                        }
                        tmax8 = s.splat8(tmax);
                    }
                    Leaf::Sphere(index) => {
                        let sphere = &tables.spheres[index as usize];
                        if let Some(hit) = sphere.nearest(&ray, tmax, instance, &accept) {
                            if ANY {
                                return Some(hit);
                            }
                            tmax = hit.t;
                            best = Some(hit);
                            tmax8 = s.splat8(tmax);
                        }
                    }
                    Leaf::Instance(index) => {
                        let placed = &tables.instances[index as usize];
                        let local = placed.localise(&ray);
                        if local.is_usable() {
                            stack.push(0.0, Child::LEAVE_INSTANCE);
                            ray = local;
                            instance = placed.id;
                            child = Child::inner(placed.root);
                            continue 'space;
                        }
                    }
                }
            }
            match pop::<ANY>(&mut stack, tmax) {
                Some(next) => child = next,
                None => return best,
            }
        }
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
