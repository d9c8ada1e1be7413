//! Colours as a scene stores them: by RGB or by a full spectrum, as reflectance or as emission.
use super::{Curve, Rgb, Spectrum, Wavelengths, observer::at_lanes, observer::observer, uplift::Uplift};
use std::ops::Mul;

/// A reflectance, or another property of matter: given by RGB, or by a curve over wavelength with its RGB stand-in.
#[derive(Clone, Debug, PartialEq)]
pub struct Colour {
    rgb: Rgb,
    body: Body,
}

#[derive(Clone, Debug, PartialEq)]
enum Body {
    Uplift(Uplift),
    Curve(Curve),
}

impl From<Rgb> for Colour {
    /// A colour in linear sRGB. In spectral mode it is a smooth spectrum that has this colour under D65.
    fn from(rgb: Rgb) -> Self {
        Self { rgb, body: Body::Uplift(Uplift::new(rgb)) }
    }
}

impl Colour {
    /// A measured reflectance. In RGB mode it is its colour under D65, within the gamut.
    pub fn reflectance(curve: Curve) -> Self {
        Self { rgb: curve.reflectance_rgb().max(Rgb::ZERO), body: Body::Curve(curve) }
    }
    /// A measured property that is no colour, as η or k of a metal. In RGB mode it is its values at
    /// [`super::CHANNELS_NM`].
    pub fn index(curve: Curve) -> Self {
        Self { rgb: curve.channels(), body: Body::Curve(curve) }
    }
    /// The measured curve, if it is not given by RGB.
    pub fn curve(&self) -> Option<&Curve> {
        if let Body::Curve(curve) = &self.body { Some(curve) } else { None }
    }
    /// The RGB stand-in.
    #[inline]
    pub fn rgb(&self) -> Rgb {
        self.rgb
    }
    /// Its values at `lambda`.
    #[inline]
    pub fn at(&self, lambda: Wavelengths) -> Spectrum {
        match lambda {
            Wavelengths::Rgb => Spectrum(self.rgb.extend(0.0)),
            Wavelengths::Spectral(nm) => Spectrum(match &self.body {
                Body::Uplift(u) => u.lanes(nm),
                Body::Curve(c) => c.lanes(nm),
            }),
        }
    }
}

/// Emitted radiance, intensity or irradiance: given by RGB, or by a curve over wavelength with its RGB stand-in.
#[derive(Clone, Debug, PartialEq)]
pub struct Illuminant {
    colour: Colour,
    scale: f32,
}

impl From<Rgb> for Illuminant {
    /// Light of a colour in linear sRGB, unbounded. In spectral mode it is D65 filtered by a smooth spectrum, so that
    /// (1, 1, 1) is D65 itself, and the film reads what is given here.
    fn from(rgb: Rgb) -> Self {
        Self { colour: rgb.into(), scale: 1.0 }
    }
}

impl Illuminant {
    /// Light of the spectrum `curve`, as it is: 1 at every wavelength has luminance 1. In RGB mode it is its colour,
    /// within the gamut.
    pub fn spectrum(curve: Curve) -> Self {
        Self { colour: Colour { rgb: curve.radiance_rgb().max(Rgb::ZERO), body: Body::Curve(curve) }, scale: 1.0 }
    }
    /// Light of the spectral shape of `curve`, of luminance `y`.
    pub fn of_luminance(curve: &Curve, y: f32) -> Self {
        let now = curve.luminance();
        Self::spectrum(curve.scaled(if now > 0.0 { y / now } else { 0.0 }))
    }
    /// The spectrum and what it is multiplied by, if it is not given by RGB.
    pub fn curve(&self) -> Option<(&Curve, f32)> {
        self.colour.curve().map(|curve| (curve, self.scale))
    }
    /// The RGB stand-in.
    #[inline]
    pub fn rgb(&self) -> Rgb {
        self.colour.rgb * self.scale
    }
    /// True when nothing is emitted.
    pub fn is_black(&self) -> bool {
        self.rgb() == Rgb::ZERO
    }
    /// Its values at `lambda`.
    #[inline]
    pub fn at(&self, lambda: Wavelengths) -> Spectrum {
        let v = self.colour.at(lambda) * self.scale;
        match (lambda, &self.colour.body) {
            (Wavelengths::Spectral(nm), Body::Uplift(_)) => v * Spectrum(at_lanes(&observer().d65, nm)),
            _ => v,
        }
    }
    /// Its values at `lambda` times those of a picture's pixel `filter`: for pictures that shine.
    #[inline]
    pub fn filtered(&self, filter: Rgb, lambda: Wavelengths) -> Spectrum {
        match &self.colour.body {
            // The product of two colours as one, so that the film reads it exactly.
            Body::Uplift(_) => Spectrum::emission(self.rgb() * filter, lambda),
            Body::Curve(_) => self.at(lambda) * Spectrum::reflectance(filter, lambda),
        }
    }
}

impl Mul<f32> for Illuminant {
    type Output = Self;
    fn mul(self, k: f32) -> Self {
        Self { scale: self.scale * k, ..self }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::spectrum::ColorMode;

    /// The film's mean over 64 passes.
    fn film(value: impl Fn(Wavelengths) -> Spectrum) -> Rgb {
        let n = 64;
        let pass = |i| {
            let lambda = ColorMode::Spectral.wavelengths(3, i);
            value(lambda).to_rgb(lambda)
        };
        (0..n).map(pass).sum::<Rgb>() / n as f32
    }

    #[test]
    fn the_film_reads_what_lights_are_given() {
        for rgb in [Rgb::ONE, Rgb::new(5.0, 2.0, 0.5), Rgb::new(0.1, 0.3, 2.0), Rgb::new(0.0, 1.0, 0.0)] {
            for seen in [film(|l| Illuminant::from(rgb).at(l)), film(|l| Spectrum::emission(rgb, l))] {
                assert!((seen - rgb).abs().max_element() < 2e-3 * rgb.max_element(), "{rgb}: {seen}");
            }
            let (lamp, filter) = (Illuminant::from(rgb) * 2.0, Rgb::new(0.5, 0.2, 0.8));
            let seen = film(|l| lamp.filtered(filter, l));
            assert!((seen - 2.0 * rgb * filter).abs().max_element() < 4e-3 * rgb.max_element(), "{seen}");
        }
    }

    #[test]
    fn an_even_spectrum_has_luminance_one_and_shapes_are_scaled_to_a_luminance() {
        let even = Curve::new(|_| 1.0);
        let seen = film(|l| Illuminant::spectrum(even.clone()).at(l));
        assert!((seen - even.radiance_rgb()).abs().max_element() < 2e-3, "{seen}");
        let lamp = Illuminant::of_luminance(&Curve::new(|nm| nm), 3.0);
        assert!((lamp.rgb().dot(Rgb::new(0.2126, 0.7152, 0.0722)) - 3.0).abs() < 1e-2, "{}", lamp.rgb());
    }
}
