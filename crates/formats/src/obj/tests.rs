//! Each odd input with what becomes of it; the expected texts lie in `snapshots/`.

use super::{ObjFile, parse, parse_mtl, read_libraries};
use crate::diagnostic::{Diagnostic, Error, Sink, SourceFile};
use proptest::prelude::*;

const SQUARE: &str = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n";

fn read(text: impl AsRef<[u8]>) -> (ObjFile, Result<(), Error>, Vec<Diagnostic>) {
    let mut sink = Sink::default();
    let tree = parse(&SourceFile::from_bytes("test.obj", text.as_ref()), &mut sink);
    let result = sink.finish(());
    (tree, result, sink.take_warnings())
}

fn good(text: impl AsRef<[u8]>) -> ObjFile {
    let (tree, result, warnings) = read(text);
    assert!(result.is_ok() && warnings.is_empty(), "{result:?} {warnings:?}");
    tree
}

fn told(result: Result<(), Error>, warnings: &[Diagnostic]) -> String {
    let (errors, earlier) = result.map_or_else(|e| (e.errors, e.warnings), |()| (Vec::new(), Vec::new()));
    let texts: Vec<String> = errors.iter().chain(&earlier).chain(warnings).map(Diagnostic::to_string).collect();
    texts.join("\n\n")
}

/// The sum of the triangles' areas, and of their signed areas as seen from +z.
fn areas(tree: &ObjFile) -> (f32, f32) {
    let point = |i: u32| glam::Vec3::from_array(tree.positions[i as usize]);
    let mut sums = (0.0, 0.0);
    for [a, b, c] in tree.meshes.iter().flat_map(|m| &m.triangles) {
        let cross = (point(b.position) - point(a.position)).cross(point(c.position) - point(a.position));
        sums.0 += 0.5 * cross.length();
        sums.1 += 0.5 * cross.z;
    }
    sums
}

#[test]
fn a_square_becomes_two_triangles_of_its_area() {
    let tree = good(format!("{SQUARE}f 1 2 3 4\n"));
    assert_eq!(tree.triangle_count(), 2);
    assert_eq!(areas(&tree), (1.0, 1.0));
}

#[test]
fn a_concave_polygon_is_cut_inside_of_itself() {
    // An L of area 3, in both orientations and starting at every corner.
    let corners = ["0 0 0", "2 0 0", "2 1 0", "1 1 0", "1 2 0", "0 2 0"];
    let vertices = corners.map(|c| format!("v {c}\n")).concat();
    for start in 0..6 {
        let mut order: Vec<String> = (0..6).map(|i| (1 + (start + i) % 6).to_string()).collect();
        let tree = good(format!("{vertices}f {}\n", order.join(" ")));
        assert_eq!((tree.triangle_count(), areas(&tree)), (4, (3.0, 3.0)));
        order.reverse();
        let tree = good(format!("{vertices}f {}\n", order.join(" ")));
        assert_eq!((tree.triangle_count(), areas(&tree)), (4, (3.0, -3.0)));
    }
}

#[test]
fn a_polygon_of_many_corners_ends_in_time() {
    // A comb: every second corner is reflex, so that most corners are no ears.
    let n = 20_000;
    let height = |i| if i % 2 == 0 { 0 } else { 1000 + i % 7 };
    let vertices = (0..n).map(|i| format!("v {i} {} 0\n", height(i))).collect::<Vec<_>>().concat();
    let face: Vec<String> = (1..=n).map(|i| i.to_string()).collect();
    let (tree, result, _) = read(format!("{vertices}v {n} -5 0\nv 0 -5 0\nf {} {} {}\n", face.join(" "), n + 1, n + 2));
    assert!(result.is_ok());
    assert_eq!(tree.triangle_count(), n);
}

