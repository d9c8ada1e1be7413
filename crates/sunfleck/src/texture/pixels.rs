//! How the pixels of a picture are kept: in as little memory as they need, without changing them.
//!
//! What a file held is seen in the numbers themselves, whatever a reader made of them: 8-bit values, through whatever curve, are
//! at most 256 different numbers in a channel; Radiance pictures are three small whole numbers over a power of two; and many
//! OpenEXR files hold half floats. So a picture takes 1, 3, 4 or 6 bytes a pixel, and 12 if nothing else holds it.
use crate::spectrum::Rgb;
use glam::{Vec2, Vec3};
use half::f16;

/// Pixels by row.
#[derive(Clone, Debug)]
pub(super) enum Pixels {
    /// As they are: 12 bytes.
    Full(Vec<Rgb>),
    /// Half floats times a power of two: 6 bytes.
    Half(Vec<[u16; 3]>, f32),
    /// Three mantissas and a common exponent (Ward 1991, "Real Pixels"): 4 bytes.
    Shared(Vec<[u8; 4]>),
    /// Numbers of values, by channel: 3 bytes.
    Listed(Vec<[u8; 3]>, Box<[[f32; 256]; 3]>),
    /// Greys, by number: 1 byte.
    Grey(Vec<u8>, Box<[f32; 256]>),
}

/// Smaller pictures stay as they are.
const WORTH: usize = 1 << 12;

/// Undoes the bias of a half float's exponent whose bits were put where those of an `f32` are: 2¹¹².
const REBIAS: f32 = f32::from_bits((127 + 112) << 23);

impl Pixels {
    /// The same pixels in the smallest way that keeps each bit of them.
    pub(super) fn new(pixels: Vec<Rgb>) -> Self {
        if pixels.len() < WORTH {
            return Self::Full(pixels);
        }
        listed(&pixels)
            .or_else(|| Some(Self::Shared(pixels.iter().map(|p| shared(*p)).collect::<Option<_>>()?)))
            .or_else(|| Some(Self::Half(pixels.iter().map(|p| exact_half(*p)).collect::<Option<_>>()?, 1.0)))
            .unwrap_or(Self::Full(pixels))
    }
    /// Rounds pixels to half floats times a power of two that brings the largest one just below their limit. A value `x` moves
    /// by at most 2⁻¹¹ `|x|`, and one of less than 2⁻²⁸ of the largest by at most 2⁻³⁹ of that. `None` if one is not finite, or
    /// the largest is less than 1e-30.
    pub(super) fn rounded(pixels: &[Rgb]) -> Option<Self> {
        let most = pixels.iter().fold(0.0f32, |m, p| m.max(p.abs().max_element()));
        if !pixels.iter().all(|p| p.is_finite()) || most < 1e-30 {
            return None;
        }
        // The largest value becomes one of [2¹⁴, 2¹⁵): no rounding takes that beyond 65504.
        let scale = f32::from_bits(((most.to_bits() >> 23) - 14) << 23);
        let half = |p: &Rgb| (*p / scale).to_array().map(|v| f16::from_f32(v).to_bits());
        Some(Self::Half(pixels.iter().map(half).collect(), scale))
    }
    /// How many.
    pub(super) fn len(&self) -> usize {
        match self {
            Self::Full(p) => p.len(),
            Self::Half(p, _) => p.len(),
            Self::Shared(p) => p.len(),
            Self::Listed(p, _) => p.len(),
            Self::Grey(p, _) => p.len(),
        }
    }
    /// Bytes of memory.
    pub(super) fn bytes(&self) -> usize {
        match self {
            Self::Full(p) => size_of_val(&p[..]),
            Self::Half(p, _) => size_of_val(&p[..]),
            Self::Shared(p) => size_of_val(&p[..]),
            Self::Listed(p, list) => size_of_val(&p[..]) + size_of_val(&**list),
            Self::Grey(p, list) => size_of_val(&p[..]) + size_of_val(&**list),
        }
    }
    /// Pixel `i`.
    #[inline]
    pub(super) fn get(&self, i: usize) -> Rgb {
        match self {
            Self::Full(p) => p[i],
            Self::Half(p, scale) => from_half(p[i], *scale),
            Self::Shared(p) => from_shared(p[i]),
            Self::Listed(p, list) => from_list(p[i], list),
            Self::Grey(p, list) => Rgb::splat(list[usize::from(p[i])]),
        }
    }
    /// Between four pixels: `f` across from the first to the second, and down from these to the others.
    #[inline]
    pub(super) fn blend(&self, at: [usize; 4], f: Vec2) -> Rgb {
        let [a, b, c, d] = match self {
            Self::Full(p) => at.map(|i| p[i]),
            Self::Half(p, scale) => at.map(|i| from_half(p[i], *scale)),
            Self::Shared(p) => at.map(|i| from_shared(p[i])),
            Self::Listed(p, list) => at.map(|i| from_list(p[i], list)),
            Self::Grey(p, list) => at.map(|i| Rgb::splat(list[usize::from(p[i])])),
        };
        a.lerp(b, f.x).lerp(c.lerp(d, f.x), f.y)
    }
}

