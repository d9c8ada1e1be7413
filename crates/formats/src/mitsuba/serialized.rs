//! Mitsuba's own files of meshes, `.serialized`: several meshes, each packed by zlib, and a table of where they begin.
//!
//! All numbers are little-endian. A file is a mesh after the other, then the table, then the number of meshes (32 bits);
//! each mesh is `0x041C`, the version, and a packed stream of flags, name (version 4), counts, arrays (Jakob 2014,
//! "Mitsuba Documentation", section 8.1.7).

use crate::ply::PlyMesh;
use crate::tessellate::valid;
use flate2::read::ZlibDecoder;
use std::io::Read;

const MAGIC: u16 = 0x041C;
const HAS_NORMALS: u32 = 0x1;
const HAS_UVS: u32 = 0x2;
const HAS_COLOURS: u32 = 0x8;
const FACE_NORMALS: u32 = 0x10;
const IS_DOUBLE: u32 = 0x2000;

/// A mesh may unpack to this much whatever its size,
const SMALL: u64 = 1 << 26;
/// and beyond that to so many times its own, but never to more than the last one.
const MAX_RATIO: u64 = 1000;
const LARGEST: u64 = 1 << 30;

/// The mesh of that number, and whether it asks for the normals of its faces.
///
/// # Errors
/// What is wrong with the file.
pub(super) fn mesh(file: &[u8], index: usize) -> Result<(PlyMesh, bool), String> {
    let head = |at: usize| Some((u16_at(file, at)?, u16_at(file, at.checked_add(2)?)?));
    let version = match head(0) {
        Some((MAGIC, version @ (3 | 4))) => version,
        Some((MAGIC, version)) => return Err(format!("meshes of version {version} are not supported, only 3 and 4")),
        _ => return Err("this is no file of serialized meshes".to_owned()),
    };
    let start = if index == 0 { 0 } else { offset(file, version, index)? };
    let Some((MAGIC, _)) = head(start) else { return Err(format!("mesh {index} does not begin where the table says")) };
    let packed = file.get(start + 4..).unwrap_or_default();
    let limit = (packed.len() as u64 * MAX_RATIO).clamp(SMALL, LARGEST);
    let mut bytes = Vec::new();
    let unpacked = ZlibDecoder::new(packed).take(limit + 1).read_to_end(&mut bytes);
    unpacked.map_err(|e| format!("cannot unpack mesh {index}: {e}"))?;
    if bytes.len() as u64 > limit {
        return Err(format!("mesh {index} unpacks to more than {} MiB", limit >> 20));
    }
    let read = Stream { bytes: &bytes, at: 0 }.mesh(version);
    read.ok_or_else(|| format!("mesh {index} ends too early"))
}

/// Where a mesh begins, by the table at the end of the file.
fn offset(file: &[u8], version: u16, index: usize) -> Result<usize, String> {
    let end = file.len().checked_sub(4).ok_or("the file ends too early")?;
    let count = u32_at(file, end).unwrap_or(0) as usize;
    if index >= count {
        return Err(format!("there is no mesh {index}: the file has {count}, counted from 0"));
    }
    let width = if version == 4 { 8 } else { 4 };
    let at = end.checked_sub(width * (count - index)).ok_or("the file ends too early")?;
    let offset = if version == 4 { u64_at(file, at) } else { u32_at(file, at).map(u64::from) };
    Ok(offset.unwrap_or(u64::MAX).min(file.len() as u64) as usize)
}

fn array<const N: usize>(bytes: &[u8], at: usize) -> Option<[u8; N]> {
    bytes.get(at..at.checked_add(N)?)?.try_into().ok()
}

fn u16_at(bytes: &[u8], at: usize) -> Option<u16> {
    array(bytes, at).map(u16::from_le_bytes)
}

fn u32_at(bytes: &[u8], at: usize) -> Option<u32> {
    array(bytes, at).map(u32::from_le_bytes)
}

fn u64_at(bytes: &[u8], at: usize) -> Option<u64> {
    array(bytes, at).map(u64::from_le_bytes)
}

/// An unpacked mesh.
struct Stream<'b> {
    bytes: &'b [u8],
    at: usize,
}

