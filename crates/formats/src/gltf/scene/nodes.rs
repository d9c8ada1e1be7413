//! The hierarchy of nodes: what hangs where.

use super::super::document::{Fields, whole};
use super::Importer;
use glam::{DAffine3, DMat4, DQuat, DVec3};
use serde_json::Value;

impl Importer<'_> {
    /// Adds the scene that is shown: the default one, or the first; without scenes, all nodes that have no parent.
    pub(in super::super) fn run(&mut self) {
        let mut stack: Vec<(usize, DAffine3)> = self.roots().into_iter().map(|n| (n, DAffine3::IDENTITY)).collect();
        stack.reverse();
        let count = self.root.items("nodes").len();
        let mut world = vec![None; count];
        let mut order = Vec::new();
        while let Some((index, parent)) = stack.pop() {
            let Some(node) = self.root.items("nodes").get(index) else { continue };
            // Nodes with two parents are told of by the checks; they hang where they are met first.
            if world[index].is_some() {
                continue;
            }
            let placed = parent * local(node);
            world[index] = Some(placed);
            order.push((index, placed));
            let children = node.items("children").iter().rev().filter_map(whole);
            stack.extend(children.map(|child| (child, placed)));
        }
        let world: Vec<DAffine3> = world.into_iter().map(|w| w.unwrap_or(DAffine3::IDENTITY)).collect();
        let before = self.target.lights();
        self.meshes(&order, &world);
        let emitting = self.target.lights() - before;
        for (index, placed) in &order {
            let node = &self.root.items("nodes")[*index];
            self.light(node, placed);
            self.camera(node, placed);
        }
        // Without a camera it is a thing to look at, whatever shines on it.
        if self.target.camera.is_none() {
            self.target.glowing += emitting;
        }
    }

    fn roots(&self) -> Vec<usize> {
        let scenes = self.root.items("scenes");
        let shown = self.root.index("scene").unwrap_or(0);
        if let Some(scene) = scenes.get(shown) {
            return scene.items("nodes").iter().filter_map(whole).collect();
        }
        let nodes = self.root.items("nodes");
        let mut has_parent = vec![false; nodes.len()];
        for child in nodes.iter().flat_map(|n| n.items("children")).filter_map(whole) {
            if let Some(slot) = has_parent.get_mut(child) {
                *slot = true;
            }
        }
        (0..nodes.len()).filter(|i| !has_parent[*i]).collect()
    }
}

/// Where a node is in its parent (glTF 2.0, section 3.5.3).
pub(super) fn local(node: &Value) -> DAffine3 {
    if node.get("matrix").is_some() {
        let m = node.numbers("matrix", DMat4::IDENTITY.to_cols_array().map(|v| v as f32));
        return DAffine3::from_mat4(DMat4::from_cols_array(&m.map(f64::from)));
    }
    let wide = |v: [f32; 3]| DVec3::from_array(v.map(f64::from));
    let [x, y, z, w] = node.numbers("rotation", [0.0, 0.0, 0.0, 1.0]).map(f64::from);
    let turn = DQuat::from_xyzw(x, y, z, w);
    let turn = if turn.length_squared() > 0.0 { turn.normalize() } else { DQuat::IDENTITY };
    let (scale, shift) = (wide(node.numbers("scale", [1.0; 3])), wide(node.numbers("translation", [0.0; 3])));
    DAffine3::from_scale_rotation_translation(scale, turn, shift)
}
