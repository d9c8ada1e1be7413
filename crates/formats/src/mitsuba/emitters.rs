//! `emitter`: lights that are no surfaces.

use super::document::Found;
use super::props::Props;
use super::scene::Importer;
use super::sky;
use super::spectra::Role;
use crate::diagnostic::Diagnostic;
use crate::files::first_of;
use crate::image::RgbImage32;
use glam::{DAffine3, DMat3, DVec3, Mat3, Vec2, Vec3};
use std::f32::consts::PI;
use sunfleck::light::{
    DirectionalLight, EnvironmentLight, Light, PointLight, ProjectionLight, Rim, SpotLight, SunLight,
};
use sunfleck::spectrum::Illuminant;
use sunfleck::texture::{ImageTexture, Wrap};

const EMITTERS: [&str; 14] = [
    "area",
    "collimated",
    "constant",
    "directional",
    "directionalarea",
    "envmap",
    "point",
    "projector",
    "sky",
    "spot",
    "sun",
    "sunsky",
    "timed_sunsky",
    "volpathemitter",
];

/// What takes the axes of a longitude-latitude map of ours to those of Mitsuba's, where longitude is atan2(x, -z).
const ENVMAP_FROM_MAP: Mat3 = Mat3::from_cols(Vec3::Z, Vec3::Y, Vec3::NEG_X);
/// The same for a sky whose zenith is z.
const SKY_FROM_MAP: Mat3 = Mat3::from_cols(Vec3::X, Vec3::Z, Vec3::NEG_Y);

/// Sides of a projected picture at least, in pixels.
const LEAST_PROJECTED: u32 = 256;

impl Importer<'_, '_> {
    /// Adds a light that stands in the scene.
    pub(super) fn emitter(&mut self, number: usize) -> Found<()> {
        let props = self.props(number);
        let (name, at) = props.element.plugin()?;
        // One that waits for a shape to refer to it.
        if matches!(name, "area" | "directionalarea") {
            return Ok(());
        }
        let world = props.transform("to_world")?;
        props.ignore(&["sampling_weight", "samples"]);
        match name {
            "point" => self.point(&props, &world)?,
            "spot" => self.spot(&props, &world)?,
            "projector" => self.projector(&props, &world)?,
            "directional" => self.directional(&props, &world)?,
            "constant" => {
                let radiance = self.light_of(&props, "radiance", 1.0)?;
                self.target.light(EnvironmentLight::constant(radiance));
            }
            "envmap" => self.envmap(&props, &world)?,
            "sky" | "sun" | "sunsky" | "timed_sunsky" => self.sunsky(name, &props, &world)?,
            _ if EMITTERS.contains(&name) => {
                self.near(name, &props, "nothing: it is left out");
                props.ignore(&["power", "irradiance", "radius", "scale"]);
            }
            _ => return Err(at.unknown("emitter", name, EMITTERS)),
        }
        self.tell_unused(&props);
        Ok(())
    }

    fn point(&mut self, props: &Props, world: &DAffine3) -> Found<()> {
        let p = props.vector("position")?.unwrap_or(world.translation).as_vec3();
        let intensity = self.light_of(props, "intensity", 1.0)?;
        self.target.light(PointLight { p, intensity });
        Ok(())
    }

    fn spot(&mut self, props: &Props, world: &DAffine3) -> Found<()> {
        let intensity = self.light_of(props, "intensity", 1.0)?;
        let cutoff = props.float("cutoff_angle", 20.0)?;
        let beam = props.float("beam_width", 0.75 * cutoff)?.min(cutoff);
        let angles = [beam, cutoff].map(|a| a.to_radians() as f32);
        let axis = world.transform_vector3(DVec3::Z).as_vec3();
        if let Some((number, _)) = props.get("texture")
            && let Some(picture) = self.shone_through(number)?
            && cutoff < 89.0
        {
            let [beam, out] = angles;
            let falloff = |cos: f32| ((out - cos.acos()) / (out - beam).max(1e-6)).clamp(0.0, 1.0);
            // Its first row is where y is negative.
            let axes = Vec3::new(1.0, -1.0, 1.0);
            return self.project(props, world, axes, (intensity, picture), [2.0 * out.tan(); 2], falloff);
        }
        let spot = SpotLight::new(world.translation.as_vec3(), axis, intensity, angles);
        self.target.light(spot.map_err(|e| props.bad(&e.to_string()))?.with_rim(Rim::Even));
        Ok(())
    }

