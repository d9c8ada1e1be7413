//! Pictures on surfaces.

use super::super::data::{Reference, reason, reference};
use super::super::document::Fields;
use super::Importer;
use crate::diagnostic::Diagnostic;
use crate::image::{ImageFile, read_image_bytes};
use glam::{Affine2, Mat2, Vec2, Vec3};
use serde_json::Value;
use std::collections::HashMap;
use sunfleck::scene::TextureId;
use sunfleck::texture::{ImageTexture, Mapped, Texture, UvSet, Wrap};

/// What stands for a colour whose picture is missing: nothing in a real scene looks like it.
const MISSING: Vec3 = Vec3::new(1.0, 0.0, 1.0);

/// What the numbers of a picture are.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub(super) enum Role {
    /// Colours, through the sRGB curve.
    Colour,
    /// Numbers as they are.
    Data,
}

/// A picture in the scene, and its opacity if it has any.
#[derive(Clone, Copy, Debug)]
pub(super) struct Picture {
    pub(super) id: TextureId,
    pub(super) alpha: Option<TextureId>,
    /// Of all its pixels.
    pub(super) mean: Vec3,
    /// Mean of its opacity.
    pub(super) opacity: f32,
}

/// Pictures that were read already, by texture and role; `None` for those that cannot be read.
#[derive(Default)]
pub(super) struct Textures(HashMap<(usize, Role), Option<Picture>>);

impl Importer<'_> {
    /// The picture that a property of a material points to, at its coordinates. `None` if it points to none, or to one that
    /// cannot be read where it is no colour.
    pub(super) fn texture(&mut self, info: &Value, role: Role) -> Option<Picture> {
        let index = info.index("index")?;
        let known = self.textures.0.get(&(index, role)).copied();
        let picture = if let Some(picture) = known {
            picture
        } else {
            let picture = self.picture(index, role);
            self.textures.0.insert((index, role), picture);
            picture
        }?;
        let map = transform(info);
        let set = uv_set(info);
        let alpha = picture.alpha.map(|a| self.mapped(a, map, set));
        Some(Picture { id: self.mapped(picture.id, map, set), alpha, ..picture })
    }

    pub(super) fn mapped(&mut self, of: TextureId, map: Affine2, set: usize) -> TextureId {
        if map == Affine2::IDENTITY && set == 0 {
            return of;
        }
        let set = if set == 0 { UvSet::First } else { UvSet::Second };
        self.target.builder().texture(Texture::Mapped(Mapped { of, map, set }))
    }

    fn picture(&mut self, texture: usize, role: Role) -> Option<Picture> {
        let Some((image, alpha)) = self.decoded(texture, role) else {
            let id = (role == Role::Colour).then(|| self.target.builder().constant(MISSING));
            return id.map(|id| Picture { id, alpha: None, mean: MISSING, opacity: 1.0 });
        };
        let (mean, opacity) = (image.mean(), alpha.as_ref().map_or(1.0, |a| a.mean().x));
        let mut add = |image| self.target.builder().texture(Texture::Image(image));
        Some(Picture { id: add(image), alpha: alpha.map(add), mean, opacity })
    }

    /// Reads a texture: its colours or data, and its opacity if it has any. `None` with a finding if that fails.
    fn decoded(&mut self, texture: usize, role: Role) -> Option<(ImageTexture, Option<ImageTexture>)> {
        let json = self.root.items("textures").get(texture)?;
        let Some(image) = source(json) else {
            let path = self.called("textures", texture);
            self.note("gltf::picture", path, "there is no picture that can be read");
            return None;
        };
        let file = match self.image(image) {
            Ok(file) if role == Role::Data => file.undo_srgb(),
            Ok(file) => file,
            Err(reason) => {
                let path = self.called("images", image);
                let shown = if role == Role::Colour { "; it is shown in magenta" } else { "; it is left out" };
                let told = self.told;
                told.lapse(&mut self.target.sink, "gltf::picture", path, format_args!("{reason}{shown}"));
                return None;
            }
        };
        let wrap = self.wrap(json);
        let size = (file.image.width as usize, file.image.height as usize);
        let is_clear = file.alpha.iter().any(|a| *a < 1.0);
        let alpha = if is_clear { file.alpha.iter().map(|a| Vec3::splat(*a)).collect() } else { Vec::new() };
        let pixels = file.image.data.into_iter().map(Vec3::from_array).collect();
        let made = |pixels| {
            let image = ImageTexture::new(size.0, size.1, pixels, Wrap::Repeat)?;
            Some(image.with_wrap(wrap[0], wrap[1]))
        };
        Some((made(pixels)?, made(alpha)))
    }

    /// The picture that a property points to for looking at its colours here, with the way to its coordinates.
    pub(super) fn colours(&mut self, info: &Value) -> Option<(ImageTexture, Affine2, usize)> {
        self.lying(info, Role::Colour)
    }

    /// The picture that a property points to, with the way to its coordinates.
    pub(super) fn lying(&mut self, info: &Value, role: Role) -> Option<(ImageTexture, Affine2, usize)> {
        let (image, _) = self.decoded(info.index("index")?, role)?;
        Some((image, transform(info), uv_set(info)))
    }

    /// How a texture goes on across and down beyond its edges.
    fn wrap(&self, texture: &Value) -> [Wrap; 2] {
        let sampler = texture.index("sampler").and_then(|s| self.root.items("samplers").get(s));
        ["wrapS", "wrapT"].map(|key| match sampler.and_then(|s| s.index(key)) {
            Some(33_071) => Wrap::Clamp,
            Some(33_648) => Wrap::Mirror,
            _ => Wrap::Repeat,
        })
    }

    /// Reads a picture.
    ///
    /// # Errors
    /// Why it cannot be read.
    pub(super) fn image(&mut self, index: usize) -> Result<ImageFile, String> {
        let json = self.root.items("images").get(index).ok_or("it does not exist")?;
        let damaged = |e: crate::Error| e.errors.first().map_or(String::new(), |d: &Diagnostic| d.message.clone());
        if let Some(view) = json.index("bufferView") {
            let bytes = self.buffers.view(self.root, view).ok_or_else(|| format!("bufferViews[{view}] has no data"))?;
            return read_image_bytes("", bytes).map_err(damaged);
        }
        match reference(json.text("uri").ok_or("it has neither `uri` nor `bufferView`")?)? {
            Reference::Remote => Err("it lies neither beside the scene nor in it, and is not fetched".to_owned()),
            Reference::Data { bytes, .. } => read_image_bytes("", &bytes).map_err(damaged),
            Reference::File(name) => {
                let path = self.files.find(&name, "");
                let source = self.files.include(&path, self.target).map_err(|e| reason(&name, &e))?;
                read_image_bytes(&name, source.bytes()).map_err(|e| format!("{name}: {}", damaged(e)))
            }
        }
    }
}

