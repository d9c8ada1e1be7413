//! The triangles of a primitive.

use super::super::document::{Fields, whole};
use super::Importer;
use glam::{Vec2, Vec3, Vec4};
use serde_json::Value;

/// Vertices and triangles as the file gives them; each list is empty or as long as the positions.
#[derive(Clone, Debug, Default, PartialEq)]
pub(super) struct Geometry {
    pub(super) positions: Vec<Vec3>,
    pub(super) normals: Vec<Vec3>,
    /// With the side of the bitangent in `w`.
    pub(super) tangents: Vec<Vec4>,
    /// Two sets, `v` growing downwards as in the file.
    pub(super) uvs: [Vec<Vec2>; 2],
    /// Linear, with opacity.
    pub(super) colours: Vec<Vec4>,
    /// For skins, four by four.
    pub(super) bones: Vec<Bones>,
    pub(super) triangles: Vec<[u32; 3]>,
}

/// Joints that vertices follow, and how much.
pub(super) type Bones = (Vec<[u32; 4]>, Vec<[f32; 4]>);

/// Modes of primitives (glTF 2.0, section 3.7.2.1).
const TRIANGLES: usize = 4;
const STRIP: usize = 5;
const FAN: usize = 6;

impl Importer<'_> {
    /// The triangles of a primitive at its rest pose, morphed by `weights`; `None` if there are none, or after an error.
    pub(super) fn geometry(&mut self, primitive: &Value, weights: &[f32], path: &str) -> Option<Geometry> {
        let mode = primitive.index("mode").unwrap_or(TRIANGLES);
        if !(TRIANGLES..=FAN).contains(&mode) {
            self.note("gltf::mode", path, "points and lines are left out");
            return None;
        }
        if primitive.field("attributes").get("POSITION").is_none() {
            self.note("gltf::positions", path, "there are no positions; the primitive is left out");
            return None;
        }
        let mut geometry = match primitive.extension("KHR_draco_mesh_compression") {
            Some(packed) => self.draco(primitive, packed, path)?,
            None => self.plain(primitive, mode, path)?,
        };
        self.morph(primitive, weights, &mut geometry, path);
        Some(geometry)
    }

    fn plain(&mut self, primitive: &Value, mode: usize, path: &str) -> Option<Geometry> {
        let mut geometry = Geometry::default();
        let attributes = primitive.field("attributes").as_object()?;
        for (name, index) in attributes {
            let Some(accessor) = whole(index) else { continue };
            if semantic(name).is_none() {
                continue;
            }
            let place = format!("{path}.attributes.{name}");
            let list = self.accessor(accessor, &place)?;
            if !self.afford(list.count, path) {
                return None;
            }
            geometry.set_joints(name, || list.wholes::<4>());
            geometry.set(name, list.width, list.floats::<4>());
        }
        let count = geometry.positions.len();
        let order = match primitive.index("indices") {
            None => None,
            Some(index) => {
                let list = self.accessor(index, &format!("{path}.indices"))?;
                if !list.component.is_unsigned() || list.width != 1 {
                    self.error("gltf::indices", path, "indices must be single whole numbers of 0 or more");
                    return None;
                }
                if !self.afford(list.count, path) {
                    return None;
                }
                Some(list.wholes::<1>())
            }
        };
        let corners = order.as_ref().map_or(count, Vec::len);
        if let Some(order) = &order
            && let Some(at) = order.iter().position(|[i]| *i as usize >= count)
        {
            let message = format!("index {at} is {}, but there are {count} vertices", order[at][0]);
            self.error("gltf::indices", format_args!("{path}.indices"), message);
            return None;
        }
        let corner = |i: usize| order.as_ref().map_or(i as u32, |o| o[i][0]);
        geometry.triangles = triangles(mode, corners).map(|t| t.map(corner)).collect();
        self.same_length(geometry, path)
    }

    /// Lists of another length than the positions have no meaning.
    pub(super) fn same_length(&mut self, geometry: Geometry, path: &str) -> Option<Geometry> {
        let count = geometry.positions.len();
        let lengths = [
            ("NORMAL", geometry.normals.len()),
            ("TANGENT", geometry.tangents.len()),
            ("TEXCOORD_0", geometry.uvs[0].len()),
            ("TEXCOORD_1", geometry.uvs[1].len()),
            ("COLOR_0", geometry.colours.len()),
        ];
        let bones = geometry.bones.iter().flat_map(|(j, w)| [("JOINTS", j.len()), ("WEIGHTS", w.len())]);
        if let Some((name, found)) = lengths.into_iter().chain(bones).find(|(_, n)| *n != 0 && *n != count) {
            let message = format!("{name} has {found} elements, but there are {count} positions");
            self.error("gltf::attributes", path, message);
            return None;
        }
        Some(geometry)
    }

    /// Adds what morph targets move.
    fn morph(&mut self, primitive: &Value, weights: &[f32], geometry: &mut Geometry, path: &str) {
        let active = primitive.items("targets").iter().zip(weights).enumerate().filter(|(_, (_, w))| **w != 0.0);
        for (i, (target, weight)) in active {
            let Some(attributes) = target.as_object() else { continue };
            for (name, index) in attributes {
                let Some(list) = whole(index).and_then(|a| self.accessor(a, &format!("{path}.targets[{i}].{name}")))
                else {
                    continue;
                };
                if !self.afford(list.count, path) {
                    return;
                }
                let by: Vec<Vec4> = list.floats::<4>().into_iter().map(|v| *weight * Vec4::from_array(v)).collect();
                geometry.shift(name, &by);
            }
        }
    }
}

