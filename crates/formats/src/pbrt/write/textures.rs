//! Textures: pbrt has a map of coordinates on each picture or pattern, so maps are carried down to those.

use super::Writer;
use super::text::{colour, float, matrix, numbers, ours, param, quoted, string};
use crate::Error;
use crate::image::RgbImage32;
use glam::{Affine2, Vec2, Vec3};
use sunfleck::bsdf::{Scalar, TextureId};
use sunfleck::spectrum::Colour;
use sunfleck::texture::{ImageTexture, Mapped, Mix, Noise, NoiseKind, Texture, UvSet, VertexColour, Wrap};

/// What a texture comes down to.
enum Told {
    /// The same everywhere.
    Constant(Colour),
    /// A texture that has a name.
    Named(String),
}

impl Writer<'_> {
    /// A parameter that is the texture `id`, as a colour.
    pub(super) fn colour_param(&mut self, name: &str, id: TextureId) -> Result<String, Error> {
        Ok(match self.texture(id, false, Uv::PLAIN)? {
            Told::Constant(c) => colour(name, &c),
            Told::Named(texture) => param("texture", name, &quoted(&texture)),
        })
    }

    /// A parameter that is a number.
    pub(super) fn scalar_param(&mut self, name: &str, s: Scalar) -> Result<String, Error> {
        Ok(match s {
            Scalar::Constant(x) => float(name, x),
            Scalar::Texture(id) => match self.texture(id, true, Uv::PLAIN)? {
                Told::Constant(c) => float(name, c.rgb().x),
                Told::Named(texture) => param("texture", name, &quoted(&texture)),
            },
        })
    }

    /// The colour of a texture that is the same everywhere.
    pub(super) fn constant(&self, id: TextureId) -> Option<&Colour> {
        match &self.scene.parts.textures[id.0 as usize] {
            Texture::Constant(c) => Some(c),
            _ => None,
        }
    }

    /// Tells of the texture `id` looked up at `uv`, as a number if `is_float`, unless it was told of before.
    fn texture(&mut self, id: TextureId, is_float: bool, uv: Uv) -> Result<Told, Error> {
        let key = (id, is_float, uv.bits());
        if let Some(name) = self.textures.get(&key) {
            return Ok(Told::Named(name.clone()));
        }
        let told = match &self.scene.parts.textures[id.0 as usize] {
            Texture::Constant(c) => return Ok(Told::Constant(c.clone())),
            Texture::Mapped(m) => {
                return self.texture(m.of, is_float, uv.mapped(m));
            }
            Texture::Image(image) => self.image(image, uv, |c| if is_float { Vec3::splat(c.x) } else { c })?,
            Texture::Product(p) => return self.product(p.of, is_float, uv),
            Texture::Mix(m) => self.mix(m, is_float, uv)?,
            Texture::Checkerboard(c) => {
                let of = self.pair(["tex1", "tex2"], c.of, is_float, uv)?;
                format!("\"checkerboard\"{of}{}", uv.then(c.map).params())
            }
            Texture::Dots(d) => {
                let of = self.pair(["inside", "outside"], [d.inside, d.outside], is_float, uv)?;
                format!("\"dots\"{of}{}", uv.then(d.map).params())
            }
            Texture::Noise(n) => return Ok(self.noise(n, is_float, key)),
            Texture::Channel(c) => {
                let channel = usize::from(c.channel.min(2));
                return self.of_picture(c.of, uv, move |v| Vec3::splat(v.to_array()[channel]));
            }
            Texture::Threshold(t) => {
                let cutoff = t.cutoff;
                return self.of_picture(t.of, uv, move |v| Vec3::splat(f32::from(v.x >= cutoff)));
            }
            Texture::Vertex(kind) => {
                // White to pbrt, which knows no colours of vertices.
                let class = if *kind == VertexColour::Rgb { "sunfleck-vertex-rgb" } else { "sunfleck-vertex-alpha" };
                let (kind, one) = if is_float { ("float", "1") } else { ("spectrum", "1 1 1") };
                let value = if is_float { param("float", "value", one) } else { param("rgb", "value", one) };
                let name = self.tell(key, &format!("\"constant\"{value}"));
                self.line(&format!("#sunfleck Texture \"{name}\" \"{kind}\" \"{class}\""));
                return Ok(Told::Named(name));
            }
        };
        Ok(Told::Named(self.tell(key, &told)))
    }

    /// Writes the directive of a texture.
    fn tell(&mut self, key: super::TextureKey, what: &str) -> String {
        let name = self.texture_name();
        let kind = if key.1 { "float" } else { "spectrum" };
        self.line(&format!("Texture \"{name}\" \"{kind}\" {what}"));
        self.textures.insert(key, name.clone());
        name
    }

    /// A picture of the values `value` of another.
    fn image(&mut self, image: &ImageTexture, uv: Uv, value: impl Fn(Vec3) -> Vec3) -> Result<String, Error> {
        let [across, down] = image.wrap();
        let (w, h) = (image.width(), image.height());
        // What is mirrored beyond its edges repeats after two of them.
        let twice = |wrap| if wrap == Wrap::Mirror { 2 } else { 1 };
        let (columns, rows) = (w * twice(across), h * twice(down));
        let fold = |i: usize, n: usize| if i < n { i } else { 2 * n - 1 - i };
        let pixel = |i: usize| value(image.pixel(fold(i % columns, w), fold(i / columns, h))).to_array();
        let data = (0..columns * rows).map(pixel).collect();
        let file = self.files.picture(RgbImage32 { width: columns as u32, height: rows as u32, data })?;
        let is_clamped = |wrap| wrap == Wrap::Clamp;
        let word = |wrap| if is_clamped(wrap) { "clamp" } else { "repeat" };
        let wrap = word(across);
        // pbrt has one word for both.
        let upward = if word(down) == wrap { String::new() } else { ours(&string("wrapv", word(down))) };
        // The picture as it was is the upper half.
        let scale = Vec2::new(1.0 / twice(across) as f32, 1.0 / twice(down) as f32);
        let offset = if down == Wrap::Mirror { Vec2::new(0.0, 0.5) } else { Vec2::ZERO };
        let uv = uv.then(Affine2::from_scale_angle_translation(scale, 0.0, offset));
        Ok(format!(
            "\"imagemap\"{}{}{}",
            string("filename", &file),
            string("wrap", wrap),
            uv.params() + upward.trim_end()
        ))
    }

    /// A texture made of a picture, if `of` is one.
    fn of_picture(&mut self, of: TextureId, uv: Uv, value: impl Fn(Vec3) -> Vec3) -> Result<Told, Error> {
        match &self.scene.parts.textures[of.0 as usize] {
            Texture::Constant(c) => Ok(Told::Constant(value(c.rgb()).into())),
            Texture::Mapped(m) => self.of_picture(m.of, uv.mapped(m), value),
            Texture::Image(image) => {
                let what = self.image(image, uv, value)?;
                let name = format!("t{}", self.textures.len());
                // Kept under a key that nothing else has.
                let key = (TextureId(u32::MAX - self.textures.len() as u32), true, uv.bits());
                self.line(&format!("Texture \"{name}\" \"float\" {what}"));
                self.textures.insert(key, name.clone());
                Ok(Told::Named(name))
            }
            _ => {
                self.note("channels and stencils of textures other than pictures are left out");
                Ok(Told::Constant(Vec3::splat(0.5).into()))
            }
        }
    }

    /// pbrt multiplies by numbers only: colours are multiplied into what they tint.
    fn product(&mut self, of: [TextureId; 2], is_float: bool, uv: Uv) -> Result<Told, Error> {
        let key = (TextureId(u32::MAX - self.textures.len() as u32), is_float, uv.bits());
        let [a, b] = of.map(|id| self.constant(id).map(Colour::rgb));
        if let (Some(a), Some(b)) = (a, b) {
            return Ok(Told::Constant((a * b).into()));
        }
        let (tint, other) = match (a, b) {
            (Some(tint), _) => (tint, of[1]),
            (_, Some(tint)) => (tint, of[0]),
            _ => {
                let pair = self.pair(["tex", "scale"], of, is_float, uv)?;
                if !is_float {
                    self.note("pbrt itself multiplies textures by numbers only");
                }
                return Ok(Told::Named(self.tell(key, &format!("\"scale\"{pair}"))));
            }
        };
        if let Some((image, uv)) = self.picture_of(other, uv) {
            let image = image.clone();
            let what = self.image(&image, uv, |c| if is_float { Vec3::splat(c.x * tint.x) } else { c * tint })?;
            return Ok(Told::Named(self.tell(key, &what)));
        }
        let kind = if is_float { "float" } else { "rgb" };
        let values = if is_float { tint.x.to_string() } else { numbers(tint.to_array()) };
        let tex = match self.texture(other, is_float, uv)? {
            Told::Named(name) => param("texture", "tex", &quoted(&name)),
            Told::Constant(c) => return Ok(Told::Constant((c.rgb() * tint).into())),
        };
        Ok(Told::Named(self.tell(key, &format!("\"scale\"{tex}{}", param(kind, "scale", &values)))))
    }

    /// The picture that `id` is, under its maps.
    fn picture_of(&self, id: TextureId, uv: Uv) -> Option<(&ImageTexture, Uv)> {
        match &self.scene.parts.textures[id.0 as usize] {
            Texture::Image(image) => Some((image, uv)),
            Texture::Mapped(m) => self.picture_of(m.of, uv.mapped(m)),
            _ => None,
        }
    }

    fn mix(&mut self, m: &Mix, is_float: bool, uv: Uv) -> Result<String, Error> {
        let of = self.pair(["tex1", "tex2"], [m.from, m.to], is_float, uv)?;
        let amount = match self.texture(m.amount, true, uv)? {
            Told::Constant(c) => float("amount", c.rgb().x),
            Told::Named(name) => param("texture", "amount", &quoted(&name)),
        };
        Ok(format!("\"mix\"{of}{amount}"))
    }

    /// Two textures as parameters.
    fn pair(&mut self, names: [&str; 2], of: [TextureId; 2], is_float: bool, uv: Uv) -> Result<String, Error> {
        let mut all = String::new();
        for (name, id) in names.into_iter().zip(of) {
            all += &match self.texture(id, is_float, uv)? {
                Told::Constant(c) if is_float => float(name, c.rgb().x),
                Told::Constant(c) => colour(name, &c),
                Told::Named(texture) => param("texture", name, &quoted(&texture)),
            };
        }
        Ok(all)
    }

    /// Noise is a number for pbrt: as a colour it mixes black and white. Marble is a colour only.
    fn noise(&mut self, n: &Noise, is_float: bool, key: super::TextureKey) -> Told {
        let octaves = |octaves: u32, roughness: f32| {
            param("integer", "octaves", &octaves.to_string()) + &float("roughness", roughness)
        };
        let (class, params) = match n.kind {
            NoiseKind::Fbm { octaves: o, roughness } => ("fbm", octaves(o, roughness)),
            NoiseKind::Wrinkled { octaves: o, roughness } => ("wrinkled", octaves(o, roughness)),
            NoiseKind::Windy => ("windy", String::new()),
            NoiseKind::Marble { octaves: o, roughness, variation } => {
                ("marble", octaves(o, roughness) + &float("variation", variation))
            }
        };
        self.line(&format!("AttributeBegin\n  Transform {}", matrix(&n.pattern_from_world.inverse())));
        let is_colour = class == "marble";
        let of = self.tell((key.0, !is_colour, key.2), &format!("\"{class}\"{params}"));
        self.line("AttributeEnd");
        if is_colour != is_float {
            return Told::Named(of);
        }
        let amount = param("texture", "amount", &quoted(&of));
        Told::Named(self.tell(key, &format!("\"mix\" \"rgb tex1\" [ 0 0 0 ] \"rgb tex2\" [ 1 1 1 ]{amount}")))
    }
}

