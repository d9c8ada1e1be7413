//! What may stand where in the JSON: kinds of values, ranges, what must be there, and references to what exists.
//!
//! The rules are tables, in [`tables`] and [`extensions`], after the JSON schemas of the glTF 2.0 specification and of
//! its extensions (Khronos glTF registry); `walk` compares a file with them.

mod extensions;
mod tables;
mod walk;

pub(super) use walk::check;

/// What a value must be.
#[derive(Clone, Copy)]
enum Kind {
    /// True or false.
    Flag,
    /// A text.
    Text,
    /// A text, usually one of these; others are odd.
    Word(&'static [&'static str]),
    /// A whole number, usually one of these; others are odd.
    Code(&'static [u64]),
    /// A whole number from the first to the second.
    Whole(u64, u64),
    /// A number in a range.
    Number(Range),
    /// The index of an element of that list of the file.
    Index(&'static str),
    /// An object with these properties.
    Object(&'static Schema),
    /// An object whose properties are free to name and all of one kind.
    Map(&'static Kind),
    /// A list.
    List(&'static Kind, Length),
}

/// How many elements a list may have; an empty list is never right.
#[derive(Clone, Copy)]
enum Length {
    Any,
    Exactly(usize),
    /// Any number of elements, each but once.
    Distinct,
}

/// From `low` (left out if `is_open`) to `high`.
#[derive(Clone, Copy)]
struct Range {
    low: f64,
    is_open: bool,
    high: f64,
}

/// A property of an object.
struct Property {
    name: &'static str,
    kind: Kind,
    is_required: bool,
}

/// The properties of an object, besides `extensions` and `extras`.
struct Schema {
    properties: &'static [Property],
    /// Extensions that may stand here, with what they hold.
    extensions: &'static [(&'static str, &'static Schema)],
}

const fn must(name: &'static str, kind: Kind) -> Property {
    Property { name, kind, is_required: true }
}

const fn may(name: &'static str, kind: Kind) -> Property {
    Property { name, kind, is_required: false }
}

/// Every number.
const REAL: Kind = Kind::Number(Range { low: f64::NEG_INFINITY, is_open: false, high: f64::INFINITY });
/// From 0 to 1.
const UNIT: Kind = Kind::Number(Range { low: 0.0, is_open: false, high: 1.0 });
/// 0 or more.
const POSITIVE_OR_ZERO: Kind = Kind::Number(Range { low: 0.0, is_open: false, high: f64::INFINITY });
/// More than 0.
const POSITIVE: Kind = Kind::Number(Range { low: 0.0, is_open: true, high: f64::INFINITY });
/// A whole number of 0 or more.
const COUNT: Kind = Kind::Whole(0, u64::MAX);
/// A whole number of 1 or more.
const SOME: Kind = Kind::Whole(1, u64::MAX);

/// The extensions that this reader understands; of these, a file may require any.
pub(super) const UNDERSTOOD: &[&str] = &[
    "EXT_mesh_gpu_instancing",
    "EXT_meshopt_compression",
    "EXT_texture_webp",
    "KHR_draco_mesh_compression",
    "KHR_lights_punctual",
    "KHR_materials_anisotropy",
    "KHR_materials_clearcoat",
    "KHR_materials_dispersion",
    "KHR_materials_emissive_strength",
    "KHR_materials_ior",
    "KHR_materials_iridescence",
    "KHR_materials_pbrSpecularGlossiness",
    "KHR_materials_sheen",
    "KHR_materials_specular",
    "KHR_materials_transmission",
    "KHR_materials_unlit",
    "KHR_materials_variants",
    "KHR_materials_volume",
    "KHR_mesh_quantization",
    "KHR_meshopt_compression",
    "KHR_texture_basisu",
    "KHR_texture_transform",
];
