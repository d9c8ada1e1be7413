//! Where light comes from: chosen from a point ([`Emitter::sample_li`]), emitted into the scene
//! ([`Emitter::sample_le`]), or met by a ray ([`Emitter::le`], [`Emitter::le_escaped`]).
//!
//! To add one: write `light/<name>.rs` implementing [`Emitter`] and add one word to `lights!` below; the contract tests
//! run over the whole list.
mod area;
mod directional;
mod environment;
mod goniometric;
mod panorama;
mod point;
mod projection;
mod spot;
mod sun;
mod table;

pub use area::{AreaLight, Sides};
pub use directional::DirectionalLight;
pub use environment::{EnvironmentError, EnvironmentLight};
pub use goniometric::GoniometricLight;
pub use point::PointLight;
pub use projection::{ProjectionError, ProjectionLight};
pub use spot::{Rim, SpotError, SpotLight};
pub use sun::SunLight;
pub use table::LightTable;

use crate::{
    math::{Frame, Ray, offset_origin, warp::square_to_disk},
    shape::AreaSample,
    spectrum::{Rgb, Spectrum, Wavelengths},
};
use glam::{Vec2, Vec3};
use std::f32::consts::PI;

/// Handle of a light of the scene.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct LightId(pub u32);

/// What a light may know of the world it shines into.
#[derive(Clone, Copy, Debug)]
pub struct Surroundings {
    /// Centre of a sphere that holds the whole scene.
    pub centre: Vec3,
    /// Its radius, > 0.
    pub radius: f32,
    /// What the lanes mean in this pass.
    pub lambda: Wavelengths,
}

impl Surroundings {
    /// Area (m²) of a disk across the sphere: what parallel light falls through on its way into the scene.
    pub fn disk_area(&self) -> f32 {
        PI * self.radius * self.radius
    }
    /// A ray along the unit direction `d` that starts just outside the sphere, uniform over the disk across `d`.
    #[inline]
    pub fn ray_from_outside(&self, d: Vec3, u: Vec2) -> Ray {
        let o = across(self.centre, self.radius, d, u) - 1.001 * self.radius * d;
        Ray { o, d, tmin: 0.0, tmax: f32::INFINITY }
    }
    /// A ray along `d` that starts outside the sphere on the line through `p`.
    #[inline]
    pub fn ray_from_outside_through(&self, d: Vec3, p: Vec3) -> Ray {
        // Back to the plane that touches the sphere.
        let o = p - ((p - self.centre).dot(d) + 1.001 * self.radius) * d;
        Ray { o, d, tmin: 0.0, tmax: f32::INFINITY }
    }
}

/// A point uniform over the disk of `radius` around `centre` across the unit direction `d`.
#[inline]
pub(crate) fn across(centre: Vec3, radius: f32, d: Vec3, u: Vec2) -> Vec3 {
    let on_disk = radius * square_to_disk(u);
    let frame = Frame::from_normal(d);
    centre + on_disk.x * frame.s + on_disk.y * frame.t
}

/// Where a connection to a light ends, or a ray starts; what a shadow ray needs to know.
#[derive(Clone, Copy, Debug)]
pub enum LightEnd {
    /// On an emitting surface.
    Surface(AreaSample),
    /// At a point without extent.
    Point(Vec3),
    /// Outside the scene, in the direction `wi`.
    Infinite,
}

impl LightEnd {
    /// Where it is, if it is somewhere.
    #[inline]
    pub fn place(&self) -> Option<Vec3> {
        match self {
            Self::Surface(q) => Some(q.p),
            Self::Point(p) => Some(*p),
            Self::Infinite => None,
        }
    }
}

