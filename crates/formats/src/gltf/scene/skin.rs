//! Skins: vertices that follow several nodes, at the pose that the nodes have.

use super::super::document::{Fields, whole};
use super::Importer;
use super::geometry::Geometry;
use glam::{DAffine3, DMat4, Vec4};

impl Importer<'_> {
    /// What takes vertices from the space they are bound in to the world, by joint. `None` after an error.
    pub(super) fn joints(&mut self, skin: usize, world: &[DAffine3]) -> Option<Vec<DAffine3>> {
        let json = self.root.items("skins").get(skin)?;
        let nodes: Vec<usize> = json.items("joints").iter().filter_map(whole).collect();
        let mut inverse = Vec::new();
        if let Some(index) = json.index("inverseBindMatrices") {
            let path = format!("skins[{skin}].inverseBindMatrices");
            inverse = self.accessor(index, &path)?.floats::<16>();
            if inverse.len() < nodes.len() {
                let message = format!("there are {} matrices for {} joints", inverse.len(), nodes.len());
                self.error("gltf::skin", path, message);
                return None;
            }
        }
        let joint = |(i, node): (usize, &usize)| {
            let placed = world.get(*node).copied().unwrap_or(DAffine3::IDENTITY);
            let bound = inverse
                .get(i)
                .map_or(DAffine3::IDENTITY, |m| DAffine3::from_mat4(DMat4::from_cols_array(&m.map(f64::from))));
            placed * bound
        };
        Some(nodes.iter().enumerate().map(joint).collect())
    }
}

impl Geometry {
    /// Moves each vertex by the joints that it follows, by their weights.
    ///
    /// # Errors
    /// A joint that does not exist.
    pub(super) fn follow(&mut self, joints: &[DAffine3]) -> Result<(), String> {
        for vertex in 0..self.positions.len() {
            let mut sum = DMat4::ZERO;
            let mut total = 0.0;
            for (which, weights) in &self.bones {
                let (Some(which), Some(weights)) = (which.get(vertex), weights.get(vertex)) else { continue };
                for (joint, weight) in which.iter().zip(weights).filter(|(_, w)| **w > 0.0) {
                    let missing = || format!("vertex {vertex} follows joint {joint} of {}", joints.len());
                    let placed = joints.get(*joint as usize).ok_or_else(missing)?;
                    sum += DMat4::from(*placed) * f64::from(*weight);
                    total += f64::from(*weight);
                }
            }
            if total > 0.0 {
                self.move_vertex(vertex, &DAffine3::from_mat4(sum * (1.0 / total)));
            }
        }
        Ok(())
    }

    /// Moves all vertices.
    pub(super) fn place(&mut self, by: &DAffine3) {
        let turn = by.matrix3.inverse().transpose();
        let turn = if turn.is_finite() { turn } else { by.matrix3 };
        let side = if by.matrix3.determinant() < 0.0 { -1.0 } else { 1.0 };
        for p in &mut self.positions {
            *p = by.transform_point3(p.as_dvec3()).as_vec3();
        }
        for n in &mut self.normals {
            *n = (turn * n.as_dvec3()).normalize_or_zero().as_vec3();
        }
        for t in &mut self.tangents {
            *t = tangent(*t, by, side);
        }
        if side < 0.0 {
            self.triangles.iter_mut().for_each(|t| t.swap(1, 2));
        }
    }

    fn move_vertex(&mut self, i: usize, by: &DAffine3) {
        self.positions[i] = by.transform_point3(self.positions[i].as_dvec3()).as_vec3();
        let turn = by.matrix3.inverse().transpose();
        let turn = if turn.is_finite() { turn } else { by.matrix3 };
        if let Some(n) = self.normals.get_mut(i) {
            *n = (turn * n.as_dvec3()).normalize_or_zero().as_vec3();
        }
        if let Some(t) = self.tangents.get_mut(i) {
            *t = tangent(*t, by, 1.0);
        }
    }
}

fn tangent(t: Vec4, by: &DAffine3, side: f32) -> Vec4 {
    by.transform_vector3(t.truncate().as_dvec3()).normalize_or_zero().as_vec3().extend(side * t.w)
}
