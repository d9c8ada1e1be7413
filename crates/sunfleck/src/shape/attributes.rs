//! What a mesh may know at its vertices beside normals and texture coordinates, and its tangents.
use super::{Mesh, MeshError};
use crate::texture::VertexAttributes;
use accel::Hit;
use glam::{Mat3A, Vec2, Vec3, Vec4};

/// More about the vertices of a [`Mesh`]; each list is empty or as long as the positions.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Attributes {
    /// Second set of texture coordinates.
    pub uv2: Vec<Vec2>,
    /// Colour (linear sRGB) and opacity.
    pub colours: Vec<Vec4>,
    /// Where the texture coordinate `u` grows (unit), and in `w` the sign of the side that `v` grows to: `v` grows along
    /// `w · n × tangent`, as in glTF. Without them tangents follow from positions and texture coordinates.
    pub tangents: Vec<Vec4>,
}

impl Attributes {
    /// Each list with its name and length.
    pub(super) fn lengths(&self) -> [(&'static str, usize); 3] {
        [
            ("second texture coordinates", self.uv2.len()),
            ("vertex colours", self.colours.len()),
            ("tangents", self.tangents.len()),
        ]
    }
    /// The same on a mesh moved by `m`.
    pub(super) fn transformed(&self, m: &Mat3A) -> Self {
        let side = m.determinant().signum();
        let tangents = self.tangents.iter().map(|t| (*m * t.truncate()).extend(side * t.w)).collect();
        Self { uv2: self.uv2.clone(), colours: self.colours.clone(), tangents }
    }
}

/// How the point moves per unit of the texture coordinates u and v; not unit, not at right angles.
pub type Tangents = [Vec3; 2];

impl Mesh {
    /// Adds to what the vertices know.
    ///
    /// # Errors
    /// A list of another length than the positions.
    pub fn with_attributes(mut self, attributes: Attributes) -> Result<Self, MeshError> {
        let vertices = self.positions().len();
        for (what, found) in attributes.lengths() {
            if found != 0 && found != vertices {
                return Err(MeshError::Attribute { what, found, vertices });
            }
        }
        let none = attributes.lengths().iter().all(|(_, n)| *n == 0);
        self.attributes = (!none).then(|| Box::new(attributes));
        Ok(self)
    }
    /// What the mesh knows at a hit.
    #[inline]
    pub(super) fn attributes_at(&self, hit: &Hit) -> VertexAttributes {
        match &self.attributes {
            None => VertexAttributes::default(),
            Some(a) => self.interpolated(a, hit),
        }
    }
    #[inline(never)]
    fn interpolated(&self, a: &Attributes, hit: &Hit) -> VertexAttributes {
        let mut at = VertexAttributes::default();
        if !a.uv2.is_empty() {
            at.uv2 = self.interpolate(&a.uv2, hit);
        }
        if !a.colours.is_empty() {
            at.colour = self.interpolate(&a.colours, hit);
        }
        at
    }
    /// Tangents at a hit where the shading normal is `n`. `None` where texture coordinates do not say.
    pub(super) fn tangents(&self, hit: &Hit, n: Vec3) -> Option<Tangents> {
        let [a, b, c] = self.corners(self.positions(), hit.primitive);
        let [ta, tb, tc] =
            if self.uvs.is_empty() { [Vec2::ZERO, Vec2::X, Vec2::Y] } else { self.corners(&self.uvs, hit.primitive) };
        let (e1, e2, t1, t2) = (b - a, c - a, tb - ta, tc - ta);
        let det = t1.perp_dot(t2);
        let known = (det != 0.0).then(|| [(t2.y * e1 - t1.y * e2) / det, (t1.x * e2 - t2.x * e1) / det]);
        let known = known.filter(|[u, v]| u.is_finite() && v.is_finite());
        match &self.attributes {
            Some(extra) if !extra.tangents.is_empty() => {
                let t = self.interpolate(&extra.tangents, hit);
                let [u, v] = known.map_or([1.0, 1.0], |[u, v]| [u.length(), v.length()]);
                let along = t.truncate().try_normalize()?;
                Some([u * along, v * t.w.signum() * n.cross(along)])
            }
            _ => known,
        }
    }
}
