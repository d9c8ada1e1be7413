//! Indexed triangles with optional vertex normals and texture coordinates.
use super::{AreaSample, Attributes, Parallelogram, SurfacePoint, gamma, plane_error, unit_and_length};
use crate::math::{Discrete, warp::square_to_triangle};
use accel::Hit;
use glam::{Affine3A, Vec2, Vec3};
use std::ops::{Add, Mul};

/// Triangles over shared vertices; the outer side is where vertices turn counter-clockwise.
#[derive(Clone, Debug, Default)]
pub struct Mesh {
    positions: Vec<Vec3>,
    normals: Vec<Vec3>,
    pub(super) uvs: Vec<Vec2>,
    indices: Vec<[u32; 3]>,
    /// By triangle.
    planes: Vec<Plane>,
    /// Triangle areas, for drawing points.
    areas: Discrete,
    /// If there is more.
    pub(super) attributes: Option<Box<Attributes>>,
}

/// What is the same all over a triangle.
#[derive(Clone, Copy, Debug)]
struct Plane {
    /// Unit normal.
    ng: Vec3,
    /// Bound on each coordinate's absolute error of points computed from barycentrics.
    p_error: f32,
}

impl Plane {
    /// The plane of a triangle, and the triangle's area (m²).
    fn new([a, b, c]: [Vec3; 3]) -> (Self, f32) {
        let (e1, e2) = (b - a, c - a);
        let (ng, twice_area) = unit_and_length(e1.cross(e2));
        // Barycentrics are themselves rounded; a moved barycentric moves the point within the plane only.
        let p_error = gamma(7.0) * a.abs().max(b.abs()).max(c.abs()) + plane_error(e1, e2, ng, twice_area);
        // What counts is how far the point may lie off the plane; that is kept, spread evenly over the coordinates.
        let across = ng.abs();
        (Self { ng, p_error: p_error.dot(across) / across.element_sum() }, 0.5 * twice_area)
    }
}

/// Why vertices and indices do not make a mesh.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum MeshError {
    /// An index points past the vertices.
    #[error("triangle {triangle} refers to vertex {index}, but there are {vertices}")]
    Index {
        /// Which triangle.
        triangle: usize,
        /// Its index.
        index: u32,
        /// Number of vertices.
        vertices: usize,
    },
    /// Normals or texture coordinates do not match the vertices.
    #[error("there are {found} {what} for {vertices} vertices")]
    Attribute {
        /// Which attribute.
        what: &'static str,
        /// How many there are.
        found: usize,
        /// Number of vertices.
        vertices: usize,
    },
}

