//! Hierarchies of objects, built once and placed as often as needed.

use super::{
    Bvh, Counts, Geometry, Part, Quality, Tables,
    cells::{self, Stored},
    instance::{self, Instance, Placed},
    node::{Child, Leaf, Node, Offsets, WIDTH},
    refs::{Owner, Ref},
    simd::SimdLevel,
    triangle::Block,
};
use crate::Aabb;
use rayon::prelude::*;
use std::sync::Arc;

/// The hierarchies of some objects, shared by everything that [`Objects::place`] makes of them.
#[derive(Clone)]
pub struct Objects {
    tables: Arc<Tables>,
    entrances: Vec<Entrance>,
    /// Of all objects together.
    counts: Counts,
}

/// Where an object's hierarchy starts, and the box around it.
#[derive(Clone, Copy)]
struct Entrance {
    root: u32,
    bounds: Aabb,
}

impl Objects {
    /// Builds the hierarchy of each object. The result does not depend on the number of threads.
    ///
    /// # Panics
    /// If an index of a mesh is out of range, or if there are more than 2^28 primitives.
    pub fn build(objects: &[&[Geometry]], quality: Quality) -> Self {
        let parts: Vec<Part> = objects.par_iter().map(|object| Part::build(object, &[], quality)).collect();
        let (mut tables, mut counts) = (Tables::default(), Counts::default());
        let mut enter = |part: Part| {
            counts.add(&part.counts);
            Entrance { bounds: part.bounds, root: tables.append(part) }
        };
        let entrances = parts.into_iter().map(&mut enter).collect();
        Self { tables: Arc::new(tables), entrances, counts }
    }

    /// The box around object `object`, in its own space; empty if there is nothing.
    ///
    /// # Panics
    /// If there is no such object.
    pub fn bounds(&self, object: u32) -> Aabb {
        self.entrances[object as usize].bounds
    }

    /// The hierarchy over geometry placed directly in world space and over `instances` of these objects; see
    /// [`Bvh::build`]. Takes time for the world's own geometry and for the instances, but not for the objects.
    ///
    /// # Panics
    /// If an index of a mesh or the object of an instance is out of range, or if there are more than 2^28 primitives.
    pub fn place(&self, world: &[Geometry], instances: &[Instance], quality: Quality) -> Bvh {
        let (mut placed, mut refs, mut counts) = (Vec::new(), Vec::new(), self.counts);
        for (id, instance) in instances.iter().enumerate() {
            match self.enter(instance, id as u32, placed.len() as u32) {
                Some((instance, reference)) => {
                    placed.push(instance);
                    refs.push(reference);
                }
                None => counts.dropped_instances += 1,
            }
        }
        counts.instances = placed.len();
        let part = Part::build(world, &refs, quality);
        counts.add(&part.counts);
        Bvh {
            bounds: part.bounds,
            world: Tables { cells: part.cells, names: part.names, spheres: part.spheres, instances: placed },
            objects: Arc::clone(&self.tables),
            counts,
            level: SimdLevel::detect(),
        }
    }

    /// An instance for the tables and its reference for the builder; `None` if no ray can hit it.
    fn enter(&self, instance: &Instance, id: u32, index: u32) -> Option<(Placed, Ref)> {
        let (map, entrance) = (&instance.world_from_object, &self.entrances[instance.object as usize]);
        let object_from_world = instance::invert(map)?;
        let world = entrance.bounds.transformed(map);
        let usable = !world.is_empty() && world.min.abs().max(world.max.abs()).max_element() < 1e18;
        let placed = Placed { object_from_world, root: entrance.root, id };
        usable.then(|| (placed, Ref::new(world.min, world.max, Owner::Instance(index))))
    }
}

impl Tables {
    /// Adds the tables of an object and returns its root.
    fn append(&mut self, part: Part) -> u32 {
        let by =
            Offsets { cells: self.cells.len() as u32, spheres: self.spheres.len() as u32, names: self.names.count() };
        self.cells.extend(part.cells);
        self.names.append(part.names);
        self.spheres.extend(part.spheres);
        assert!(self.cells.len().max(self.spheres.len()) < Child::MAX_INDEX, "hierarchies take at most 8 GiB");
        self.renumber(by);
        by.cells
    }

    /// Tells the nodes and blocks of an object that was appended where everything is now.
    fn renumber(&mut self, by: Offsets) {
        let mut nodes = vec![by.cells];
        while let Some(cell) = nodes.pop() {
            // SAFETY: the list only holds the root of the object and the inner children of its nodes.
            let node: &mut Node = unsafe { cells::get_mut(&mut self.cells, cell) };
            node.children = node.children.map(|child| child.moved(by));
            let node = *node;
            for child in (0..WIDTH).filter(|&slot| node.is_used(slot)).map(|slot| node.children[slot]) {
                if child.is_inner() {
                    nodes.push(child.index());
                } else if let Leaf::Blocks { first, count } = child.leaf() {
                    for index in 0..count {
                        // SAFETY: leaves only name blocks that were written.
                        let block: &mut Block =
                            unsafe { cells::get_mut(&mut self.cells, first + index * Block::CELLS) };
                        block.numbers = block.numbers.map(|number| number.wrapping_add(by.names));
                    }
                }
            }
        }
    }
}
