//! `EXT_mesh_gpu_instancing`: one mesh at many places.

use super::super::document::{Fields, whole};
use super::Importer;
use glam::{DAffine3, DQuat, DVec3};
use serde_json::Value;

impl Importer<'_> {
    /// The places of a node's mesh within the node: one, or those that the extension lists.
    pub(super) fn places(&mut self, node: &Value, index: usize) -> Vec<DAffine3> {
        let Some(extension) = node.extension("EXT_mesh_gpu_instancing") else { return vec![DAffine3::IDENTITY] };
        let path = format!("nodes[{index}].extensions.EXT_mesh_gpu_instancing");
        let attributes = extension.field("attributes");
        let mut list = |name: &str| -> Option<Vec<[f32; 4]>> {
            let accessor = self.accessor(whole(attributes.field(name))?, &path)?;
            Some(accessor.floats::<4>())
        };
        let (shifts, turns, scales) = (list("TRANSLATION"), list("ROTATION"), list("SCALE"));
        let counts = [&shifts, &turns, &scales].into_iter().flatten().map(Vec::len);
        let Some(count) = counts.clone().max() else { return vec![DAffine3::IDENTITY] };
        if counts.into_iter().any(|c| c != count) {
            self.error("gltf::instancing", path, "its attributes are of different counts");
            return Vec::new();
        }
        let vector = |list: &Option<Vec<[f32; 4]>>, i: usize, default: DVec3| {
            list.as_ref().map_or(default, |l| DVec3::new(l[i][0].into(), l[i][1].into(), l[i][2].into()))
        };
        let place = |i: usize| {
            let turn = turns.as_ref().map_or(DQuat::IDENTITY, |l| DQuat::from_array(l[i].map(f64::from)));
            let turn = if turn.length_squared() > 0.0 { turn.normalize() } else { DQuat::IDENTITY };
            let (scale, shift) = (vector(&scales, i, DVec3::ONE), vector(&shifts, i, DVec3::ZERO));
            DAffine3::from_scale_rotation_translation(scale, turn, shift)
        };
        (0..count).map(place).collect()
    }
}
