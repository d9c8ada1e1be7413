//! From MTL materials to sunfleck's models.

use super::{MtlMaterial, ObjFile};
use crate::diagnostic::{Diagnostic, SourceFile, Span};
use crate::image::read_image_bytes;
use crate::load::Target;
use glam::Vec3;
use std::collections::HashMap;
use std::path::{Path, PathBuf};
use std::rc::Rc;
use sunfleck::bsdf::{
    DielectricMaterial, DiffuseMaterial, MaskMaterial, Material, MirrorMaterial, NormalMapMaterial, PhongMaterial,
    Scalar,
};
use sunfleck::scene::{MaterialId, TextureId};
use sunfleck::texture::{ImageTexture, Texture, Wrap};

/// For faces without a material, and for materials that are not defined.
const DEFAULT_GREY: Vec3 = Vec3::splat(0.5);

/// Models of illumination with refraction, by the MTL specification.
const REFRACTING: [u32; 4] = [4, 6, 7, 9];

/// Models of illumination with mirror reflection.
const REFLECTING: [u32; 3] = [3, 5, 8];

/// Where a file names a material.
pub(super) type Place<'s> = (&'s SourceFile, Span);

/// What faces send out, to their outer side.
#[derive(Clone)]
pub(super) enum Glow {
    /// Nothing.
    Nothing,
    /// The same radiance everywhere.
    Even(Vec3),
    /// The radiance that a picture shows.
    Picture(Rc<ImageTexture>),
}

/// Makes each material once.
pub(super) struct Appearances<'t> {
    tree: &'t ObjFile,
    by_name: HashMap<&'t str, &'t MtlMaterial>,
    folder: &'t Path,
    made: HashMap<Option<usize>, (MaterialId, Glow)>,
    pictures: HashMap<(PathBuf, [u32; 3], Role), Option<Picture>>,
}

impl<'t> Appearances<'t> {
    /// `folder` is where file names start.
    pub(super) fn new(tree: &'t ObjFile, folder: &'t Path) -> Self {
        let by_name = tree.material_by_name();
        Self { tree, by_name, folder, made: HashMap::new(), pictures: HashMap::new() }
    }

    /// The material of that index into the file's names, and the radiance it emits, if any.
    pub(super) fn of(&mut self, index: Option<usize>, source: &SourceFile, target: &mut Target) -> (MaterialId, Glow) {
        if let Some(made) = self.made.get(&index) {
            return made.clone();
        }
        let named = index.map(|i| &self.tree.material_names[i]);
        let definition = named.and_then(|(name, _)| self.by_name.get(name.as_str()).copied());
        let made = if let (Some(mtl), Some((_, span))) = (definition, named) {
            let model = self.model(mtl, (source, *span), target);
            let emission = self.emission(mtl, (source, *span), target);
            let bare = target.builder().material(model);
            let id = self.covered(mtl, bare, (source, *span), target);
            if let Some((name, _)) = named {
                target.name_material(name, id);
            }
            (id, emission)
        } else {
            let reflectance = target.builder().constant(DEFAULT_GREY);
            (target.builder().material(DiffuseMaterial { reflectance }), Glow::Nothing)
        };
        self.made.insert(index, made.clone());
        made
    }

    /// `Ke`, or the picture that `map_Ke` names times `Ke` (a black one does not count).
    fn emission(&self, mtl: &MtlMaterial, place: Place, target: &mut Target) -> Glow {
        let ke = mtl.emission.map_or(Vec3::ZERO, Vec3::from_array).max(Vec3::ZERO);
        let scale = if ke == Vec3::ZERO { Vec3::ONE } else { ke };
        let path = mtl.emission_map.as_ref().map(|name| self.folder.join(name));
        match path.and_then(|path| read_texture(&path, scale, Role::Light, place, target)) {
            Some(picture) => Glow::Picture(Rc::new(picture)),
            None if ke == Vec3::ZERO => Glow::Nothing,
            None => Glow::Even(ke),
        }
    }

    fn model(&mut self, mtl: &MtlMaterial, place: Place, target: &mut Target) -> Material {
        let kd = reflectance(mtl.diffuse, DEFAULT_GREY);
        let ks = reflectance(mtl.specular, Vec3::ZERO);
        let model = mtl.model.unwrap_or(2);
        if let Some(eta) = refraction(mtl, model) {
            let transmittance = reflectance(mtl.transmission.filter(|t| *t != [0.0; 3]), Vec3::ONE);
            let (white, tint) = (target.builder().constant(Vec3::ONE), target.builder().constant(transmittance));
            return DielectricMaterial { eta: eta.into(), reflectance: white, transmittance: tint }.into();
        }
        let diffuse = self.diffuse(mtl, kd, place, target);
        if mtl.is_physical() {
            return self.physical(mtl, diffuse, place, target).into();
        }
        if REFLECTING.contains(&model) && ks != Vec3::ZERO && kd == Vec3::ZERO && mtl.diffuse_map.is_none() {
            return MirrorMaterial { reflect: target.builder().constant(ks) }.into();
        }
        let exponent = mtl.exponent.unwrap_or(0.0);
        if model >= 2 && ks != Vec3::ZERO && exponent > 0.0 {
            let specular = target.builder().constant(ks);
            return PhongMaterial { diffuse, specular, exponent: exponent.min(1e6) }.into();
        }
        DiffuseMaterial { reflectance: diffuse }.into()
    }