impl Mesh {
    /// Checks and takes vertex arrays; `normals` and `uvs` are empty or as long as `positions`.
    ///
    /// # Errors
    /// An index out of range, or an attribute array of another length.
    pub fn new(
        positions: Vec<Vec3>,
        normals: Vec<Vec3>,
        uvs: Vec<Vec2>,
        indices: Vec<[u32; 3]>,
    ) -> Result<Self, MeshError> {
        let vertices = positions.len();
        for (what, found) in [("normals", normals.len()), ("texture coordinates", uvs.len())] {
            if found != 0 && found != vertices {
                return Err(MeshError::Attribute { what, found, vertices });
            }
        }
        for (triangle, t) in indices.iter().enumerate() {
            if let Some(&index) = t.iter().find(|&&i| i as usize >= vertices) {
                return Err(MeshError::Index { triangle, index, vertices });
            }
        }
        let mut planes = Vec::with_capacity(indices.len());
        let areas = Discrete::new(indices.iter().map(|t| {
            let (plane, area) = Plane::new(t.map(|i| positions[i as usize]));
            planes.push(plane);
            area
        }));
        Ok(Self { positions, normals, uvs, indices, planes, areas, attributes: None })
    }
    /// Vertex positions.
    pub fn positions(&self) -> &[Vec3] {
        &self.positions
    }
    /// Vertex indices of each triangle.
    pub fn indices(&self) -> &[[u32; 3]] {
        &self.indices
    }
    /// Unit normals at the vertices, or none.
    pub fn normals(&self) -> &[Vec3] {
        &self.normals
    }
    /// Texture coordinates at the vertices, or none.
    pub fn uvs(&self) -> &[Vec2] {
        &self.uvs
    }
    /// What else the vertices know.
    pub fn attributes(&self) -> Option<&Attributes> {
        self.attributes.as_deref()
    }
    #[inline]
    pub(super) fn corners<T: Copy>(&self, values: &[T], triangle: u32) -> [T; 3] {
        self.indices[triangle as usize].map(|i| values[i as usize])
    }
    /// What vertices know, at a hit.
    #[inline]
    pub(super) fn interpolate<T: Copy + Add<Output = T> + Mul<f32, Output = T>>(&self, values: &[T], hit: &Hit) -> T {
        let [a, b, c] = self.corners(values, hit.primitive);
        a * (1.0 - hit.u - hit.v) + b * hit.u + c * hit.v
    }
    /// Point, error and unit normal at barycentrics.
    #[inline]
    fn point(&self, triangle: u32, u: f32, v: f32) -> (Vec3, Vec3, Vec3) {
        let [a, b, c] = self.corners(&self.positions, triangle);
        let Plane { ng, p_error } = self.planes[triangle as usize];
        ((1.0 - u - v) * a + u * b + v * c, Vec3::splat(p_error), ng)
    }
    #[inline]
    pub(super) fn surface_point(&self, hit: &Hit, wants_uv: bool) -> SurfacePoint {
        let (u, v) = (hit.u, hit.v);
        let (p, p_error, ng) = self.point(hit.primitive, u, v);
        let n = if self.normals.is_empty() {
            ng
        } else {
            let n = self.interpolate(&self.normals, hit).normalize_or(ng);
            // Files disagree about which side vertex normals take; the winding decides.
            if n.dot(ng) < 0.0 { -n } else { n }
        };
        let uv = match (wants_uv, self.uvs.is_empty()) {
            (false, _) => Vec2::ZERO,
            (true, true) => Vec2::new(u, v),
            (true, false) => self.interpolate(&self.uvs, hit),
        };
        SurfacePoint { p, p_error, ng, n, uv }
    }
    pub(super) fn area(&self) -> f32 {
        self.areas.total() as f32
    }
    pub(super) fn sample_area(&self, s: Vec2) -> AreaSample {
        let (triangle, _, rest) = self.areas.sample(s.x).unwrap_or((0, 1.0, s.x));
        let b = square_to_triangle(Vec2::new(rest, s.y));
        let (p, p_error, ng) = self.point(triangle as u32, b.x, b.y);
        AreaSample { p, p_error, ng }
    }
    /// The parallelogram that two triangles make up, if that is what the mesh is.
    pub(crate) fn as_parallelogram(&self) -> Option<Parallelogram> {
        let &[first, second] = self.indices.as_slice() else { return None };
        // Turned so that the first one's edge from `c` to `a` is the diagonal, which the second runs along the other way.
        let turns = |[a, b, c]: [u32; 3]| [[a, b, c], [b, c, a], [c, a, b]];
        let same = |i: u32, j: u32| self.positions[i as usize] == self.positions[j as usize];
        let corners = turns(first).into_iter().find_map(|[a, b, c]| {
            turns(second).into_iter().find_map(|[e, f, d]| (same(e, a) && same(f, c)).then_some([a, b, c, d]))
        });
        let [a, b, c, d] = corners?.map(|i| self.positions[i as usize]);
        let (u, v) = (b - a, d - a);
        let extent = a.abs().max(b.abs()).max(c.abs()).max(d.abs()).max_element();
        let even = (a + u + v - c).abs().max_element() <= 4.0 * f32::EPSILON * extent;
        (even && u.cross(v).length_squared() > 0.0).then(|| Parallelogram::new(a, u, v))
    }
    pub(super) fn transformed(&self, m: &Affine3A) -> Self {
        let normal_matrix = m.matrix3.inverse().transpose();
        let mirrored = m.matrix3.determinant() < 0.0;
        let positions: Vec<Vec3> = self.positions.iter().map(|&p| m.transform_point3(p)).collect();
        // Not normalised: interpolating moved normals is then the same as moving interpolated ones, as instances do.
        let normals = self.normals.iter().map(|&n| normal_matrix * n).collect();
        let indices = self.indices.iter().map(|&[a, b, c]| if mirrored { [a, c, b] } else { [a, b, c] }).collect();
        let mesh =
            Self::new(positions, normals, self.uvs.clone(), indices).expect("a valid mesh stays valid when moved");
        Self { attributes: self.attributes.as_ref().map(|a| Box::new(a.transformed(&m.matrix3))), ..mesh }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn bad_indices_and_attributes_are_named() {
        let p = vec![Vec3::ZERO, Vec3::X, Vec3::Y];
        assert_eq!(
            Mesh::new(p.clone(), vec![], vec![], vec![[0, 1, 3]]).unwrap_err(),
            MeshError::Index { triangle: 0, index: 3, vertices: 3 }
        );
        assert_eq!(
            Mesh::new(p, vec![Vec3::Z], vec![], vec![]).unwrap_err(),
            MeshError::Attribute { what: "normals", found: 1, vertices: 3 }
        );
    }

    #[test]
    fn two_triangles_are_a_parallelogram_if_they_share_a_diagonal_and_a_side() {
        let mesh = |p: [Vec3; 4], t: [[u32; 3]; 2]| Mesh::new(p.to_vec(), vec![], vec![], t.to_vec()).unwrap();
        let p = [Vec3::ZERO, Vec3::X, Vec3::new(1.5, 2.0, 0.0), Vec3::new(0.5, 2.0, 0.0)];
        for t in [[[0, 1, 2], [0, 2, 3]], [[2, 0, 1], [3, 0, 2]], [[1, 2, 3], [3, 0, 1]]] {
            let patch = mesh(p, t).as_parallelogram().unwrap();
            let mut corners = patch.corners().map(|c| [c.x, c.y]);
            corners.sort_by(|a, b| a.partial_cmp(b).unwrap());
            assert_eq!(corners, [[0.0, 0.0], [0.5, 2.0], [1.0, 0.0], [1.5, 2.0]]);
            assert!(patch.u().cross(patch.v()).z > 0.0);
        }
        // Turned against each other, a kite, folded along the diagonal.
        assert!(mesh(p, [[0, 1, 2], [0, 3, 2]]).as_parallelogram().is_none());
        let moved = |to: Vec3| mesh([p[0], p[1], p[2], to], [[0, 1, 2], [0, 2, 3]]).as_parallelogram();
        assert!(moved(Vec3::new(0.4, 2.0, 0.0)).is_none() && moved(Vec3::new(0.5, 2.0, 0.1)).is_none());
    }

    #[test]
    fn area_points_are_spread_by_triangle_area() {
        let p = vec![Vec3::ZERO, Vec3::X, Vec3::Y, Vec3::new(0.0, -3.0, 0.0)];
        let m = Mesh::new(p, vec![], vec![], vec![[0, 1, 2], [0, 3, 1]]).unwrap();
        assert!((m.area() - 2.0).abs() < 1e-6);
        let below = (0..1024).filter(|i| m.sample_area(Vec2::new((*i as f32 + 0.5) / 1024.0, 0.37)).p.y < 0.0).count();
        assert_eq!(below, 768);
    }
}
