//! Spectra in ten bytes, for what is kept by the million.
use super::Spectrum;

/// Four lanes, none negative, as fractions of a common power of two. Each is off by at most 1/65,000 of the largest lane,
/// or by the smallest normal `f32` (1.2e-38) if that is more, and what is black stays black.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct PackedSpectrum {
    lanes: [u16; 4],
    /// Exponent field of an `f32` that is worth one unit of a lane.
    unit: u8,
    /// For whoever keeps it: the byte would be lost to alignment.
    pub tag: u8,
}

/// Bits of the fraction of an `f32`.
const FRACTION: u32 = 23;

impl PackedSpectrum {
    /// Packs `s`, whose lanes are finite.
    #[inline]
    pub fn new(s: Spectrum, tag: u8) -> Self {
        // The largest lane is below 2^(exponent − 126), so a unit of 2^-16 of that fits.
        let exponent = s.max().max(0.0).to_bits() >> FRACTION;
        let unit = exponent.saturating_sub(15).max(1);
        let per_unit = f32::from_bits((254 - unit) << FRACTION);
        // A cast saturates, which takes care of rounding up to 2^16.
        let lanes = s.lanes().map(|v| (v * per_unit + 0.5) as u16);
        Self { lanes, unit: unit as u8, tag }
    }
    /// The spectrum.
    #[inline]
    pub fn get(self) -> Spectrum {
        let unit = f32::from_bits(u32::from(self.unit) << FRACTION);
        Spectrum::from_lanes(self.lanes.map(f32::from)) * unit
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::sampler::{Domain, Sampler};

    #[test]
    fn lanes_are_kept_to_a_fraction_of_the_largest() {
        for i in 0..20_000 {
            let mut s = Sampler::new(1, Domain::Prepare, 0, i);
            let scale = 10f32.powf(70.0 * s.next_1d() - 33.0);
            let value = Spectrum::from_lanes([(); 4].map(|()| scale * s.next_1d()));
            let packed = PackedSpectrum::new(value, 7);
            let error = (packed.get() - value).map(f32::abs).max();
            let allowed = (value.max() / 65_000.0).max(f32::MIN_POSITIVE);
            assert!(error <= allowed, "{value:?} became {:?}", packed.get());
            assert_eq!(packed.tag, 7);
        }
    }

    #[test]
    fn black_and_powers_of_two_are_exact_and_extremes_do_no_harm() {
        let same = |v: f32| PackedSpectrum::new(Spectrum::splat(v), 0).get().lanes()[0];
        for v in [0.0, 1.0, 0.5, 4096.0, 2f32.powi(-100)] {
            assert_eq!(same(v), v);
        }
        assert!((same(f32::MAX) / f32::MAX - 1.0).abs() < 1e-4);
        assert!(same(f32::MIN_POSITIVE) < 1e-36);
        assert_eq!(size_of::<PackedSpectrum>(), 10);
    }
}
