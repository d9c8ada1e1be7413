//! Sampling of tables: pick a row in proportion to its weight.

/// A discrete distribution over `0..n`, with the chosen interval's remainder available as a fresh uniform number.
#[derive(Clone, Debug, Default)]
pub struct Discrete {
    /// Cumulative probabilities; the last entry is 1. Empty when there is nothing to pick.
    cdf: Vec<f32>,
    total: f64,
}

impl Discrete {
    /// Builds from weights; negative and non-finite ones count as zero. All-zero weights give a uniform pick.
    pub fn new(weights: impl IntoIterator<Item = f32>) -> Self {
        let mut sums: Vec<f64> = Vec::new();
        let mut total = 0.0f64;
        for w in weights {
            total += if w.is_finite() { f64::from(w.max(0.0)) } else { 0.0 };
            sums.push(total);
        }
        let n = sums.len();
        let uniform = total <= 0.0;
        let mut cdf: Vec<f32> = sums
            .iter()
            .enumerate()
            .map(|(i, &s)| if uniform { (i + 1) as f32 / n as f32 } else { (s / total) as f32 })
            .collect();
        // Rounding must not leave a gap at the end, nor give the tail's zero-weight rows a share.
        let last =
            if uniform { n.saturating_sub(1) } else { sums.partition_point(|&s| s < total).min(n.saturating_sub(1)) };
        cdf.iter_mut().skip(last).for_each(|c| *c = 1.0);
        Self { cdf, total }
    }
    /// Number of rows.
    pub fn len(&self) -> usize {
        self.cdf.len()
    }
    /// True when there is nothing to pick.
    pub fn is_empty(&self) -> bool {
        self.cdf.is_empty()
    }
    /// Sum of the weights.
    pub fn total(&self) -> f64 {
        self.total
    }
    /// Picks a row: `(row, prob, u')` with `u'` uniform in [0, 1) again. `None` when empty.
    #[inline]
    pub fn sample(&self, u: f32) -> Option<(usize, f32, f32)> {
        if self.len() == 1 {
            return Some((0, 1.0, u));
        }
        let i = self.cdf.partition_point(|&c| c <= u).min(self.cdf.len().checked_sub(1)?);
        let prob = self.prob(i);
        let lo = if i == 0 { 0.0 } else { self.cdf[i - 1] };
        Some((i, prob, ((u - lo) / prob.max(f32::MIN_POSITIVE)).clamp(0.0, 1.0 - f32::EPSILON / 2.0)))
    }
    /// Probability of row `i`.
    #[inline]
    pub fn prob(&self, i: usize) -> f32 {
        self.cdf[i] - if i == 0 { 0.0 } else { self.cdf[i - 1] }
    }
}

/// A piecewise-constant density over the unit square, `width` x `height` cells, row 0 at `v = 0`.
#[derive(Clone, Debug)]
pub struct Discrete2d {
    rows: Discrete,
    columns: Vec<Discrete>,
}

impl Discrete2d {
    /// Builds from row-major weights. `weights.len()` must be `width * height`.
    pub fn new(weights: &[f32], width: usize) -> Self {
        let columns: Vec<Discrete> = weights.chunks(width).map(|row| Discrete::new(row.iter().copied())).collect();
        Self { rows: Discrete::new(columns.iter().map(|c| c.total() as f32)), columns }
    }
    /// Draws a point of the square and its density (with respect to the square's area).
    #[inline]
    pub fn sample(&self, u: glam::Vec2) -> (glam::Vec2, f32) {
        let (y, py, fy) = self.rows.sample(u.y).unwrap_or((0, 1.0, u.y));
        let column = &self.columns[y];
        let (x, px, fx) = column.sample(u.x).unwrap_or((0, 1.0, u.x));
        let (w, h) = (column.len() as f32, self.columns.len() as f32);
        (glam::Vec2::new((x as f32 + fx) / w, (y as f32 + fy) / h), px * py * w * h)
    }
    /// Density at a point of the square.
    #[inline]
    pub fn pdf(&self, p: glam::Vec2) -> f32 {
        let h = self.columns.len();
        let y = ((p.y * h as f32) as usize).min(h - 1);
        let w = self.columns[y].len();
        let x = ((p.x * w as f32) as usize).min(w - 1);
        self.rows.prob(y) * self.columns[y].prob(x) * (w * h) as f32
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::Vec2;

    #[test]
    fn rows_are_picked_in_proportion_and_zero_rows_never() {
        let d = Discrete::new([0.0, 1.0, 0.0, 3.0, f32::NAN, 0.0]);
        let mut count = [0; 6];
        for i in 0..1000 {
            let (row, prob, rest) = d.sample(i as f32 / 1000.0).unwrap();
            assert!((0.0..1.0).contains(&rest) && (prob - d.prob(row)).abs() < 1e-7);
            count[row] += 1;
        }
        assert_eq!(count, [0, 250, 0, 750, 0, 0]);
        assert_eq!(d.sample(0.999_999_94).unwrap().0, 3);
        assert!(Discrete::new([]).sample(0.5).is_none());
    }

    #[test]
    fn the_density_of_a_table_matches_its_samples_and_integrates_to_one() {
        let weights: Vec<f32> = (0..12).map(|i| (i % 5) as f32).collect();
        let d = Discrete2d::new(&weights, 4);
        let mut integral = 0.0;
        for i in 0..4096 {
            let u = Vec2::new((i % 64) as f32 + 0.5, (i / 64) as f32 + 0.5) / 64.0;
            let (p, pdf) = d.sample(u);
            assert!(pdf > 0.0 && (d.pdf(p) - pdf).abs() < 1e-3 * pdf, "{p}: {pdf} {}", d.pdf(p));
            integral += d.pdf(u) / 4096.0;
        }
        assert!((integral - 1.0).abs() < 0.03, "{integral}");
    }
}
