//! Lights that shine through a picture: `goniometric` and `projection`.

use super::directives::{Importer, warning};
use super::infinite;
use super::lights::{luminance, rotation};
use super::params::{Found, Params};
use crate::image::RgbImage32;
use glam::{DVec3, Mat3, Vec2, Vec3};
use sunfleck::light::{Emitter, GoniometricLight, ProjectionLight, Surroundings};
use sunfleck::spectrum::{Illuminant, Wavelengths};
use sunfleck::texture::{ImageTexture, Wrap};

impl Importer<'_> {
    /// The picture of a light under the name it has in either version, and that name: `latlong` is our own writer's.
    fn shone_through(&mut self, params: &Params) -> Found<Option<(RgbImage32, &'static str)>> {
        params.ignore(&["filename"]);
        let Some(name) = ["latlong", "filename", "mapname"].into_iter().find(|n| params.get(n).is_some()) else {
            return Ok(None);
        };
        let picture = self.picture_file(params, name, "taken as white")?.map(|(image, _)| image);
        // Light without a picture stands for what is missing.
        let image = picture.unwrap_or_else(|| RgbImage32::filled(1, 1, [1.0; 3]));
        Ok(Some((image, name)))
    }

    pub(super) fn goniometric(&mut self, params: &Params) -> Found<()> {
        let Some((image, name)) = self.shone_through(params)? else { return self.point(params) };
        let intensity = self.emitted(params, "I")?;
        let p = self.place(params, "from", DVec3::ZERO)?;
        let world_from_light = rotation(&self.state.world_from_object().matrix3);
        // Version 3 looks its map up with y and z exchanged, the map's pole along y.
        let swap = if name == "mapname" { Mat3::from_cols(Vec3::X, Vec3::Z, Vec3::Y) } else { Mat3::IDENTITY };
        let light = infinite::panorama(if name == "latlong" { image } else { grey(image) }, name == "filename")
            .and_then(|(map, light_from_map)| {
                let world_from_map = world_from_light * swap * light_from_map;
                GoniometricLight::new(p, intensity.clone(), map, world_from_map).map_err(|e| e.to_string())
            });
        match light {
            Ok(light) => {
                let factor = self.asked_power(params, &light, &intensity)?;
                let (map, world_from_map) = light.picture();
                let map = map.clone();
                if let Ok(light) = GoniometricLight::new(p, intensity * factor, map, world_from_map) {
                    self.target.light(light);
                }
            }
            Err(why) => self.dark_picture(params, &why),
        }
        Ok(())
    }

    pub(super) fn projection(&mut self, params: &Params) -> Found<()> {
        let Some((image, _)) = self.shone_through(params)? else {
            return Err(params.bad("pbrt::no-file", "a projection needs a `filename`"));
        };
        let intensity = self.emitted(params, "I")?;
        let fov = params.number("fov", 90.0)?;
        if !(fov > 0.0 && fov < 180.0) {
            return Err(params.bad("pbrt::value", "the field of view must be more than 0 and less than 180 degrees"));
        }
        let world = self.state.world_from_object();
        let axes = rotation(&world.matrix3);
        let (width, height) = (image.width as f32, image.height as f32);
        // The shorter side has the angle, unless our own writer says more.
        let size = match params.numbers("window", 2)? {
            Some(window) => Vec2::new(window[0] as f32, window[1] as f32),
            None => 2.0 * (0.5 * fov as f32).to_radians().tan() * Vec2::new(width, height) / width.min(height),
        };
        let pixels = image.data.iter().map(|p| Vec3::from_array(*p)).collect();
        let picture = ImageTexture::new(image.width as usize, image.height as usize, pixels, Wrap::Clamp);
        let Some(picture) = picture else { return Ok(()) };
        let p = world.translation.as_vec3();
        match ProjectionLight::new(p, axes, size, intensity.clone(), picture.clone()) {
            Ok(light) => {
                let factor = self.asked_power(params, &light, &intensity)?;
                if let Ok(light) = ProjectionLight::new(p, axes, size, intensity * factor, picture) {
                    self.target.light(light);
                }
            }
            Err(why) => self.dark_picture(params, &why.to_string()),
        }
        Ok(())
    }

    /// What `power` multiplies a light by.
    fn asked_power(&mut self, params: &Params, light: &impl Emitter, intensity: &Illuminant) -> Found<f32> {
        let nothing = Surroundings { centre: Vec3::ZERO, radius: 1.0, lambda: Wavelengths::Rgb };
        let flux = luminance(&light.power(&nothing).into()) / luminance(intensity).max(f32::MIN_POSITIVE);
        self.power(params, intensity, flux)
    }

    fn dark_picture(&mut self, params: &Params, why: &str) {
        let message = format!("this picture gives no light: {why}");
        let told = params.at.tell(warning("pbrt::environment", message), "");
        self.target.sink.warn("pbrt::environment", || told);
    }
}

/// Goniometric pictures have one channel; of those with three the mean counts.
fn grey(mut image: RgbImage32) -> RgbImage32 {
    image.data.iter_mut().for_each(|p| *p = [p.iter().sum::<f32>() / 3.0; 3]);
    image
}
