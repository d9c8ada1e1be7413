//! `texture`: colours and numbers over surfaces.
//!
//! Texture coordinates are kept as Mitsuba has them: the first row of a picture is at v = 0. So pictures are stored here
//! with their last row on top.

use super::document::Found;
use super::props::Props;
use super::scene::Importer;
use super::spectra::Role;
use super::transforms::flat;
use crate::diagnostic::Diagnostic;
use crate::files::first_of;
use glam::{Affine2, Vec2, Vec3};
use std::path::PathBuf;
use sunfleck::bsdf::TextureId;
use sunfleck::texture::{Checkerboard, ImageTexture, Mapped, Product, Scalar, Texture, UvMap, UvSet, Wrap};

const TEXTURES: [&str; 10] = [
    "bitmap",
    "checkerboard",
    "curvature",
    "gridtexture",
    "mesh_attribute",
    "scale",
    "vertexcolors",
    "volume",
    "wireframe",
    "ldrtexture",
];

/// What stands for a picture that is missing: nothing in a real scene looks like it.
const MISSING: Vec3 = Vec3::new(1.0, 0.0, 1.0);

/// A picture of normals that all stand upright.
const FLAT: Vec3 = Vec3::new(0.5, 0.5, 1.0);

/// A texture, and its mean for places that take one value only.
#[derive(Clone, Copy, Debug)]
pub(super) struct Made {
    pub(super) id: TextureId,
    pub(super) mean: Vec3,
    /// Whether it is not the same everywhere.
    pub(super) varies: bool,
}

/// A picture as it is read: which file, whether its values are data, and how it goes on outside.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub(super) struct Picture {
    path: PathBuf,
    pub(super) is_data: bool,
    /// Whether its green channel is turned over: normals of a mesh whose texture coordinates are.
    pub(super) is_flipped: bool,
    wrap: [&'static str; 2],
}

impl Importer<'_, '_> {
    /// The same colour everywhere.
    pub(super) fn constant(&mut self, colour: Vec3) -> Made {
        Made { id: self.target.builder().constant(colour), mean: colour, varies: false }
    }

