//! The words of the format.

/// Elements that are objects. `luminaire` and `camera` are names of version 0.3.
pub(super) const OBJECTS: [&str; 17] = [
    "bsdf",
    "camera",
    "emitter",
    "film",
    "integrator",
    "luminaire",
    "medium",
    "phase",
    "ref",
    "rfilter",
    "sampler",
    "scene",
    "sensor",
    "shape",
    "subsurface",
    "texture",
    "volume",
];

/// Elements that are values.
pub(super) const VALUES: [&str; 14] = [
    "animation",
    "blackbody",
    "boolean",
    "float",
    "integer",
    "matrix",
    "point",
    "rgb",
    "spectrum",
    "srgb",
    "string",
    "tensor",
    "transform",
    "vector",
];

/// Elements that steer reading.
pub(super) const STEERING: [&str; 5] = ["alias", "default", "include", "path", "resource"];

/// Steps of a transformation.
pub(super) const STEPS: [&str; 6] = ["lookat", "matrix", "rotate", "scale", "translate", "look_at"];

/// The name of version 3 for an element.
pub(super) fn modern(tag: &str) -> &str {
    match tag {
        "luminaire" => "emitter",
        "camera" => "sensor",
        "lookAt" | "look_at" => "lookat",
        _ => tag,
    }
}

/// Whether an element of that kind means something.
pub(super) fn is_known(tag: &str) -> bool {
    [&OBJECTS[..], &VALUES[..], &STEERING[..], &STEPS[..]].iter().any(|list| list.contains(&tag))
}

/// All kinds of elements.
pub(super) fn all() -> impl Iterator<Item = &'static str> {
    [&OBJECTS[..], &VALUES[..], &STEERING[..], &STEPS[..]].into_iter().flatten().copied()
}