#[test]
fn every_form_of_a_corner_is_read() {
    let tree = good(format!("{SQUARE}vt 0 0\nvt 1 0 0\nvn 0 0 1\nf 1 2/2 3//1 4/1/1\nf -4/-2/-1 -3/ -2//\n"));
    let triangles = &tree.meshes[0].triangles;
    let all = |corner: super::Corner| (corner.position, corner.uv(), corner.normal());
    assert_eq!(triangles[0].map(all), [(0, None, None), (1, Some(1), None), (2, None, Some(0))]);
    assert_eq!(all(triangles[1][2]), (3, Some(0), Some(0)));
    assert_eq!(triangles[2].map(all), [(0, Some(0), Some(0)), (1, None, None), (2, None, None)]);
}

#[test]
fn a_face_may_stand_before_its_vertices() {
    assert_eq!(good(format!("f 1 2 3\n{SQUARE}")).triangle_count(), 1);
}

#[test]
fn a_material_covers_the_faces_behind_it() {
    let tree = good(format!(
        "{SQUARE}f 1 2 3\nusemtl A\nf 1 2 3\nf 1 2 4\no second one\nf 1 2 3\nusemtl B 2 # three\nf 1 2 3\nusemtl A\nf 2 3 4\n"
    ));
    let meshes: Vec<_> = tree.meshes.iter().map(|m| (m.object.as_str(), m.material, m.triangles.len())).collect();
    assert_eq!(meshes, [("", None, 1), ("", Some(0), 2), ("second one", Some(0), 2), ("second one", Some(1), 1)]);
    assert_eq!(tree.material_names[1].0, "B 2 # three");
}

#[test]
fn lines_may_be_continued_and_may_end_in_any_way() {
    let tree = good(b"v 0 0 \\\n 0\r\nv 1 0 0 0.5 nan 1\rv 0 1\\\r\n 0\nf 1 2\\\n 3");
    assert_eq!(tree.positions, [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]]);
    assert_eq!(tree.triangle_count(), 1);
}

