//! A pinhole, or a thin lens when it has an aperture.
use super::{
    CameraError, CameraRay, CameraSample, Project, Spread, View,
    frame::{self, Lens, Stand, within},
};
use crate::math::Ray;
use glam::{Vec2, Vec3};

/// A perspective camera.
#[derive(Clone, Debug)]
pub struct Perspective {
    stand: Stand,
    lens: Lens,
    /// Width and height of the picture at distance 1.
    size: Vec2,
    /// The middle of the picture at distance 1, to the right and up.
    centre: Vec2,
}

impl Perspective {
    /// A pinhole camera. `fov` is the full vertical angle in degrees, 0 < fov < 180; `aspect` the picture's width over
    /// its height. An `up` along the line of sight is replaced by some perpendicular.
    ///
    /// # Errors
    /// Coinciding points, or a number out of range.
    pub fn new(view: &View, fov: f32, aspect: f32) -> Result<Self, CameraError> {
        within("the field of view", fov, fov > 0.0 && fov < 180.0, "more than 0 and less than 180 degrees")?;
        let aspect = frame::aspect(aspect)?;
        let height = 2.0 * (0.5 * fov.to_radians()).tan();
        let size = Vec2::new(height * aspect, height);
        Ok(Self { stand: Stand::new(view)?, lens: Lens::PINHOLE, size, centre: Vec2::ZERO })
    }
    /// Gives the camera a thin lens of `aperture` diameter, sharp on the plane at `focus_distance` (both world units).
    ///
    /// # Errors
    /// A negative aperture, or a focus distance that is not positive.
    pub fn with_lens(self, aperture: f32, focus_distance: f32) -> Result<Self, CameraError> {
        Ok(Self { lens: Lens::new(aperture, focus_distance)?, ..self })
    }
    /// Moves the picture in its plane, to the right and up, in heights of the picture: a part cut out of a larger one, or
    /// upright walls as by a shift lens.
    pub fn with_shift(self, shift: Vec2) -> Self {
        Self { centre: shift * self.size.y, ..self }
    }
    /// Exchanges left and right, as in programs whose axes are left-handed.
    pub fn mirrored(self) -> Self {
        Self { stand: self.stand.mirrored(), ..self }
    }
    /// The eye.
    pub fn position(&self) -> Vec3 {
        self.stand.position
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
        let target = self.lens.focus * self.stand.to_world(Vec3::new(x, y, 1.0));
        let lens = self.stand.to_world(self.lens.point(u_lens).extend(0.0));
        let d = (target - lens).normalize();
        let ray = Ray { o: self.stand.position + lens, d, tmin: 0.0, tmax: f32::INFINITY };
        CameraRay { ray, spread: Spread::SolidAngle(self.solid_angle(d.dot(self.stand.forward))) }
    }
    #[inline]
    fn sample_wi(&self, from: Vec3, u_lens: Vec2) -> Option<CameraSample> {
        let lens = self.stand.to_world(self.lens.point(u_lens).extend(0.0));
        let p = self.stand.position + lens;
        let to = p - from;
        let wi = to.try_normalize()?;
        let cos = -wi.dot(self.stand.forward);
        if cos <= 0.0 {
            return None;
        }
        // Where the ray from the lens meets the plane in focus, scaled to distance 1.
        let focus = (lens - wi * (self.lens.focus / cos)) / self.lens.focus;
        let plane = (self.stand.to_local(focus).truncate() - self.centre) / self.size;
        let raster = Vec2::new(0.5 + plane.x, 0.5 - plane.y);
        Some(CameraSample { p, wi, raster, importance: 1.0 / (self.solid_angle(cos) * to.length_squared()) })
    }
    #[inline]
    fn has_lens(&self) -> bool {
        self.lens.radius > 0.0
    }
    /// The eye moves along a straight line and turns at constant speed; picture and lens change linearly.
    fn between(&self, to: &Self, time: f32) -> Option<Self> {
        Some(Self {
            stand: self.stand.between(&to.stand, time)?,
            lens: self.lens.between(to.lens, time),
            size: self.size.lerp(to.size, time),
            centre: self.centre.lerp(to.centre, time),
        })
    }
}
