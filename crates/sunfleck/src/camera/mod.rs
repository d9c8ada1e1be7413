//! The eye: from a place on the picture to a ray, and from a point of the scene back to the picture.
//!
//! Places on the picture are `raster` coordinates in [0, 1]²: x to the right, y **down**, row 0 on top. To add a model:
//! write `camera/<name>.rs` implementing [`Project`] and one word in `cameras!`.
mod frame;
mod orthographic;
mod perspective;
mod spherical;

pub use frame::{CameraError, View};
pub use orthographic::Orthographic;
pub use perspective::Perspective;
pub use spherical::{Spherical, Unrolling};

use crate::math::Ray;
use glam::{Vec2, Vec3};

/// A camera ray.
#[derive(Clone, Copy, Debug)]
pub struct CameraRay {
    /// Origin and unit direction.
    pub ray: Ray,
    /// What a unit of raster area covers at this place.
    pub spread: Spread,
}

/// How far apart the rays of neighbouring places are: what a unit of raster area covers, or one pixel.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Spread {
    /// They share an origin: solid angle (sr).
    SolidAngle(f32),
    /// They are parallel: area across them (world units²).
    Area(f32),
}

impl Spread {
    /// Area (world units²) across the rays, after the way `distance`.
    #[inline]
    pub fn area_at(self, distance: f32) -> f32 {
        match self {
            Self::SolidAngle(w) => w * (distance * distance),
            Self::Area(a) => a,
        }
    }
    /// Width (world units) across the rays of a square that covers [`Spread::area_at`].
    #[inline]
    pub fn width_at(self, distance: f32) -> f32 {
        self.area_at(distance).sqrt()
    }
    /// The share of one of `pixels` pixels.
    #[inline]
    #[must_use]
    pub fn of_pixel(self, pixels: usize) -> Self {
        match self {
            Self::SolidAngle(w) => Self::SolidAngle(w / pixels as f32),
            Self::Area(a) => Self::Area(a / pixels as f32),
        }
    }
}

/// A point of the scene as the camera sees it.
#[derive(Clone, Copy, Debug)]
pub struct CameraSample {
    /// Point on the lens.
    pub p: Vec3,
    /// Unit direction from the point of the scene to `p`.
    pub wi: Vec3,
    /// Where on the picture's plane; may lie outside [0, 1]², where only a wide pixel filter reaches.
    pub raster: Vec2,
    /// `1 / `[`Spread::area_at`]` (distance)`: a path of flux Φ that scatters `f·cos` toward the lens adds
    /// `Φ·f·cos·importance` per unit of raster area.
    pub importance: f32,
}

/// The contract of every camera; checked in `tests/camera_contract.rs`.
pub trait Project {
    /// The ray through `raster` and the lens point of `u_lens`.
    fn ray(&self, raster: Vec2, u_lens: Vec2) -> CameraRay;
    /// Connects `from` to the lens point of `u_lens`; `None` if `from` is behind the camera.
    fn sample_wi(&self, from: Vec3, u_lens: Vec2) -> Option<CameraSample>;
    /// Whether `u_lens` matters.
    fn has_lens(&self) -> bool;
    /// The camera at `time` on the way from this one (0) to `to` (1); `None` if there is no way, as between mirror images.
    fn between(&self, to: &Self, time: f32) -> Option<Self>
    where
        Self: Sized;
}

/// Declares the closed set of cameras and forwards every [`Project`] method to them.
macro_rules! cameras {
    ($($name:ident),* $(,)?) => {
        /// One of the models of this room.
        #[derive(Clone, Debug)]
        pub enum Camera { $(#[doc = concat!("See [`", stringify!($name), "`].")] $name($name)),* }
        $(impl From<$name> for Camera { fn from(c: $name) -> Self { Self::$name(c) } })*
        impl Project for Camera {
            #[inline]
            fn ray(&self, raster: Vec2, u_lens: Vec2) -> CameraRay {
                match self { $(Self::$name(c) => c.ray(raster, u_lens)),* }
            }
            #[inline]
            fn sample_wi(&self, from: Vec3, u_lens: Vec2) -> Option<CameraSample> {
                match self { $(Self::$name(c) => c.sample_wi(from, u_lens)),* }
            }
            #[inline]
            fn has_lens(&self) -> bool {
                match self { $(Self::$name(c) => c.has_lens()),* }
            }
            fn between(&self, to: &Self, time: f32) -> Option<Self> {
                match (self, to) {
                    $((Self::$name(c), Self::$name(to)) => c.between(to, time).map(Self::$name),)*
                    _ => None,
                }
            }
        }
    };
}

cameras![Perspective, Orthographic, Spherical];