#[inline]
fn from_half(pixel: [u16; 3], scale: f32) -> Rgb {
    // Sign, exponent and mantissa move to where those of an `f32` are; a product with a power of two is exact.
    let wide = |h: u16| f32::from_bits(u32::from(h & 0x8000) << 16 | u32::from(h & 0x7fff) << 13);
    Vec3::from_array(pixel.map(wide)) * REBIAS * scale
}

fn exact_half(pixel: Rgb) -> Option<[u16; 3]> {
    let half = pixel.to_array().map(|v| f16::from_f32(v).to_bits());
    let same = from_half(half, 1.0).to_array().map(f32::to_bits) == pixel.to_array().map(f32::to_bits);
    (same && pixel.is_finite()).then_some(half)
}

/// Bias of the common exponent: a pixel is its mantissas times 2^(exponent − 136).
const SHARED_BIAS: u32 = 136;
/// Below, its power of two is no normal `f32`.
const LEAST_SHARED: u32 = SHARED_BIAS - 126;

#[inline]
fn from_shared([r, g, b, e]: [u8; 4]) -> Rgb {
    Vec3::new(f32::from(r), f32::from(g), f32::from(b)) * f32::from_bits((u32::from(e) + 127 - SHARED_BIAS) << 23)
}

fn shared(pixel: Rgb) -> Option<[u8; 4]> {
    if pixel == Rgb::ZERO && pixel.is_negative_bitmask() == 0 {
        return Some([0, 0, 0, LEAST_SHARED as u8]);
    }
    // The largest mantissa is in [128, 256), in an `f32` in [1, 2).
    let e = (pixel.max_element().to_bits() >> 23) + SHARED_BIAS - 127 - 7;
    if pixel.is_negative_bitmask() != 0 || !pixel.is_finite() || !(LEAST_SHARED..=255).contains(&e) {
        return None;
    }
    let mantissa = pixel / f32::from_bits((e + 127 - SHARED_BIAS) << 23);
    let [r, g, b] = mantissa.to_array().map(|m| m as u8);
    (mantissa.fract() == Vec3::ZERO).then_some([r, g, b, e as u8])
}

#[inline]
fn from_list(pixel: [u8; 3], list: &[[f32; 256]; 3]) -> Rgb {
    Vec3::from_array(std::array::from_fn(|c| list[c][usize::from(pixel[c])]))
}

fn listed(pixels: &[Rgb]) -> Option<Pixels> {
    let mut lists = [List::new(), List::new(), List::new()];
    let same = |p: &Rgb| p.x.to_bits() == p.y.to_bits() && p.x.to_bits() == p.z.to_bits();
    if pixels.iter().all(same) {
        let [list, ..] = &mut lists;
        let numbers = pixels.iter().map(|p| list.number(p.x)).collect::<Option<_>>()?;
        return Some(Pixels::Grey(numbers, Box::new(list.values)));
    }
    let numbers = (pixels.iter())
        .map(|p| Some([lists[0].number(p.x)?, lists[1].number(p.y)?, lists[2].number(p.z)?]))
        .collect::<Option<_>>()?;
    Some(Pixels::Listed(numbers, Box::new(lists.map(|l| l.values))))
}

/// Different values by number, in the order in which they came.
struct List {
    values: [f32; 256],
    count: usize,
    /// Numbers by hash, from 1 on, each in the first free place; 0 for none.
    places: [u16; 1024],
}

