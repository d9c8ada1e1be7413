//! Chance that belongs to a ray.
use crate::{
    math::Ray,
    sampler::{mix64, unit},
};

/// Uniform numbers that are a function of a ray's bits. Rays of different paths are different, so their numbers are
/// independent; asked twice along the same ray, the answer is the same.
#[derive(Clone, Copy, Debug)]
pub struct Coin(u64);

impl Coin {
    /// That of `ray`.
    #[inline]
    pub fn new(ray: &Ray) -> Self {
        let bits = |v: glam::Vec3| v.to_array().map(|c| u64::from(c.to_bits()));
        let ([a, b, c], [d, e, f]) = (bits(ray.o), bits(ray.d));
        Self([a << 32 | b, c << 32 | d, e << 32 | f].into_iter().fold(0x5357_494E_4B4C_4553, |h, v| mix64(h ^ v)))
    }
    /// A number in [0, 1) for the purpose `salt`.
    #[inline]
    pub fn toss(self, salt: u64) -> f32 {
        unit((mix64(self.0 ^ salt.wrapping_mul(0x9e37_79b9_7f4a_7c15)) >> 32) as u32)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::Vec3;

    #[test]
    fn tosses_are_even_and_independent_of_each_other() {
        let (mut sum, mut both, n) = (0.0, 0.0, 100_000);
        for i in 0..n {
            let coin = Coin::new(&Ray::new(Vec3::new(0.3, i as f32 * 1e-4, -2.0), Vec3::Z));
            let (a, b) = (coin.toss(1), coin.toss(2));
            sum += f64::from(a);
            both += f64::from(a) * f64::from(b);
        }
        let n = f64::from(n);
        assert!((sum / n - 0.5).abs() < 4e-3 && (both / n - 0.25).abs() < 4e-3, "{} {}", sum / n, both / n);
    }
}
