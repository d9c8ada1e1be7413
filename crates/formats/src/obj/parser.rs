//! The statements of an `.obj` file.

use super::faces::Face;
use super::triangulate::Triangulator;
use super::{Corner, Library, ObjFile, ObjMesh};
use crate::diagnostic::{Diagnostic, Sink, SourceFile, Span};
use crate::lines::{Line, Lines, finite, shortened};
use std::collections::HashMap;

/// The faces of a file may have at most this many corners together.
pub const MAX_CORNERS: usize = 1 << 27;

/// Statements without meaning for surfaces of given triangles.
const SILENT: [&str; 16] = [
    "s",
    "mg",
    "bevel",
    "c_interp",
    "d_interp",
    "lod",
    "shadow_obj",
    "trace_obj",
    "usemap",
    "maplib",
    "vp",
    "cstype",
    "deg",
    "bmat",
    "step",
    "end",
];

/// Statements of shapes that are not read.
const SHAPELESS: [&str; 7] = ["l", "p", "curv", "curv2", "surf", "csh", "call"];

const KEYWORDS: [&str; 9] = ["v", "vt", "vn", "f", "o", "g", "usemtl", "mtllib", "s"];

/// Reads an `.obj` file. Errors go to `sink`, and reading goes on behind them; the tree is whole only if there are none.
pub fn parse(source: &SourceFile, sink: &mut Sink) -> ObjFile {
    let mut parser = Parser {
        source,
        sink,
        tree: ObjFile::default(),
        corners: Vec::new(),
        faces: Vec::new(),
        forward: Vec::new(),
        mesh_of: HashMap::new(),
        material_of: HashMap::new(),
        object: String::new(),
        material: None,
        mesh: None,
    };
    parser.file();
    parser.tree
}

pub(super) struct Parser<'s> {
    pub(super) source: &'s SourceFile,
    pub(super) sink: &'s mut Sink,
    pub(super) tree: ObjFile,
    pub(super) corners: Vec<Corner>,
    pub(super) faces: Vec<Face>,
    /// Indices of elements that were not yet there: (array, index, place).
    pub(super) forward: Vec<(usize, u32, Span)>,
    mesh_of: HashMap<(String, Option<usize>), usize>,
    material_of: HashMap<String, usize>,
    object: String,
    material: Option<usize>,
    /// The mesh of the current object and material, once it has a face.
    mesh: Option<usize>,
}

