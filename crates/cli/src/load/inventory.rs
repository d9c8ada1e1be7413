//! What a scene is made of, piece by piece.
use serde::Serialize;
use std::mem::size_of;
use sunfleck::{
    bsdf::Material,
    scene::{MaterialId, Parts},
    shape::{Mesh, Shape},
    texture::Texture,
};

/// Materials, textures and memory.
#[derive(Clone, Debug, Default, Serialize)]
pub(crate) struct Inventory {
    pub(crate) materials: Vec<MaterialInfo>,
    pub(crate) textures: Vec<TextureInfo>,
    /// Objects that nothing places.
    pub(crate) unused_objects: usize,
    /// Memory of triangles and their vertices, before they are placed.
    pub(crate) geometry_bytes: usize,
    pub(crate) texture_bytes: usize,
}

/// A material.
#[derive(Clone, Debug, Serialize)]
pub(crate) struct MaterialInfo {
    /// What files call it.
    pub(crate) name: Option<String>,
    pub(crate) model: &'static str,
    /// Surfaces and other materials that use it.
    pub(crate) uses: usize,
}

/// A texture that is a picture or a pattern.
#[derive(Clone, Debug, Serialize)]
pub(crate) struct TextureInfo {
    pub(crate) kind: &'static str,
    /// Of a picture.
    pub(crate) size: Option<[usize; 2]>,
    /// Materials and other textures that use it.
    pub(crate) uses: usize,
}

impl Inventory {
    pub(super) fn new(parts: &Parts, names: &[(String, MaterialId)]) -> Self {
        let surfaces = || parts.surfaces.iter().chain(parts.objects.iter().flatten());
        let (mut by_surfaces, mut by_materials) = (vec![0; parts.materials.len()], vec![0; parts.textures.len()]);
        surfaces().for_each(|s| count(&mut by_surfaces, s.material.0));
        parts.materials.iter().flat_map(Material::parts).for_each(|id| count(&mut by_surfaces, id.0));
        parts.materials.iter().flat_map(Material::textures).for_each(|id| count(&mut by_materials, id.0));
        parts.textures.iter().flat_map(Texture::parts).for_each(|id| count(&mut by_materials, id.0));
        let name_of = |i: usize| names.iter().find(|(_, id)| id.0 as usize == i).map(|(name, _)| name.clone());
        let materials = parts.materials.iter().enumerate().map(|(i, m)| MaterialInfo {
            name: name_of(i),
            model: m.name(),
            uses: by_surfaces[i],
        });
        let textures = parts.textures.iter().zip(&by_materials).filter_map(|(t, &uses)| texture(t, uses));
        let mut placed = vec![0; parts.objects.len()];
        parts.instances.iter().for_each(|i| count(&mut placed, i.object.0));
        let shape_bytes = |s: &Shape| size_of::<Shape>() + if let Shape::Mesh(m) = s { mesh_bytes(m) } else { 0 };
        Self {
            materials: materials.collect(),
            textures: textures.collect(),
            unused_objects: placed.iter().filter(|n| **n == 0).count(),
            geometry_bytes: surfaces().map(|s| shape_bytes(&s.shape)).sum(),
            texture_bytes: parts.textures.iter().map(texture_bytes).sum(),
        }
    }
}

fn count(counts: &mut [usize], id: u32) {
    if let Some(n) = counts.get_mut(id as usize) {
        *n += 1;
    }
}

fn texture(t: &Texture, uses: usize) -> Option<TextureInfo> {
    let size = if let Texture::Image(image) = t { Some([image.width(), image.height()]) } else { None };
    let kind = match t {
        Texture::Constant(_) => return None,
        Texture::Image(_) => "picture",
        Texture::Checkerboard(_) | Texture::Dots(_) => "pattern",
        Texture::Noise(_) => "noise",
        _ => "composed",
    };
    Some(TextureInfo { kind, size, uses })
}

fn mesh_bytes(m: &Mesh) -> usize {
    size_of_val(m.positions()) + size_of_val(m.normals()) + size_of_val(m.uvs()) + size_of_val(m.indices())
}

fn texture_bytes(t: &Texture) -> usize {
    let pixels = if let Texture::Image(image) = t { image.width() * image.height() * size_of::<[f32; 3]>() } else { 0 };
    size_of::<Texture>() + pixels
}
