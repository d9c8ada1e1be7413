//! `LightSource` and `AreaLightSource`.
//!
//! Version 4 gives light in photometric terms: what is not `rgb` has brightness 1 times `scale`. All radiance is multiplied
//! by the exposure of the film, so that pixel values are pbrt's.

use super::directives::{Importer, unknown, warning};
use super::infinite;
use super::params::{Found, Params};
use super::spectra::Role;
use glam::{DMat3, DVec3, Mat3, Vec3};
use std::f32::consts::PI;
use sunfleck::light::{DirectionalLight, EnvironmentLight, Light, PointLight, Rim, Sides, SpotLight, SunLight};
use sunfleck::spectrum::Illuminant;

const LIGHTS: [&str; 7] = ["distant", "goniometric", "infinite", "point", "projection", "spot", "exinfinite"];

impl Importer<'_> {
    pub(super) fn light_source(&mut self, name: &str, params: Params) -> Found<()> {
        let params = self.with_defaults("light", params);
        match name {
            "distant" => self.distant(&params)?,
            "infinite" | "exinfinite" => self.infinite(&params)?,
            "point" => self.point(&params)?,
            "spot" => self.spot(&params)?,
            "goniometric" => self.goniometric(&params)?,
            "projection" => self.projection(&params)?,
            _ => return Err(unknown(&params.at, "light", name, LIGHTS)),
        }
        self.tell_unused(&params);
        Ok(())
    }

    /// A colour of light times `scale` and exposure.
    pub(super) fn emitted(&mut self, params: &Params, name: &'static str) -> Found<Illuminant> {
        let light = match params.get(name).cloned() {
            Some(param) => self.illuminant(&param)?,
            None => Vec3::ONE.into(),
        };
        // A number in version 4, a colour in version 3.
        let scale = match params.get("scale").cloned() {
            Some(param) => self.colour(&param, Role::Reflectance)?.rgb(),
            None => Vec3::ONE,
        };
        let is_grey = scale == Vec3::splat(scale.x);
        let light = if is_grey { light * scale.x } else { (light.rgb() * scale).into() } * self.picture.exposure();
        let light = self.picture.film.balanced(light.rgb()).map_or(light, Illuminant::from);
        let colour = light.rgb();
        if colour.is_finite() && colour.min_element() >= 0.0 {
            return Ok(light);
        }
        if colour.is_finite() {
            params.get(name).inspect(|p| {
                let told = p.at.tell(warning("pbrt::negative-light", "negative light is taken as none"), "");
                self.target.sink.warn("pbrt::negative-light", || told);
            });
            return Ok(colour.max(Vec3::ZERO).into());
        }
        Err(params.bad("pbrt::value", "this light is not finite"))
    }

    /// What to multiply a light by for the flux that `power` asks for, when it gives `flux` lumens over its luminance.
    pub(super) fn power(&self, params: &Params, light: &Illuminant, flux: f32) -> Found<f32> {
        let Some(power) = params.maybe_number("power")? else { return Ok(1.0) };
        let given = luminance(light) / self.picture.exposure() * flux;
        Ok(if power > 0.0 && given > 0.0 { power as f32 / given } else { 1.0 })
    }

    pub(super) fn place(&self, params: &Params, name: &'static str, default: DVec3) -> Found<Vec3> {
        let p = params.vec3(name)?.unwrap_or(default);
        Ok(self.state.world_from_object().transform_point3(p).as_vec3())
    }

    pub(super) fn point(&mut self, params: &Params) -> Found<()> {
        let intensity = self.emitted(params, "I")?;
        let power = self.power(params, &intensity, 4.0 * PI)?;
        let p = self.place(params, "from", DVec3::ZERO)?;
        self.target.light(PointLight { p, intensity: intensity * power });
        Ok(())
    }

    fn distant(&mut self, params: &Params) -> Found<()> {
        let mut irradiance = self.emitted(params, "L")?;
        if let Some(lux) = params.maybe_number("illuminance")?.filter(|lux| *lux > 0.0) {
            let now = luminance(&irradiance).max(f32::MIN_POSITIVE);
            irradiance = irradiance * (lux as f32 / now * self.picture.exposure());
        }
        params.ignore(&["power"]);
        let from = params.vec3("from")?.unwrap_or(DVec3::ZERO);
        let to = params.vec3("to")?.unwrap_or(DVec3::Z);
        let direction = self.state.world_from_object().transform_vector3(to - from).as_vec3();
        // Our own word for a disc.
        let radius = params.maybe_number("radius")?.filter(|r| *r > 0.0);
        let light: Option<Light> = match radius {
            Some(radius) => SunLight::new(direction, radius as f32, irradiance).map(Light::from),
            None => DirectionalLight::new(direction, irradiance).map(Light::from),
        };
        match light {
            Some(light) => self.target.light(light),
            None => return Err(params.bad("pbrt::value", "a distant light needs a direction: `from` is `to`")),
        }
        Ok(())
    }

    fn spot(&mut self, params: &Params) -> Found<()> {
        let cone = params.number("coneangle", 30.0)?.to_radians();
        let delta = params.number("conedeltaangle", 5.0)?.to_radians();
        let (from, to) = (self.place(params, "from", DVec3::ZERO)?, self.place(params, "to", DVec3::Z)?);
        self.cone(params, from, to - from, [(cone - delta).max(0.0), cone])
    }

    fn cone(&mut self, params: &Params, p: Vec3, direction: Vec3, [hot, out]: [f64; 2]) -> Found<()> {
        let intensity = self.emitted(params, "I")?;
        // Only version 4, with its smooth rim, knows `power`.
        let solid_angle = PI * (2.0 - hot.cos() - out.cos()) as f32;
        let power = self.power(params, &intensity, solid_angle)?;
        let spot = SpotLight::new(p, direction, intensity * power, [hot as f32, out as f32]);
        let spot = spot.map_err(|e| params.bad("pbrt::value", &e.to_string()))?;
        // Our own writer says so where it is not that of the version.
        let rim = params.word("rim", "", &["fourth", "smooth", "even", "square"])?;
        let rim = match rim {
            "even" => Rim::Even,
            "square" => Rim::Square,
            "fourth" => Rim::Fourth,
            _ if self.picture.is_version_3 => Rim::Fourth,
            _ => Rim::Smooth,
        };
        self.target.light(spot.with_rim(rim));
        Ok(())
    }

    fn infinite(&mut self, params: &Params) -> Found<()> {
        params.ignore(&["nsamples", "samples", "filename"]);
        if let Some(portal) = params.get("portal") {
            let at = portal.at.clone();
            let message = "a portal is not used: light from outside finds its way without it";
            self.warn_once("pbrt::portal", "", || at.tell(warning("pbrt::portal", message), "ignored"));
        }
        let mut radiance = self.emitted(params, "L")?;
        let lux = params.maybe_number("illuminance")?.filter(|lux| *lux > 0.0);
        let name = ["latlong", "filename", "mapname"].into_iter().find(|n| params.get(n).is_some());
        let picture = match name {
            Some(name) => self.picture_file(params, name, "taken as white")?,
            None => None,
        };
        let Some((image, at)) = picture else {
            if let Some(lux) = lux {
                // A hemisphere of radiance L gives πL.
                let now = (PI * luminance(&radiance)).max(f32::MIN_POSITIVE);
                radiance = radiance * (lux as f32 / now * self.picture.exposure());
            }
            self.target.light(EnvironmentLight::constant(radiance));
            return Ok(());
        };
        if let Some(lux) = lux {
            let found = infinite::illuminance(&image) / self.picture.exposure();
            radiance = radiance * (lux as f32 / found.max(f32::MIN_POSITIVE));
        }
        let world_from_light = rotation(&self.state.world_from_object().matrix3);
        let map = infinite::panorama(image, name == Some("filename"));
        let light = map.and_then(|(map, light_from_map)| {
            EnvironmentLight::panorama(map, radiance, world_from_light * light_from_map).map_err(|e| e.to_string())
        });
        match light {
            Ok(light) => self.target.light(light),
            Err(why) => {
                let told = at.tell(warning("pbrt::environment", format!("this picture gives no light: {why}")), "");
                self.target.sink.warn("pbrt::environment", || told);
            }
        }
        Ok(())
    }

    /// Checks the kind; the light itself is made with each shape.
    pub(super) fn area_light(&mut self, name: &str, params: Params) -> Found<Params> {
        let params = self.with_defaults("light", params);
        if name != "diffuse" && name != "area" {
            return Err(unknown(&params.at, "area light", name, ["diffuse"]));
        }
        // Asks for all it knows, so that what is left can be told of once and not with each shape.
        self.emission(&params, 1.0)?;
        params.ignore(&["nsamples", "samples"]);
        if let Some(param) = params.get("filename") {
            let at = param.at.clone();
            let message = "the picture on an area light is left out: it shines evenly";
            self.warn_once("pbrt::area-picture", "", || at.tell(warning("pbrt::area-picture", message), ""));
        }
        self.tell_unused(&params);
        Ok(params)
    }

    /// What a shape of that area emits.
    pub(super) fn emission(&mut self, params: &Params, area: f32) -> Found<Option<(Illuminant, Sides)>> {
        let radiance = self.emitted(params, "L")?;
        let sides = if params.bool("twosided", false)? { Sides::Two } else { Sides::One };
        let both = if sides == Sides::Two { 2.0 } else { 1.0 };
        let power = self.power(params, &radiance, PI * area * both)?;
        Ok((!radiance.is_black()).then(|| (radiance * power, sides)))
    }
}

/// Luminance of linear sRGB.
pub(super) fn luminance(light: &Illuminant) -> f32 {
    light.rgb().dot(Vec3::new(0.212_639, 0.715_169, 0.072_192))
}

/// The turn and mirroring in a matrix, without its scaling.
pub(super) fn rotation(m: &DMat3) -> Mat3 {
    let x = m.x_axis.normalize_or(DVec3::X);
    let y = (m.y_axis - x * x.dot(m.y_axis)).normalize_or(DVec3::Y);
    let z = x.cross(y) * if m.determinant() < 0.0 { -1.0 } else { 1.0 };
    DMat3::from_cols(x, y, z).as_mat3()
}