impl Parser<'_> {
    fn file(&mut self) {
        let start = if self.source.bytes().starts_with(b"\xEF\xBB\xBF") { 3 } else { 0 };
        for mut line in Lines::with_continuations(self.source, start) {
            if self.sink.is_full() || self.corners.len() > MAX_CORNERS {
                break;
            }
            if let Some(word) = line.word() {
                self.statement(&mut line, word);
            }
        }
        self.check_forward();
        if self.sink.is_ok() {
            self.triangulate();
        }
    }

    fn statement(&mut self, line: &mut Line, word: Span) {
        match self.source.slice(word) {
            b"v" => {
                // A stand-in for a bad vertex keeps the numbers of those behind it.
                let p = self.numbers_or(line, word, 3).map_err(|error| self.sink.error(*error));
                self.tree.positions.push(p.unwrap_or_default());
            }
            b"vt" => {
                let uv = self.soft_numbers(line, word, 1).unwrap_or_default();
                self.tree.uvs.push([uv[0], uv[1]]);
            }
            b"vn" => {
                let n = self.soft_numbers(line, word, 3).unwrap_or_default();
                self.tree.normals.push(n);
            }
            b"f" | b"fo" => self.face(line, word),
            b"o" | b"g" => {
                let name = line.rest();
                self.object = self.source.text(name);
                self.mesh = None;
            }
            b"usemtl" => self.use_material(line, word),
            b"mtllib" => {
                let span = line.rest();
                self.tree.libraries.push(Library { names: self.source.text(span), span });
            }
            _ => self.other(word),
        }
    }

    fn other(&mut self, word: Span) {
        let (source, text) = (self.source, self.source.text(word));
        let is = |list: &[&str]| list.contains(&text.as_str());
        if is(&SILENT) {
            return;
        }
        if is(&SHAPELESS) {
            self.sink.warn("obj::no-surface", || {
                let message = format!("`{text}`: lines, points and free-form shapes are not read");
                Diagnostic::warning("obj::no-surface", message).at(source, word, "skipped")
            });
        } else {
            self.sink.warn("obj::unknown-keyword", || {
                Diagnostic::warning("obj::unknown-keyword", format!("unknown keyword `{}`", shortened(&text)))
                    .at(source, word, "the line is skipped")
                    .one_of(&text, KEYWORDS)
            });
        }
    }

    /// As `numbers_or`, but a fault is a warning: a mesh without that normal or texture coordinate can still be drawn.
    fn soft_numbers(&mut self, line: &mut Line, word: Span, wanted: usize) -> Option<[f32; 3]> {
        let error = match self.numbers_or(line, word, wanted) {
            Ok(numbers) => return Some(numbers),
            Err(error) => error,
        };
        self.sink.warn("obj::bad-attribute", || {
            let severity = crate::diagnostic::Severity::Warning;
            let warning = Diagnostic { severity, code: "obj::bad-attribute", ..*error };
            warning.help("faces that use this line are drawn without it")
        });
        None
    }

    /// `wanted` finite numbers of three, the others 0. What follows them (weights, colours) is not read.
    fn numbers_or(&self, line: &mut Line, word: Span, wanted: usize) -> Result<[f32; 3], Box<Diagnostic>> {
        let mut numbers = [0.0; 3];
        let mut last = word;
        for (i, number) in numbers.iter_mut().enumerate() {
            match line.number() {
                Some(span) => {
                    *number = finite(self.source, span, "obj::bad-number")?;
                    last = span;
                }
                None if i < wanted => {
                    let message = format!("`{}` needs {wanted} numbers, found {i}", self.source.text(word));
                    let error = Diagnostic::error("obj::missing-number", message);
                    return Err(Box::new(error.at(self.source, last.after(), "a number is missing here")));
                }
                None => break,
            }
        }
        Ok(numbers)
    }

    fn use_material(&mut self, line: &mut Line, word: Span) {
        let span = line.rest();
        let name = self.source.text(span);
        let source = self.source;
        self.mesh = None;
        if name.is_empty() {
            self.material = None;
            return self.sink.warn("obj::no-name", || {
                Diagnostic::warning("obj::no-name", "`usemtl` without a name").at(source, word, "no material")
            });
        }
        let names = &mut self.tree.material_names;
        self.material = Some(*self.material_of.entry(name).or_insert_with_key(|name| {
            names.push((name.clone(), span));
            names.len() - 1
        }));
    }

    /// The mesh that the next face belongs to.
    pub(super) fn current_mesh(&mut self) -> usize {
        if let Some(mesh) = self.mesh {
            return mesh;
        }
        let meshes = &mut self.tree.meshes;
        let mesh =
            *self.mesh_of.entry((self.object.clone(), self.material)).or_insert_with_key(|(object, material)| {
                meshes.push(ObjMesh { object: object.clone(), material: *material, triangles: Vec::new() });
                meshes.len() - 1
            });
        self.mesh = Some(mesh);
        mesh
    }

    /// Faces to triangles, now that all positions are known.
    fn triangulate(&mut self) {
        let mut triangulator = Triangulator::new(&self.tree.positions);
        for face in &self.faces {
            let corners = &self.corners[face.first..face.first + face.count];
            triangulator.triangulate(corners, &mut self.tree.meshes[face.mesh].triangles);
        }
        if triangulator.is_exhausted() {
            let source = self.source;
            self.sink.warn("obj::polygons", || {
                Diagnostic::warning("obj::polygons", "the polygons are too many and too large to cut with care")
                    .in_file(source.name())
                    .help("the last of them were cut into fans, which is wrong where they are not convex")
            });
        }
    }
}
