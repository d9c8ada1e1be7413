//! Ever smaller versions of a picture (Williams 1983, "Pyramidal Parametrics").
use super::{image::Wrap, image::place_between, pixels::Pixels};
use crate::spectrum::Rgb;
use glam::Vec2;

/// One of them.
#[derive(Clone, Debug)]
pub(super) struct Level {
    width: usize,
    height: usize,
    pixels: Pixels,
}

impl Level {
    /// Bilinear interpolation, as in the picture itself.
    #[inline]
    pub(super) fn eval(&self, uv: Vec2, wrap: [Wrap; 2]) -> Rgb {
        let (at, f) = place_between(uv, self.width, self.height, wrap);
        self.pixels.blend(at, f)
    }
    /// Bytes of memory.
    pub(super) fn bytes(&self) -> usize {
        self.pixels.bytes()
    }
}

/// The versions of a picture that have half as many pixels a side, a quarter, and so on to a single one. Each is the mean of
/// what it covers, so all have the same mean, rounded to half floats.
pub(super) fn levels(width: usize, height: usize, pixel: impl Fn(usize) -> Rgb) -> Vec<Level> {
    let mut levels = Vec::new();
    let mut last: Option<Vec<Rgb>> = None;
    let (mut w, mut h) = (width, height);
    while w > 1 || h > 1 {
        let (columns, rows) = (shares(w), shares(h));
        let next: Vec<Rgb> = match &last {
            None => smaller(&columns, &rows, w, &pixel),
            Some(p) => smaller(&columns, &rows, w, |i| p[i]),
        };
        (w, h) = (columns.len(), rows.len());
        let pixels = Pixels::rounded(&next).unwrap_or_else(|| Pixels::Full(next.clone()));
        levels.push(Level { width: w, height: h, pixels });
        last = Some(next);
    }
    levels
}

/// For each of half as many pixels, the first of those that it covers, and how much of it each of up to three takes.
fn shares(n: usize) -> Vec<(usize, [f32; 3])> {
    let m = (n / 2).max(1);
    let wide = n as f64 / m as f64;
    let one = |i: usize| {
        let (from, to) = (i as f64 * wide, (i + 1) as f64 * wide);
        let first = from as usize;
        let share = |k: usize| {
            let (low, high) = ((first + k) as f64, (first + k + 1) as f64);
            ((high.min(to) - low.max(from)).max(0.0) / wide) as f32
        };
        (first, [0, 1, 2].map(share))
    };
    (0..m).map(one).collect()
}

fn smaller(
    columns: &[(usize, [f32; 3])],
    rows: &[(usize, [f32; 3])],
    width: usize,
    pixel: impl Fn(usize) -> Rgb,
) -> Vec<Rgb> {
    let mut all = Vec::with_capacity(columns.len() * rows.len());
    for (y, down) in rows {
        for (x, across) in columns {
            let mut sum = Rgb::ZERO;
            for (j, wy) in down.iter().enumerate().filter(|(_, w)| **w > 0.0) {
                for (i, wx) in across.iter().enumerate().filter(|(_, w)| **w > 0.0) {
                    sum += wx * wy * pixel((y + j) * width + x + i);
                }
            }
            all.push(sum);
        }
    }
    all
}