    /// `Kd`, or the picture that `map_Kd` names times `Kd` (a black one does not count).
    fn diffuse(&mut self, mtl: &MtlMaterial, kd: Vec3, place: Place, target: &mut Target) -> TextureId {
        let scale = if mtl.diffuse.is_none() || kd == Vec3::ZERO { Vec3::ONE } else { kd };
        let name = mtl.diffuse_map.as_ref();
        let picture = name.and_then(|name| self.picture(name, scale, Role::Colour, place, target));
        picture.map_or_else(|| target.builder().constant(kd), |p| p.id)
    }

    /// A material with its normals and its holes. What is glass has none of these.
    fn covered(&mut self, mtl: &MtlMaterial, of: MaterialId, place: Place, target: &mut Target) -> MaterialId {
        let mut id = if mtl.is_physical() { Self::turned(mtl, of, target) } else { of };
        let mut data = |name: &Option<String>, target: &mut Target| {
            name.as_ref().and_then(|name| self.picture(name, Vec3::ONE, Role::Data, place, target))
        };
        if let Some(picture) = data(&mtl.normal_map, target) {
            if picture.mean.z > 0.6 && picture.mean.z > picture.mean.x + 0.1 {
                id = target.builder().material(NormalMapMaterial { of: id, map: picture.id, scale: 1.0 });
            } else {
                target.sink.warn("mtl::heights", || {
                    let message = format!("the relief of material `{}` is a picture of heights", mtl.name);
                    Diagnostic::warning("mtl::heights", message).at(place.0, place.1, "left out")
                });
            }
        }
        if refraction(mtl, mtl.model.unwrap_or(2)).is_some() {
            return id;
        }
        let opacity: Scalar = match data(&mtl.opacity_map, target) {
            Some(picture) => picture.id.into(),
            None => mtl.opacity.unwrap_or(1.0).clamp(0.0, 1.0).into(),
        };
        // Many programs write opacity as `Tr`, which is the opposite.
        if opacity == Scalar::Constant(0.0) {
            target.sink.warn("mtl::opacity", || {
                let message = format!("material `{}` says that it cannot be seen at all", mtl.name);
                let warning = Diagnostic::warning("mtl::opacity", message);
                warning.at(place.0, place.1, "drawn opaque").help("for glass, give `Ni` above 1 besides `d`")
            });
            return id;
        }
        if opacity == Scalar::Constant(1.0) {
            return id;
        }
        target.builder().material(MaskMaterial { of: id, opacity })
    }

    /// A picture times `scale`; a warning if it cannot be read.
    pub(super) fn picture(
        &mut self,
        name: &str,
        scale: Vec3,
        role: Role,
        place: Place,
        target: &mut Target,
    ) -> Option<Picture> {
        let path = self.folder.join(name);
        let key = (path.clone(), scale.to_array().map(f32::to_bits), role);
        *self.pictures.entry(key).or_insert_with(|| read_picture(&path, scale, role, place, target))
    }
}

/// What the numbers of a picture are.
#[derive(Clone, Copy, PartialEq, Eq, Hash)]
pub(super) enum Role {
    /// Colours of matter.
    Colour,
    /// Radiance, which may be above 1.
    Light,
    /// Numbers as they are.
    Data,
}

/// A picture, and its mean.
#[derive(Clone, Copy)]
pub(super) struct Picture {
    pub(super) id: TextureId,
    mean: Vec3,
}

/// Reads a texture; a warning if that fails.
fn read_picture(path: &Path, scale: Vec3, role: Role, place: Place, target: &mut Target) -> Option<Picture> {
    let texture = read_texture(path, scale, role, place, target)?;
    let mean = texture.mean();
    Some(Picture { id: target.builder().texture(Texture::Image(texture)), mean })
}

fn read_texture(path: &Path, scale: Vec3, role: Role, place: Place, target: &mut Target) -> Option<ImageTexture> {
    let read = crate::diagnostic::read_bytes(path).and_then(|bytes| {
        let picture = read_image_bytes(&path.display().to_string(), &bytes)?;
        target.input(&bytes);
        Ok(if role == Role::Data { picture.undo_srgb().image } else { picture.image })
    });
    match read {
        Ok(image) => {
            let most = Vec3::splat(if role == Role::Light { f32::MAX } else { 1.0 });
            let pixels = image.data.into_iter().map(|p| Vec3::from_array(p).clamp(Vec3::ZERO, most) * scale).collect();
            ImageTexture::new(image.width as usize, image.height as usize, pixels, Wrap::Repeat)
        }
        Err(error) => {
            target.sink.warn("mtl::texture", || {
                let first = error.errors.first();
                let reason = first.map_or("cannot be read", |e| e.message.as_str());
                let message = format!("texture {}: {reason}", path.display());
                let warning = Diagnostic::warning("mtl::texture", message);
                let warning = warning.at(place.0, place.1, "drawn in its plain colour");
                first.into_iter().flat_map(|e| &e.help).cloned().fold(warning, Diagnostic::help)
            });
            None
        }
    }
}

/// The index of refraction, if the material is glass: it says so, or it is not opaque and has an index.
fn refraction(mtl: &MtlMaterial, model: u32) -> Option<f32> {
    let given = mtl.ior.filter(|n| *n > 1.0);
    let is_clear = mtl.opacity.is_some_and(|d| d < 1.0);
    match given {
        Some(eta) if is_clear || REFRACTING.contains(&model) => Some(eta),
        None if mtl.ior.is_none() && is_clear && REFRACTING.contains(&model) => Some(1.5),
        _ => None,
    }
}

fn reflectance(colour: Option<[f32; 3]>, default: Vec3) -> Vec3 {
    colour.map_or(default, Vec3::from_array).clamp(Vec3::ZERO, Vec3::ONE)
}
