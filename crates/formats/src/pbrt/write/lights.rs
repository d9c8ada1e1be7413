//! Lights that are no surfaces.

use super::Writer;
use super::text::{float, light, matrix, numbers, ours, param, point, string};
use crate::Error;
use crate::image::RgbImage32;
use glam::{Affine3A, Mat3, Vec2, Vec3};
use sunfleck::light::{EnvironmentLight, GoniometricLight, Light, ProjectionLight, Rim, SpotLight};
use sunfleck::math::warp::square_to_equal_area_sphere;
use sunfleck::texture::ImageTexture;

/// Pixels along a side of pictures in pbrt's layout of the sphere, at most.
const MAX_SIDE: f32 = 2048.0;

impl Writer<'_> {
    pub(super) fn lights(&mut self) -> Result<(), Error> {
        let lights = self.scene.parts.lights;
        for l in lights {
            match l {
                Light::Point(l) => {
                    let line = format!("\"point\"{}{}", light("I", &l.intensity), point("from", l.p));
                    self.source(None, &line);
                }
                Light::Directional(l) => {
                    let to = point("from", Vec3::ZERO) + &point("to", l.direction());
                    let line = format!("\"distant\"{}{to}", light("L", l.irradiance()));
                    self.source(None, &line);
                }
                Light::Sun(l) => {
                    let to = point("from", Vec3::ZERO) + &point("to", l.direction());
                    let disc = ours(&float("radius", l.radius()));
                    let line = format!("\"distant\"{}{to}{disc}", light("L", l.irradiance()));
                    self.source(None, &line);
                }
                Light::Spot(l) => {
                    let line = spot(l);
                    self.source(None, &line);
                }
                Light::Environment(l) => self.environment(l)?,
                Light::Goniometric(l) => self.goniometric(l)?,
                Light::Projection(l) => self.projection(l)?,
                // Surfaces that emit are told of with their shapes.
                Light::Area(_) => {}
                #[allow(unreachable_patterns, reason = "lights may be added without a word for them here")]
                _ => self.note("some lights have no words in pbrt and are left out"),
            }
        }
        Ok(())
    }

    /// A light source, in a space of its own if there is a transformation.
    fn source(&mut self, world_from_light: Option<Affine3A>, what: &str) {
        match world_from_light {
            None => self.line(&format!("LightSource {what}")),
            Some(m) => {
                let m = matrix(&m);
                self.line(&format!("AttributeBegin\n  Transform {m}\n  LightSource {what}\nAttributeEnd"));
            }
        }
    }

    fn environment(&mut self, l: &EnvironmentLight) -> Result<(), Error> {
        let Some((image, world_from_map)) = l.picture() else {
            let line = format!("\"infinite\"{}", light("L", l.radiance()));
            self.source(None, &line);
            return Ok(());
        };
        let (files, m) = self.around(image, world_from_map, l.radiance().rgb())?;
        // pbrt takes a picture or a colour; what the picture is multiplied by is in it for pbrt.
        let line = format!("\"infinite\"{}{}", files, ours(&light("L", l.radiance())));
        self.source(Some(m), line.trim_end());
        Ok(())
    }

    fn goniometric(&mut self, l: &GoniometricLight) -> Result<(), Error> {
        let (image, world_from_map) = l.picture();
        let (files, m) = self.around(image, world_from_map, Vec3::ONE)?;
        let m = Affine3A::from_mat3_translation(Mat3::from(m.matrix3), l.position());
        let line = format!("\"goniometric\"{}{files}", light("I", l.intensity()));
        self.source(Some(m), line.trim_end());
        Ok(())
    }

    /// A picture of the sphere times `tint` in pbrt's square layout, and as it is for us; and what takes pbrt's axes to the world's.
    fn around(&mut self, image: &ImageTexture, world_from_map: Mat3, tint: Vec3) -> Result<(String, Affine3A), Error> {
        // As the reader has it: the axes of a longitude-latitude map in a light's space with z up.
        let light_from_map = Mat3::from_cols(-Vec3::X, Vec3::Z, -Vec3::Y);
        let (w, h) = (image.width(), image.height());
        let side = ((w * h) as f32).sqrt().ceil().clamp(1.0, MAX_SIDE) as u32;
        let pixel = |i: u32| {
            let place = (Vec2::new((i % side) as f32, (i / side) as f32) + 0.5) / side as f32;
            let d = light_from_map.transpose() * square_to_equal_area_sphere(place);
            let longitude = (d.z.atan2(d.x) + std::f32::consts::PI) / std::f32::consts::TAU;
            let latitude = d.x.hypot(d.z).atan2(d.y) / std::f32::consts::PI;
            (tint * image.eval(Vec2::new(longitude, 1.0 - latitude))).to_array()
        };
        let square = RgbImage32 { width: side, height: side, data: (0..side * side).map(pixel).collect() };
        let long = RgbImage32 { width: w as u32, height: h as u32, data: pixels(image) };
        let (square, long) = (self.files.picture(square)?, self.files.picture(long)?);
        let params = string("filename", &square) + &ours(&string("latlong", &long));
        Ok((params, Affine3A::from_mat3(world_from_map * light_from_map.transpose())))
    }

    fn projection(&mut self, l: &ProjectionLight) -> Result<(), Error> {
        let image = l.picture();
        let (w, h) = (image.width() as f32, image.height() as f32);
        let file = self.files.picture(RgbImage32 { width: w as u32, height: h as u32, data: pixels(image) })?;
        let size = l.size();
        let fov = 2.0 * (0.5 * size.min_element()).atan().to_degrees();
        let ours = ours(&param("float", "window", &numbers(size.to_array())));
        let params = format!(
            "\"projection\"{}{}{}{ours}",
            light("I", l.intensity()),
            string("filename", &file),
            float("fov", fov)
        );
        let m = Affine3A::from_mat3_translation(l.axes(), l.position());
        self.source(Some(m), params.trim_end());
        Ok(())
    }
}

fn spot(l: &SpotLight) -> String {
    let [hot, out] = l.angles().map(f32::to_degrees);
    let rim = match l.rim() {
        Rim::Smooth => String::new(),
        Rim::Square => ours(&string("rim", "square")),
        Rim::Fourth => ours(&string("rim", "fourth")),
        Rim::Even => ours(&string("rim", "even")),
    };
    let p = l.position();
    let cone = float("coneangle", out) + &float("conedeltaangle", out - hot);
    let line = format!(
        "\"spot\"{}{}{}{cone}{rim}",
        light("I", l.intensity()),
        point("from", p),
        point("to", p + l.direction())
    );
    line.trim_end().to_owned()
}

fn pixels(image: &ImageTexture) -> Vec<[f32; 3]> {
    let w = image.width();
    (0..w * image.height()).map(|i| image.pixel(i % w, i / w).to_array()).collect()
}