/// (name of the snapshot, input)
const ODD: [(&str, &str); 12] = [
    ("index_zero", "v 0 0 0\nf 0 1 1\n"),
    ("index_too_large", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 4\n"),
    ("index_too_negative", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf -1 -2 -4\n"),
    ("no_normals", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1//1 2//1 3//1\n"),
    ("index_not_a_number", "v 0 0 0\nf 1 one 1\n"),
    ("too_many_parts", "v 0 0 0\nf 1/1/1/1 1 1\n"),
    ("huge_index", "v 0 0 0\nf 1 99999999999999999999 1\n"),
    ("few_corners", "v 0 0 0\nf\nf 1 1\n"),
    ("bad_vertex", "v 0 0\nv 0 nan 0\nv 0 3.1+e2 0\n"),
    ("bad_normal", "v 0 0 0\nvn 0 0 nan\nf 1//1 1//1 1//1\n"),
    ("lines_and_points", "v 0 0 0\nl 1 1\np 1\n"),
    ("unknown_keyword", "vertex 0 0 0\nusemtl\n"),
];

#[test]
fn every_odd_input_gets_a_message_with_its_place() {
    for (name, input) in ODD {
        let (_, result, warnings) = read(input);
        let text = told(result, &warnings);
        assert!(text.contains("test.obj:"), "{name}: no place in\n{text}");
        insta::assert_snapshot!(name, format!("{input}\n----\n{text}"));
    }
}

#[test]
fn a_library_gives_its_materials() {
    let mut sink = Sink::default();
    let text = "newmtl Hard White\nKd 0.5\nKS 0.1 0.2 0.3\nNs 20\nTr 0.25\nNi 1.5\nillum 7\n\
                map_Kd -s 2 2 -bm 0.5 textures\\wood grain.png\nnewmtl B\nd 0.5\nKe 1 2 3 # bright\n";
    let all = parse_mtl(&SourceFile::from_bytes("test.mtl", text), &mut sink);
    assert!(sink.take_warnings().is_empty());
    assert_eq!(
        (all[0].name.as_str(), all[0].diffuse, all[0].specular),
        ("Hard White", Some([0.5; 3]), Some([0.1, 0.2, 0.3]))
    );
    assert_eq!((all[0].opacity, all[0].ior, all[0].model), (Some(0.75), Some(1.5), Some(7)));
    assert_eq!(all[0].diffuse_map.as_deref(), Some("textures/wood grain.png"));
    assert_eq!((all[1].opacity, all[1].emission), (Some(0.5), Some([1.0, 2.0, 3.0])));
}

#[test]
fn odd_libraries_get_a_message_with_its_place() {
    let text = "Kd 1 1 1\nnewmtl A\nKd\nKs 1 x 1\nKd spectral a.rfl\nmap_Bump b.png\nKdd 1 1 1\n";
    let mut sink = Sink::default();
    parse_mtl(&SourceFile::from_bytes("test.mtl", text), &mut sink);
    let result = sink.finish(());
    insta::assert_snapshot!("library", told(result, &sink.take_warnings()));
}

#[test]
fn missing_libraries_and_materials_are_warnings() {
    let folder = tempfile::tempdir().unwrap();
    std::fs::write(folder.path().join("my materials.mtl"), "newmtl White\n").unwrap();
    std::fs::write(folder.path().join("boxes.mtl"), "newmtl Red\n").unwrap();
    let text =
        format!("mtllib my materials.mtl\nmtllib box.mtl\n{SQUARE}usemtl Whit\nf 1 2 3\nusemtl White\nf 1 2 3\n");
    let source = SourceFile::from_bytes("test.obj", text);
    let mut sink = Sink::default();
    let mut tree = parse(&source, &mut sink);
    let files = read_libraries(&mut tree, &source, folder.path(), &mut sink);
    assert_eq!((files.len(), tree.material_by_name().len()), (1, 1));
    let text = told(sink.finish(()), &sink.take_warnings());
    insta::assert_snapshot!("missing_library", text.replace(&folder.path().display().to_string(), "FOLDER"));
}

const SAMPLE: &str = "# box\nmtllib a.mtl\no box\nv -0.5 0 1e-3\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv .5 .5 1\nvt 0 0\nvt 1 0\n\
                      vn 0 0 1\ng side\nusemtl red one\ns 1\nf 1/1/1 2/2/1 3//1 4\nf -1 -2 \\\n -3\nl 1 2\nf 5 4 3 2 1\n";

const MTL_SAMPLE: &str =
    "newmtl A\nKd 0.5 0.5 0.5\nNs 10\nd -halo 0.5\nillum 2\nmap_Kd -s 1 1 1 a b.png\nnewmtl B\nKe 1\n";

/// `text` with a few bytes changed, cut, or repeated.
fn mutated(text: &'static str) -> impl Strategy<Value = Vec<u8>> {
    let edit = (0..text.len(), 0..text.len(), any::<u8>(), 0..4_u8);
    proptest::collection::vec(edit, 1..12).prop_map(move |edits| {
        let mut bytes = text.as_bytes().to_vec();
        for (at, other, byte, kind) in edits {
            let (at, other) = (at % bytes.len().max(1), other % bytes.len().max(1));
            match kind {
                0 if !bytes.is_empty() => bytes[at] = byte,
                1 => bytes.insert(at, byte),
                2 => drop(bytes.drain(at.min(other)..at.max(other))),
                _ => {
                    let copy = bytes[at.min(other)..at.max(other)].to_vec();
                    bytes.splice(at..at, copy);
                }
            }
        }
        bytes
    })
}

proptest! {
    #[test]
    fn no_mutation_of_a_good_file_makes_the_parser_panic(bytes in mutated(SAMPLE)) {
        let (tree, result, warnings) = read(&bytes);
        if result.is_ok() {
            for corner in tree.meshes.iter().flat_map(|m| &m.triangles).flatten() {
                prop_assert!((corner.position as usize) < tree.positions.len());
                prop_assert!(corner.uv().is_none_or(|i| (i as usize) < tree.uvs.len()));
                prop_assert!(corner.normal().is_none_or(|i| (i as usize) < tree.normals.len()));
            }
        }
        told(result, &warnings);
    }

    #[test]
    fn no_mutation_of_a_good_library_makes_the_parser_panic(bytes in mutated(MTL_SAMPLE)) {
        let mut sink = Sink::default();
        parse_mtl(&SourceFile::from_bytes("test.mtl", bytes), &mut sink);
        let result = sink.finish(());
        told(result, &sink.take_warnings());
    }
}
