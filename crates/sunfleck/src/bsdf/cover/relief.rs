//! Normals from textures: relief that geometry lacks.
//!
//! The new normal depends on the place alone, and stays in the hemisphere of the true one: so paths from both ends see the same
//! surface. Where a direction is above one of the two normals and below the other, nothing is scattered, as for
//! the normals of meshes ([`crate::scene::Interaction::f`]).
use super::{MaterialId, Site};
use crate::{
    bsdf::{Lookup, MaterialEntry, TextureId},
    math::Frame,
    texture::Scalar,
};
use glam::Vec3;

/// The least cosine between the true normal and one from a texture.
const LEAST_COS: f32 = 0.05;

/// `n`, turned toward `ng` until they are not quite at a right angle.
fn above(n: Vec3, ng: Vec3) -> Vec3 {
    let lack = LEAST_COS - n.dot(ng);
    if lack > 0.0 { (n + lack * ng).try_normalize().unwrap_or(ng) } else { n }
}

/// A material with the normals of a picture: (2r − 1, 2g − 1, 2b − 1) along the growth of u, of v, and of the normal.
#[derive(Clone, Copy, Debug)]
pub struct NormalMapMaterial {
    /// The material.
    pub of: MaterialId,
    /// The normals; a picture of numbers, not of colours.
    pub map: TextureId,
    /// What the first two components are multiplied by; 1 as stored.
    pub scale: f32,
}

impl NormalMapMaterial {
    pub(super) const ENTRY: MaterialEntry = MaterialEntry {
        name: "normalmap",
        about: "another material with normals from the picture `map`, in the frame of the texture coordinates",
    };

    pub(super) fn normal(&self, site: &Site) -> Vec3 {
        let m = 2.0 * site.at.rgb(self.map) - 1.0;
        let m = Vec3::new(m.x * self.scale, m.y * self.scale, m.z);
        let (frame, side) = match site.tangents {
            Some([u, v]) => {
                let frame = Frame::along(site.n, u);
                (frame, 1f32.copysign(frame.t.dot(v)))
            }
            None => (Frame::from_normal(site.n), 1.0),
        };
        let n = m.x * frame.s + side * m.y * frame.t + m.z * frame.n;
        n.try_normalize().map_or(site.n, |n| above(n, site.ng))
    }
}

/// A material whose normals are those of a surface that is moved out by `height` (Blinn 1978, "Simulation of Wrinkled
/// Surfaces").
#[derive(Clone, Copy, Debug)]
pub struct BumpMapMaterial {
    /// The material.
    pub of: MaterialId,
    /// How far the surface is moved along its normal, times `scale`.
    pub height: Scalar,
    /// World units per unit of `height`.
    pub scale: f32,
}

/// Difference of texture coordinates over which heights are compared.
const STEP: f32 = 5e-4;

impl BumpMapMaterial {
    pub(super) const ENTRY: MaterialEntry = MaterialEntry {
        name: "bumpmap",
        about: "another material with the normals of a surface moved out by `height`",
    };

    pub(super) fn normal(&self, site: &Site) -> Vec3 {
        let Some(tangents) = site.tangents else { return site.n };
        let n = site.n;
        // Blinn 1978, eq. 2: the moved surface's derivatives, but for the change of the normal, which matters little for low
        // relief. Both are taken in the plane of the shading normal.
        let [u, v] = [0, 1].map(|axis| {
            let along = tangents[axis];
            let height = |d: f32| {
                let mut uv = site.at.uv;
                uv[axis] += d;
                Lookup { uv, p: site.at.p + d * along, ..site.at }.scalar(self.height)
            };
            along - n * n.dot(along) + n * (self.scale * (height(STEP) - height(-STEP)) / (2.0 * STEP))
        });
        let moved = u.cross(v);
        (moved * 1f32.copysign(moved.dot(n))).try_normalize().map_or(n, |n| above(n, site.ng))
    }
}
