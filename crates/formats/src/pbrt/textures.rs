//! `Texture`: named colours and numbers over surfaces.

use super::directives::{Importer, unknown, warning};
use super::params::{Found, Param, Params};
use super::spectra::Role;
use super::tokens::At;
use crate::diagnostic::Diagnostic;
use crate::files::first_of;
use crate::image::{RgbImage32, srgb_from_linear};
use glam::{Affine2, Affine3A, DAffine3, DVec3, Vec2, Vec3};
use std::collections::HashMap;
use sunfleck::bsdf::TextureId;
use sunfleck::texture::{
    Checkerboard, Dots, ImageTexture, Mapped, Mix, Noise, NoiseKind, Product, Texture, UvMap, UvSet, VertexColour, Wrap,
};

const CLASSES: [&str; 14] = [
    "bilerp",
    "checkerboard",
    "constant",
    "directionmix",
    "dots",
    "fbm",
    "imagemap",
    "marble",
    "mix",
    "ptex",
    "scale",
    "uv",
    "windy",
    "wrinkled",
];

/// What stands for a picture that is missing: nothing in a real scene looks like it.
const MISSING: Vec3 = Vec3::new(1.0, 0.0, 1.0);

/// A texture, and its mean for places that take one value only.
#[derive(Clone, Copy, Debug)]
pub(super) struct Made {
    pub(super) id: TextureId,
    pub(super) mean: Vec3,
}

/// By name; numbers and colours have names of their own.
#[derive(Default)]
pub(super) struct Textures {
    pub(super) numbers: HashMap<String, Made>,
    pub(super) colours: HashMap<String, Made>,
}

