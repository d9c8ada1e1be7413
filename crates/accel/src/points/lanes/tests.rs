use glam::Vec3;

use super::portable::Portable;
use super::{LANES, Lanes, Near, Row};

/// Sixteen values that take in ordinary ones, zeros, huge, tiny, infinite and NaN.
fn row(seed: u32) -> Row {
    std::array::from_fn(|i| {
        let bits = (seed * 16 + i as u32).wrapping_mul(0x9E37_79B9) ^ 0x5bd1_e995;
        match bits % 11 {
            0 => f32::NAN,
            1 => f32::INFINITY,
            2 => -1e30,
            3 => 1e-30,
            4 => 0.0,
            _ => (bits >> 8) as f32 / 1e6 - 8.0,
        }
    })
}

fn same_bits(a: &Row, b: &Row) -> bool {
    (0..LANES).all(|i| a[i].to_bits() == b[i].to_bits() || (a[i].is_nan() && b[i].is_nan()))
}

/// Numbers and bits of the squared distances of the points found, numbered from 1000.
fn near(lanes: impl Lanes, at: [&Row; 3], p: Vec3, bound: f32, valid: u32) -> Vec<(u32, u32)> {
    let (mut numbers, mut d2) = ([7; LANES], [7.0; LANES]);
    let count = lanes.near(at, p, bound, valid, 1000, Near { numbers: &mut numbers, d2: &mut d2 });
    numbers.into_iter().zip(d2.map(f32::to_bits)).take(count).collect()
}

fn agrees_with_portable(lanes: impl Lanes) {
    for seed in 0..200 {
        let rows: [Row; 6] = std::array::from_fn(|a| row(seed * 8 + a as u32));
        let [x, y, z, u, v, w] = &rows;
        let p = Vec3::new(seed as f32 * 0.05 - 4.0, 0.5, -1.0);
        for bound in [0.0, 1.0, 30.0, f32::INFINITY] {
            let (mut expected, mut found) = ([0.0; LANES], [0.0; LANES]);
            let want = Portable.points([x, y, z], p, bound, &mut expected);
            assert_eq!(lanes.points([x, y, z], p, bound, &mut found), want);
            assert!(same_bits(&found, &expected));

            let valid = seed.wrapping_mul(0x9E37_79B9) >> 16;
            assert_eq!(near(lanes, [x, y, z], p, bound, valid), near(Portable, [x, y, z], p, bound, valid));

            let (mut lo, mut hi) = ([[0.0; LANES]; 3], [[0.0; LANES]; 3]);
            for (a, (s, t)) in [(x, u), (y, v), (z, w)].into_iter().enumerate() {
                // A box has no NaN: `min` and `max` drop it.
                lo[a] = std::array::from_fn(|i| s[i].min(t[i]).min(1e38));
                hi[a] = std::array::from_fn(|i| s[i].max(t[i]).max(-1e38));
            }
            let want = Portable.boxes(lo.each_ref(), hi.each_ref(), p, bound, &mut expected);
            assert_eq!(lanes.boxes(lo.each_ref(), hi.each_ref(), p, bound, &mut found), want);
            assert!(same_bits(&found, &expected));

            let d2: [[f32; 4]; 3] = std::array::from_fn(|a| std::array::from_fn(|i| rows[a][i].abs()));
            assert_eq!(lanes.cells(&d2, bound), Portable.cells(&d2, bound));
        }
    }
}

#[test]
#[cfg(target_arch = "x86_64")]
fn avx2_gives_the_bits_of_plain_rust() {
    if let Some(lanes) = super::x86::Avx2::detect() {
        agrees_with_portable(lanes);
    }
}

#[test]
#[cfg(target_arch = "x86_64")]
fn avx512_gives_the_bits_of_plain_rust() {
    if let Some(lanes) = super::x86::Avx512::detect() {
        agrees_with_portable(lanes);
    }
}

#[test]
fn plain_rust_gives_the_distances_of_glam() {
    let rows: [Row; 3] = std::array::from_fn(|a| std::array::from_fn(|i| (a * 16 + i) as f32 * 0.37));
    let p = Vec3::new(1.0, 5.0, 9.0);
    let mut d2 = [0.0; LANES];
    let mask = Portable.points(rows.each_ref(), p, 40.0, &mut d2);
    for i in 0..LANES {
        let expected = p.distance_squared(Vec3::new(rows[0][i], rows[1][i], rows[2][i]));
        assert_eq!(d2[i].to_bits(), expected.to_bits());
        assert_eq!(mask >> i & 1 == 1, expected <= 40.0);
    }
}

#[test]
fn what_is_near_comes_in_order_and_only_if_it_is_valid() {
    let rows: [Row; 3] = std::array::from_fn(|a| std::array::from_fn(|i| if a == 0 { (i % 5) as f32 } else { 0.0 }));
    let found = near(Portable, rows.each_ref(), Vec3::ZERO, 1.0, 0b1110_1111_1111_1011);
    let expected = [0, 1, 5, 6, 10, 11, 15].map(|i| (1000 + i, ((i % 5) as f32).to_bits()));
    assert_eq!(found, expected);
}

#[test]
fn a_box_is_never_farther_than_its_points() {
    for seed in 0..500 {
        let (s, t) = (row(seed), row(seed + 500));
        let keep = |v: f32| if v.is_finite() { v } else { 0.25 };
        let lo: [Row; 3] = std::array::from_fn(|a| std::array::from_fn(|i| keep(s[(i + a) % 16]).min(keep(t[i]))));
        let hi: [Row; 3] = std::array::from_fn(|a| std::array::from_fn(|i| keep(s[(i + a) % 16]).max(keep(t[i]))));
        let p = Vec3::new(0.1, 3.3, -7.7) * (seed as f32 * 0.01);
        let (mut to_box, mut to_lo, mut to_hi) = ([0.0; LANES], [0.0; LANES], [0.0; LANES]);
        Portable.boxes(lo.each_ref(), hi.each_ref(), p, 1.0, &mut to_box);
        Portable.points(lo.each_ref(), p, 1.0, &mut to_lo);
        Portable.points(hi.each_ref(), p, 1.0, &mut to_hi);
        assert!((0..LANES).all(|i| to_box[i] <= to_lo[i].min(to_hi[i])));
    }
}

#[test]
fn cells_are_numbered_x_then_y_then_z() {
    let far = 9.0;
    let d2 = [[far, 0.0, far, far], [far, far, 0.0, far], [far, far, far, 0.0]];
    assert_eq!(Portable.cells(&d2, 1.0), 1 << (1 + 4 * 2 + 16 * 3));
}
