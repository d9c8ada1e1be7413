//! A pinhole, or a thin lens when it has an aperture.
use super::{CameraRay, CameraSample, Project};
use crate::math::{Motion, Ray, warp::square_to_disk};
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

/// A perspective camera.
#[derive(Clone, Debug)]
pub struct Perspective {
    position: Vec3,
    right: Vec3,
    up: Vec3,
    forward: Vec3,
    /// Width and height of the picture at distance 1.
    size: Vec2,
    /// The middle of the picture at distance 1, to the right and up.
    centre: Vec2,
    lens_radius: f32,
    focus_distance: f32,
}

/// Why numbers do not make a camera.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum PerspectiveError {
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

impl Perspective {
    /// A pinhole camera. `fov` is the full vertical angle in degrees, 0 < fov < 180; `aspect` the picture's width over
    /// its height. An `up` along the line of sight is replaced by some perpendicular.
    ///
    /// # Errors
    /// Coinciding points, or a number out of range.
    pub fn new(view: &View, fov: f32, aspect: f32) -> Result<Self, PerspectiveError> {
        let range = |what, value: f32, ok: bool, range| {
            if ok { Ok(value) } else { Err(PerspectiveError::Range { what, value, range }) }
        };
        range("the field of view", fov, fov > 0.0 && fov < 180.0, "more than 0 and less than 180 degrees")?;
        range("the aspect ratio", aspect, aspect > 0.0 && aspect.is_finite(), "positive")?;
        let no_direction = PerspectiveError::NoDirection { position: view.position, look_at: view.look_at };
        let forward = (view.look_at - view.position).try_normalize().ok_or(no_direction)?;
        // right = forward × up: looking along +z with +y up, +x is at the left of the picture, as in NRenderer.
        let right = forward.cross(view.up).try_normalize().unwrap_or_else(|| forward.any_orthonormal_vector());
        let height = 2.0 * (0.5 * fov.to_radians()).tan();
        Ok(Self {
            position: view.position,
            right,
            up: right.cross(forward),
            forward,
            size: Vec2::new(height * aspect, height),
            centre: Vec2::ZERO,
            lens_radius: 0.0,
            focus_distance: 1.0,
        })
    }
    /// Gives the camera a thin lens of `aperture` diameter, sharp on the plane at `focus_distance` (both world units).
    ///
    /// # Errors
    /// A negative aperture, or a focus distance that is not positive.
    pub fn with_lens(self, aperture: f32, focus_distance: f32) -> Result<Self, PerspectiveError> {
        if !(aperture >= 0.0 && aperture.is_finite()) {
            return Err(PerspectiveError::Range { what: "the aperture", value: aperture, range: "zero or positive" });
        }
        if !(focus_distance > 0.0 && focus_distance.is_finite()) {
            return Err(PerspectiveError::Range {
                what: "the focus distance",
                value: focus_distance,
                range: "positive",
            });
        }
        Ok(Self { lens_radius: 0.5 * aperture, focus_distance, ..self })
    }
    /// Moves the picture in its plane, to the right and up, in heights of the picture: a part cut out of a larger one, or
    /// upright walls as by a shift lens.
    pub fn with_shift(self, shift: Vec2) -> Self {
        Self { centre: shift * self.size.y, ..self }
    }
    /// Exchanges left and right, as in programs whose axes are left-handed.
    pub fn mirrored(self) -> Self {
        Self { right: -self.right, ..self }
    }
    /// The eye.
    pub fn position(&self) -> Vec3 {
        self.position
    }
    fn world_from_camera(&self) -> Affine3A {
        Affine3A::from_mat3_translation(Mat3::from_cols(self.right, self.up, self.forward), self.position)
    }
    fn lens_offset(&self, u_lens: Vec2) -> Vec3 {
        if self.lens_radius == 0.0 {
            return Vec3::ZERO;
        }
        let l = self.lens_radius * square_to_disk(u_lens);
        l.x * self.right + l.y * self.up
    }
    /// Solid angle per raster area in a direction of cosine `cos` with the axis: the picture at distance 1 has area
    /// `size.x · size.y`, seen under cos³.
    fn solid_angle(&self, cos: f32) -> f32 {
        self.size.x * self.size.y * cos * cos * cos
    }
}

impl Project for Perspective {
    #[inline]
    fn ray(&self, raster: Vec2, u_lens: Vec2) -> CameraRay {
        let (x, y) = (self.centre.x + (raster.x - 0.5) * self.size.x, self.centre.y + (0.5 - raster.y) * self.size.y);
        let target = self.focus_distance * (self.forward + x * self.right + y * self.up);
        let lens = self.lens_offset(u_lens);
        let d = (target - lens).normalize();
        let ray = Ray { o: self.position + lens, d, tmin: 0.0, tmax: f32::INFINITY };
        CameraRay { ray, solid_angle: self.solid_angle(d.dot(self.forward)) }
    }
    #[inline]
    fn sample_wi(&self, from: Vec3, u_lens: Vec2) -> Option<CameraSample> {
        let lens = self.lens_offset(u_lens);
        let p = self.position + lens;
        let to = p - from;
        let wi = to.try_normalize()?;
        let cos = -wi.dot(self.forward);
        if cos <= 0.0 {
            return None;
        }
        // Where the ray from the lens meets the plane in focus, scaled to distance 1.
        let focus = (lens - wi * (self.focus_distance / cos)) / self.focus_distance;
        let plane = (Vec2::new(focus.dot(self.right), focus.dot(self.up)) - self.centre) / self.size;
        let raster = Vec2::new(0.5 + plane.x, 0.5 - plane.y);
        Some(CameraSample { p, wi, raster, importance: 1.0 / (self.solid_angle(cos) * to.length_squared()) })
    }
    /// The eye moves along a straight line and turns at constant speed; picture and lens change linearly.
    fn between(&self, to: &Self, time: f32) -> Option<Self> {
        let m = Motion::new(&self.world_from_camera(), &to.world_from_camera())?.at(time);
        let lerp = |a: f32, b: f32| a + time * (b - a);
        Some(Self {
            position: m.translation.into(),
            right: m.matrix3.x_axis.into(),
            up: m.matrix3.y_axis.into(),
            forward: m.matrix3.z_axis.into(),
            size: self.size.lerp(to.size, time),
            centre: self.centre.lerp(to.centre, time),
            lens_radius: lerp(self.lens_radius, to.lens_radius),
            focus_distance: lerp(self.focus_distance, to.focus_distance),
        })
    }
}