impl Importer<'_> {
    /// A `Texture` directive; its name is read already.
    pub(super) fn texture(&mut self, name: &str, at: &At) -> Found<()> {
        let kind = self.string(at)?;
        let class = self.string(at)?;
        let params = Params::read(&mut self.tokens, at.clone())?;
        let params = self.with_defaults("texture", params);
        let is_number = match kind.as_str() {
            "float" => true,
            "spectrum" | "color" | "rgb" => false,
            _ => return Err(unknown(at, "kind of texture", &kind, ["float", "spectrum", "color"])),
        };
        let made = self.make_texture(&class, &params)?;
        self.tell_unused(&params);
        let names = if is_number { &mut self.textures.numbers } else { &mut self.textures.colours };
        names.insert(name.to_owned(), made);
        Ok(())
    }

    fn make_texture(&mut self, class: &str, params: &Params) -> Found<Made> {
        match class {
            "constant" => self.operand(params, "value", Vec3::ONE),
            "imagemap" => self.image_map(params),
            "scale" => {
                let (a, b) = if params.get("tex1").is_some() { ("tex1", "tex2") } else { ("tex", "scale") };
                let (a, b) = (self.operand(params, a, Vec3::ONE)?, self.operand(params, b, Vec3::ONE)?);
                Ok(self.made(Texture::Product(Product { of: [a.id, b.id] }), a.mean * b.mean))
            }
            "mix" | "directionmix" => self.mixture(class, params),
            "checkerboard" => {
                let (a, b) = (self.operand(params, "tex1", Vec3::ONE)?, self.operand(params, "tex2", Vec3::ZERO)?);
                params.ignore(&["dimension", "aamode"]);
                let map = uv_map(params)?;
                let made =
                    self.made(Texture::Checkerboard(Checkerboard { of: [a.id, b.id], map }), 0.5 * (a.mean + b.mean));
                self.elsewhere(params, made)
            }
            "dots" => {
                let inside = self.operand(params, "inside", Vec3::ONE)?;
                let outside = self.operand(params, "outside", Vec3::ZERO)?;
                let map = uv_map(params)?;
                // Half of the squares have a dot, of area π·0.35².
                let mean = outside.mean.lerp(inside.mean, 0.19);
                Ok(self.made(Texture::Dots(Dots { inside: inside.id, outside: outside.id, map }), mean))
            }
            "bilerp" | "uv" => self.corners(class, params),
            "fbm" | "wrinkled" | "windy" | "marble" => self.noise(class, params),
            "sunfleck-vertex-rgb" => Ok(self.made(Texture::Vertex(VertexColour::Rgb), Vec3::ONE)),
            "sunfleck-vertex-alpha" => Ok(self.made(Texture::Vertex(VertexColour::Alpha), Vec3::ONE)),
            _ if CLASSES.contains(&class) => {
                let message = format!("textures of the kind `{class}` are shown in grey");
                self.warn_once("pbrt::texture", class, || params.at.tell(warning("pbrt::texture", message), ""));
                Ok(self.constant(Vec3::splat(0.5)))
            }
            _ => Err(unknown(&params.at, "kind of texture", class, CLASSES)),
        }
    }

    /// At texture coordinates that only our own writer asks for: turned ones, or the second ones.
    fn elsewhere(&mut self, params: &Params, made: Made) -> Found<Made> {
        let matrix =
            params.numbers("uvmatrix", 6)?.map(|m| Affine2::from_cols_array(&[0, 1, 2, 3, 4, 5].map(|i| m[i] as f32)));
        let set = if params.integer("uvset", 1..=2)? == Some(2) { UvSet::Second } else { UvSet::First };
        if matrix.is_none() && set == UvSet::First {
            return Ok(made);
        }
        let map = matrix.unwrap_or(Affine2::IDENTITY);
        Ok(self.made(Texture::Mapped(Mapped { of: made.id, map, set }), made.mean))
    }

    pub(super) fn constant(&mut self, colour: Vec3) -> Made {
        Made { id: self.target.builder().constant(colour), mean: colour }
    }

    /// A parameter that is a colour, a number, or a texture.
    fn operand(&mut self, params: &Params, name: &'static str, default: Vec3) -> Found<Made> {
        let Some(param) = params.get(name).cloned() else { return Ok(self.constant(default)) };
        if param.kind == "texture" {
            return self.named_texture(&param);
        }
        let colour = self.colour(&param, Role::Reflectance)?;
        let mean = colour.rgb();
        Ok(Made { id: self.target.builder().constant(colour), mean })
    }

    fn made(&mut self, texture: Texture, mean: Vec3) -> Made {
        Made { id: self.target.builder().texture(texture), mean }
    }

    fn mixture(&mut self, class: &str, params: &Params) -> Found<Made> {
        let (a, b) = (self.operand(params, "tex1", Vec3::ZERO)?, self.operand(params, "tex2", Vec3::ONE)?);
        if class == "directionmix" {
            params.ignore(&["dir"]);
            let message = "`directionmix` is shown as an even mix";
            self.warn_once("pbrt::texture", class, || params.at.tell(warning("pbrt::texture", message), ""));
        }
        let amount = self.operand(params, "amount", Vec3::splat(0.5))?;
        let mean = a.mean + (b.mean - a.mean) * amount.mean;
        Ok(self.made(Texture::Mix(Mix { from: a.id, to: b.id, amount: amount.id }), mean))
    }

    /// Colours at the corners of the unit square, and between them.
    fn corners(&mut self, class: &str, params: &Params) -> Found<Made> {
        let corner = |this: &mut Self, name, default| this.operand(params, name, default).map(|made| made.mean);
        let [v00, v10, v01, v11] = if class == "uv" {
            [Vec3::ZERO, Vec3::X, Vec3::Y, Vec3::X + Vec3::Y]
        } else {
            let low = [corner(self, "v00", Vec3::ZERO)?, corner(self, "v10", Vec3::ZERO)?];
            [low[0], low[1], corner(self, "v01", Vec3::ONE)?, corner(self, "v11", Vec3::ONE)?]
        };
        let map = uv_map(params)?;
        let mean = 0.25 * (v00 + v10 + v01 + v11);
        let Some(image) = ImageTexture::new(2, 2, vec![v01, v11, v00, v10], Wrap::Clamp) else {
            return Ok(self.constant(mean));
        };
        // Centres of the pixels are the corners.
        let of = self.target.builder().texture(Texture::Image(image));
        let map = UvMap { scale: 0.5 * map.scale, offset: 0.25 + 0.5 * map.offset };
        Ok(self.made(Texture::Mapped(Mapped { of, map: map.into(), set: UvSet::First }), mean))
    }

    fn noise(&mut self, class: &str, params: &Params) -> Found<Made> {
        let octaves = params.integer("octaves", 0..=64)?.unwrap_or(8) as u32;
        let roughness = params.number("roughness", 0.5)? as f32;
        let scale = params.number("scale", 1.0)?;
        let (kind, mean) = match class {
            "fbm" => (NoiseKind::Fbm { octaves, roughness }, 0.2),
            "wrinkled" => (NoiseKind::Wrinkled { octaves, roughness }, 0.5),
            "windy" => (NoiseKind::Windy, 0.05),
            _ => {
                let variation = params.number("variation", 0.2)? as f32;
                (NoiseKind::Marble { octaves, roughness, variation }, 0.8)
            }
        };
        let to_pattern = DAffine3::from_scale(DVec3::splat(scale)) * self.state.world_from_object().inverse();
        let pattern_from_world =
            Affine3A::from_mat3_translation(to_pattern.matrix3.as_mat3(), to_pattern.translation.as_vec3());
        Ok(self.made(Texture::Noise(Noise { kind, pattern_from_world }), Vec3::splat(mean)))
    }

    fn named_texture(&self, param: &Param) -> Found<Made> {
        let Some([name]) = param.strings() else { return Err(param.expected("the name of a texture")) };
        let Textures { numbers, colours } = &self.textures;
        let found = colours.get(name).or_else(|| numbers.get(name));
        found.copied().ok_or_else(|| {
            let names = colours.keys().chain(numbers.keys()).map(String::as_str);
            unknown(&param.at, "texture", name, names)
        })
    }

    /// The texture that a parameter names.
    pub(super) fn texture_of(&mut self, param: &Param) -> Found<TextureId> {
        Ok(self.named_texture(param)?.id)
    }

    /// One colour for a parameter: of a texture its mean.
    pub(super) fn mean_spectrum(&mut self, param: &Param) -> Found<Vec3> {
        if param.kind != "texture" {
            return Ok(self.colour(param, Role::Reflectance)?.rgb());
        }
        self.tell_mean(param);
        Ok(self.named_texture(param)?.mean)
    }

    /// A number: of a texture its mean.
    pub(super) fn float(&mut self, params: &Params, name: &'static str, default: f64) -> Found<f64> {
        let Some(param) = params.get(name).cloned() else { return Ok(default) };
        if param.kind != "texture" {
            return params.number(name, default);
        }
        self.tell_mean(&param);
        Ok(f64::from(self.named_texture(&param)?.mean.element_sum() / 3.0))
    }

    pub(super) fn tell_mean(&mut self, param: &Param) {
        let message = format!("the texture of `{}` is taken as its mean everywhere", param.name);
        self.warn_once("pbrt::mean", &param.name, || param.at.tell(warning("pbrt::mean", message), ""));
    }

    /// A picture of normals; `None` with a warning if it is missing.
    pub(super) fn normal_map(&mut self, params: &Params) -> Found<Option<TextureId>> {
        let Some((image, _)) = self.picture_file(params, "normalmap", "left out")? else { return Ok(None) };
        // The numbers as they are stored.
        let is_encoded = !holds_floats(params.string("normalmap")?.unwrap_or_default());
        let stored = |p: [f32; 3]| {
            let v = Vec3::from_array(p);
            if is_encoded { v.map(srgb_from_linear) } else { v }
        };
        let pixels = image.data.into_iter().map(stored).collect();
        let texture = ImageTexture::new(image.width as usize, image.height as usize, pixels, Wrap::Repeat);
        Ok(texture.map(|t| self.target.builder().texture(Texture::Image(t))))
    }

    fn image_map(&mut self, params: &Params) -> Found<Made> {
        params.ignore(&["filter", "maxanisotropy", "trilinear", "gamma"]);
        let scale = params.number("scale", 1.0)? as f32;
        let invert = params.bool("invert", false)?;
        let wrap = params.word("wrap", "repeat", &["repeat", "black", "clamp", "octahedralsphere"])?;
        let wrap = if wrap == "repeat" { Wrap::Repeat } else { Wrap::Clamp };
        let upward = params.word("wrapv", "", &["repeat", "clamp"])?;
        let wrapv = match upward {
            "repeat" => Wrap::Repeat,
            "clamp" => Wrap::Clamp,
            _ => wrap,
        };
        let encoding = params.string("encoding")?.unwrap_or("sRGB").to_owned();
        let Some((image, _)) = self.picture_file(params, "filename", "shown in magenta")? else {
            return Ok(self.constant(MISSING));
        };
        let decode =
            decoder(&encoding).ok_or_else(|| params.misfit("encoding", "`sRGB`, `linear` or `gamma` and a number"))?;
        // Files of floats hold linear values, whatever is said.
        let is_encoded = !holds_floats(params.string("filename")?.unwrap_or_default());
        let value = |p: [f32; 3]| {
            let v = Vec3::from_array(p);
            let v = if is_encoded { v.map(&decode) } else { v };
            scale * if invert { (Vec3::ONE - v).max(Vec3::ZERO) } else { v }
        };
        let pixels: Vec<Vec3> = image.data.into_iter().map(value).collect();
        let texture = ImageTexture::new(image.width as usize, image.height as usize, pixels, wrap);
        let Some(texture) = texture.map(|t| t.with_wrap(wrap, wrapv)) else { return Ok(self.constant(MISSING)) };
        let mean = texture.mean();
        let of = self.target.builder().texture(Texture::Image(texture));
        let map = uv_map(params)?;
        let made = Made { id: of, mean };
        if map != UvMap::default() && params.get("uvmatrix").is_none() {
            let made = self.made(Texture::Mapped(Mapped { of, map: map.into(), set: UvSet::First }), mean);
            return self.elsewhere(params, made);
        }
        self.elsewhere(params, made)
    }

    /// Reads a picture that a parameter names. `None` with a warning, which says what is shown `instead`,
    /// if that fails.
    pub(super) fn picture_file(
        &mut self,
        params: &Params,
        name: &'static str,
        instead: &str,
    ) -> Found<Option<(RgbImage32, At)>> {
        let Some(file) = params.string(name)?.map(str::to_owned) else {
            return Err(params.bad("pbrt::no-file", "a picture needs a `filename`"));
        };
        let at = params.get(name).map_or(&params.at, |p| &p.at).clone();
        let path = self.files.find(&file, at.source.name());
        match self.files.picture(&path, self.target) {
            Ok(picture) => Ok(Some((picture.image, at))),
            Err(error) => {
                let told =
                    Diagnostic { severity: crate::Severity::Warning, code: "pbrt::missing-picture", ..first_of(error) };
                self.target.sink.warn("pbrt::missing-picture", || at.tell(told, instead));
                Ok(None)
            }
        }
    }
}

