//! The values, as far as a mesh needs them.

use super::header::{self, Element, Encoding, Header, Property, Scalar};
use super::values::{Trouble, Values};
use crate::diagnostic::{Diagnostic, Sink, SourceFile, Span};
use crate::obj::{Corner, Triangulator};
use glam::{Vec2, Vec4};
use sunfleck::shape::Attributes;

/// What a `.ply` file holds of a mesh.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct PlyMesh {
    /// Positions.
    pub positions: Vec<[f32; 3]>,
    /// Normals, not unit; empty, or as many as positions.
    pub normals: Vec<[f32; 3]>,
    /// Texture coordinates; empty, or as many as positions.
    pub uvs: Vec<[f32; 2]>,
    /// What else the vertices know; empty lists, or as long as that of positions.
    pub extra: Attributes,
    /// Polygons cut into triangles; all indices are valid.
    pub triangles: Vec<[u32; 3]>,
    /// Faces left out because they refer to vertices that do not exist.
    pub bad_faces: usize,
}

/// Names of texture coordinates in the wild.
const UV_NAMES: [[&str; 2]; 4] = [["u", "v"], ["s", "t"], ["texture_u", "texture_v"], ["texture_s", "texture_t"]];

/// Names of the list of a face's corners.
const CORNER_NAMES: [&str; 2] = ["vertex_indices", "vertex_index"];

/// Reads a file. Problems go to `sink`; after an error the mesh means nothing.
pub fn parse(source: &SourceFile, sink: &mut Sink) -> PlyMesh {
    let Some(header) = header::parse(source, sink) else { return PlyMesh::default() };
    let mut body = Body {
        values: Values::new(source.bytes(), header.body, header.encoding),
        mesh: PlyMesh::default(),
        corners: Vec::new(),
        polygons: Vec::new(),
    };
    for element in header.elements.iter().filter(|e| !e.properties.is_empty()) {
        if let Err(stop) = body.element(element, &header) {
            sink.error(stop.tell(element, source));
            return PlyMesh::default();
        }
    }
    body.triangulate()
}

/// Where and why reading ended.
struct Stop {
    /// Which one of its element.
    index: u64,
    why: Why,
}

enum Why {
    Value(Trouble),
    /// A list whose length is no whole number.
    Length(f64),
    /// `vertex` without `x`, `y` and `z`.
    NoPositions,
}

impl Stop {
    fn tell(self, element: &Element, source: &SourceFile) -> Diagnostic {
        let one = format!("{} {} of {}", element.name, self.index + 1, element.count);
        match self.why {
            Why::Value(Trouble::End) => {
                let message = format!("the file ends before {one} is complete");
                Diagnostic::error("ply::truncated", message).in_file(source.name())
            }
            Why::Value(Trouble::NoNumber(start, end)) => {
                let message = format!("{one} has a value that is no number");
                Diagnostic::error("ply::bad-number", message).at(source, Span::new(start, end), "")
            }
            Why::Length(length) => {
                let message = format!("{one} has a list of {length} values");
                let error = Diagnostic::error("ply::bad-length", message).in_file(source.name());
                error.help("the values before it may not be what the header says")
            }
            Why::NoPositions => {
                let message = "the element `vertex` has no `x`, `y` and `z`";
                Diagnostic::error("ply::no-positions", message).in_file(source.name())
            }
        }
    }
}

struct Body<'s> {
    values: Values<'s>,
    mesh: PlyMesh,
    /// Corners of all faces with more than three.
    corners: Vec<Corner>,
    /// How many corners each of those has.
    polygons: Vec<usize>,
}