    /// The property under the first of the names that is given: a colour, a number, or a texture.
    pub(super) fn input(&mut self, props: &Props, names: &[&'static str], default: Vec3, role: Role) -> Found<Made> {
        for name in names {
            if let Some((number, _)) = props.get(name) {
                let number = self.document.resolve(number)?;
                return self.operand(number, role);
            }
        }
        Ok(self.constant(default))
    }

    fn operand(&mut self, number: usize, role: Role) -> Found<Made> {
        if self.document.elements[number].tag == "texture" {
            return self.texture(number);
        }
        let colour = self.given(number)?.colour(role);
        let mean = colour.rgb();
        Ok(Made { id: self.target.builder().constant(colour), mean, varies: false })
    }

    /// A number that may come from a texture, taken as its mean everywhere.
    pub(super) fn mean_of(&mut self, props: &Props, name: &'static str, default: f64) -> Found<f64> {
        let Some((number, element)) = props.get(name) else { return Ok(default) };
        if ["float", "integer"].contains(&element.tag.as_str()) {
            return props.float(name, default);
        }
        let number = self.document.resolve(number)?;
        let made = self.operand(number, Role::Index)?;
        if made.varies {
            let message = format!("the texture of `{name}` is taken as its mean everywhere");
            self.warn_once("mitsuba::mean", name, props, &message);
        }
        Ok(f64::from(made.mean.element_sum() / 3.0))
    }

    /// A number that may come from a texture.
    pub(super) fn scalar(&mut self, props: &Props, name: &'static str, default: f64) -> Found<Scalar> {
        let Some((number, element)) = props.get(name) else { return Ok(Scalar::Constant(default as f32)) };
        if ["float", "integer"].contains(&element.tag.as_str()) {
            return props.float(name, default).map(|v| Scalar::Constant(v as f32));
        }
        let number = self.document.resolve(number)?;
        let made = self.operand(number, Role::Index)?;
        Ok(if made.varies { self.as_numbers(made.id).into() } else { Scalar::Constant(made.mean.x) })
    }

    /// A texture that is asked for numbers instead of colours: Mitsuba's checkerboards then have their squares the other way
    /// about.
    pub(super) fn as_numbers(&mut self, id: TextureId) -> TextureId {
        let (board, mapped) = match &self.target.builder().parts().textures[id.0 as usize] {
            Texture::Checkerboard(c) => (Some(*c), None),
            Texture::Mapped(m) => (None, Some(*m)),
            _ => return id,
        };
        if let Some(board) = board {
            let of = [board.of[1], board.of[0]];
            return self.target.builder().texture(Texture::Checkerboard(Checkerboard { of, ..board }));
        }
        let Some(mapped) = mapped else { return id };
        let of = self.as_numbers(mapped.of);
        if of == mapped.of {
            return id;
        }
        let texture = Texture::Mapped(Mapped { of, ..mapped });
        self.target.builder().texture(texture)
    }

    /// The texture of an element, made once.
    pub(super) fn texture(&mut self, number: usize) -> Found<Made> {
        if let Some(made) = self.textures.get(&number) {
            return Ok(*made);
        }
        let made = self.once(number, |this| {
            let props = this.props(number);
            let made = this.make_texture(&props)?;
            this.tell_unused(&props);
            Ok(made)
        })?;
        self.textures.insert(number, made);
        Ok(made)
    }

    fn make_texture(&mut self, props: &Props) -> Found<Made> {
        let (name, _) = props.element.plugin()?;
        match name {
            "bitmap" | "ldrtexture" => self.bitmap(props, None),
            "checkerboard" => {
                // Plain numbers may be above 1: they need not be colours.
                let role = |names: [&'static str; 2]| {
                    let is_number = names.iter().any(|n| props.get(n).is_some_and(|(_, e)| e.tag == "float"));
                    if is_number { Role::Index } else { Role::Reflectance }
                };
                let names = [["color0", "dark_color"], ["color1", "bright_color"]];
                let a = self.input(props, &names[0], Vec3::splat(0.4), role(names[0]))?;
                let b = self.input(props, &names[1], Vec3::splat(0.2), role(names[1]))?;
                // Its squares have half a unit.
                let map = UvMap { scale: Vec2::splat(2.0), offset: Vec2::ZERO };
                let board = Texture::Checkerboard(Checkerboard { of: [a.id, b.id], map });
                let board = self.made(board, 0.5 * (a.mean + b.mean));
                let map = uv_map(props)?;
                Ok(self.mapped(board, map))
            }
            "scale" => {
                let scale = self.input(props, &["scale", "value"], Vec3::ONE, Role::Index)?;
                let Some(inner) = props.object("texture")? else {
                    return Err(props.bad("`scale` needs a texture in it"));
                };
                let inner = self.texture(inner)?;
                let product = Texture::Product(Product { of: [inner.id, scale.id] });
                Ok(self.made(product, inner.mean * scale.mean))
            }
            _ if TEXTURES.contains(&name) => {
                self.near(name, props, "an even grey");
                props.ignore(&["color0", "color1", "line_width", "name", "to_uv", "scale", "volume", "filename"]);
                Ok(self.constant(Vec3::splat(0.5)))
            }
            _ => Err(props.unknown_plugin("texture", &TEXTURES)),
        }
    }

    fn made(&mut self, texture: Texture, mean: Vec3) -> Made {
        Made { id: self.target.builder().texture(texture), mean, varies: true }
    }

    fn mapped(&mut self, made: Made, map: Affine2) -> Made {
        if map == Affine2::IDENTITY {
            return made;
        }
        self.made(Texture::Mapped(Mapped { of: made.id, map, set: UvSet::First }), made.mean)
    }

    /// A picture; `as_normals` if it holds normals, and whether those are turned over.
    fn bitmap(&mut self, props: &Props, as_normals: Option<bool>) -> Found<Made> {
        props.ignore(&["filter_type", "max_anisotropy", "cache", "channel", "accel", "format"]);
        let Some(file) = props.string("filename")? else {
            return Err(props.bad("a picture needs a `filename`"));
        };
        let both = props.word("wrap_mode", "repeat", &WRAPS)?;
        let wrap = [props.word("wrap_mode_u", both, &WRAPS)?, props.word("wrap_mode_v", both, &WRAPS)?];
        let is_data = props.boolean("raw", false)? || props.float("gamma", 0.0)? == 1.0;
        let path = self.files.find(&file.value, file.at.source.name());
        let wrap = wrap.map(|word| WRAPS.into_iter().find(|w| *w == word).unwrap_or("repeat"));
        let key =
            Picture { path, is_data: is_data || as_normals.is_some(), is_flipped: as_normals == Some(true), wrap };
        let made = self.pictures.get(&key).copied().unwrap_or_else(|| {
            let made = self.read_texture(&key).map_err(|error| {
                let severity = crate::Severity::Warning;
                let told = Diagnostic { severity, code: "mitsuba::missing-picture", ..*error };
                self.target.sink.warn("mitsuba::missing-picture", || file.at.tell(told, "shown in magenta"));
            });
            self.pictures.insert(key, made.ok());
            made.ok()
        });
        let map = uv_map(props)?;
        Ok(match made {
            Some(made) => self.mapped(made, map),
            None if as_normals.is_some() => self.constant(FLAT),
            None => self.constant(MISSING),
        })
    }

    /// A picture of normals. `is_flipped` if the mesh's coordinates run against each other.
    pub(super) fn normals(&mut self, number: usize, is_flipped: bool) -> Found<TextureId> {
        let props = self.props(number);
        if props.element.plugin()?.0 != "bitmap" {
            return Err(props.bad("normals must come from a `bitmap`"));
        }
        let made = self.bitmap(&props, Some(is_flipped))?;
        self.tell_unused(&props);
        Ok(made.id)
    }

    fn read_texture(&mut self, key: &Picture) -> Found<Made> {
        let mut file = self.files.picture(&key.path, self.target).map_err(|e| Box::new(first_of(e)))?;
        if key.is_data {
            file = file.undo_srgb();
        }
        let (width, height) = (file.image.width as usize, file.image.height as usize);
        let mut data = file.image.data;
        for y in 0..height / 2 {
            let (above, below) = data.split_at_mut((height - 1 - y) * width);
            above[y * width..(y + 1) * width].swap_with_slice(&mut below[..width]);
        }
        let flipped = |[r, g, b]: [f32; 3]| if key.is_flipped { [r, 1.0 - g, b] } else { [r, g, b] };
        // In place: a large picture should not be in memory twice.
        let pixels = data.into_iter().map(|p| Vec3::from_array(flipped(p))).collect();
        let [across, down] = key.wrap.map(wrap_of);
        let texture = ImageTexture::new(width, height, pixels, across);
        let texture = texture.ok_or_else(|| Box::new(Diagnostic::error("mitsuba::picture", "the picture is empty")))?;
        let texture = texture.with_wrap(across, down);
        let mean = texture.mean();
        Ok(self.made(Texture::Image(texture), mean))
    }
}

/// Scale, turn and shift of texture coordinates, by `to_uv` or by the names of version 0.5.
fn uv_map(props: &Props) -> Found<Affine2> {
    let both = props.float("uvscale", 1.0)?;
    let scale = Vec2::new(props.float("uscale", both)? as f32, props.float("vscale", both)? as f32);
    let shift = Vec2::new(props.float("uoffset", 0.0)? as f32, props.float("voffset", 0.0)? as f32);
    Ok(flat(&props.transform("to_uv")?) * Affine2::from_scale_angle_translation(scale, 0.0, shift))
}

const WRAPS: [&str; 5] = ["repeat", "mirror", "clamp", "zero", "one"];

fn wrap_of(word: &str) -> Wrap {
    match word {
        "repeat" => Wrap::Repeat,
        "mirror" => Wrap::Mirror,
        _ => Wrap::Clamp,
    }
}
