//! Which surface does a ray meet first, and does it meet one at all?
//!
//! An eight-wide bounding volume hierarchy over triangles, spheres and instances of objects.
//!
//! ```text
//! Geometry --refs, presplit--> boxes --build--> binary tree --collapse, emit--> Tables --traverse--> Hit
//! ```
//!
//! World and objects share one node format; an instance is a leaf of the world whose object starts at some node of the
//! objects' tables. Those are shared, so that objects can be placed anew, as when they move, at the price of the few
//! nodes above them. `traverse` walks the tables with the vector operations of `simd`.

mod binning;
mod build;
mod cells;
mod clip;
mod collapse;
mod emit;
mod few;
mod instance;
mod leaves;
mod names;
mod node;
mod objects;
mod partition;
mod presplit;
mod refs;
mod simd;
mod slabs;
mod spatial;
mod sphere;
mod stack;
mod traverse;
mod tree;
mod triangle;

pub use instance::Instance;
pub use objects::Objects;
pub use simd::SimdLevel;

use crate::{Aabb, Hit, Ray, memory::prefetch};
use cells::Cell;
use glam::{Vec3, Vec4Swizzles};
use instance::Placed;
use names::Names;
use node::Child;
use refs::{Collected, Ref};
use sphere::Sphere;
use std::sync::Arc;

/// A shape as the caller has it.
#[derive(Clone, Copy, Debug)]
pub enum Geometry<'a> {
    /// A mesh. An index outside `positions` is the caller's bug and panics.
    Triangles {
        /// Vertices.
        positions: &'a [Vec3],
        /// Three vertices per triangle.
        indices: &'a [[u32; 3]],
    },
    /// The surface of a ball.
    Sphere {
        /// Centre.
        centre: Vec3,
        /// Radius, positive.
        radius: f32,
    },
}

impl Geometry<'_> {
    /// The corners of a triangle; only for meshes.
    fn corners(&self, primitive: u32) -> [Vec3; 3] {
        let Self::Triangles { positions, indices } = self else { unreachable!("only meshes own triangles") };
        indices[primitive as usize].map(|i| positions[i as usize])
    }

    /// Asks the caches for the indices of a triangle.
    fn prefetch_indices(&self, primitive: u32) {
        if let Self::Triangles { indices, .. } = self {
            prefetch(&indices[primitive as usize]);
        }
    }

    /// Asks the caches for the corners of a triangle.
    fn prefetch_corners(&self, primitive: u32) {
        if let Self::Triangles { positions, indices } = self {
            indices[primitive as usize].iter().for_each(|&i| prefetch(&positions[i as usize]));
        }
    }
}

/// How long to build for.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Quality {
    /// A good tree quickly.
    #[default]
    Default,
    /// Slower to build and a little larger, faster to trace.
    High,
}

impl Quality {
    /// How many references cutting before the build may add, as a share of those that there are.
    fn cuts(self) -> f32 {
        match self {
            Self::Default => 0.28,
            Self::High => 0.5,
        }
    }

    /// The same for spatial splits, and from which crowd on they are looked for (see `build::Builder`).
    fn spatial(self) -> (f32, f32) {
        match self {
            Self::Default => (0.0, f32::INFINITY),
            Self::High => (0.5, 2.5),
        }
    }
}

/// What was built in, and what was left out.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Counts {
    /// Triangles in world and objects.
    pub triangles: usize,
    /// Spheres in world and objects.
    pub spheres: usize,
    /// Instances.
    pub instances: usize,
    /// Triangles without area, spheres without a positive radius, and primitives with NaN, infinite or huge (beyond
    /// ±1e18) coordinates.
    pub dropped_primitives: usize,
    /// Instances whose transform cannot be inverted, or takes the object beyond ±1e18.
    pub dropped_instances: usize,
}

/// The tables that traversal walks: those of the world, where node 0 is the root, or those of all objects.
#[derive(Default)]
struct Tables {
    cells: Vec<Cell>,
    names: Names,
    spheres: Vec<Sphere>,
    instances: Vec<Placed>,
}

/// A bounding volume hierarchy, immutable once built.
pub struct Bvh {
    world: Tables,
    objects: Arc<Tables>,
    bounds: Aabb,
    counts: Counts,
    level: SimdLevel,
}

