//! Colours and spectra: how the file gives them, and what they are here.

use super::document::{Attribute, Element, Found};
use super::props::{Props, numbers};
use super::scene::Importer;
use crate::files::first_of;
use crate::image::linear_from_srgb;
use glam::Vec3;
use sunfleck::spectrum::{Colour, Curve, Illuminant};

/// Kinds of spectra that `spectrum type=...` may ask for.
const SPECTRA: [&str; 9] =
    ["blackbody", "d65", "irregular", "raw_constant", "rawconstant", "regular", "rgb", "srgb", "uniform"];

/// What a colour is for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Role {
    /// A share of light in [0, 1].
    Reflectance,
    /// An index of refraction or an extinction.
    Index,
}

/// A colour as a file gives it.
#[derive(Clone, Debug)]
pub(super) enum Given {
    Rgb(Vec3),
    Curve(Curve),
}

impl Given {
    fn times(self, scale: f64) -> Self {
        match self {
            Self::Rgb(rgb) => Self::Rgb(rgb * scale as f32),
            Self::Curve(curve) => Self::Curve(curve.scaled(scale as f32)),
        }
    }
    /// As a property of matter.
    pub(super) fn colour(self, role: Role) -> Colour {
        match (self, role) {
            (Self::Rgb(rgb), Role::Reflectance) => rgb.clamp(Vec3::ZERO, Vec3::ONE).into(),
            (Self::Rgb(rgb), Role::Index) => rgb.max(Vec3::ZERO).into(),
            (Self::Curve(curve), Role::Reflectance) => Colour::reflectance(curve),
            (Self::Curve(curve), Role::Index) => Colour::index(curve),
        }
    }
    /// As light.
    pub(super) fn illuminant(self) -> Illuminant {
        match self {
            Self::Rgb(rgb) => rgb.max(Vec3::ZERO).into(),
            Self::Curve(curve) => Illuminant::spectrum(curve),
        }
    }
}

impl Importer<'_, '_> {
    /// The colour of an element that is a value, or a spectrum by plugin.
    pub(super) fn given(&mut self, number: usize) -> Found<Given> {
        let element = &self.document.elements[number];
        if self.is_object(number) {
            return self.spectrum_plugin(number);
        }
        match element.tag.as_str() {
            "float" | "integer" => match numbers(element.required("value")?)?[..] {
                [grey] => Ok(Given::Rgb(Vec3::splat(grey as f32))),
                _ => Err(element.at.bad("mitsuba::value", "a number is needed")),
            },
            "rgb" => rgb(element.required("value")?, false),
            "srgb" => rgb(element.required("value")?, true),
            "spectrum" => self.inline(element),
            "blackbody" => blackbody_element(element),
            _ => {
                let error = element.at.bad("mitsuba::kind", format!("`{}` is no colour", element.tag));
                Err(Box::new(error.expected("`rgb`, `spectrum`, `float` or `texture`")))
            }
        }
    }

    /// A property that is light; black is none.
    pub(super) fn light_of(&mut self, props: &Props, name: &'static str, default: f64) -> Found<Illuminant> {
        let Some((number, _)) = props.get(name) else {
            return Ok(Vec3::splat(default as f32).into());
        };
        let number = self.document.resolve(number)?;
        if self.document.elements[number].tag == "texture" {
            let mean = self.texture(number)?.mean;
            self.warn_once(
                "mitsuba::textured-light",
                name,
                props,
                "a light with a picture shines evenly, as bright as its mean",
            );
            return Ok(mean.into());
        }
        Ok(self.given(number)?.illuminant())
    }

    /// `value` is one number, three in old files, or pairs `wavelength:value`; `filename` names a file of pairs.
    fn inline(&mut self, element: &Element) -> Found<Given> {
        if let Some(name) = element.attribute("filename") {
            let path = self.files.find(&name.value, name.at.source.name());
            let bytes = self.files.read(&path).map_err(|e| Box::new(name.at.tell(first_of(e), "named here")))?;
            self.target.input(&bytes);
            return curve(&String::from_utf8_lossy(&bytes), name);
        }
        let value = element.required("value")?;
        if value.value.contains(':') {
            return curve(&value.value, value);
        }
        match numbers(value)?[..] {
            [grey] => Ok(Given::Rgb(Vec3::splat(grey as f32))),
            [r, g, b] => Ok(Given::Rgb(glam::DVec3::new(r, g, b).as_vec3())),
            _ => {
                let error = value.at.bad("mitsuba::value", "this is no spectrum");
                Err(Box::new(error.expected("one number, or pairs such as `400:0.1, 700:0.5`")))
            }
        }
    }

    fn spectrum_plugin(&mut self, number: usize) -> Found<Given> {
        let props = self.props(number);
        let (name, _) = props.element.plugin()?;
        let given = match name {
            "uniform" | "raw_constant" | "rawconstant" => {
                props.ignore(&["wavelength_min", "wavelength_max"]);
                Given::Rgb(Vec3::splat(props.float("value", 1.0)? as f32))
            }
            "d65" => {
                let scale = props.float("scale", 1.0)?;
                let colour = match props.get("color") {
                    Some((number, _)) => self.given(number)?,
                    None => Given::Rgb(Vec3::ONE),
                };
                colour.times(scale)
            }
            "srgb" | "rgb" => match props.get("color").or(props.get("value")) {
                Some((number, _)) => self.once(number, |this| this.given(number))?,
                None => Given::Rgb(Vec3::ONE),
            },
            "blackbody" => {
                props.ignore(&["wavelength_min", "wavelength_max"]);
                let kelvin = props.float("temperature", 5000.0)?;
                planck(kelvin, props.float("scale", 1.0)?)
                    .ok_or_else(|| props.bad("a temperature is above 0 kelvin"))?
            }
            "regular" | "irregular" => regular(&props)?,
            _ => return Err(props.unknown_plugin("spectrum", &SPECTRA)),
        };
        self.tell_unused(&props);
        Ok(given)
    }
}

