//! The core of glTF 2.0.

use super::Kind::{Code, Flag, Index, List, Map, Number, Object, Text, Whole, Word};
use super::extensions as ext;
use super::{COUNT, Length, POSITIVE, POSITIVE_OR_ZERO, REAL, Range, SOME, Schema, UNIT, may, must};

const NAME: super::Property = may("name", Text);
const COMPONENT_TYPES: &[u64] = &[5120, 5121, 5122, 5123, 5125, 5126];

pub(super) const ROOT: Schema = Schema {
    properties: &[
        must("asset", Object(&ASSET)),
        may("scene", Index("scenes")),
        may("scenes", List(&Object(&SCENE), Length::Any)),
        may("nodes", List(&Object(&NODE), Length::Any)),
        may("meshes", List(&Object(&MESH), Length::Any)),
        may("accessors", List(&Object(&ACCESSOR), Length::Any)),
        may("buffers", List(&Object(&BUFFER), Length::Any)),
        may("bufferViews", List(&Object(&BUFFER_VIEW), Length::Any)),
        may("cameras", List(&Object(&CAMERA), Length::Any)),
        may("images", List(&Object(&IMAGE), Length::Any)),
        may("materials", List(&Object(&MATERIAL), Length::Any)),
        may("samplers", List(&Object(&SAMPLER), Length::Any)),
        may("skins", List(&Object(&SKIN), Length::Any)),
        may("textures", List(&Object(&TEXTURE), Length::Any)),
        may("animations", List(&Object(&ANIMATION), Length::Any)),
        may("extensionsUsed", List(&Text, Length::Distinct)),
        may("extensionsRequired", List(&Text, Length::Distinct)),
    ],
    extensions: &[("KHR_lights_punctual", &ext::LIGHTS), ("KHR_materials_variants", &ext::VARIANTS)],
};

const ASSET: Schema = Schema {
    properties: &[must("version", Text), may("minVersion", Text), may("generator", Text), may("copyright", Text)],
    extensions: &[],
};

const SCENE: Schema =
    Schema { properties: &[NAME, may("nodes", List(&Index("nodes"), Length::Distinct))], extensions: &[] };

const NODE: Schema = Schema {
    properties: &[
        NAME,
        may("camera", Index("cameras")),
        may("children", List(&Index("nodes"), Length::Distinct)),
        may("skin", Index("skins")),
        may("matrix", List(&REAL, Length::Exactly(16))),
        may("mesh", Index("meshes")),
        may("rotation", List(&Number(Range { low: -1.0, is_open: false, high: 1.0 }), Length::Exactly(4))),
        may("scale", List(&REAL, Length::Exactly(3))),
        may("translation", List(&REAL, Length::Exactly(3))),
        may("weights", List(&REAL, Length::Any)),
    ],
    extensions: &[("KHR_lights_punctual", &ext::NODE_LIGHT), ("EXT_mesh_gpu_instancing", &ext::INSTANCING)],
};

const MESH: Schema = Schema {
    properties: &[
        NAME,
        must("primitives", List(&Object(&PRIMITIVE), Length::Any)),
        may("weights", List(&REAL, Length::Any)),
    ],
    extensions: &[],
};

const ATTRIBUTES: super::Kind = Map(&Index("accessors"));

const PRIMITIVE: Schema = Schema {
    properties: &[
        must("attributes", ATTRIBUTES),
        may("indices", Index("accessors")),
        may("material", Index("materials")),
        may("mode", Code(&[0, 1, 2, 3, 4, 5, 6])),
        may("targets", List(&ATTRIBUTES, Length::Any)),
    ],
    extensions: &[("KHR_draco_mesh_compression", &ext::DRACO), ("KHR_materials_variants", &ext::PRIMITIVE_VARIANTS)],
};

const ACCESSOR: Schema = Schema {
    properties: &[
        NAME,
        may("bufferView", Index("bufferViews")),
        may("byteOffset", COUNT),
        must("componentType", Code(COMPONENT_TYPES)),
        may("normalized", Flag),
        must("count", SOME),
        must("type", Word(&["SCALAR", "VEC2", "VEC3", "VEC4", "MAT2", "MAT3", "MAT4"])),
        may("max", List(&REAL, Length::Any)),
        may("min", List(&REAL, Length::Any)),
        may("sparse", Object(&SPARSE)),
    ],
    extensions: &[],
};

const SPARSE: Schema = Schema {
    properties: &[
        must("count", SOME),
        must("indices", Object(&SPARSE_INDICES)),
        must("values", Object(&SPARSE_VALUES)),
    ],
    extensions: &[],
};

const SPARSE_INDICES: Schema = Schema {
    properties: &[
        must("bufferView", Index("bufferViews")),
        may("byteOffset", COUNT),
        must("componentType", Code(&[5121, 5123, 5125])),
    ],
    extensions: &[],
};

const SPARSE_VALUES: Schema =
    Schema { properties: &[must("bufferView", Index("bufferViews")), may("byteOffset", COUNT)], extensions: &[] };

const BUFFER: Schema = Schema {
    properties: &[NAME, may("uri", Text), must("byteLength", SOME)],
    extensions: &[("EXT_meshopt_compression", &ext::MESHOPT_BUFFER), ("KHR_meshopt_compression", &ext::MESHOPT_BUFFER)],
};