impl List {
    fn new() -> Self {
        Self { values: [0.0; 256], count: 0, places: [0; 1024] }
    }
    /// The number of a value, a new one if it has none. `None` if there are too many.
    #[inline]
    fn number(&mut self, v: f32) -> Option<u8> {
        let mut place = (v.to_bits().wrapping_mul(0x9e37_79b1) >> 22) as usize;
        loop {
            match self.places[place] {
                0 if self.count == self.values.len() => return None,
                0 => {
                    self.values[self.count] = v;
                    self.count += 1;
                    self.places[place] = self.count as u16;
                }
                n if self.values[usize::from(n) - 1].to_bits() == v.to_bits() => return Some((n - 1) as u8),
                _ => place = (place + 1) % self.places.len(),
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const N: usize = 2 * WORTH;

    fn number(i: usize) -> u32 {
        (i as u32).wrapping_mul(0x9e37_79b9).rotate_left(13).wrapping_mul(0x85eb_ca6b)
    }

    /// The bytes of a pixel, once every bit has come back.
    fn kept(pixel: impl Fn(usize) -> Rgb) -> usize {
        let all: Vec<Rgb> = (0..N).map(pixel).collect();
        let pixels = Pixels::new(all.clone());
        for (i, p) in all.iter().enumerate() {
            assert_eq!(pixels.get(i).to_array().map(f32::to_bits), p.to_array().map(f32::to_bits), "{i}");
            assert!(!p.is_finite() || pixels.blend([i, 0, i, 0], Vec2::ZERO) == *p);
        }
        pixels.bytes() / N
    }

    #[test]
    fn pixels_are_kept_to_the_last_bit_in_as_few_bytes_as_they_need() {
        let byte = |i: usize, c: u32| (number(i) >> (8 * c) & 255) as f32;
        let curve = |v: f32| (0.37 * v / 255.0).powf(2.2) - 0.01;
        assert_eq!(kept(|i| Vec3::splat(curve(byte(i, 0)))), 1);
        assert_eq!(kept(|i| Vec3::new(curve(byte(i, 0)), byte(i, 1), 0.1 * byte(i, 2))), 3);
        let power = |i: usize| 2f32.powi((number(i) >> 24) as i32 % 80 - 40);
        assert_eq!(kept(|i| Vec3::new(byte(i, 0), 0.0, 255.0) * power(i)), 4);
        let half = |v: u32| f16::from_bits(v as u16 & 0xbbff).to_f32();
        assert_eq!(kept(|i| Vec3::new(half(number(i)), half(number(i) >> 8), half(number(i) >> 16))), 6);
        assert_eq!(kept(|i| Vec3::new(number(i) as f32, 1.0, -0.0)), 12);
        assert_eq!(
            kept(|i| if i == N - 1 { Vec3::INFINITY } else { Vec3::new(1.0, 0.0, 1e9 + byte(i, 1).min(254.0)) }),
            3
        );
    }

    #[test]
    fn rounding_moves_no_value_by_more_than_it_says_up_to_the_brightest_sun() {
        for most in [1e-12f32, 1.0, 65_504.0, 3e9, 3e38] {
            let all: Vec<Rgb> = (0..N)
                .map(|i| {
                    let t = number(i) as f32 / u32::MAX as f32;
                    let sign = if i % 3 == 0 { -1.0 } else { 1.0 };
                    most * Vec3::new(t, 1e-12f32.powf(t), sign * 1e-3 * t)
                })
                .chain([Vec3::splat(most), Vec3::ZERO])
                .collect();
            let pixels = Pixels::rounded(&all).unwrap();
            assert_eq!(pixels.bytes() / all.len(), 6);
            let mut sum = [0.0f64; 2];
            for (i, p) in all.iter().enumerate() {
                let back = pixels.get(i);
                let bound = (p.abs() * 2f32.powi(-11)).max(Vec3::splat(most * 2f32.powi(-39)));
                assert!((back - p).abs().cmple(bound).all(), "{most}: {p} becomes {back}");
                sum[0] += f64::from(back.x / most);
                sum[1] += f64::from(p.x / most);
            }
            assert!((sum[0] / sum[1] - 1.0).abs() < 1e-5, "{sum:?}");
        }
        assert!(Pixels::rounded(&[Vec3::ONE, Vec3::INFINITY]).is_none() && Pixels::rounded(&[Vec3::ZERO]).is_none());
    }
}
