//! Roughness: pbrt's numbers and textures as the roughness of GGX.

use super::directives::Importer;
use super::mitsubas::facets;
use super::params::{Found, Params};
use glam::Vec3;
use sunfleck::bsdf::{Roughness, Scalar, TextureId};
use sunfleck::texture::{Checkerboard, Dots, ImageTexture, Mapped, Texture};

/// Pictures and patterns within one another, at most.
const MAX_DEPTH: u32 = 16;

impl Importer<'_> {
    /// GGX roughness from the parameters `names` (both directions, u, v); `default` is the number when none is given. `None`
    /// for what is smooth.
    pub(super) fn roughness(
        &mut self,
        params: &Params,
        names: [&'static str; 3],
        default: f64,
    ) -> Found<Option<Roughness>> {
        let remap = params.bool("remaproughness", true)?;
        let is_version_3 = self.picture.is_version_3;
        let alpha = move |r: f32| match (remap, is_version_3) {
            (false, _) => r,
            (true, false) => r.max(0.0).sqrt(),
            (true, true) => {
                // The fit of version 3 (Pharr, Jakob & Humphreys 2016, `RoughnessToAlpha`).
                let x = r.max(1e-3).ln();
                1.62142 + x * (0.819_955 + x * (0.1734 + x * (0.017_120_1 + x * 0.000_640_711)))
            }
        };
        let both = self.rough(params, names[0], &alpha)?;
        let u = self.rough(params, names[1], &alpha)?.or(both);
        let v = self.rough(params, names[2], &alpha)?.or(both);
        let default = if default > 0.0 { alpha(default as f32) } else { 0.0 };
        let [u, v] = [u, v].map(|r| r.unwrap_or(Scalar::Constant(default)));
        let rough = Roughness::aligned(u, v).with(facets(params)?);
        Ok((u != Scalar::Constant(0.0) || v != Scalar::Constant(0.0)).then_some(rough))
    }

    fn rough(&mut self, params: &Params, name: &'static str, alpha: &impl Fn(f32) -> f32) -> Found<Option<Scalar>> {
        let Some(param) = params.get(name).cloned() else { return Ok(None) };
        if param.kind == "texture" {
            let id = self.texture_of(&param)?;
            if let Some(id) = self.mapped_values(id, alpha, 0) {
                return Ok(Some(Scalar::Texture(id)));
            }
            self.tell_mean(&param);
            return Ok(Some(Scalar::Constant(alpha(self.mean_of(id, 0)).clamp(0.0, 1.0))));
        }
        let r = params.number(name, 0.0)? as f32;
        // What is smooth stays smooth, whatever the fit says.
        Ok(Some(Scalar::Constant(if r > 0.0 { alpha(r).clamp(0.0, 1.0) } else { 0.0 })))
    }

    /// The texture whose values are those of `id` under `f`; `None` where that cannot be said.
    pub(super) fn mapped_values(&mut self, id: TextureId, f: &impl Fn(f32) -> f32, depth: u32) -> Option<TextureId> {
        if depth > MAX_DEPTH {
            return None;
        }
        let value = |c: Vec3| Vec3::splat(f(c.x).clamp(0.0, 1.0));
        let made = match self.target.builder().parts().textures[id.0 as usize].clone() {
            Texture::Constant(c) => Texture::Constant(value(c.rgb()).into()),
            Texture::Image(image) => {
                let (w, h) = (image.width(), image.height());
                let pixels = (0..w * h).map(|i| value(image.pixel(i % w, i / w))).collect();
                let [across, down] = image.wrap();
                Texture::Image(ImageTexture::new(w, h, pixels, across)?.with_wrap(across, down))
            }
            Texture::Mapped(m) => Texture::Mapped(Mapped { of: self.mapped_values(m.of, f, depth + 1)?, ..m }),
            Texture::Checkerboard(c) => {
                let of = [self.mapped_values(c.of[0], f, depth + 1)?, self.mapped_values(c.of[1], f, depth + 1)?];
                Texture::Checkerboard(Checkerboard { of, ..c })
            }
            Texture::Dots(d) => {
                let inside = self.mapped_values(d.inside, f, depth + 1)?;
                Texture::Dots(Dots { inside, outside: self.mapped_values(d.outside, f, depth + 1)?, ..d })
            }
            _ => return None,
        };
        Some(self.target.builder().texture(made))
    }

    /// About the mean of a texture's red channel.
    fn mean_of(&mut self, id: TextureId, depth: u32) -> f32 {
        let known = self.textures.numbers.values().chain(self.textures.colours.values()).find(|made| made.id == id);
        if let Some(made) = known {
            return made.mean.x;
        }
        if depth > MAX_DEPTH {
            return 0.5;
        }
        match self.target.builder().parts().textures[id.0 as usize].clone() {
            Texture::Constant(c) => c.rgb().x,
            Texture::Image(image) => image.mean().x,
            Texture::Mapped(m) => self.mean_of(m.of, depth + 1),
            Texture::Checkerboard(c) => 0.5 * (self.mean_of(c.of[0], depth + 1) + self.mean_of(c.of[1], depth + 1)),
            Texture::Dots(d) => 0.19 * self.mean_of(d.inside, depth + 1) + 0.81 * self.mean_of(d.outside, depth + 1),
            _ => 0.5,
        }
    }
}
