//! Where a camera stands, how it is turned, and its lens.
use crate::math::{Motion, warp::square_to_disk};
use glam::{Affine3A, Mat3, Vec2, Vec3};

/// Position and orientation.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct View {
    /// The eye.
    pub position: Vec3,
    /// A point in the middle of the picture.
    pub look_at: Vec3,
    /// What should point up.
    pub up: Vec3,
}

/// Why numbers do not make a camera.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum CameraError {
    /// Position and target coincide, or something is not finite.
    #[error("the camera at {position} cannot look at {look_at}: the two must be finite and different points")]
    NoDirection {
        /// The eye.
        position: Vec3,
        /// The target.
        look_at: Vec3,
    },
    /// A number out of its range.
    #[error("{what} is {value}, but must be {range}")]
    Range {
        /// Which number.
        what: &'static str,
        /// Its value.
        value: f32,
        /// Where it may lie.
        range: &'static str,
    },
}

/// `value`, or the error that it is none of `range`.
pub(super) fn within(what: &'static str, value: f32, ok: bool, range: &'static str) -> Result<f32, CameraError> {
    if ok { Ok(value) } else { Err(CameraError::Range { what, value, range }) }
}

/// The width of a picture over its height, which must be positive.
pub(super) fn aspect(aspect: f32) -> Result<f32, CameraError> {
    within("the aspect ratio", aspect, aspect > 0.0 && aspect.is_finite(), "positive")
}

/// Place and axes of a camera.
#[derive(Clone, Copy, Debug)]
pub(super) struct Stand {
    pub(super) position: Vec3,
    pub(super) right: Vec3,
    pub(super) up: Vec3,
    pub(super) forward: Vec3,
}

impl Stand {
    /// An `up` along the line of sight is replaced by some perpendicular.
    pub(super) fn new(view: &View) -> Result<Self, CameraError> {
        let no_direction = CameraError::NoDirection { position: view.position, look_at: view.look_at };
        let forward = (view.look_at - view.position).try_normalize().ok_or(no_direction)?;
        // right = forward × up: looking along +z with +y up, +x is at the left of the picture, as in NRenderer.
        let right = forward.cross(view.up).try_normalize().unwrap_or_else(|| forward.any_orthonormal_vector());
        Ok(Self { position: view.position, right, up: right.cross(forward), forward })
    }
    /// Exchanges left and right.
    pub(super) fn mirrored(self) -> Self {
        Self { right: -self.right, ..self }
    }
    /// A direction (or offset) given to the right, up and forward.
    #[inline]
    pub(super) fn to_world(self, v: Vec3) -> Vec3 {
        v.x * self.right + v.y * self.up + v.z * self.forward
    }
    /// The inverse of [`Stand::to_world`].
    #[inline]
    pub(super) fn to_local(self, v: Vec3) -> Vec3 {
        Vec3::new(v.dot(self.right), v.dot(self.up), v.dot(self.forward))
    }
    /// The eye moves along a straight line and turns at constant speed.
    pub(super) fn between(&self, to: &Self, time: f32) -> Option<Self> {
        let placed = |s: &Self| Affine3A::from_mat3_translation(Mat3::from_cols(s.right, s.up, s.forward), s.position);
        let m = Motion::new(&placed(self), &placed(to))?.at(time);
        Some(Self {
            position: m.translation.into(),
            right: m.matrix3.x_axis.into(),
            up: m.matrix3.y_axis.into(),
            forward: m.matrix3.z_axis.into(),
        })
    }
}

/// A thin lens; a pinhole where the radius is 0.
#[derive(Clone, Copy, Debug)]
pub(super) struct Lens {
    pub(super) radius: f32,
    /// Distance of the plane that is sharp, world units.
    pub(super) focus: f32,
}

impl Lens {
    pub(super) const PINHOLE: Self = Self { radius: 0.0, focus: 1.0 };

    pub(super) fn new(aperture: f32, focus: f32) -> Result<Self, CameraError> {
        within("the aperture", aperture, aperture >= 0.0 && aperture.is_finite(), "zero or positive")?;
        within("the focus distance", focus, focus > 0.0 && focus.is_finite(), "positive")?;
        Ok(Self { radius: 0.5 * aperture, focus })
    }
    /// A point of the lens, uniform in area, to the right and up from its middle.
    #[inline]
    pub(super) fn point(self, u: Vec2) -> Vec2 {
        if self.radius == 0.0 { Vec2::ZERO } else { self.radius * square_to_disk(u) }
    }
    pub(super) fn between(self, to: Self, time: f32) -> Self {
        let lerp = |a: f32, b: f32| a + time * (b - a);
        Self { radius: lerp(self.radius, to.radius), focus: lerp(self.focus, to.focus) }
    }
}