    /// A plane at distance 1 gets the picture times π as its irradiance.
    fn projector(&mut self, props: &Props, world: &DAffine3) -> Found<()> {
        let scale = props.float("scale", 1.0)? as f32;
        let picture = match props.get("irradiance") {
            Some((number, _)) => self.shone_through(number)?,
            None => None,
        };
        let (intensity, picture) = match picture {
            Some(picture) => (Vec3::ONE.into(), picture),
            None => (self.light_of(props, "irradiance", 1.0)?, RgbImage32::filled(1, 1, [1.0; 3])),
        };
        let aspect = f64::from(picture.width) / f64::from(picture.height);
        let width = 2.0 * super::picture::half_tangent(props, aspect)? as f32;
        let height = width / aspect as f32;
        // As a camera would see it.
        let axes = Vec3::new(-1.0, 1.0, 1.0);
        self.project(props, world, axes, (intensity * scale, picture), [width, height], |cos| PI / cos.powi(3))
    }

    /// The picture of a texture that a light shines through; `None` with a warning for other textures.
    pub(super) fn shone_through(&mut self, number: usize) -> Found<Option<RgbImage32>> {
        let number = self.document.resolve(number)?;
        if self.document.elements[number].tag != "texture" {
            return Ok(None);
        }
        let texture = self.props(number);
        if texture.element.plugin()?.0 != "bitmap" {
            self.near("texture", &texture, "even light");
            return Ok(None);
        }
        texture.ignore(&["raw", "wrap_mode", "filter_type", "to_uv", "format"]);
        let file = texture.string("filename")?.ok_or_else(|| texture.bad("a picture needs a `filename`"))?;
        let path = self.files.find(&file.value, file.at.source.name());
        match self.files.picture(&path, self.target) {
            Ok(picture) => Ok(Some(picture.image)),
            Err(error) => {
                let severity = crate::Severity::Warning;
                let told = Diagnostic { severity, code: "mitsuba::missing-picture", ..first_of(error) };
                self.target.sink.warn("mitsuba::missing-picture", || file.at.tell(told, "shown as even light"));
                Ok(None)
            }
        }
    }

    /// A light that shines through a picture, which is `size` large at distance 1, each pixel times `factor` of its cosine.
    /// `axes` are the signs of x and y to the right and up in the picture.
    fn project(
        &mut self,
        props: &Props,
        world: &DAffine3,
        axes: Vec3,
        (intensity, picture): (Illuminant, RgbImage32),
        size: [f32; 2],
        factor: impl Fn(f32) -> f32,
    ) -> Found<()> {
        // Fine enough for the factor, too.
        let finer = LEAST_PROJECTED.div_ceil(picture.width.min(picture.height));
        let (width, height) = (picture.width * finer, picture.height * finer);
        let pixel = |i: u32| {
            let (x, y) = (i % width, i / width);
            let at = Vec2::new((x as f32 + 0.5) / width as f32 - 0.5, 0.5 - (y as f32 + 0.5) / height as f32);
            let cos = (at * Vec2::from_array(size)).extend(1.0).length().recip();
            Vec3::from_array(picture.pixel(x / finer, y / finer)) * factor(cos)
        };
        let pixels = (0..width * height).map(pixel).collect();
        let picture = ImageTexture::new(width as usize, height as usize, pixels, Wrap::Clamp);
        let picture = picture.ok_or_else(|| props.bad("the picture is empty"))?;
        let axes = turn(&world.matrix3) * Mat3::from_diagonal(axes);
        let size = Vec2::from_array(size);
        let light = ProjectionLight::new(world.translation.as_vec3(), axes, size, intensity, picture);
        self.target.light(light.map_err(|e| props.bad(&e.to_string()))?);
        Ok(())
    }

    fn directional(&mut self, props: &Props, world: &DAffine3) -> Found<()> {
        let direction = props.vector("direction")?.unwrap_or(world.transform_vector3(DVec3::Z));
        let irradiance = self.light_of(props, "irradiance", 1.0)?;
        let light = DirectionalLight::new(direction.as_vec3(), irradiance);
        self.target.light(light.ok_or_else(|| props.bad("a directional emitter needs a direction"))?);
        Ok(())
    }

    fn envmap(&mut self, props: &Props, world: &DAffine3) -> Found<()> {
        props.ignore(&["gamma", "cache", "mis_compensation"]);
        let scale = props.float("scale", 1.0)? as f32;
        let Some(file) = props.string("filename")? else {
            return Err(props.bad("an `envmap` needs a `filename`"));
        };
        let path = self.files.find(&file.value, file.at.source.name());
        let world_from_map = turn(&world.matrix3) * ENVMAP_FROM_MAP;
        let read = self.files.picture(&path, self.target).map_err(|e| Box::new(first_of(e)));
        let light = read.and_then(|picture| panorama(picture.image, scale, world_from_map));
        match light {
            Ok(light) => self.target.light(light),
            Err(error) => {
                let severity = crate::Severity::Warning;
                let told = Diagnostic { severity, code: "mitsuba::missing-picture", ..*error };
                let told = told.help("an even light of 0.5 takes its place");
                self.target.sink.warn("mitsuba::missing-picture", || file.at.tell(told, ""));
                self.target.light(EnvironmentLight::constant(Vec3::splat(0.5 * scale)));
            }
        }
        Ok(())
    }

