//! Colours and spectra: how the file gives them, and what they are here.

use super::directives::Importer;
use super::params::{Found, Param, Values};
use crate::diagnostic::Diagnostic;
use crate::files::first_of;
use glam::{DMat3, DVec3, Vec3};
use sunfleck::spectrum::{Colour, Curve, Illuminant, Ior, NAMED, Named, named};

/// What a property of matter is.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub(super) enum Role {
    /// A colour: a spectrum of ones is white.
    Reflectance,
    /// An index of refraction or an extinction.
    Index,
}

/// A spectrum by name: one that is known, or a file.
enum ByName {
    Known(&'static Named),
    File(Curve),
}

impl Importer<'_> {
    /// The property that a parameter gives by numbers or by name.
    pub(super) fn colour(&mut self, param: &Param, role: Role) -> Found<Colour> {
        let of_curve = |curve| match role {
            Role::Reflectance => Colour::reflectance(curve),
            Role::Index => Colour::index(curve),
        };
        match (param.kind.as_str(), &param.values) {
            ("spectrum", Values::Strings(names)) if names.len() == 1 => Ok(match self.by_name(&names[0], param)? {
                ByName::Known(known) => self.known(known, role),
                ByName::File(curve) => of_curve(curve),
            }),
            ("spectrum", Values::Numbers(pairs)) if pairs.len() > 1 => Ok(of_curve(curve_of(pairs, param)?)),
            (kind, Values::Numbers(numbers)) => match by_numbers(kind, numbers) {
                Some(rgb) => Ok(rgb.into()),
                None => Err(param.expected(expected(kind))),
            },
            _ => Err(param.expected("a colour")),
        }
    }

    /// The light that a parameter gives. What is not `rgb` has luminance 1 in version 4.
    pub(super) fn illuminant(&mut self, param: &Param) -> Found<Illuminant> {
        let is_version_3 = self.picture.is_version_3;
        let of_curve = |curve: &Curve| {
            if is_version_3 { Illuminant::spectrum(curve.clone()) } else { Illuminant::of_luminance(curve, 1.0) }
        };
        match (param.kind.as_str(), &param.values) {
            ("spectrum", Values::Strings(names)) if names.len() == 1 => match self.by_name(&names[0], param)? {
                ByName::Known(known) if known.is_lamp() => Ok(known.illuminant()),
                ByName::Known(_) => Err(param.expected("a spectrum of light")),
                ByName::File(curve) => Ok(of_curve(&curve)),
            },
            ("spectrum", Values::Numbers(pairs)) if pairs.len() > 1 => Ok(of_curve(&curve_of(pairs, param)?)),
            ("blackbody", Values::Numbers(n)) if (1..=2).contains(&n.len()) && n[0] > 0.0 => Ok(match n[..] {
                // Version 3 divides by the largest value and multiplies by a scale.
                [kelvin, scale] => Illuminant::spectrum(Curve::blackbody(kelvin as f32)) * scale as f32,
                _ => Illuminant::of_luminance(&Curve::blackbody(n[0] as f32), 1.0),
            }),
            (kind, Values::Numbers(numbers)) => match by_numbers(kind, numbers) {
                Some(rgb) => Ok(rgb.into()),
                None => Err(param.expected(expected(kind))),
            },
            _ => Err(param.expected("a colour of light")),
        }
    }

    /// A known spectrum as a property, made once.
    pub(super) fn known(&mut self, known: &'static Named, role: Role) -> Colour {
        let make = || match role {
            Role::Reflectance => Colour::reflectance(known.curve()),
            Role::Index => known.colour(),
        };
        self.known_spectra.entry((known.name, role)).or_insert_with(make).clone()
    }

    fn by_name(&mut self, name: &str, param: &Param) -> Found<ByName> {
        if let Some(known) = named(name) {
            return Ok(ByName::Known(known));
        }
        let path = self.files.find(name, param.at.source.name());
        if self.files.is_missing(&path) {
            let error = param.at.tell(Diagnostic::error("pbrt::spectrum", format!("no spectrum or file `{name}`")), "");
            return Err(Box::new(error.one_of(name, NAMED.iter().map(|n| n.name))));
        }
        let bytes = self.files.read(&path).map_err(|e| Box::new(param.at.tell(first_of(e), "named here")))?;
        self.target.input(&bytes);
        let pairs = spd(&bytes).ok_or_else(|| param.expected("a file of pairs of numbers, wavelength and value"))?;
        Ok(ByName::File(curve_of(&pairs, param)?))
    }

    /// The index of refraction that a parameter gives.
    pub(super) fn index(&mut self, param: &Param) -> Found<Ior> {
        match (param.kind.as_str(), &param.values) {
            ("spectrum", Values::Strings(names)) if names.len() == 1 => Ok(match self.by_name(&names[0], param)? {
                ByName::Known(known) => known.ior().unwrap_or_else(|| Ior::Constant(known.curve().channels().y)),
                ByName::File(curve) => Ior::fitted(&curve),
            }),
            ("spectrum", Values::Numbers(pairs)) if pairs.len() > 1 => Ok(Ior::fitted(&curve_of(pairs, param)?)),
            _ => Ok(Ior::Constant(self.colour(param, Role::Index)?.rgb().y)),
        }
    }
}

/// Three numbers, or one for grey. `None` if there are others.
fn by_numbers(kind: &str, numbers: &[f64]) -> Option<Vec3> {
    let rgb = match (kind, numbers) {
        ("rgb" | "color", &[r, g, b]) => DVec3::new(r, g, b),
        ("xyz", &[x, y, z]) => rgb_from_xyz(DVec3::new(x, y, z)),
        ("blackbody", _) => return None,
        (_, &[grey]) => DVec3::splat(grey),
        _ => return None,
    };
    Some(rgb.as_vec3())
}

fn expected(kind: &str) -> &'static str {
    match kind {
        "blackbody" => "a temperature in kelvin",
        "spectrum" => "pairs of numbers, wavelength and value, or a name",
        _ => "three numbers",
    }
}

/// Pairs of wavelength (nm) and value.
fn curve_of(numbers: &[f64], param: &Param) -> Found<Curve> {
    if !numbers.len().is_multiple_of(2) {
        return Err(param.expected(expected("spectrum")));
    }
    let pairs: Vec<(f32, f32)> = numbers.chunks_exact(2).map(|p| (p[0] as f32, p[1] as f32)).collect();
    Curve::sampled(&pairs).map_err(|e| param.expected(e.to_string()))
}

/// The numbers of an `.spd` file: pairs in any lines, `#` begins a comment.
fn spd(bytes: &[u8]) -> Option<Vec<f64>> {
    let text = String::from_utf8_lossy(bytes);
    let words = text.lines().flat_map(|line| line.split('#').next().unwrap_or("").split_whitespace());
    words.map(|w| w.parse().ok()).collect()
}

/// XYZ to linear sRGB (IEC 61966-2-1).
fn rgb_from_xyz(xyz: DVec3) -> DVec3 {
    let m = DMat3::from_cols_array(&[
        3.240_97, -0.969_244, 0.055_630, -1.537_383, 1.875_968, -0.203_977, -0.498_611, 0.041_555, 1.056_972,
    ]);
    m * xyz
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn files_of_samples_may_have_comments() {
        assert_eq!(spd(b"# a comment\n400 1 # here\n500\t3\n"), Some(vec![400.0, 1.0, 500.0, 3.0]));
        assert_eq!(spd(b"400 one"), None);
    }
}