/// Where a texture is looked up: a matrix over the first texture coordinates, or over the second ones.
#[derive(Clone, Copy)]
pub(super) struct Uv {
    map: Affine2,
    second: bool,
}

impl Uv {
    const PLAIN: Self = Self { map: Affine2::IDENTITY, second: false };

    /// A map after this one.
    fn then(self, inner: impl Into<Affine2>) -> Self {
        Self { map: inner.into() * self.map, ..self }
    }

    /// That of a texture inside of `m`.
    fn mapped(self, m: &Mapped) -> Self {
        if m.set == UvSet::Second { Self { map: m.map, second: true } } else { self.then(m.map) }
    }

    /// To look things up by.
    fn bits(self) -> ([u32; 6], bool) {
        (self.map.to_cols_array().map(f32::to_bits), self.second)
    }

    /// The parameters of a texture. pbrt scales and shifts the first coordinates; the rest only we read.
    fn params(self) -> String {
        let m = self.map;
        let (x, y) = (m.matrix2.x_axis, m.matrix2.y_axis);
        let is_straight = x.y == 0.0 && y.x == 0.0;
        let scale = if is_straight { Vec2::new(x.x, y.y) } else { Vec2::new(x.length(), y.length()) };
        let all = [("uscale", scale.x, 1.0), ("vscale", scale.y, 1.0)];
        let shift = [("udelta", m.translation.x, 0.0), ("vdelta", m.translation.y, 0.0)];
        let pbrts = all.iter().chain(&shift).filter(|(_, v, default)| v != default);
        let mut params: String = pbrts.map(|(name, v, _)| float(name, *v)).collect();
        let mut exact = String::new();
        if !is_straight {
            exact += &param("float", "uvmatrix", &numbers(m.to_cols_array()));
        }
        if self.second {
            exact += &param("integer", "uvset", "2");
        }
        params += ours(&exact).trim_end();
        params
    }
}