/// Three numbers or one, or `#rrggbb`.
fn rgb(value: &Attribute, is_encoded: bool) -> Found<Given> {
    let text = value.value.trim();
    let colour = if let Some(digits) = text.strip_prefix('#') {
        let packed = u32::from_str_radix(digits, 16).ok().filter(|_| digits.len() == 6);
        let packed = packed.ok_or_else(|| value.at.bad("mitsuba::value", "a colour has six digits behind `#`"))?;
        Vec3::from_array([16, 8, 0].map(|shift| (packed >> shift & 0xFF) as f32 / 255.0))
    } else {
        match numbers(value)?[..] {
            [grey] => Vec3::splat(grey as f32),
            [r, g, b] => glam::DVec3::new(r, g, b).as_vec3(),
            _ => return Err(value.at.bad("mitsuba::value", "a colour has one number or three")),
        }
    };
    Ok(Given::Rgb(if is_encoded { colour.map(linear_from_srgb) } else { colour }))
}

/// Pairs of wavelength (nm) and value, with `:` or blanks between; nothing outside of them.
fn curve(text: &str, place: &Attribute) -> Found<Given> {
    let words = text.lines().flat_map(|line| line.split('#').next().unwrap_or("").split([':', ',', ' ', '\t', '\r']));
    let numbers: Option<Vec<f32>> = words.filter(|w| !w.is_empty()).map(|w| w.parse().ok()).collect();
    let numbers = numbers.filter(|n| n.len().is_multiple_of(2));
    let numbers = numbers.ok_or_else(|| {
        Box::new(place.at.bad("mitsuba::value", "this is no spectrum").expected("pairs such as `400:0.1, 700:0.5`"))
    })?;
    sampled(numbers.chunks_exact(2).map(|p| (p[0], p[1])).collect()).map_err(|why| place.at.bad("mitsuba::value", why))
}

fn sampled(mut pairs: Vec<(f32, f32)>) -> Result<Given, String> {
    if let [(_, value)] = pairs[..] {
        return Ok(Given::Rgb(Vec3::splat(value)));
    }
    if let (Some(first), Some(last)) = (pairs.first().copied(), pairs.last().copied()) {
        pairs.insert(0, (first.0 - 0.01, 0.0));
        pairs.push((last.0 + 0.01, 0.0));
    }
    Curve::sampled(&pairs).map(Given::Curve).map_err(|e| e.to_string())
}

/// Values at wavelengths, or at even steps between two of them.
fn regular(props: &Props) -> Found<Given> {
    let list = |name| props.string(name).and_then(|v| v.map(numbers).transpose());
    let values = list("values")?.or(list("value")?).ok_or_else(|| props.bad("a spectrum needs `values`"))?;
    let last = values.len().max(2) as f64 - 1.0;
    let nm = if let Some(nm) = list("wavelengths")? {
        nm
    } else {
        let (from, to) = (props.float("wavelength_min", 360.0)?, props.float("wavelength_max", 830.0)?);
        (0..values.len()).map(|i| from + (to - from) * i as f64 / last).collect()
    };
    if nm.len() != values.len() {
        return Err(props.bad("there must be as many `wavelengths` as `values`"));
    }
    sampled(nm.iter().zip(&values).map(|(nm, v)| (*nm as f32, *v as f32)).collect()).map_err(|why| props.bad(&why))
}

/// `temperature` in kelvin, with or without a `K` behind it.
fn blackbody_element(element: &Element) -> Found<Given> {
    let text = element.required("temperature")?;
    let kelvin = text.value.trim().trim_end_matches(['k', 'K']).parse::<f64>().ok();
    let scale = match element.attribute("scale") {
        Some(scale) => numbers(scale)?.first().copied().unwrap_or(1.0),
        None => 1.0,
    };
    let wrong = || text.at.bad("mitsuba::value", "a temperature is a number of kelvin above 0");
    kelvin.and_then(|k| planck(k, scale)).ok_or_else(wrong)
}

/// Radiance of a black body in W/(m²·sr·nm) by Planck's law, with the constants of CODATA 2018. `None` unless hot.
fn planck(kelvin: f64, scale: f64) -> Option<Given> {
    /// 2hc² in W·m²/sr, and hc/k in m·K.
    const FIRST: f64 = 1.191_042_972e-16;
    const SECOND: f64 = 1.438_776_877e-2;
    let at = |nm: f32| {
        let m = f64::from(nm) * 1e-9;
        (scale * 1e-9 * FIRST / (m.powi(5) * ((SECOND / (m * kelvin)).exp() - 1.0))) as f32
    };
    (kelvin > 0.0 && kelvin.is_finite()).then(|| Given::Curve(Curve::new(at)))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_black_body_has_the_radiance_of_plancks_law() {
        // At 5000 K the peak is at 2898 µm·K / 5000 K = 580 nm with 4.096e-6 W/(m²·sr·nm·K⁵)·T⁵ = 12 800.
        let Some(Given::Curve(curve)) = planck(5000.0, 1.0) else { panic!("no curve") };
        assert!((curve.at(580.0) / 12_800.0 - 1.0).abs() < 0.01, "{}", curve.at(580.0));
        assert!(curve.at(579.6) > curve.at(540.0) && curve.at(579.6) > curve.at(620.0));
    }
}
