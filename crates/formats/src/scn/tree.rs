//! What an `.scn` file says, before it becomes a scene.

use crate::diagnostic::Span;
use glam::Vec3;

/// A value and where it was written.
#[derive(Clone, Debug, PartialEq)]
pub struct Spanned<T> {
    /// The value.
    pub value: T,
    /// Its place in the file.
    pub span: Span,
}

/// All sections of one file, merged by kind.
#[derive(Clone, Debug, Default)]
pub struct ScnFile {
    /// Materials in the order of the file; their names are unique.
    pub materials: Vec<ScnMaterial>,
    /// Models in the order of the file; names may repeat.
    pub models: Vec<ScnModel>,
    /// Lights in the order of the file.
    pub lights: Vec<ScnLight>,
}

/// A `Material` line and its `Prop` lines.
#[derive(Clone, Debug)]
pub struct ScnMaterial {
    /// The name.
    pub name: Spanned<String>,
    /// The number behind the name, 0 if absent. Its meaning differs between forks of NRenderer.
    pub type_id: u32,
    /// Properties; keys are unique (the first of equal keys counts).
    pub props: Vec<ScnProp>,
}

impl ScnMaterial {
    /// The property of that key.
    pub fn prop(&self, key: &str) -> Option<&ScnProp> {
        self.props.iter().find(|p| p.key.value == key)
    }
}

/// One `Prop` line.
#[derive(Clone, Debug)]
pub struct ScnProp {
    /// The key, such as `diffuseColor`.
    pub key: Spanned<String>,
    /// Type and value.
    pub value: PropValue,
}

/// The value of a property: plain linear numbers.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum PropValue {
    /// `Int`.
    Int(i32),
    /// `Float`.
    Float(f32),
    /// `Vec3`.
    Vec3([f32; 3]),
    /// `Vec4`.
    Vec4([f32; 4]),
    /// `RGB`.
    Rgb([f32; 3]),
    /// `RGBA`.
    Rgba([f32; 4]),
}

impl PropValue {
    /// The type words of the format.
    pub const TYPES: [&'static str; 6] = ["Int", "Float", "Vec3", "Vec4", "RGB", "RGBA"];

    /// A number, or `None` for a colour or vector.
    pub fn as_number(self) -> Option<f32> {
        match self {
            Self::Int(i) => Some(i as f32),
            Self::Float(x) => Some(x),
            _ => None,
        }
    }

    /// Three numbers (the first three of four), or `None` for a single number.
    pub fn as_triple(self) -> Option<[f32; 3]> {
        match self {
            Self::Vec3(v) | Self::Rgb(v) => Some(v),
            Self::Vec4([x, y, z, _]) | Self::Rgba([x, y, z, _]) => Some([x, y, z]),
            _ => None,
        }
    }
}

/// A `Model` line with what follows it.
#[derive(Clone, Debug)]
pub struct ScnModel {
    /// The name; `undefined` if absent.
    pub name: Spanned<String>,
    /// World = local + translation.
    pub translation: Vec3,
    /// `Scale`, which NRenderer applies to its wire preview only.
    pub scale: Option<Spanned<Vec3>>,
    /// Spheres, triangles and planes in the order of the file.
    pub shapes: Vec<ScnShape>,
}

/// A shape of a model, in the model's space.
#[derive(Clone, Debug)]
pub struct ScnShape {
    /// The node's name.
    pub name: Spanned<String>,
    /// Index into [`ScnFile::materials`].
    pub material: usize,
    /// The geometry.
    pub kind: ShapeKind,
}

/// The geometry of a shape.
#[derive(Clone, Debug)]
pub enum ShapeKind {
    /// A sphere.
    Sphere(Sphere),
    /// A triangle.
    Triangle(Triangle),
    /// A parallelogram.
    Plane(Plane),
}

/// A sphere. NRenderer stores an axis too, which nothing uses.
#[derive(Clone, Debug, Default)]
pub struct Sphere {
    /// Centre.
    pub centre: Vec3,
    /// Radius; 0 if absent.
    pub radius: f32,
}

/// A triangle.
#[derive(Clone, Debug)]
pub struct Triangle {
    /// The vertices.
    pub vertices: [Vec3; 3],
    /// The stored normal, independent of the vertices.
    pub normal: Vec3,
}

/// A parallelogram.
#[derive(Clone, Debug)]
pub struct Plane {
    /// The corner `P`.
    pub corner: Vec3,
    /// The edge `U`.
    pub u: Vec3,
    /// The edge `V`.
    pub v: Vec3,
    /// The stored normal, independent of the edges.
    pub normal: Vec3,
}

/// The kinds of light.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum LightKind {
    /// Shines equally in all directions from a point.
    Point,
    /// Shines from a point into a cone.
    Spot,
    /// Shines from infinity along a direction.
    Directional,
    /// A parallelogram of constant radiance.
    Area,
}

impl LightKind {
    /// The word of the format.
    pub fn word(self) -> &'static str {
        match self {
            Self::Point => "Point",
            Self::Spot => "Spot",
            Self::Directional => "Directional",
            Self::Area => "Area",
        }
    }
}

/// A light in world space. Fields that its kind does not use keep their defaults.
#[derive(Clone, Debug)]
pub struct ScnLight {
    /// The kind.
    pub kind: LightKind,
    /// The name; `undefined` if absent.
    pub name: Spanned<String>,
    /// Point and spot: intensity (W/sr); directional: irradiance (W/m²); area: radiance (W/(m² sr)).
    pub irv: [f32; 3],
    /// `P`: position, or the corner of an area light.
    pub position: Vec3,
    /// `D`: where a directional or spot light shines.
    pub direction: Vec3,
    /// `U`: edge of an area light.
    pub u: Vec3,
    /// `V`: edge of an area light.
    pub v: Vec3,
    /// `HotSpot`: angle of the full-intensity cone, radians.
    pub hot_spot: f32,
    /// `Fallout`: angle at which a spot light ends, radians.
    pub fallout: f32,
}