/// A direction from which a light reaches a point.
#[derive(Clone, Copy, Debug)]
pub struct LiSample {
    /// Unit direction from the point to the light.
    pub wi: Vec3,
    /// Radiance arriving along it, were nothing in between; for a delta light, irradiance perpendicular to `wi`.
    pub li: Spectrum,
    /// Density of `wi` (1/sr); 1 for a delta light.
    pub pdf: f32,
    /// The light cannot be hit by a ray: no other technique finds this contribution.
    pub delta: bool,
    /// The far end.
    pub end: LightEnd,
}

/// A ray leaving a light.
#[derive(Clone, Copy, Debug)]
pub struct LeSample {
    /// Origin and unit direction; already off the emitting surface.
    pub ray: Ray,
    /// Emitted radiance; intensity (W/sr) of a light without extent, irradiance of one without solid angle.
    pub le: Spectrum,
    /// Density of the origin (1/m²); 1 for a light without extent.
    pub pdf_area: f32,
    /// Density of the direction (1/sr); 1 for a light without solid angle.
    pub pdf_dir: f32,
    /// |cos| at the emitting surface; 1 where there is none.
    pub cos: f32,
    /// What was left.
    pub origin: LeOrigin,
}

/// What an emitted ray leaves.
#[derive(Clone, Copy, Debug)]
pub enum LeOrigin {
    /// An emitting surface.
    Surface(EmitterHit),
    /// A point without extent.
    Point,
    /// The space outside the scene.
    Infinite,
}

impl LeSample {
    /// The flux (W) that this ray stands for: `Le |cos θ| / (pdf_area · pdf_dir)`.
    #[inline]
    pub fn flux(&self) -> Spectrum {
        self.le * (self.cos / (self.pdf_area * self.pdf_dir))
    }
}

/// A point of an emitting surface, met by a ray.
#[derive(Clone, Copy, Debug)]
pub struct EmitterHit {
    /// Position.
    pub p: Vec3,
    /// Geometric normal, unit, on the outer side.
    pub ng: Vec3,
}

/// The contract of every light, and by itself that of lights which no ray can hit; checked for each in `tests/light_contract.rs`.
pub trait Emitter {
    /// Word for messages and summaries.
    fn name(&self) -> &'static str;
    /// Total emitted flux (W); for lights outside the scene, what enters the disk of the scene's radius.
    fn power(&self, around: &Surroundings) -> Rgb;
    /// Draws a direction in which the light is seen from `from`; `None` if it sends nothing there.
    fn sample_li(&self, from: Vec3, u: Vec2, around: &Surroundings) -> Option<LiSample>;
    /// Density (1/sr) with which [`Emitter::sample_li`] draws the direction `wi` toward `hit` (`None`: toward infinity).
    fn pdf_li(&self, _from: Vec3, _wi: Vec3, _hit: Option<&EmitterHit>) -> f32 {
        0.0
    }
    /// Draws an emitted ray.
    fn sample_le(&self, u_area: Vec2, u_dir: Vec2, around: &Surroundings) -> Option<LeSample>;
    /// Draws where a ray starts, as [`Emitter::sample_le`] does.
    fn start_le(&self, _u_area: Vec2) -> LightEnd {
        LightEnd::Infinite
    }
    /// The ray that leaves `start` in the unit direction `d`, with the densities of [`Emitter::sample_le`]. `None` where
    /// nothing is emitted, and for light from infinity, whose rays have no start of their own.
    fn le_along(&self, _start: &LightEnd, _d: Vec3, _around: &Surroundings) -> Option<LeSample> {
        None
    }
    /// Densities `(pdf_area, pdf_dir)` with which [`Emitter::sample_le`] emits in direction `d` from `hit` (`None` for a
    /// light without a surface), in the convention of [`LeSample`]; zero where it never would.
    fn pdf_le(&self, hit: Option<&EmitterHit>, d: Vec3, around: &Surroundings) -> (f32, f32);
    /// Radiance leaving the emitting surface at `hit` in direction `wo`. Black for lights without a surface.
    fn le(&self, _hit: &EmitterHit, _wo: Vec3, _lambda: Wavelengths) -> Spectrum {
        Spectrum::BLACK
    }
    /// Radiance seen by a ray that leaves the scene in direction `d`. Black for lights inside the scene.
    fn le_escaped(&self, _d: Vec3, _lambda: Wavelengths) -> Spectrum {
        Spectrum::BLACK
    }
    /// Whether rays that leave the scene see this light.
    fn is_infinite(&self) -> bool {
        false
    }
    /// Whether no ray can hit it.
    fn is_delta(&self) -> bool;
}

