//! Which surface does a ray meet first, and does it meet one at all?
//!
//! An eight-wide bounding volume hierarchy over triangles, spheres and instances of objects.
//!
//! ```text
//! Geometry --refs--> boxes --build--> binary tree --collapse, emit--> Tables --traverse--> Hit
//! ```
//!
//! World and objects share one set of tables and one node format; an instance is a leaf of the world whose object
//! starts at another node. `traverse` walks the tables with the vector operations of `simd`.

mod binning;
mod build;
mod clip;
mod collapse;
mod emit;
mod instance;
mod node;
mod refs;
mod simd;
mod slabs;
mod spatial;
mod sphere;
mod stack;
mod traverse;
mod triangle;

pub use instance::Instance;
pub use simd::SimdLevel;

use crate::{Aabb, Hit, Ray};
use emit::Wide;
use glam::{Vec3, Vec4Swizzles};
use instance::Placed;
use node::{Child, Node, Offsets};
use rayon::prelude::*;
use refs::{Bounds, Owner, Ref};
use sphere::Sphere;
use triangle::Block;

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

/// The shared tables that traversal walks; node 0 is the root of the world.
struct Tables {
    nodes: Vec<Node>,
    blocks: Vec<Block>,
    spheres: Vec<Sphere>,
    instances: Vec<Placed>,
}

/// A bounding volume hierarchy, immutable once built.
pub struct Bvh {
    tables: Tables,
    bounds: Aabb,
    counts: Counts,
    level: SimdLevel,
}

/// One hierarchy before its tables are joined with the others.
struct Part {
    wide: Wide,
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
        let parts: Vec<Part> = objects.par_iter().map(|object| Part::build(object, Vec::new(), quality)).collect();
        let mut roots = Vec::with_capacity(parts.len());
        let mut placed = Vec::new();
        let mut refs = Vec::new();
        let mut counts = Counts::default();
        for (id, instance) in instances.iter().enumerate() {
            let bounds = &parts[instance.object as usize].bounds;
            match place(instance, id as u32, bounds, placed.len() as u32) {
                Some((instance, reference)) => {
                    placed.push(instance);
                    refs.push(reference);
                }
                None => counts.dropped_instances += 1,
            }
        }
        counts.instances = placed.len();
        let world = Part::build(world, refs, quality);
        let bounds = world.bounds;
        counts.add(&world.counts);
        let mut tables =
            Tables { nodes: world.wide.nodes, blocks: world.wide.blocks, spheres: world.spheres, instances: placed };
        for part in parts {
            counts.add(&part.counts);
            roots.push(tables.append(part));
        }
        for (instance, from) in tables.instances.iter_mut().map(|placed| (placed.id as usize, placed)) {
            from.root = roots[instances[instance].object as usize];
        }
        Self { tables, bounds, counts, level: SimdLevel::detect() }
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
        self.tables.trace::<false, _>(self.level, ray, |_| true)
    }

    /// Whether anything lies on the ray.
    pub fn occluded(&self, ray: &Ray) -> bool {
        self.tables.trace::<true, _>(self.level, ray, |_| true).is_some()
    }

    /// The nearest hit among those that `accept` lets count. It may be asked about hits that turn out not to be the
    /// nearest, in no particular order, and about the same triangle more than once.
    pub fn closest_filtered(&self, ray: &Ray, accept: impl Fn(&Hit) -> bool) -> Option<Hit> {
        self.tables.trace::<false, _>(self.level, ray, accept)
    }

    /// Whether anything that `accept` lets count lies on the ray.
    pub fn occluded_filtered(&self, ray: &Ray, accept: impl Fn(&Hit) -> bool) -> bool {
        self.tables.trace::<true, _>(self.level, ray, accept).is_some()
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
        size_of_val(self.tables.nodes.as_slice())
            + size_of_val(self.tables.blocks.as_slice())
            + size_of_val(self.tables.spheres.as_slice())
            + size_of_val(self.tables.instances.as_slice())
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
    fn build(geometries: &[Geometry], mut refs: Vec<Ref>, quality: Quality) -> Self {
        let collected = refs::collect(geometries);
        let counts = Counts {
            triangles: collected.refs.len() - collected.spheres.len(),
            spheres: collected.spheres.len(),
            dropped_primitives: collected.dropped,
            ..Counts::default()
        };
        refs.extend(collected.refs);
        assert!(refs.len() < Child::MAX_INDEX, "a hierarchy holds at most 2^28 primitives");
        let bounds = refs.iter().fold(Bounds::EMPTY, |all, r| all.union(&r.bounds()));
        let bounds = Aabb { min: bounds.lo.xyz(), max: bounds.hi.xyz() };
        let binary = build::build(&mut refs, geometries, quality);
        Self { wide: emit::emit(&binary, geometries), spheres: collected.spheres, bounds, counts }
    }
}

impl Tables {
    /// Adds the tables of an object and returns its root.
    fn append(&mut self, part: Part) -> u32 {
        let by = Offsets {
            nodes: self.nodes.len() as u32,
            blocks: self.blocks.len() as u32,
            spheres: self.spheres.len() as u32,
        };
        self.nodes.extend(part.wide.nodes.into_iter().map(|mut node| {
            node.children = node.children.map(|child| child.moved(by));
            node
        }));
        self.blocks.extend(part.wide.blocks);
        self.spheres.extend(part.spheres);
        assert!(self.nodes.len().max(self.blocks.len()).max(self.spheres.len()) < Child::MAX_INDEX);
        by.nodes
    }
}

/// An instance for the tables and its reference for the builder; `None` if no ray can hit it.
fn place(instance: &Instance, id: u32, bounds: &Aabb, index: u32) -> Option<(Placed, Ref)> {
    let map = &instance.world_from_object;
    let object_from_world = instance::invert(map)?;
    let world = instance::transformed_bounds(map, bounds);
    let usable = !world.is_empty() && world.min.abs().max(world.max.abs()).max_element() < 1e18;
    usable.then(|| (Placed { object_from_world, root: 0, id }, Ref::new(world.min, world.max, Owner::Instance(index))))
}