/// Whether the name is that of a picture of floats.
fn holds_floats(name: &str) -> bool {
    let name = name.to_lowercase();
    [".exr", ".hdr", ".pfm"].iter().any(|e| name.ends_with(e))
}

/// Repetitions and shift of texture coordinates. Other mappings than that of the surface are taken as it.
fn uv_map(params: &Params) -> Found<UvMap> {
    params.ignore(&["mapping", "v1", "v2"]);
    let pair = |version_4, version_3, default: f64| match params.maybe_number(version_4)? {
        Some(number) => Ok(number as f32),
        None => params.number(version_3, default).map(|n| n as f32),
    };
    let scale = Vec2::new(pair("su", "uscale", 1.0)?, pair("sv", "vscale", 1.0)?);
    let offset = Vec2::new(pair("du", "udelta", 0.0)?, pair("dv", "vdelta", 0.0)?);
    Ok(UvMap { scale, offset })
}

/// From the linear values that an 8-bit picture is read to, to those that its encoding means.
fn decoder(encoding: &str) -> Option<impl Fn(f32) -> f32 + use<>> {
    let exponent = match encoding.split_whitespace().collect::<Vec<_>>()[..] {
        ["sRGB"] => None,
        ["linear"] => Some(1.0),
        ["gamma", exponent] => Some(exponent.parse::<f32>().ok().filter(|e| *e > 0.0)?),
        _ => return None,
    };
    Some(move |v: f32| exponent.map_or(v, |e| srgb_from_linear(v).max(0.0).powf(e)))
}
