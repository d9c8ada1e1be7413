//! Extensions, by where they stand.

use super::Kind::{Index, List, Map, Number, Object, Text, Whole, Word};
use super::tables::{NORMAL_INFO, TEXTURE_INFO};
use super::{COUNT, Length, POSITIVE, POSITIVE_OR_ZERO, REAL, Range, SOME, Schema, UNIT, may, must};
use std::f64::consts::FRAC_PI_2;

const EMPTY: Schema = Schema { properties: &[], extensions: &[] };
const TEXTURE: super::Kind = Object(&TEXTURE_INFO);
const RGB: super::Kind = List(&UNIT, Length::Exactly(3));

pub(super) const MATERIAL_EXTENSIONS: &[(&str, &Schema)] = &[
    ("KHR_materials_anisotropy", &ANISOTROPY),
    ("KHR_materials_clearcoat", &CLEARCOAT),
    ("KHR_materials_dispersion", &Schema { properties: &[may("dispersion", POSITIVE_OR_ZERO)], extensions: &[] }),
    (
        "KHR_materials_emissive_strength",
        &Schema { properties: &[may("emissiveStrength", POSITIVE_OR_ZERO)], extensions: &[] },
    ),
    ("KHR_materials_ior", &Schema { properties: &[may("ior", POSITIVE_OR_ZERO)], extensions: &[] }),
    ("KHR_materials_iridescence", &IRIDESCENCE),
    ("KHR_materials_pbrSpecularGlossiness", &SPECULAR_GLOSSINESS),
    ("KHR_materials_sheen", &SHEEN),
    ("KHR_materials_specular", &SPECULAR),
    (
        "KHR_materials_transmission",
        &Schema {
            properties: &[may("transmissionFactor", UNIT), may("transmissionTexture", TEXTURE)],
            extensions: &[],
        },
    ),
    ("KHR_materials_unlit", &EMPTY),
    ("KHR_materials_volume", &VOLUME),
];

const ANISOTROPY: Schema = Schema {
    properties: &[may("anisotropyStrength", UNIT), may("anisotropyRotation", REAL), may("anisotropyTexture", TEXTURE)],
    extensions: &[],
};

const CLEARCOAT: Schema = Schema {
    properties: &[
        may("clearcoatFactor", UNIT),
        may("clearcoatTexture", TEXTURE),
        may("clearcoatRoughnessFactor", UNIT),
        may("clearcoatRoughnessTexture", TEXTURE),
        may("clearcoatNormalTexture", Object(&NORMAL_INFO)),
    ],
    extensions: &[],
};

const IRIDESCENCE: Schema = Schema {
    properties: &[
        may("iridescenceFactor", UNIT),
        may("iridescenceTexture", TEXTURE),
        may("iridescenceIor", Number(Range { low: 1.0, is_open: false, high: f64::INFINITY })),
        may("iridescenceThicknessMinimum", POSITIVE_OR_ZERO),
        may("iridescenceThicknessMaximum", POSITIVE_OR_ZERO),
        may("iridescenceThicknessTexture", TEXTURE),
    ],
    extensions: &[],
};

const SHEEN: Schema = Schema {
    properties: &[
        may("sheenColorFactor", RGB),
        may("sheenColorTexture", TEXTURE),
        may("sheenRoughnessFactor", UNIT),
        may("sheenRoughnessTexture", TEXTURE),
    ],
    extensions: &[],
};

const SPECULAR: Schema = Schema {
    properties: &[
        may("specularFactor", UNIT),
        may("specularTexture", TEXTURE),
        may("specularColorFactor", List(&POSITIVE_OR_ZERO, Length::Exactly(3))),
        may("specularColorTexture", TEXTURE),
    ],
    extensions: &[],
};

const SPECULAR_GLOSSINESS: Schema = Schema {
    properties: &[
        may("diffuseFactor", List(&UNIT, Length::Exactly(4))),
        may("diffuseTexture", TEXTURE),
        may("specularFactor", RGB),
        may("glossinessFactor", UNIT),
        may("specularGlossinessTexture", TEXTURE),
    ],
    extensions: &[],
};

const VOLUME: Schema = Schema {
    properties: &[
        may("thicknessFactor", POSITIVE_OR_ZERO),
        may("thicknessTexture", TEXTURE),
        may("attenuationDistance", POSITIVE),
        may("attenuationColor", RGB),
    ],
    extensions: &[],
};

pub(super) const TEXTURE_TRANSFORM: Schema = Schema {
    properties: &[
        may("offset", List(&REAL, Length::Exactly(2))),
        may("rotation", REAL),
        may("scale", List(&REAL, Length::Exactly(2))),
        may("texCoord", COUNT),
    ],
    extensions: &[],
};

pub(super) const TEXTURE_SOURCE: Schema = Schema { properties: &[may("source", Index("images"))], extensions: &[] };

pub(super) const LIGHTS: Schema =
    Schema { properties: &[must("lights", List(&Object(&LIGHT), Length::Any))], extensions: &[] };

const LIGHT: Schema = Schema {
    properties: &[
        may("name", Text),
        may("color", RGB),
        may("intensity", POSITIVE_OR_ZERO),
        may("range", POSITIVE),
        may("spot", Object(&SPOT)),
        must("type", Word(&["directional", "point", "spot"])),
    ],
    extensions: &[],
};

const SPOT: Schema = Schema {
    properties: &[
        may("innerConeAngle", Number(Range { low: 0.0, is_open: false, high: FRAC_PI_2 })),
        may("outerConeAngle", Number(Range { low: 0.0, is_open: true, high: FRAC_PI_2 })),
    ],
    extensions: &[],
};

pub(super) const NODE_LIGHT: Schema =
    Schema { properties: &[must("light", Index("KHR_lights_punctual.lights"))], extensions: &[] };

pub(super) const INSTANCING: Schema =
    Schema { properties: &[must("attributes", Map(&Index("accessors")))], extensions: &[] };

pub(super) const DRACO: Schema = Schema {
    properties: &[must("bufferView", Index("bufferViews")), must("attributes", Map(&COUNT))],
    extensions: &[],
};

pub(super) const VARIANTS: Schema =
    Schema { properties: &[must("variants", List(&Object(&VARIANT), Length::Any))], extensions: &[] };

const VARIANT: Schema = Schema { properties: &[must("name", Text)], extensions: &[] };

pub(super) const PRIMITIVE_VARIANTS: Schema =
    Schema { properties: &[must("mappings", List(&Object(&MAPPING), Length::Any))], extensions: &[] };

const MAPPING: Schema = Schema {
    properties: &[
        must("material", Index("materials")),
        must("variants", List(&Index("KHR_materials_variants.variants"), Length::Distinct)),
        may("name", Text),
    ],
    extensions: &[],
};

pub(super) const MESHOPT_BUFFER: Schema = Schema { properties: &[may("fallback", super::Kind::Flag)], extensions: &[] };

pub(super) const MESHOPT_VIEW: Schema = Schema {
    properties: &[
        must("buffer", Index("buffers")),
        may("byteOffset", COUNT),
        must("byteLength", SOME),
        must("byteStride", Whole(2, 256)),
        must("count", SOME),
        must("mode", Word(&["ATTRIBUTES", "TRIANGLES", "INDICES"])),
        may("filter", Word(&["NONE", "OCTAHEDRAL", "QUATERNION", "EXPONENTIAL", "COLOR"])),
    ],
    extensions: &[],
};

pub(super) const ANIMATION_POINTER: Schema = Schema { properties: &[must("pointer", Text)], extensions: &[] };