const BUFFER_VIEW: Schema = Schema {
    properties: &[
        NAME,
        must("buffer", Index("buffers")),
        may("byteOffset", COUNT),
        must("byteLength", SOME),
        may("byteStride", Whole(4, 252)),
        may("target", Code(&[34962, 34963])),
    ],
    extensions: &[("EXT_meshopt_compression", &ext::MESHOPT_VIEW), ("KHR_meshopt_compression", &ext::MESHOPT_VIEW)],
};

const CAMERA: Schema = Schema {
    properties: &[
        NAME,
        must("type", Word(&["perspective", "orthographic"])),
        may("orthographic", Object(&ORTHOGRAPHIC)),
        may("perspective", Object(&PERSPECTIVE)),
    ],
    extensions: &[],
};

const ORTHOGRAPHIC: Schema = Schema {
    properties: &[must("xmag", REAL), must("ymag", REAL), must("zfar", POSITIVE), must("znear", POSITIVE_OR_ZERO)],
    extensions: &[],
};

const PERSPECTIVE: Schema = Schema {
    properties: &[may("aspectRatio", POSITIVE), must("yfov", POSITIVE), may("zfar", POSITIVE), must("znear", POSITIVE)],
    extensions: &[],
};

const IMAGE: Schema = Schema {
    properties: &[NAME, may("uri", Text), may("mimeType", Text), may("bufferView", Index("bufferViews"))],
    extensions: &[],
};

const SAMPLER: Schema = Schema {
    properties: &[
        NAME,
        may("magFilter", Code(&[9728, 9729])),
        may("minFilter", Code(&[9728, 9729, 9984, 9985, 9986, 9987])),
        may("wrapS", Code(&[33071, 33648, 10497])),
        may("wrapT", Code(&[33071, 33648, 10497])),
    ],
    extensions: &[],
};

const TEXTURE: Schema = Schema {
    properties: &[NAME, may("sampler", Index("samplers")), may("source", Index("images"))],
    extensions: &[("EXT_texture_webp", &ext::TEXTURE_SOURCE), ("KHR_texture_basisu", &ext::TEXTURE_SOURCE)],
};

/// What points to a texture.
pub(super) const TEXTURE_INFO: Schema = Schema {
    properties: &[must("index", Index("textures")), may("texCoord", COUNT)],
    extensions: &[("KHR_texture_transform", &ext::TEXTURE_TRANSFORM)],
};

/// What points to a texture of normals.
pub(super) const NORMAL_INFO: Schema = Schema {
    properties: &[must("index", Index("textures")), may("texCoord", COUNT), may("scale", REAL)],
    extensions: &[("KHR_texture_transform", &ext::TEXTURE_TRANSFORM)],
};

const OCCLUSION_INFO: Schema = Schema {
    properties: &[must("index", Index("textures")), may("texCoord", COUNT), may("strength", UNIT)],
    extensions: &[("KHR_texture_transform", &ext::TEXTURE_TRANSFORM)],
};

const MATERIAL: Schema = Schema {
    properties: &[
        NAME,
        may("pbrMetallicRoughness", Object(&METALLIC_ROUGHNESS)),
        may("normalTexture", Object(&NORMAL_INFO)),
        may("occlusionTexture", Object(&OCCLUSION_INFO)),
        may("emissiveTexture", Object(&TEXTURE_INFO)),
        may("emissiveFactor", List(&UNIT, Length::Exactly(3))),
        may("alphaMode", Word(&["OPAQUE", "MASK", "BLEND"])),
        may("alphaCutoff", POSITIVE_OR_ZERO),
        may("doubleSided", Flag),
    ],
    extensions: ext::MATERIAL_EXTENSIONS,
};

const METALLIC_ROUGHNESS: Schema = Schema {
    properties: &[
        may("baseColorFactor", List(&UNIT, Length::Exactly(4))),
        may("baseColorTexture", Object(&TEXTURE_INFO)),
        may("metallicFactor", UNIT),
        may("roughnessFactor", UNIT),
        may("metallicRoughnessTexture", Object(&TEXTURE_INFO)),
    ],
    extensions: &[],
};

const SKIN: Schema = Schema {
    properties: &[
        NAME,
        may("inverseBindMatrices", Index("accessors")),
        may("skeleton", Index("nodes")),
        must("joints", List(&Index("nodes"), Length::Distinct)),
    ],
    extensions: &[],
};

const ANIMATION: Schema = Schema {
    properties: &[
        NAME,
        must("channels", List(&Object(&CHANNEL), Length::Any)),
        must("samplers", List(&Object(&ANIMATION_SAMPLER), Length::Any)),
    ],
    extensions: &[],
};

const CHANNEL: Schema =
    Schema { properties: &[must("sampler", COUNT), must("target", Object(&CHANNEL_TARGET))], extensions: &[] };

const CHANNEL_TARGET: Schema = Schema {
    properties: &[
        may("node", Index("nodes")),
        must("path", Word(&["translation", "rotation", "scale", "weights", "pointer"])),
    ],
    extensions: &[("KHR_animation_pointer", &ext::ANIMATION_POINTER)],
};

const ANIMATION_SAMPLER: Schema = Schema {
    properties: &[
        must("input", Index("accessors")),
        may("interpolation", Word(&["LINEAR", "STEP", "CUBICSPLINE"])),
        must("output", Index("accessors")),
    ],
    extensions: &[],
};
