//! Files in memory, whole and damaged.

use super::{PlyMesh, parse, shape};
use crate::diagnostic::{Sink, SourceFile};
use insta::assert_snapshot;
use proptest::prelude::*;

const CUBE_FACE: &str = "ply\nformat ascii 1.0\ncomment a square\nelement vertex 4\nproperty float x\nproperty float y\n\
    property float z\nproperty uchar red\nproperty float s\nproperty float t\nelement face 1\n\
    property list uchar uint vertex_indices\nend_header\n\
    0 0 0 9 0 0\n1 0 0 9 1 0\n1 1 0 9 1 1\n0 1 0 9 0 1\n4 0 1 2 3\n";

fn read(bytes: &[u8]) -> (PlyMesh, String) {
    let source = SourceFile::from_bytes("a.ply", bytes);
    let mut sink = Sink::default();
    let mesh = parse(&source, &mut sink);
    let all = match sink.finish(()) {
        Ok(()) => sink.take_warnings(),
        Err(error) => error.errors,
    };
    (mesh, all.iter().map(ToString::to_string).collect::<Vec<_>>().join("\n\n"))
}

/// The square in binary; `end` is what ends the lines of the header.
fn binary(big: bool, end: &str) -> Vec<u8> {
    let format = if big { "binary_big_endian" } else { "binary_little_endian" };
    let header = format!(
        "ply\nformat {format} 1.0\nelement face 1\nproperty list uchar int vertex_index\nelement junk 2\n\
         property list ushort double a\nelement vertex 4\nproperty double x\nproperty float y\nproperty short z\n\
         property float nx\nproperty float ny\nproperty float nz\nend_header\n"
    );
    let mut bytes = header.replace('\n', end).into_bytes();
    let mut put = |mut value: Vec<u8>| {
        if big {
            value.reverse();
        }
        bytes.extend(value);
    };
    put(vec![4]);
    [0_i32, 1, 2, 3].into_iter().for_each(|i| put(i.to_le_bytes().to_vec()));
    for length in [1_u16, 2] {
        put(length.to_le_bytes().to_vec());
        (0..length).for_each(|_| put(7.0_f64.to_le_bytes().to_vec()));
    }
    for [x, y] in [[0_u8, 0], [1, 0], [1, 1], [0, 1]] {
        put(f64::from(x).to_le_bytes().to_vec());
        put(f32::from(y).to_le_bytes().to_vec());
        put(10_i16.to_le_bytes().to_vec());
        [0.0_f32, 0.0, 1.0].into_iter().for_each(|n| put(n.to_le_bytes().to_vec()));
    }
    bytes
}

#[test]
fn a_quad_becomes_two_triangles_with_texture_coordinates() {
    let (mesh, told) = read(CUBE_FACE.as_bytes());
    assert_eq!(told, "");
    assert_eq!(mesh.triangles, [[0, 1, 2], [0, 2, 3]]);
    assert_eq!(mesh.uvs, [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]]);
    assert!(mesh.normals.is_empty());
}

#[test]
fn both_byte_orders_and_all_line_ends_give_the_same_mesh() {
    let (mesh, _) = read(&binary(false, "\n"));
    assert_eq!(mesh.positions, [[0.0, 0.0, 10.0], [1.0, 0.0, 10.0], [1.0, 1.0, 10.0], [0.0, 1.0, 10.0]]);
    assert_eq!(mesh.normals, [[0.0, 0.0, 1.0]; 4]);
    assert_eq!(mesh.triangles.len(), 2);
    for (big, end) in [(true, "\n"), (false, "\r\n"), (true, "\r\n"), (false, "\r")] {
        assert_eq!(read(&binary(big, end)), (mesh.clone(), String::new()), "{big} {end:?}");
    }
}

#[test]
fn counts_without_bytes_behind_them_reserve_no_memory() {
    for count in ["4000000000", "18446744073709551615"] {
        let text =
            CUBE_FACE.replace("vertex 4", &format!("vertex {count}")).replace("face 1", &format!("face {count}"));
        assert!(read(text.as_bytes()).1.contains("the file ends before vertex"));
    }
    // Nothing to read for each of them: no time either.
    let empty = "ply\nformat ascii 1.0\nelement nothing 18446744073709551615\nend_header\n";
    assert_eq!(read(empty.as_bytes()), (PlyMesh::default(), String::new()));
    let mut long = binary(false, "\n");
    let at = long.windows(10).position(|w| w == b"end_header").unwrap() + 11;
    long[at] = 255;
    assert!(read(&long).1.contains("error"));
}

#[test]
fn faces_that_show_nothing_are_counted_and_left_out() {
    let text = CUBE_FACE.replace("face 1", "face 4") + "3 0 0 1\n3 0 1 9\n2 0 1\n";
    let (mesh, _) = read(text.as_bytes());
    let mut sink = Sink::default();
    assert!(shape(&mesh, "a.ply", &mut sink).is_some());
    let told: Vec<String> = sink.take_warnings().into_iter().map(|w| w.message).collect();
    assert_eq!(told, ["1 of 4 faces have no area", "1 of 4 faces refer to vertices that do not exist"]);
}

#[test]
fn mistakes_are_told_with_their_places() {
    let cases = [
        "solid\n".to_owned(),
        CUBE_FACE.replace("ascii", "asci"),
        CUBE_FACE.replace("uchar red", "uchra red"),
        CUBE_FACE.replace("vertex 4", "vertex four"),
        CUBE_FACE.replace("comment", "remark").replace("1 1 0 9", "1 one 0 9"),
        CUBE_FACE.replace("property float z\n", ""),
        CUBE_FACE.replace("4 0 1 2 3\n", ""),
        CUBE_FACE.replace("4 0 1 2 3\n", "-1 0"),
        "ply\nformat ascii 1.0\n".to_owned(),
        "ply\nproperty int x\n".to_owned(),
    ];
    let told: Vec<String> = cases.iter().map(|c| read(c.as_bytes()).1).collect();
    assert_snapshot!(told.join("\n\n"));
}

proptest! {
    #[test]
    fn no_damage_makes_the_reader_panic(
        which in 0..3,
        damage in proptest::collection::vec((any::<prop::sample::Index>(), any::<u8>()), 1..8),
        cut in any::<prop::sample::Index>(),
    ) {
        let mut bytes = match which {
            0 => CUBE_FACE.as_bytes().to_vec(),
            n => binary(n == 1, "\n"),
        };
        for (at, value) in damage {
            let i = at.index(bytes.len());
            bytes[i] = value;
        }
        bytes.truncate(cut.index(bytes.len() * 4).max(bytes.len() / 2));
        let (mesh, _) = read(&bytes);
        prop_assert!(mesh.triangles.iter().flatten().all(|i| (*i as usize) < mesh.positions.len()));
    }
}