/// One hierarchy before its tables are joined with the others.
struct Part {
    cells: Vec<Cell>,
    names: Names,
    spheres: Vec<Sphere>,
    bounds: Aabb,
    counts: Counts,
}

impl Bvh {
    /// Builds the hierarchy. `world` is geometry placed directly in world space; `objects[k]` is the geometry of object
    /// k, seen only through `instances`. The result does not depend on the number of threads.
    ///
    /// Primitives and instances that no ray can hit are dropped and counted, see [`Bvh::counts`].
    ///
    /// # Panics
    /// If an index of a mesh or the object of an instance is out of range, or if there are more than 2^28 primitives.
    pub fn build(world: &[Geometry], objects: &[&[Geometry]], instances: &[Instance], quality: Quality) -> Self {
        Objects::build(objects, quality).place(world, instances, quality)
    }

    /// The same hierarchy, traced with the given instructions, or with the best that the processor has if it lacks
    /// them. Meant for tests; [`Bvh::build`] chooses the best.
    pub fn with_simd(mut self, level: SimdLevel) -> Self {
        self.level = level.min(SimdLevel::detect());
        self
    }

    /// The instructions that queries use.
    pub fn simd(&self) -> SimdLevel {
        self.level
    }

    /// The nearest hit, if there is one.
    pub fn closest(&self, ray: &Ray) -> Option<Hit> {
        self.trace::<false, _>(ray, |_| true)
    }

    /// Whether anything lies on the ray.
    pub fn occluded(&self, ray: &Ray) -> bool {
        self.trace::<true, _>(ray, |_| true).is_some()
    }

    /// The nearest hit among those that `accept` lets count. It may be asked about hits that turn out not to be the
    /// nearest, in no particular order, and about the same triangle more than once.
    pub fn closest_filtered(&self, ray: &Ray, accept: impl Fn(&Hit) -> bool) -> Option<Hit> {
        self.trace::<false, _>(ray, accept)
    }

    /// Whether anything that `accept` lets count lies on the ray.
    pub fn occluded_filtered(&self, ray: &Ray, accept: impl Fn(&Hit) -> bool) -> bool {
        self.trace::<true, _>(ray, accept).is_some()
    }

    /// The box around everything, in world space; empty if there is nothing.
    pub fn bounds(&self) -> Aabb {
        self.bounds
    }

    /// What was built in, and what was left out.
    pub fn counts(&self) -> Counts {
        self.counts
    }

    /// Size of all tables, in bytes.
    pub fn memory_bytes(&self) -> usize {
        self.world.memory_bytes() + self.objects.memory_bytes()
    }
}

impl Counts {
    fn add(&mut self, other: &Self) {
        self.triangles += other.triangles;
        self.spheres += other.spheres;
        self.dropped_primitives += other.dropped_primitives;
    }
}

impl Part {
    /// The hierarchy over some geometry and over ready-made references (to instances).
    fn build(geometries: &[Geometry], instances: &[Ref], quality: Quality) -> Self {
        let Collected { mut refs, spheres, dropped } = refs::collect(geometries, instances, quality.cuts());
        let counts = Counts {
            triangles: refs.len() - spheres.len() - instances.len(),
            spheres: spheres.len(),
            dropped_primitives: dropped,
            ..Counts::default()
        };
        assert!(refs.len() < Child::MAX_INDEX, "a hierarchy holds at most 2^28 primitives");
        let (bounds, surface) = refs::measure(&refs);
        presplit::presplit(&mut refs, geometries, &bounds, surface, quality.cuts());
        let bounds = Aabb { min: bounds.lo.xyz(), max: bounds.hi.xyz() };
        let (names, firsts) = Names::new(geometries);
        let tree = build::build(&mut refs, geometries, &firsts, quality);
        Self { cells: emit::emit(&tree, geometries, &names), names, spheres, bounds, counts }
    }
}

impl Tables {
    fn memory_bytes(&self) -> usize {
        size_of_val(self.cells.as_slice())
            + self.names.memory_bytes()
            + size_of_val(self.spheres.as_slice())
            + size_of_val(self.instances.as_slice())
    }
}
