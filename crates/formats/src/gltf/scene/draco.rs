//! Primitives packed by `KHR_draco_mesh_compression`.

use super::super::data::Accessor;
use super::super::document::{Fields, whole};
use super::Importer;
use super::geometry::Geometry;
use draco_core::{DecodeLimits, DecoderBuffer, Mesh, MeshDecoder};
use serde_json::Value;

/// Values may be this many bytes for each packed byte: constant attributes pack without limit, real ones do not.
const MAX_RATIO: u64 = 256;
/// What any stream may unpack to, bytes,
const SMALL: u64 = 1 << 26;
/// and what none may.
const LARGE: u64 = 1 << 30;

impl Importer<'_> {
    pub(super) fn draco(&mut self, primitive: &Value, packed: &Value, path: &str) -> Option<Geometry> {
        let path = format!("{path}.extensions.KHR_draco_mesh_compression");
        let view = packed.index("bufferView")?;
        let Some(stream) = self.buffers.view(self.root, view) else {
            self.error("gltf::draco", path, format_args!("bufferViews[{view}] has no data"));
            return None;
        };
        let mesh = match decode(stream) {
            Ok(mesh) => mesh,
            Err(reason) => {
                self.error("gltf::draco", path, format_args!("the packed data are damaged: {reason}"));
                return None;
            }
        };
        let points = mesh.num_points();
        if !self.afford(points + 3 * mesh.num_faces(), &path) {
            return None;
        }
        let mut geometry = Geometry::default();
        for (name, id) in packed.field("attributes").as_object()? {
            let attribute = whole(id).and_then(|id| mesh.attribute_by_unique_id(u32::try_from(id).ok()?));
            let Some(attribute) = attribute else {
                self.error("gltf::draco", &path, format_args!("the packed data have no {name}"));
                return None;
            };
            // What the numbers mean is said by the accessor that they stand for.
            let accessor = whole(primitive.field("attributes").field(name));
            let accessor = accessor.and_then(|i| Accessor::open(self.root, self.buffers, i).ok());
            let scale = accessor.filter(|a| a.normalized).and_then(|a| a.component.largest()).unwrap_or(1.0);
            let width = usize::from(attribute.num_components());
            let values = attribute.read_f32s(points, 4);
            let list: Vec<[f32; 4]> = values.as_chunks::<4>().0.to_vec();
            geometry.set_joints(name, || list.iter().map(|v| v.map(|j| j as u32)).collect());
            geometry.set(name, width, list.iter().map(|v| v.map(|c| c / scale)).collect());
        }
        geometry.triangles = mesh.faces().iter().map(|f| f.map(|p| p.0)).collect();
        if geometry.triangles.iter().flatten().any(|i| *i as usize >= geometry.positions.len()) {
            self.error("gltf::draco", &path, "a triangle refers to a vertex that does not exist");
            return None;
        }
        self.same_length(geometry, &path)
    }
}

fn decode(stream: &[u8]) -> Result<Mesh, String> {
    let bytes = (stream.len() as u64 * MAX_RATIO).clamp(SMALL, LARGE);
    let limits = DecodeLimits::default().with_max_points(bytes / 4).with_max_faces(bytes / 12);
    let mut buffer = DecoderBuffer::new(stream).with_limits(limits.with_max_decoded_bytes(bytes));
    let mut mesh = Mesh::new();
    MeshDecoder::new().decode(&mut buffer, &mut mesh).map_err(|e| e.to_string())?;
    Ok(mesh)
}
