//! Parallel rays: things keep their size whatever their distance.
use super::{
    CameraError, CameraRay, CameraSample, Project, Spread, View,
    frame::{self, Lens, Stand, within},
};
use crate::math::Ray;
use glam::{Vec2, Vec3};

/// An orthographic camera: a plane that looks straight ahead, seeing what lies before it.
///
/// With a lens, each point of the plane sees through a disc of that size around it, sharp at the focus distance.
#[derive(Clone, Debug)]
pub struct Orthographic {
    stand: Stand,
    lens: Lens,
    /// Width and height of the plane, world units.
    size: Vec2,
    /// The middle of the picture, to the right and up of the position.
    centre: Vec2,
}

impl Orthographic {
    /// `height` of the plane in world units, and the picture's width over its height, both positive. An `up` along the
    /// line of sight is replaced by some perpendicular.
    ///
    /// # Errors
    /// Coinciding points, or a number out of range.
    pub fn new(view: &View, height: f32, aspect: f32) -> Result<Self, CameraError> {
        within("the height of the picture", height, height > 0.0 && height.is_finite(), "positive")?;
        let size = Vec2::new(height * frame::aspect(aspect)?, height);
        Ok(Self { stand: Stand::new(view)?, lens: Lens::PINHOLE, size, centre: Vec2::ZERO })
    }
    /// Gives the camera lenses of `aperture` diameter, sharp on the plane at `focus_distance` (both world units).
    ///
    /// # Errors
    /// A negative aperture, or a focus distance that is not positive.
    pub fn with_lens(self, aperture: f32, focus_distance: f32) -> Result<Self, CameraError> {
        Ok(Self { lens: Lens::new(aperture, focus_distance)?, ..self })
    }
    /// Moves the picture in its plane, to the right and up, in heights of the picture.
    pub fn with_shift(self, shift: Vec2) -> Self {
        Self { centre: shift * self.size.y, ..self }
    }
    /// Exchanges left and right, as in programs whose axes are left-handed.
    pub fn mirrored(self) -> Self {
        Self { stand: self.stand.mirrored(), ..self }
    }
    /// Direction and cosine with the axis of all rays through the lens point `lens`.
    fn direction(&self, lens: Vec2) -> (Vec3, f32) {
        let local = (-lens).extend(self.lens.focus).normalize();
        (self.stand.to_world(local), local.z)
    }
    /// Area across rays of cosine `cos` with the axis, per unit of raster area.
    fn area(&self, cos: f32) -> f32 {
        self.size.x * self.size.y * cos
    }
}

impl Project for Orthographic {
    #[inline]
    fn ray(&self, raster: Vec2, u_lens: Vec2) -> CameraRay {
        let lens = self.lens.point(u_lens);
        let (d, cos) = self.direction(lens);
        let place = self.centre + Vec2::new(raster.x - 0.5, 0.5 - raster.y) * self.size + lens;
        let o = self.stand.position + self.stand.to_world(place.extend(0.0));
        CameraRay { ray: Ray { o, d, tmin: 0.0, tmax: f32::INFINITY }, spread: Spread::Area(self.area(cos)) }
    }
    #[inline]
    fn sample_wi(&self, from: Vec3, u_lens: Vec2) -> Option<CameraSample> {
        let lens = self.lens.point(u_lens);
        let (d, cos) = self.direction(lens);
        let depth = (from - self.stand.position).dot(self.stand.forward);
        if depth <= 0.0 {
            return None;
        }
        let p = from - d * (depth / cos);
        let plane = (self.stand.to_local(p - self.stand.position).truncate() - lens - self.centre) / self.size;
        let raster = Vec2::new(0.5 + plane.x, 0.5 - plane.y);
        Some(CameraSample { p, wi: -d, raster, importance: 1.0 / self.area(cos) })
    }
    #[inline]
    fn has_lens(&self) -> bool {
        self.lens.radius > 0.0
    }
    /// The plane moves along a straight line and turns at constant speed; picture and lens change linearly.
    fn between(&self, to: &Self, time: f32) -> Option<Self> {
        Some(Self {
            stand: self.stand.between(&to.stand, time)?,
            lens: self.lens.between(to.lens, time),
            size: self.size.lerp(to.size, time),
            centre: self.centre.lerp(to.centre, time),
        })
    }
}
