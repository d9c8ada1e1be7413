//! Surfaces that emit by a picture: pieces of them, each with the mean of what the picture shows there.
//!
//! A light has one radiance here, so triangles are cut until a piece sees little change of the picture, or is small; pieces
//! of nearly the same colour become one light. What they send out together is what the picture would.

use super::geometry::Geometry;
use crate::ply::PlyMesh;
use glam::{Affine2, Vec2, Vec3, Vec4};
use std::collections::BTreeMap;
use sunfleck::texture::ImageTexture;

/// Times that a triangle is cut into four at most,
const MAX_CUTS: u32 = 5;
/// and pieces of a primitive.
const MAX_PIECES: usize = 1 << 14;
/// Steps of brightness in which pieces are told apart, over the square root of the value.
const STEPS: f32 = 12.0;
/// Change of brightness that needs no cut.
const EVEN: f32 = 0.04;

/// Triangles of about the same colour: the sum of their colours, weighed by area, and that of their areas.
type Level = (Vec3, f32, Vec<[u32; 3]>);

/// The pieces of any mesh, by what they emit, where `picture` lies as it is and its `v` grows downwards.
pub(crate) fn pieces(mesh: PlyMesh, picture: &ImageTexture) -> Vec<(Vec3, PlyMesh)> {
    let uvs = mesh.uvs.iter().map(|uv| Vec2::from_array(*uv)).collect();
    let geometry = Geometry {
        positions: mesh.positions.iter().map(|p| Vec3::from_array(*p)).collect(),
        normals: mesh.normals.iter().map(|n| Vec3::from_array(*n)).collect(),
        uvs: [uvs, Vec::new()],
        triangles: mesh.triangles,
        ..Geometry::default()
    };
    let back = |g: Geometry| PlyMesh {
        positions: g.positions.iter().map(Vec3::to_array).collect(),
        normals: g.normals.iter().map(Vec3::to_array).collect(),
        uvs: g.uvs[0].iter().map(Vec2::to_array).collect(),
        triangles: g.triangles,
        ..PlyMesh::default()
    };
    let glow = Glow { picture, map: Affine2::IDENTITY, set: 0 };
    glow.pieces(geometry).into_iter().map(|(radiance, piece)| (radiance, back(piece))).collect()
}

/// A picture, and the way from the file's texture coordinates to its own.
pub(super) struct Glow<'p> {
    pub(super) picture: &'p ImageTexture,
    /// For coordinates whose `v` grows upwards.
    pub(super) map: Affine2,
    pub(super) set: usize,
}

impl Glow<'_> {
    fn at(&self, uv: Vec2) -> Vec3 {
        let up = Vec2::new(uv.x, 1.0 - uv.y);
        self.picture.eval(self.map.transform_point2(up)).max(Vec3::ZERO)
    }

    /// Mean and largest difference of brightness over a triangle.
    fn seen(&self, corners: [Vec2; 3]) -> (Vec3, f32) {
        const N: usize = 8;
        let [a, b, c] = corners;
        let (mut sum, mut count, mut low, mut high) = (Vec3::ZERO, 0.0, f32::INFINITY, 0.0_f32);
        for i in 0..N {
            for j in 0..N - i {
                let (u, v) = ((i as f32 + 1.0 / 3.0) / N as f32, (j as f32 + 1.0 / 3.0) / N as f32);
                let value = self.at(a + u * (b - a) + v * (c - a));
                sum += value;
                count += 1.0;
                let bright = value.max_element().sqrt();
                (low, high) = (low.min(bright), high.max(bright));
            }
        }
        (sum / count, high - low)
    }

    /// The pieces of a mesh, by what they emit; those that emit nothing come with black.
    pub(super) fn pieces(&self, geometry: Geometry) -> Vec<(Vec3, Geometry)> {
        if geometry.uvs.get(self.set).is_none_or(Vec::is_empty) {
            return vec![(self.at(Vec2::ZERO), geometry)];
        }
        let mut whole = geometry;
        let mut left: Vec<([u32; 3], u32)> = std::mem::take(&mut whole.triangles).into_iter().map(|t| (t, 0)).collect();
        let budget = MAX_PIECES.max(2 * left.len());
        let mut done: BTreeMap<[u8; 3], Level> = BTreeMap::new();
        let mut pieces = left.len();
        while let Some((t, cuts)) = left.pop() {
            let (mean, change) = self.seen(t.map(|i| whole.uvs[self.set][i as usize]));
            if change > EVEN && cuts < MAX_CUTS && pieces + 3 <= budget {
                pieces += 3;
                left.extend(whole.cut(t).map(|piece| (piece, cuts + 1)));
                continue;
            }
            let level = |v: f32| if v > 0.0 { (v.sqrt() * STEPS).ceil().min(255.0) as u8 } else { 0 };
            let [a, b, c] = t.map(|i| whole.positions[i as usize]);
            let area = (b - a).cross(c - a).length();
            let (sum, total, triangles) = done.entry(mean.to_array().map(level)).or_default();
            *sum += area * mean;
            *total += area;
            triangles.push(t);
        }
        let mut new = vec![u32::MAX; whole.positions.len()];
        let piece = |(sum, total, triangles): Level| {
            let mean = if total > 0.0 { sum / total } else { Vec3::ZERO };
            (mean, whole.part(triangles, &mut new))
        };
        done.into_values().map(piece).collect()
    }
}