/// The picture of a texture: that of an extension where one is used, since all of them can be read.
fn source(texture: &Value) -> Option<usize> {
    let extended = ["KHR_texture_basisu", "EXT_texture_webp"]
        .iter()
        .find_map(|name| texture.extension(name).and_then(|e| e.index("source")));
    extended.or_else(|| texture.index("source"))
}

/// Which texture coordinates are used.
pub(in super::super) fn uv_set(info: &Value) -> usize {
    let transform = info.extension("KHR_texture_transform");
    transform.and_then(|t| t.index("texCoord")).or_else(|| info.index("texCoord")).unwrap_or(0)
}

/// `KHR_texture_transform`, for coordinates whose `v` grows upwards.
fn transform(info: &Value) -> Affine2 {
    let Some(json) = info.extension("KHR_texture_transform") else { return Affine2::IDENTITY };
    let (sin, cos) = json.number("rotation", 0.0).sin_cos();
    let scale = Vec2::from_array(json.numbers("scale", [1.0; 2]));
    let offset = Vec2::from_array(json.numbers("offset", [0.0; 2]));
    // The extension's matrix, shift · turn · scale.
    let turn = Mat2::from_cols(Vec2::new(cos, -sin), Vec2::new(sin, cos));
    let down = Affine2 { matrix2: turn * Mat2::from_diagonal(scale), translation: offset };
    let flip = Affine2 { matrix2: Mat2::from_diagonal(Vec2::new(1.0, -1.0)), translation: Vec2::Y };
    let up = flip * down * flip;
    if up.is_finite() { up } else { Affine2::IDENTITY }
}
