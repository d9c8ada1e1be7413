//! Random numbers and the χ² test.

/// Independent uniform numbers (`SplitMix64`: Steele, Lea & Flood 2014). The renderer's own are stratified, and would pass a
/// χ² test that independent ones fail.
pub(crate) struct Random(pub(crate) u64);

impl Random {
    /// A number in [0, 1) of 24 bits, as the renderer's are.
    pub(crate) fn unit(&mut self) -> f32 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut x = self.0;
        x = (x ^ (x >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        x = (x ^ (x >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        ((x ^ (x >> 31)) >> 40) as f32 / 16_777_216.0
    }
    pub(crate) fn unit2(&mut self) -> glam::Vec2 {
        glam::Vec2::new(self.unit(), self.unit())
    }
}

/// How far, in standard deviations of a normal distribution, counts lie from what was expected: Pearson's χ² through the
/// cube root of Wilson & Hilferty 1931. Cells are `(observed, expected)`; those expecting fewer than 8 are pooled.
pub(crate) fn chi2_sigmas(cells: &[(f64, f64)]) -> f64 {
    let mut sorted = cells.to_vec();
    sorted.sort_by(|a, b| a.1.total_cmp(&b.1));
    let mut pooled: Vec<(f64, f64)> = Vec::new();
    let mut pool = (0.0, 0.0);
    for (observed, expected) in sorted {
        pool = (pool.0 + observed, pool.1 + expected);
        if pool.1 >= 8.0 {
            pooled.push(std::mem::take(&mut pool));
        }
    }
    if let Some(last) = pooled.last_mut() {
        *last = (last.0 + pool.0, last.1 + pool.1);
    }
    let freedom = pooled.len() as f64 - 1.0;
    if freedom < 1.0 {
        return 0.0;
    }
    let chi2: f64 = pooled.iter().map(|(o, e)| (o - e).powi(2) / e).sum();
    let spread = 2.0 / (9.0 * freedom);
    ((chi2 / freedom).cbrt() - (1.0 - spread)) / spread.sqrt()
}

#[test]
fn chi2_gives_the_tabulated_quantiles() {
    // χ² with 100 degrees of freedom exceeds 149.449 with probability 0.001, that is at 3.090 σ.
    let cells = |chi2: f64| -> Vec<_> {
        (0..101).map(|i| (100.0 + if i == 0 { (chi2 * 100.0).sqrt() } else { 0.0 }, 100.0)).collect()
    };
    assert!((chi2_sigmas(&cells(149.449)) - 3.090).abs() < 0.01);
    assert!(chi2_sigmas(&cells(99.334)).abs() < 0.01);
}
