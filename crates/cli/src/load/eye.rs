//! The camera: what was said, else what the files say, else NRenderer's.
use crate::{
    args::{CameraArgs, Compat},
    failure::Failure,
};
use formats::load::{CameraSettings, Projection};
use glam::Vec3;
use serde::{Serialize, Serializer};
use sunfleck::{
    camera::{Camera, Unrolling, View},
    film::FilmSpec,
};

/// A camera as plain numbers.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub(crate) struct Eye {
    /// The kind of camera, as `--camera` takes it.
    #[serde(serialize_with = "kind")]
    projection: Projection,
    position: [f32; 3],
    look_at: [f32; 3],
    up: [f32; 3],
    /// Full vertical angle, degrees.
    fov: f32,
    /// Width of the picture's plane over its height.
    aspect: f32,
    /// Diameter of the lens.
    aperture: f32,
    /// Distance of what is sharp.
    focus: f32,
    /// Left and right are exchanged.
    mirrored: bool,
    /// How far the middle of the picture is from the line of sight, in heights of the picture.
    shift: [f32; 2],
}

/// As `--camera` takes it.
fn kind_name(projection: Projection) -> String {
    match projection {
        Projection::Perspective => "perspective".to_owned(),
        Projection::Orthographic(height) => format!("orthographic:{height}"),
        Projection::Spherical(Unrolling::Equirectangular) => "spherical".to_owned(),
        Projection::Spherical(Unrolling::EqualArea) => "spherical:equal-area".to_owned(),
    }
}

#[allow(clippy::trivially_copy_pass_by_ref, reason = "the signature that serde asks for")]
fn kind<S: Serializer>(projection: &Projection, to: S) -> Result<S::Ok, S::Error> {
    to.serialize_str(&kind_name(*projection))
}

impl Eye {
    pub(crate) fn new(said: &CameraArgs, file: &CameraSettings, compat: Option<Compat>) -> Self {
        let position = said.camera_position.unwrap_or(file.view.position);
        let look_at = said.look_at.unwrap_or(file.view.look_at);
        // NRenderer's default of 0.1 puts the plane in focus in front of nearly everything.
        let default_focus = if compat.is_some() { file.focus_distance } else { position.distance(look_at) };
        Self {
            projection: said.projection.unwrap_or(if said.fov.is_some() {
                Projection::Perspective
            } else {
                file.projection
            }),
            position: position.to_array(),
            look_at: look_at.to_array(),
            up: said.up.unwrap_or(file.view.up).to_array(),
            fov: said.fov.unwrap_or(file.fov),
            aspect: said.aspect.or(file.aspect).unwrap_or(1.0),
            aperture: said.aperture.unwrap_or(file.aperture),
            focus: said.focus.unwrap_or(default_focus),
            mirrored: file.is_mirrored,
            shift: file.shift,
        }
    }

    /// As the formats know it.
    pub(crate) fn settings(&self) -> CameraSettings {
        let [position, look_at, up] = [self.position, self.look_at, self.up].map(Vec3::from_array);
        CameraSettings {
            projection: self.projection,
            view: View { position, look_at, up },
            fov: self.fov,
            aperture: self.aperture,
            focus_distance: self.focus,
            aspect: Some(self.aspect),
            is_mirrored: self.mirrored,
            shift: self.shift,
        }
    }

    /// The camera itself.
    pub(super) fn open(&self) -> Result<Camera, Failure> {
        self.settings().build(self.aspect).map_err(|e| Failure::BadInput(e.into()))
    }

    /// One line for people.
    pub(crate) fn words(&self) -> String {
        let at = |v: [f32; 3]| v.map(|x| x.to_string()).join(",");
        let Self { fov, aspect, aperture, focus, .. } = self;
        let kind = match self.projection {
            Projection::Perspective => format!("fov {fov}°, aspect {aspect}"),
            Projection::Orthographic(height) => format!("orthographic, {height} high, aspect {aspect}"),
            Projection::Spherical(_) => kind_name(self.projection),
        };
        let lens = if *aperture > 0.0 { format!(", aperture {aperture}, focus {focus}") } else { String::new() };
        format!("at {} looking at {}, {kind}{lens}", at(self.position), at(self.look_at))
    }

    /// Width of the picture's plane over its height.
    pub(crate) fn aspect(&self) -> f32 {
        self.aspect
    }

    /// Advice where pixels are not square.
    pub(crate) fn stretch(&self, spec: &FilmSpec) -> Option<String> {
        let square = spec.width as f32 / spec.height as f32;
        let is_plane = !matches!(self.projection, Projection::Spherical(_));
        let stretched = is_plane && (self.aspect / square - 1.0).abs() > 1e-3;
        stretched.then(|| {
            format!("note: the picture is stretched: its aspect is {}, its pixels ask for {square}", self.aspect)
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use sunfleck::film::Filter;

    #[test]
    fn the_focus_follows_the_target_except_in_nrenderer() {
        let file = CameraSettings::default();
        let said = CameraArgs { look_at: Some(Vec3::new(0.0, 0.0, 2.0)), ..CameraArgs::default() };
        assert_eq!(Eye::new(&said, &file, None).focus, 5.0);
        assert_eq!(Eye::new(&said, &file, Some(Compat::Nrenderer)).focus, 0.1);
        let said = CameraArgs { focus: Some(7.0), ..said };
        assert_eq!(Eye::new(&said, &file, None).focus, 7.0);
    }

    #[test]
    fn a_stretched_picture_is_told_of() {
        let eye = Eye::new(&CameraArgs::default(), &CameraSettings::default(), None);
        let spec = |width, height| FilmSpec { width, height, filter: Filter::Box };
        assert_eq!(eye.stretch(&spec(500, 500)), None);
        assert!(eye.stretch(&spec(800, 400)).is_some_and(|s| s.ends_with("ask for 2")));
    }
}
