//! The words that begin a directive.

const DIRECTIVES: [&str; 36] = [
    "Accelerator",
    "ActiveTransform",
    "AreaLightSource",
    "Attribute",
    "AttributeBegin",
    "AttributeEnd",
    "Camera",
    "ColorSpace",
    "ConcatTransform",
    "CoordSysTransform",
    "CoordinateSystem",
    "Film",
    "Identity",
    "Import",
    "Include",
    "Integrator",
    "LightSource",
    "LookAt",
    "MakeNamedMaterial",
    "MakeNamedMedium",
    "Material",
    "MediumInterface",
    "NamedMaterial",
    "ObjectBegin",
    "ObjectEnd",
    "ObjectInstance",
    "Option",
    "PixelFilter",
    "ReverseOrientation",
    "Rotate",
    "Sampler",
    "Scale",
    "Shape",
    "Texture",
    "Transform",
    "Translate",
];

/// Halves of pairs, and words of version 3.
const MORE_DIRECTIVES: [&str; 6] =
    ["TransformBegin", "TransformEnd", "TransformTimes", "WorldBegin", "WorldEnd", "SurfaceIntegrator"];

/// Every directive of both versions.
pub(super) fn all() -> impl Iterator<Item = &'static str> {
    DIRECTIVES.into_iter().chain(MORE_DIRECTIVES)
}

/// Whether `word` begins a directive.
pub(super) fn is_directive(word: &str) -> bool {
    DIRECTIVES.contains(&word) || MORE_DIRECTIVES.contains(&word)
}
