//! Numbers in [0, 1] in two bytes: closures are kept by the million.
use crate::spectrum::Spectrum;

/// A number in [0, 1], in steps of 1/65535.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Unit(u16);

impl Unit {
    pub(super) const ZERO: Self = Self(0);
    #[inline]
    pub(super) fn new(v: f32) -> Self {
        Self((v.clamp(0.0, 1.0) * 65535.0).round() as u16)
    }
    #[inline]
    pub(super) fn get(self) -> f32 {
        f32::from(self.0) * (1.0 / 65535.0)
    }
}

/// A spectrum whose lanes are in [0, 1].
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct UnitSpectrum([Unit; 4]);

impl UnitSpectrum {
    pub(super) const BLACK: Self = Self([Unit::ZERO; 4]);
    #[inline]
    pub(super) fn new(s: Spectrum) -> Self {
        Self(s.lanes().map(Unit::new))
    }
    #[inline]
    pub(super) fn get(self) -> Spectrum {
        Spectrum::from_lanes(self.0.map(Unit::get))
    }
    #[inline]
    pub(super) fn is_black(self) -> bool {
        self == Self::BLACK
    }
}