/// Declares the closed set of lights and forwards every [`Emitter`] method to them.
macro_rules! lights {
    ($($variant:ident($light:ident)),* $(,)?) => {
        /// One of the models of this room.
        #[derive(Clone, Debug)]
        pub enum Light { $(#[doc = concat!("See [`", stringify!($light), "`].")] $variant($light)),* }
        $(impl From<$light> for Light { fn from(l: $light) -> Self { Self::$variant(l) } })*
        impl Emitter for Light {
            fn name(&self) -> &'static str {
                match self { $(Self::$variant(l) => l.name()),* }
            }
            fn power(&self, around: &Surroundings) -> Rgb {
                match self { $(Self::$variant(l) => l.power(around)),* }
            }
            #[inline]
            fn sample_li(&self, from: Vec3, u: Vec2, around: &Surroundings) -> Option<LiSample> {
                match self { $(Self::$variant(l) => l.sample_li(from, u, around)),* }
            }
            #[inline]
            fn pdf_li(&self, from: Vec3, wi: Vec3, hit: Option<&EmitterHit>) -> f32 {
                match self { $(Self::$variant(l) => l.pdf_li(from, wi, hit)),* }
            }
            #[inline]
            fn sample_le(&self, u_area: Vec2, u_dir: Vec2, around: &Surroundings) -> Option<LeSample> {
                match self { $(Self::$variant(l) => l.sample_le(u_area, u_dir, around)),* }
            }
            #[inline]
            fn start_le(&self, u_area: Vec2) -> LightEnd {
                match self { $(Self::$variant(l) => l.start_le(u_area)),* }
            }
            #[inline]
            fn le_along(&self, start: &LightEnd, d: Vec3, around: &Surroundings) -> Option<LeSample> {
                match self { $(Self::$variant(l) => l.le_along(start, d, around)),* }
            }
            #[inline]
            fn pdf_le(&self, hit: Option<&EmitterHit>, d: Vec3, around: &Surroundings) -> (f32, f32) {
                match self { $(Self::$variant(l) => l.pdf_le(hit, d, around)),* }
            }
            #[inline]
            fn le(&self, hit: &EmitterHit, wo: Vec3, lambda: Wavelengths) -> Spectrum {
                match self { $(Self::$variant(l) => l.le(hit, wo, lambda)),* }
            }
            #[inline]
            fn le_escaped(&self, d: Vec3, lambda: Wavelengths) -> Spectrum {
                match self { $(Self::$variant(l) => l.le_escaped(d, lambda)),* }
            }
            #[inline]
            fn is_infinite(&self) -> bool {
                match self { $(Self::$variant(l) => l.is_infinite()),* }
            }
            #[inline]
            fn is_delta(&self) -> bool {
                match self { $(Self::$variant(l) => l.is_delta()),* }
            }
        }
    };
}

lights![
    Area(AreaLight),
    Point(PointLight),
    Spot(SpotLight),
    Directional(DirectionalLight),
    Environment(EnvironmentLight),
    Goniometric(GoniometricLight),
    Projection(ProjectionLight),
    Sun(SunLight),
];

impl AreaSample {
    /// A ray from this point in direction `d`, starting off the surface.
    #[inline]
    pub(crate) fn emit(&self, d: Vec3) -> Ray {
        Ray { o: offset_origin(self.p, self.p_error, self.ng, d), d, tmin: 0.0, tmax: f32::INFINITY }
    }
}
