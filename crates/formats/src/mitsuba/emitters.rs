//! `emitter`: lights that are no surfaces.

use super::document::Found;
use super::props::Props;
use super::scene::Importer;
use super::sky;
use crate::diagnostic::Diagnostic;
use crate::files::first_of;
use crate::image::RgbImage32;
use glam::{DAffine3, DMat3, DVec3, Mat3, Vec3};
use sunfleck::light::{DirectionalLight, EnvironmentLight, PointLight, Rim, SpotLight};
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
        let mut intensity = self.light_of(props, "intensity", 1.0)?;
        if props.has("texture") {
            let texture = self.light_of(props, "texture", 1.0)?;
            intensity = (intensity.rgb() * texture.rgb()).into();
        }
        let cutoff = props.float("cutoff_angle", 20.0)?;
        let beam = props.float("beam_width", 0.75 * cutoff)?.min(cutoff);
        let angles = [beam, cutoff].map(|a| a.to_radians() as f32);
        let axis = world.transform_vector3(DVec3::Z).as_vec3();
        let spot = SpotLight::new(world.translation.as_vec3(), axis, intensity, angles);
        self.target.light(spot.map_err(|e| props.bad(&e.to_string()))?.with_rim(Rim::Even));
        Ok(())
    }

    /// As a cone without a picture.
    fn projector(&mut self, props: &Props, world: &DAffine3) -> Found<()> {
        self.near("projector", props, "a cone without a picture");
        props.ignore(&["fov_axis", "focal_length"]);
        let intensity = self.light_of(props, "irradiance", 1.0)? * props.float("scale", 1.0)? as f32;
        let half = (0.5 * props.float("fov", 39.6)?.clamp(1.0, 179.0)).to_radians() as f32;
        let axis = world.transform_vector3(DVec3::Z).as_vec3();
        let spot = SpotLight::new(world.translation.as_vec3(), axis, intensity, [0.98 * half, half]);
        self.target.light(spot.map_err(|e| props.bad(&e.to_string()))?);
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
        props.ignore(&["albedo", "stretch", "resolution", "sun_radius_scale", "sun_aperture", "complex_sun", "extend"]);
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
        if name != "sun"
            && let Some(map) = sky::panorama(sun, turbidity)
        {
            let light = EnvironmentLight::panorama(map, Vec3::splat(sky_scale as f32), world_from_map);
            self.target.light(light.map_err(|e| props.bad(&e.to_string()))?);
        }
        if name != "sky"
            && sun_scale > 0.0
            && let Some(irradiance) = sky::sunlight(sun, turbidity)
            && let Some(light) = DirectionalLight::new(world_from_map * -sun, irradiance * sun_scale as f32)
        {
            self.target.light(light);
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