#[derive(Clone, Copy, PartialEq, Eq)]
enum Semantic {
    Position,
    Normal,
    Tangent,
    Uv(usize),
    Colour,
    Joints,
    Weights,
}

/// What is read of the attribute of that name.
fn semantic(name: &str) -> Option<Semantic> {
    let numbered = |prefix: &str| name.strip_prefix(prefix).is_some_and(|n| n.parse::<u8>().is_ok());
    Some(match name {
        "POSITION" => Semantic::Position,
        "NORMAL" => Semantic::Normal,
        "TANGENT" => Semantic::Tangent,
        "TEXCOORD_0" => Semantic::Uv(0),
        "TEXCOORD_1" => Semantic::Uv(1),
        "COLOR_0" => Semantic::Colour,
        _ if numbered("JOINTS_") => Semantic::Joints,
        _ if numbered("WEIGHTS_") => Semantic::Weights,
        _ => return None,
    })
}

/// The number behind `JOINTS_` or `WEIGHTS_`.
fn set_of(name: &str) -> usize {
    name.rsplit('_').next().and_then(|n| n.parse::<u8>().ok()).map_or(0, usize::from)
}

impl Geometry {
    /// Takes a list under its name in the file; names without a meaning here are passed over.
    pub(super) fn set(&mut self, name: &str, width: usize, list: Vec<[f32; 4]>) {
        let vec3 = |[x, y, z, _]: [f32; 4]| Vec3::new(x, y, z);
        match semantic(name) {
            Some(Semantic::Position) => self.positions = list.into_iter().map(vec3).collect(),
            Some(Semantic::Normal) => self.normals = list.into_iter().map(vec3).collect(),
            Some(Semantic::Tangent) => self.tangents = list.into_iter().map(Vec4::from_array).collect(),
            Some(Semantic::Uv(set)) => self.uvs[set] = list.into_iter().map(|[u, v, ..]| Vec2::new(u, v)).collect(),
            Some(Semantic::Colour) => {
                let opaque = |[r, g, b, a]: [f32; 4]| Vec4::new(r, g, b, if width == 4 { a } else { 1.0 });
                self.colours = list.into_iter().map(|c| opaque(c).clamp(Vec4::ZERO, Vec4::ONE)).collect();
            }
            Some(Semantic::Weights) => self.bones_of(name).1 = list,
            Some(Semantic::Joints) | None => {}
        }
    }

    /// Takes a list of whole numbers if the name is that of joints.
    pub(super) fn set_joints(&mut self, name: &str, list: impl FnOnce() -> Vec<[u32; 4]>) {
        if semantic(name) == Some(Semantic::Joints) {
            self.bones_of(name).0 = list();
        }
    }

    fn bones_of(&mut self, name: &str) -> &mut Bones {
        let set = set_of(name);
        if self.bones.len() <= set {
            self.bones.resize_with(set + 1, Default::default);
        }
        &mut self.bones[set]
    }

    fn shift(&mut self, name: &str, by: &[Vec4]) {
        match semantic(name) {
            Some(Semantic::Position) => add(&mut self.positions, by, |p, d| *p += d.truncate()),
            Some(Semantic::Normal) => add(&mut self.normals, by, |n, d| *n += d.truncate()),
            Some(Semantic::Tangent) => add(&mut self.tangents, by, |t, d| *t += d.truncate().extend(0.0)),
            Some(Semantic::Uv(set)) => add(&mut self.uvs[set], by, |uv, d| *uv += d.truncate().truncate()),
            Some(Semantic::Colour) => add(&mut self.colours, by, |c, d| *c = (*c + d).clamp(Vec4::ZERO, Vec4::ONE)),
            _ => {}
        }
    }
}

fn add<T>(list: &mut [T], by: &[Vec4], one: impl Fn(&mut T, Vec4)) {
    list.iter_mut().zip(by).for_each(|(value, d)| one(value, *d));
}

/// The corners of all triangles of `corners` corners in a row (glTF 2.0, section 3.7.2.1).
fn triangles(mode: usize, corners: usize) -> Box<dyn Iterator<Item = [usize; 3]>> {
    match mode {
        STRIP => Box::new((0..corners.saturating_sub(2)).map(|i| [i, i + 1 + i % 2, i + 2 - i % 2])),
        FAN => Box::new((1..corners.saturating_sub(1)).map(|i| [i, i + 1, 0])),
        _ => Box::new((0..corners / 3).map(|i| [3 * i, 3 * i + 1, 3 * i + 2])),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn strips_and_fans_turn_all_triangles_the_same_way() {
        // A strip along x: corners at (i/2, i mod 2); a fan around the origin.
        let strip = |i: usize| Vec2::new((i / 2) as f32, 1.0 - (i % 2) as f32);
        let fan = |i: usize| if i == 0 { Vec2::ZERO } else { Vec2::from_angle(i as f32 * 0.5) };
        for (mode, at, turn) in [(STRIP, &strip as &dyn Fn(usize) -> Vec2, 1.0), (FAN, &fan, 1.0)] {
            let all: Vec<[usize; 3]> = triangles(mode, 7).collect();
            assert_eq!(all.len(), 5);
            for t in all {
                let [a, b, c] = t.map(at);
                assert!((b - a).perp_dot(c - a) * turn > 0.0, "mode {mode}: {t:?}");
            }
        }
        assert_eq!(triangles(STRIP, 2).count() + triangles(FAN, 0).count() + triangles(TRIANGLES, 5).count(), 1);
    }
}