impl Stream<'_> {
    /// `None` if it ends too early.
    fn mesh(&mut self, version: u16) -> Option<(PlyMesh, bool)> {
        let flags = u32_at(self.bytes, self.at)?;
        self.at += 4;
        if version == 4 {
            let name = self.bytes.get(self.at..)?.iter().position(|b| *b == 0)?;
            self.at += name + 1;
        }
        let vertices = usize::try_from(u64_at(self.bytes, self.at)?).ok()?;
        let faces = usize::try_from(u64_at(self.bytes, self.at + 8)?).ok()?;
        self.at += 16;
        let is_double = flags & IS_DOUBLE != 0;
        let positions = self.tuples::<3>(vertices, is_double)?;
        let normals = if flags & HAS_NORMALS != 0 { self.tuples::<3>(vertices, is_double)? } else { Vec::new() };
        let uvs = if flags & HAS_UVS != 0 { self.tuples::<2>(vertices, is_double)? } else { Vec::new() };
        if flags & HAS_COLOURS != 0 {
            self.skip(vertices.checked_mul(3 * if is_double { 8 } else { 4 })?)?;
        }
        let corners = self.skip(faces.checked_mul(12)?)?;
        let all = corners.chunks_exact(12).map(|t| [0, 4, 8].map(|at| u32_at(t, at).unwrap_or(u32::MAX)));
        let (triangles, bad_faces) = valid(all, vertices);
        Some((
            PlyMesh { positions, normals, uvs, triangles, bad_faces, ..PlyMesh::default() },
            flags & FACE_NORMALS != 0,
        ))
    }

    /// The next bytes, if there are so many.
    fn skip(&mut self, count: usize) -> Option<&[u8]> {
        let bytes = self.bytes.get(self.at..self.at.checked_add(count)?)?;
        self.at += count;
        Some(bytes)
    }

    fn tuples<const N: usize>(&mut self, count: usize, is_double: bool) -> Option<Vec<[f32; N]>> {
        let width = if is_double { 8 } else { 4 };
        let bytes = self.skip(count.checked_mul(N * width)?)?;
        let number = |at: usize| {
            if is_double {
                f64::from_bits(u64_at(bytes, at).unwrap_or(0)) as f32
            } else {
                f32::from_bits(u32_at(bytes, at).unwrap_or(0))
            }
        };
        Some((0..count).map(|i| std::array::from_fn(|k| number((i * N + k) * width))).collect())
    }
}

#[cfg(test)]
pub(super) mod tests {
    use super::*;
    use flate2::{Compression, write::ZlibEncoder};
    use std::io::Write;

    /// A file of triangles, the `i`-th one at z = i.
    pub(in crate::mitsuba) fn file(version: u16, count: u32, is_double: bool) -> Vec<u8> {
        let mut file = Vec::new();
        let mut table = Vec::new();
        for i in 0..count {
            table.push(file.len() as u64);
            file.extend(MAGIC.to_le_bytes());
            file.extend(version.to_le_bytes());
            let mut bytes = Vec::new();
            bytes.extend((HAS_UVS | if is_double { IS_DOUBLE } else { 0x1000 }).to_le_bytes());
            if version == 4 {
                bytes.extend(b"name\0");
            }
            bytes.extend(3_u64.to_le_bytes());
            bytes.extend(1_u64.to_le_bytes());
            let z = f64::from(i);
            for x in [0.0, 0.0, z, 1.0, 0.0, z, 0.0, 1.0, z, 0.0, 0.0, 1.0, 0.0, 0.0, 1.0] {
                if is_double { bytes.extend(x.to_le_bytes()) } else { bytes.extend((x as f32).to_le_bytes()) }
            }
            for corner in [0_u32, 1, 2] {
                bytes.extend(corner.to_le_bytes());
            }
            let mut packer = ZlibEncoder::new(&mut file, Compression::fast());
            packer.write_all(&bytes).unwrap();
            packer.finish().unwrap();
        }
        for offset in table {
            if version == 4 { file.extend(offset.to_le_bytes()) } else { file.extend((offset as u32).to_le_bytes()) }
        }
        file.extend(count.to_le_bytes());
        file
    }

    #[test]
    fn each_mesh_of_both_versions_and_precisions_is_found() {
        for (version, is_double) in [(3, false), (4, false), (4, true)] {
            let file = file(version, 3, is_double);
            for i in 0..3 {
                let (mesh, _) = mesh(&file, i).unwrap();
                assert_eq!((mesh.positions[1], mesh.triangles.len()), ([1.0, 0.0, i as f32], 1));
                assert_eq!(mesh.uvs[1], [1.0, 0.0]);
            }
            assert!(mesh(&file, 3).unwrap_err().contains("the file has 3"));
        }
    }

    #[test]
    fn damaged_files_are_refused() {
        let good = file(4, 2, false);
        for end in 0..good.len() - 1 {
            for index in [0, 1, 7] {
                // What is cut off the end may leave the first mesh whole.
                drop(mesh(&good[..end], index));
            }
        }
        assert!(mesh(&good[..20], 0).is_err());
        for i in 0..good.len() {
            let mut bad = good.clone();
            bad[i] ^= 0x55;
            drop((mesh(&bad, 0), mesh(&bad, 1)));
        }
        assert!(mesh(b"PK", 0).is_err());
    }
}
