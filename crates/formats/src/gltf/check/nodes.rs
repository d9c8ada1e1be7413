//! The hierarchy of nodes.

use super::super::document::{Fields, whole};
use super::Rules;

impl Rules<'_> {
    pub(super) fn nodes(&mut self) {
        let nodes = self.root.items("nodes");
        let mut parent = vec![None; nodes.len()];
        for (i, node) in nodes.iter().enumerate() {
            for child in node.items("children").iter().filter_map(whole) {
                match parent[child] {
                    Some(first) => {
                        let message = format!("nodes[{child}] is a child of nodes[{first}], too");
                        self.told.error(self.sink, "gltf::parents", format_args!("nodes[{i}].children"), message);
                    }
                    None => parent[child] = Some(i),
                }
            }
        }
        self.loops(&parent);
        for (i, scene) in self.root.items("scenes").iter().enumerate() {
            for node in scene.items("nodes").iter().filter_map(whole) {
                if let Some(above) = parent[node] {
                    let message = format!("nodes[{node}] is no root: it is a child of nodes[{above}]");
                    self.told.lapse(self.sink, "gltf::root", format_args!("scenes[{i}].nodes"), message);
                }
            }
        }
        for i in 0..nodes.len() {
            self.node(i);
        }
    }

    /// Nodes that are their own ancestors. Each node has one parent here, so it is enough to go up.
    fn loops(&mut self, parent: &[Option<usize>]) {
        let mut seen_from = vec![usize::MAX; parent.len()];
        for start in 0..parent.len() {
            let mut at = start;
            while seen_from[at] == usize::MAX {
                seen_from[at] = start;
                match parent[at] {
                    Some(up) => at = up,
                    None => break,
                }
            }
            let closes = parent[at].is_some() && seen_from[at] == start && reaches(parent, at);
            if closes {
                let path = format!("nodes[{at}]");
                self.told.error(self.sink, "gltf::loop", path, "the node is among its own descendants");
            }
        }
    }

    fn node(&mut self, i: usize) {
        let node = &self.root.items("nodes")[i];
        let path = format!("nodes[{i}]");
        let has = |key: &str| node.get(key).is_some();
        if has("matrix") && ["translation", "rotation", "scale"].into_iter().any(has) {
            let message = "it has a `matrix` and other transformations, too; the matrix counts";
            self.told.lapse(self.sink, "gltf::transform", &path, message);
        }
        let [x, y, z, w] = node.numbers("rotation", [0.0, 0.0, 0.0, 1.0]);
        if ((x * x + y * y + z * z + w * w).sqrt() - 1.0).abs() > 5e-4 {
            self.told.lapse(self.sink, "gltf::rotation", &path, "the rotation is no quaternion of length 1");
        }
        for key in ["skin", "weights"].into_iter().filter(|k| has(k) && !has("mesh")) {
            self.told.lapse(self.sink, "gltf::node", &path, format_args!("`{key}` needs a `mesh`"));
        }
    }
}

/// Whether going up from `at` leads back to it.
fn reaches(parent: &[Option<usize>], at: usize) -> bool {
    let mut up = parent[at];
    for _ in 0..parent.len() {
        match up {
            Some(node) if node == at => return true,
            Some(node) => up = parent[node],
            None => return false,
        }
    }
    false
}