impl Body<'_> {
    fn element(&mut self, element: &Element, header: &Header) -> Result<(), Stop> {
        // No more than the file has bytes for, whatever the header says.
        let room = self.values.left() / element.min_bytes(header.encoding).max(1) + 1;
        let room = room.min(usize::try_from(element.count).unwrap_or(usize::MAX));
        match element.name.as_str() {
            "vertex" => self.vertices(element, room),
            "face" => self.faces(element, room, header.encoding),
            _ => each(element, |_| self.skip(&element.properties)),
        }
    }

    fn skip(&mut self, properties: &[Property]) -> Result<(), Why> {
        for property in properties {
            let count = if property.length.is_some() { self.length(property)? } else { 1 };
            self.values.skip(property.value, count).map_err(Why::Value)?;
        }
        Ok(())
    }

    fn length(&mut self, list: &Property) -> Result<u64, Why> {
        let Some(kind) = list.length else { return Ok(1) };
        let length = self.values.next(kind).map_err(Why::Value)?;
        if length >= 0.0 && length.fract() == 0.0 { Ok(length as u64) } else { Err(Why::Length(length)) }
    }

    fn vertices(&mut self, element: &Element, room: usize) -> Result<(), Stop> {
        let scalar = |name: &str| element.properties.iter().position(|p| p.length.is_none() && p.name == name);
        let all = |names: &[&str]| names.iter().map(|n| scalar(n)).collect::<Option<Vec<usize>>>();
        let Some(position) = all(&["x", "y", "z"]) else { return Err(Stop { index: 0, why: Why::NoPositions }) };
        let normal = all(&["nx", "ny", "nz"]);
        let uv = UV_NAMES.iter().find_map(|names| all(names));
        // Floats only: bytes under these names are meant to be looked at in a viewer.
        let floats = |names: &[&str]| {
            let columns = all(names)?;
            columns.iter().all(|i| element.properties[*i].value == Scalar::F32).then_some(columns)
        };
        let uv2 = floats(&["u2", "v2"]);
        let colour = floats(&["red", "green", "blue", "alpha"]);
        let tangent = floats(&["tx", "ty", "tz", "tw"]);
        self.mesh.positions.reserve(room);
        self.mesh.normals.reserve(if normal.is_some() { room } else { 0 });
        self.mesh.uvs.reserve(if uv.is_some() { room } else { 0 });
        let mut row = vec![0.0_f32; element.properties.len()];
        each(element, |_| {
            for (property, value) in element.properties.iter().zip(&mut row) {
                if property.length.is_some() {
                    self.skip(std::slice::from_ref(property))?;
                } else {
                    *value = self.values.next(property.value).map_err(Why::Value)? as f32;
                }
            }
            let take = |columns: &[usize], i: usize| row[columns[i]];
            self.mesh.positions.push([0, 1, 2].map(|i| take(&position, i)));
            self.mesh.normals.extend(normal.as_ref().map(|n| [0, 1, 2].map(|i| take(n, i))));
            self.mesh.uvs.extend(uv.as_ref().map(|n| [0, 1].map(|i| take(n, i))));
            let four = |columns: &Vec<usize>| Vec4::from_array([0, 1, 2, 3].map(|i| take(columns, i)));
            let extra = &mut self.mesh.extra;
            extra.uv2.extend(uv2.as_ref().map(|n| Vec2::new(take(n, 0), take(n, 1))));
            extra.colours.extend(colour.as_ref().map(four));
            extra.tangents.extend(tangent.as_ref().map(four));
            Ok(())
        })
    }

    fn faces(&mut self, element: &Element, room: usize, encoding: Encoding) -> Result<(), Stop> {
        let is_corners = |p: &Property| p.length.is_some() && CORNER_NAMES.contains(&p.name.as_str());
        // A triangle takes at least three more values than its length.
        let room = room.min(self.values.left() / if encoding == Encoding::Text { 8 } else { 4 });
        self.mesh.triangles.reserve(room);
        each(element, |_| {
            for property in &element.properties {
                if is_corners(property) {
                    self.face(property)?;
                } else {
                    self.skip(std::slice::from_ref(property))?;
                }
            }
            Ok(())
        })
    }

    /// Indices are checked when all vertices are known.
    fn face(&mut self, list: &Property) -> Result<(), Why> {
        let length = self.length(list)?;
        let mut first = [0; 3];
        let start = self.corners.len();
        for i in 0..length {
            let value = self.values.next(list.value).map_err(Why::Value)?;
            let whole = value >= 0.0 && value < f64::from(u32::MAX) && value.fract() == 0.0;
            let index = if whole { value as u32 } else { u32::MAX };
            if length == 3 {
                first[i as usize] = index;
            } else {
                self.corners.push(Corner::new(index, None, None));
            }
        }
        match length {
            0..=2 => self.corners.truncate(start),
            3 => self.mesh.triangles.push(first),
            _ => self.polygons.push(length as usize),
        }
        Ok(())
    }

    fn triangulate(mut self) -> PlyMesh {
        let vertices = self.mesh.positions.len();
        let before = self.mesh.triangles.len();
        self.mesh.triangles.retain(|t| t.iter().all(|i| (*i as usize) < vertices));
        self.mesh.bad_faces = before - self.mesh.triangles.len();
        let mut triangulator = Triangulator::new(&self.mesh.positions);
        let mut cut = Vec::new();
        let mut rest = self.corners.as_slice();
        for length in self.polygons {
            let (polygon, others) = rest.split_at(length);
            rest = others;
            if polygon.iter().any(|c| c.position as usize >= vertices) {
                self.mesh.bad_faces += 1;
                continue;
            }
            triangulator.triangulate(polygon, &mut cut);
            self.mesh.triangles.extend(cut.drain(..).map(|t| t.map(|c| c.position)));
        }
        self.mesh
    }
}

fn each(element: &Element, mut one: impl FnMut(u64) -> Result<(), Why>) -> Result<(), Stop> {
    (0..element.count).try_for_each(|index| one(index).map_err(|why| Stop { index, why }))
}
