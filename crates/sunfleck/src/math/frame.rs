//! Shading frames and directions expressed in them.
use glam::Vec3;

/// A unit direction in the frame of a surface: `z` is along the shading normal.
///
/// A newtype, so that a world direction is never handed to a scattering model by mistake.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Local(pub Vec3);

impl Local {
    /// Cosine of the angle with the shading normal, in [-1, 1].
    #[inline]
    pub fn cos_theta(self) -> f32 {
        self.0.z
    }
    /// Absolute cosine of the angle with the shading normal.
    #[inline]
    pub fn abs_cos_theta(self) -> f32 {
        self.0.z.abs()
    }
    /// Whether both directions leave on the same side of the surface.
    #[inline]
    pub fn same_side(self, other: Self) -> bool {
        self.0.z * other.0.z > 0.0
    }
    /// The mirror direction about the normal.
    #[inline]
    pub fn mirrored(self) -> Self {
        Self(Vec3::new(-self.0.x, -self.0.y, self.0.z))
    }
    /// Dot product of two directions.
    #[inline]
    pub fn dot(self, other: Self) -> f32 {
        self.0.dot(other.0)
    }
}

/// A right-handed orthonormal basis; `n` is the normal.
#[derive(Clone, Copy, Debug)]
pub struct Frame {
    /// First tangent.
    pub s: Vec3,
    /// Second tangent.
    pub t: Vec3,
    /// Normal.
    pub n: Vec3,
}

impl Frame {
    /// Builds tangents around the unit vector `n` without branches (Duff et al. 2017, "Building an Orthonormal
    /// Basis, Revisited", listing 3).
    #[inline]
    pub fn from_normal(n: Vec3) -> Self {
        let sign = 1f32.copysign(n.z);
        let a = -1.0 / (sign + n.z);
        let b = n.x * n.y * a;
        Self {
            s: Vec3::new(1.0 + sign * n.x * n.x * a, sign * b, -sign * n.x),
            t: Vec3::new(b, sign + n.y * n.y * a, -n.y),
            n,
        }
    }
    /// The frame of the unit vector `n` whose first tangent is nearest to `along`; any tangent if that is parallel to `n`.
    #[inline]
    pub fn along(n: Vec3, along: Vec3) -> Self {
        match (along - n * n.dot(along)).try_normalize() {
            Some(s) if s.dot(n).abs() < 1e-3 => Self { s, t: n.cross(s), n },
            _ => Self::from_normal(n),
        }
    }
    /// World to local.
    #[inline]
    pub fn to_local(&self, v: Vec3) -> Local {
        Local(Vec3::new(v.dot(self.s), v.dot(self.t), v.dot(self.n)))
    }
    /// Local to world.
    #[inline]
    pub fn to_world(&self, v: Local) -> Vec3 {
        v.0.x * self.s + v.0.y * self.t + v.0.z * self.n
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_frame_is_orthonormal_right_handed_and_inverts() {
        for n in [
            Vec3::Z,
            Vec3::NEG_Z,
            Vec3::X,
            Vec3::new(0.3, -0.5, -0.81).normalize(),
            Vec3::new(1e-4, 0.0, -1.0).normalize(),
        ] {
            let f = Frame::from_normal(n);
            assert!((f.s.cross(f.t) - f.n).length() < 1e-5, "{n}");
            assert!(f.s.dot(f.t).abs() < 1e-6 && (f.s.length() - 1.0).abs() < 1e-5);
            let v = Vec3::new(0.2, 0.7, -0.4);
            assert!((f.to_world(f.to_local(v)) - v).length() < 1e-5);
        }
    }
}