    fn sunsky(&mut self, name: &str, props: &Props, world: &DAffine3) -> Found<()> {
        props.ignore(&["stretch", "resolution", "complex_sun", "extend"]);
        let is_old = props.element.is_old;
        let turn_to_world = turn(&world.matrix3);
        let from_map = if is_old { Mat3::IDENTITY } else { SKY_FROM_MAP };
        let sun = match props.vector("sun_direction")? {
            // In the world in old files, in the emitter's space in new ones.
            Some(d) if is_old => turn_to_world.transpose() * d.as_vec3(),
            Some(d) => from_map.transpose() * d.as_vec3(),
            None => sky::sun_at(&moment(props)?),
        };
        let sun = sun.try_normalize().ok_or_else(|| props.bad("`sun_direction` needs a length"))?;
        let turbidity = props.float("turbidity", 3.0)?.clamp(1.0, 10.0);
        let scale = props.float("scale", 1.0)?;
        let (sun_scale, sky_scale) = (props.float("sun_scale", scale)?, props.float("sky_scale", scale)?);
        let world_from_map = turn_to_world * from_map;
        let ground = if props.has("albedo") {
            self.input(props, &["albedo"], Vec3::ZERO, Role::Reflectance)?.mean
        } else {
            Vec3::splat(if is_old { 0.15 } else { 0.3 })
        };
        if name != "sun"
            && let Some(map) = sky::panorama(sun, turbidity, ground)
        {
            let light = EnvironmentLight::panorama(map, Vec3::splat(sky_scale as f32), world_from_map);
            self.target.light(light.map_err(|e| props.bad(&e.to_string()))?);
        }
        if name != "sky"
            && sun_scale > 0.0
            && let Some(irradiance) = sky::sunlight(sun, turbidity)
        {
            // Across the sky, degrees.
            let width = props.float("sun_aperture", 0.5358)? * props.float("sun_radius_scale", 1.0)?;
            let (direction, irradiance) = (world_from_map * -sun, irradiance * sun_scale as f32);
            let light: Option<Light> = if width > 0.0 {
                SunLight::new(direction, (0.5 * width.to_radians()) as f32, irradiance).map(Light::from)
            } else {
                DirectionalLight::new(direction, irradiance).map(Light::from)
            };
            light.into_iter().for_each(|light| self.target.light(light));
        }
        Ok(())
    }
}

/// Light from a picture in longitude and latitude.
fn panorama(image: RgbImage32, scale: f32, world_from_map: Mat3) -> Found<EnvironmentLight> {
    let bad = |why: &str| {
        let message = format!("this picture gives no light: {why}");
        Box::new(Diagnostic::warning("mitsuba::envmap", message))
    };
    let pixels = image.data.into_iter().map(Vec3::from_array).collect();
    let map = ImageTexture::new(image.width as usize, image.height as usize, pixels, Wrap::Repeat);
    let map = map.ok_or_else(|| bad("it is empty"))?;
    EnvironmentLight::panorama(map, Vec3::splat(scale), world_from_map).map_err(|e| bad(&e.to_string()))
}

/// Where and when; the defaults are Mitsuba's.
fn moment(props: &Props) -> Found<sky::Moment> {
    let minutes = props.float("minute", 0.0)? + props.float("second", 0.0)? / 60.0;
    Ok(sky::Moment {
        latitude: props.float("latitude", 35.6894)?,
        longitude: props.float("longitude", 139.6917)?,
        timezone: props.float("timezone", 9.0)?,
        date: [
            props.integer("year", -10_000..=10_000)?.unwrap_or(2010),
            props.integer("month", 1..=12)?.unwrap_or(7),
            props.integer("day", 1..=31)?.unwrap_or(10),
        ],
        hour: props.float("hour", 15.0)? + minutes / 60.0,
    })
}

/// The turn and mirroring in a matrix, without its scaling.
fn turn(m: &DMat3) -> Mat3 {
    let x = m.x_axis.normalize_or(DVec3::X);
    let y = (m.y_axis - x * x.dot(m.y_axis)).normalize_or(x.any_orthonormal_vector());
    let z = x.cross(y) * if m.determinant() < 0.0 { -1.0 } else { 1.0 };
    DMat3::from_cols(x, y, z).as_mat3()
}
