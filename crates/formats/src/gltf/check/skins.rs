//! Skins, and the nodes that use them.

use super::super::data::Component;
use super::super::document::{Fields, whole};
use super::Rules;

impl Rules<'_> {
    pub(super) fn skins(&mut self) {
        let parents = self.parents();
        for (s, skin) in self.list("skins").iter().enumerate() {
            let path = format!("skins[{s}]");
            let joints: Vec<usize> = skin.items("joints").iter().filter_map(whole).collect();
            self.matrices(skin.index("inverseBindMatrices"), joints.len(), &path);
            let roots: Vec<Vec<usize>> = joints.iter().map(|j| line(&parents, *j)).collect();
            let is_shared = |node: &usize| roots.iter().all(|r| r.contains(node));
            if roots.len() > 1 && !roots.first().is_some_and(|r| r.iter().any(&is_shared)) {
                self.lapse("gltf::skin", &path, "its joints have no common ancestor");
            }
            if let Some(root) = skin.index("skeleton")
                && !is_shared(&root)
            {
                self.lapse("gltf::skin", &path, format_args!("nodes[{root}] is no common ancestor of its joints"));
            }
        }
        self.users(&parents);
    }

    /// The parent of each node; where there are several, the last.
    fn parents(&self) -> Vec<Option<usize>> {
        let nodes = self.list("nodes");
        let mut parents = vec![None; nodes.len()];
        for (i, node) in nodes.iter().enumerate() {
            node.items("children").iter().filter_map(whole).for_each(|child| parents[child] = Some(i));
        }
        parents
    }

    fn matrices(&mut self, accessor: Option<usize>, joints: usize, path: &str) {
        let Some(accessor) = accessor else { return };
        let path = format!("{path}.inverseBindMatrices");
        let Some(format) = self.format(accessor) else { return };
        if format.kind != "MAT4" || format.component != Component::F32 {
            return self.error("gltf::skin", path, "these must be 4×4 matrices of floats");
        }
        if format.count < joints {
            self.error("gltf::skin", &path, format_args!("there are {} matrices for {joints} joints", format.count));
        }
        if let Some((view, json)) = self.view_of(accessor)
            && json.get("byteStride").is_some()
        {
            self.lapse("gltf::stride", path, format_args!("bufferViews[{view}] must not have a `byteStride`"));
        }
    }

    /// Nodes with a skin.
    fn users(&mut self, parents: &[Option<usize>]) {
        let scenes: Vec<Vec<usize>> = self.list("scenes").iter().map(|s| indices(s.items("nodes"))).collect();
        let is_in = |scene: &[usize], node: usize| line(parents, node).iter().any(|n| scene.contains(n));
        for (i, node) in self.list("nodes").iter().enumerate() {
            let Some(mesh) = node.index("mesh").and_then(|m| self.list("meshes").get(m)) else { continue };
            let path = format!("nodes[{i}]");
            let targets = mesh.items("primitives").first().map_or(0, |p| p.items("targets").len());
            let weights = node.items("weights").len();
            if weights > 0 && weights != targets {
                let message = format!("there are {weights} weights for {targets} morph targets");
                self.lapse("gltf::morph", &path, message);
            }
            let Some(skin) = node.index("skin").and_then(|s| self.list("skins").get(s)) else { continue };
            let follows = |p: &serde_json::Value| p.field("attributes").get("JOINTS_0").is_some();
            if !mesh.items("primitives").iter().all(follows) {
                self.lapse("gltf::skin", &path, "it has a skin, but its mesh has no joints");
            }
            let joints = indices(skin.items("joints"));
            let apart = scenes.iter().any(|s| is_in(s, i) && !joints.iter().all(|j| is_in(s, *j)));
            if apart {
                self.lapse("gltf::skin", &path, "joints of its skin are not in the scene");
            }
        }
    }
}

fn indices(list: &[serde_json::Value]) -> Vec<usize> {
    list.iter().filter_map(whole).collect()
}

/// A node and all above it. Loops are told of elsewhere; here they end.
fn line(parents: &[Option<usize>], node: usize) -> Vec<usize> {
    let mut line = vec![node];
    while let Some(up) = line.last().and_then(|n| parents.get(*n).copied().flatten()) {
        if line.len() > parents.len() {
            break;
        }
        line.push(up);
    }
    line
}