impl Geometry {
    /// Cuts a triangle at the middles of its sides into four.
    fn cut(&mut self, [a, b, c]: [u32; 3]) -> [[u32; 3]; 4] {
        let (ab, bc, ca) = (self.middle(a, b), self.middle(b, c), self.middle(c, a));
        [[a, ab, ca], [ab, b, bc], [ca, bc, c], [ab, bc, ca]]
    }

    fn middle(&mut self, a: u32, b: u32) -> u32 {
        let new = self.positions.len() as u32;
        let (a, b) = (a as usize, b as usize);
        halve(&mut self.positions, a, b, |x: Vec3, y| 0.5 * (x + y));
        halve(&mut self.normals, a, b, |x: Vec3, y| 0.5 * (x + y));
        halve(&mut self.tangents, a, b, |x: Vec4, y| (0.5 * (x + y).truncate()).extend(x.w));
        halve(&mut self.colours, a, b, |x: Vec4, y| 0.5 * (x + y));
        self.uvs.iter_mut().for_each(|uvs| halve(uvs, a, b, |x: Vec2, y| 0.5 * (x + y)));
        new
    }
}

fn halve<T: Copy>(list: &mut Vec<T>, a: usize, b: usize, mean: impl Fn(T, T) -> T) {
    if !list.is_empty() {
        list.push(mean(list[a], list[b]));
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use sunfleck::texture::Wrap;

    /// A square of side 1 in two triangles.
    fn square() -> Geometry {
        let corners = [Vec2::ZERO, Vec2::X, Vec2::ONE, Vec2::Y];
        Geometry {
            positions: corners.iter().map(|c| c.extend(0.0)).collect(),
            uvs: [corners.to_vec(), Vec::new()],
            triangles: vec![[0, 1, 2], [0, 2, 3]],
            ..Geometry::default()
        }
    }

    fn area(g: &Geometry) -> f32 {
        let area = |t: &[u32; 3]| {
            let [a, b, c] = t.map(|i| g.positions[i as usize]);
            0.5 * (b - a).cross(c - a).length()
        };
        g.triangles.iter().map(area).sum()
    }

    #[test]
    fn pieces_send_out_what_the_picture_does_and_cover_the_surface() {
        let pixels = (0..64).map(|i| Vec3::new((i % 8) as f32 / 7.0, f32::from(i < 8), 0.0)).collect();
        let picture = ImageTexture::new(8, 8, pixels, Wrap::Clamp).unwrap();
        let glow = Glow { picture: &picture, map: Affine2::IDENTITY, set: 0 };
        let pieces = glow.pieces(square());
        assert!((pieces.iter().map(|(_, g)| area(g)).sum::<f32>() - 1.0).abs() < 1e-5);
        let sent: Vec3 = pieces.iter().map(|(l, g)| *l * area(g)).sum();
        assert!((sent - picture.mean()).abs().max_element() < 0.01, "{sent} {}", picture.mean());
        assert!(pieces.len() > 8 && pieces.len() < 200, "{}", pieces.len());
        // Green is at the top of the picture, that is, at small v of the file.
        let green = pieces.iter().max_by(|a, b| a.0.y.total_cmp(&b.0.y)).unwrap();
        assert!(green.1.positions.iter().all(|p| p.y < 0.25), "{:?}", green.1.positions);
    }

    #[test]
    fn an_even_picture_leaves_a_mesh_in_one_piece() {
        let picture = ImageTexture::new(1, 1, vec![Vec3::new(0.5, 0.25, 0.0)], Wrap::Repeat).unwrap();
        let glow = Glow { picture: &picture, map: Affine2::IDENTITY, set: 0 };
        let pieces = glow.pieces(square());
        assert_eq!((pieces.len(), pieces[0].1.triangles.len(), pieces[0].0.x), (1, 2, 0.5));
    }
}
