//! Cells of the sphere that follow a set of directions, and integrals over them.
use glam::{DVec4, Vec3};
use std::f64::consts::PI;
use sunfleck::math::Local;

/// `(cos θ, φ)`.
pub(crate) type Coordinates = [f64; 2];

/// A cell `[z0, z1] × [phi0, phi1]` of the sphere, z being the cosine with the pole.
#[derive(Clone, Copy)]
struct Cell {
    lo: Coordinates,
    hi: Coordinates,
}

/// Coordinates of a direction, keeping the digits that f32 drops from a cosine near the pole.
pub(crate) fn coordinates(w: Local) -> Coordinates {
    let w = w.0.as_dvec3();
    let z = if w.z.abs() > 0.7 { (1.0 - w.x * w.x - w.y * w.y).sqrt().copysign(w.z) } else { w.z };
    [z, w.y.atan2(w.x)]
}

fn direction(z: f64, phi: f64) -> Local {
    let r = ((1.0 - z) * (1.0 + z)).max(0.0).sqrt();
    Local(Vec3::new((r * phi.cos()) as f32, (r * phi.sin()) as f32, z as f32))
}

/// A direction near which a density is worth a look, and the density there.
pub(crate) type Hint = [f64; 3];

/// Splits points in place at `at`: those below come first.
fn partition<const N: usize>(points: &mut [[f64; N]], axis: usize, at: f64) -> (&mut [[f64; N]], &mut [[f64; N]]) {
    points.sort_unstable_by_key(|p| p[axis] >= at);
    let middle = points.partition_point(|p| p[axis] < at);
    points.split_at_mut(middle)
}

impl Cell {
    fn split(self, axis: usize, at: f64) -> [Self; 2] {
        let (mut a, mut b) = (self, self);
        (a.hi[axis], b.lo[axis]) = (at, at);
        [a, b]
    }
    /// The part of a side that is taken up by points, in [0, 1].
    fn part<const N: usize>(&self, points: &[[f64; N]], axis: usize) -> f64 {
        let ends = points.iter().fold((f64::MAX, f64::MIN), |(lo, hi), p| (lo.min(p[axis]), hi.max(p[axis])));
        (ends.1 - ends.0) / (self.hi[axis] - self.lo[axis])
    }
    fn area(&self) -> f64 {
        (self.hi[0] - self.lo[0]) * (self.hi[1] - self.lo[1])
    }
    /// Gauss's rule of four by four points.
    fn gauss(&self, f: &impl Fn(Local) -> DVec4) -> DVec4 {
        const RULE: [(f64, f64); 4] = [
            (-0.861_136_311_594_052_6, 0.347_854_845_137_453_8),
            (-0.339_981_043_584_856_3, 0.652_145_154_862_546_1),
            (0.339_981_043_584_856_3, 0.652_145_154_862_546_1),
            (0.861_136_311_594_052_6, 0.347_854_845_137_453_8),
        ];
        let at = |k: usize, x: f64| 0.5 * (self.lo[k] + self.hi[k] + x * (self.hi[k] - self.lo[k]));
        let mut sum = DVec4::ZERO;
        for (x, wx) in RULE {
            for (y, wy) in RULE {
                sum += f(direction(at(0, x), at(1, y))) * (wx * wy);
            }
        }
        sum * (0.25 * self.area())
    }
}

/// Quarters a cell until quarters and whole agree. Before that, halves it while it claims far less of the last component of
/// `f`, a density, than a hint in it suggests: Gauss's points may all have missed a narrow lobe in a corner.
fn integrate(f: &impl Fn(Local) -> DVec4, cell: Cell, hints: &mut [Hint], depth: u32) -> DVec4 {
    let whole = cell.gauss(f);
    let missed = hints.iter().any(|h| h[2] * cell.area() > 1.5 * whole.w + 1e-6);
    if !missed || depth > 60 {
        return refine(f, cell, whole, 0);
    }
    // Across the lobe: along the side that leads out of it.
    let middle = [0, 1].map(|k| 0.5 * (cell.lo[k] + cell.hi[k]));
    let top = hints.iter().fold([0.0; 3], |m, h| if h[2] > m[2] { *h } else { m });
    let (along_z, along_phi) = (f(direction(middle[0], top[1])).w, f(direction(top[0], middle[1])).w);
    let axis = match (along_z > 5.0 * along_phi, along_phi > 5.0 * along_z) {
        (true, _) => 1,
        (_, true) => 0,
        _ => (depth % 2) as usize,
    };
    let middle = middle[axis];
    let [a, b] = cell.split(axis, middle);
    let (left, right) = partition(hints, axis, middle);
    integrate(f, a, left, depth + 1) + integrate(f, b, right, depth + 1)
}

fn refine(f: &impl Fn(Local) -> DVec4, cell: Cell, whole: DVec4, depth: u32) -> DVec4 {
    let middle = [0, 1].map(|k| 0.5 * (cell.lo[k] + cell.hi[k]));
    let quarters = cell.split(0, middle[0]).map(|half| half.split(1, middle[1]));
    let sums: Vec<_> = quarters.as_flattened().iter().map(|q| (q, q.gauss(f))).collect();
    let sum: DVec4 = sums.iter().map(|s| s.1).sum();
    let agrees = (sum - whole).abs().cmple(3e-3 * sum.abs() + 1e-6).all();
    if depth >= 2 && agrees || depth == 7 {
        return sum;
    }
    sums.into_iter().map(|(q, s)| refine(f, *q, s, depth + 1)).sum()
}

/// Cuts the sphere into cells that hold about equally many hints, so that a narrow lobe gets narrow cells. For each: how many
/// of `samples` fall into it, and the integral of `f`, whose last component is the density of the hints.
pub(crate) fn tally(f: &impl Fn(Local) -> DVec4, hints: &mut [Hint], samples: &mut [Coordinates]) -> Vec<(f64, DVec4)> {
    let sphere = Cell { lo: [-1.0, -PI], hi: [1.0, PI] };
    // Models change abruptly at the horizon.
    let [south, north] = sphere.split(0, 0.0);
    let (south_hints, north_hints) = partition(hints, 0, 0.0);
    let (south_samples, north_samples) = partition(samples, 0, 0.0);
    let mut out = Vec::new();
    subdivide(f, south, south_hints, south_samples, &mut out);
    subdivide(f, north, north_hints, north_samples, &mut out);
    out
}

fn subdivide(
    f: &impl Fn(Local) -> DVec4,
    cell: Cell,
    hints: &mut [Hint],
    samples: &mut [Coordinates],
    out: &mut Vec<(f64, DVec4)>,
) {
    let axis = usize::from(cell.part(hints, 1) > cell.part(hints, 0));
    hints.sort_unstable_by(|a, b| a[axis].total_cmp(&b[axis]));
    let middle = hints.get(hints.len() / 2).map_or(cell.lo[axis], |p| p[axis]);
    if hints.len() < HINTS_PER_CELL || middle <= cell.lo[axis] {
        out.push((samples.len() as f64, integrate(f, cell, hints, 0)));
        return;
    }
    let [a, b] = cell.split(axis, middle);
    let (left, right) = partition(hints, axis, middle);
    let (left_samples, right_samples) = partition(samples, axis, middle);
    subdivide(f, a, left, left_samples, out);
    subdivide(f, b, right, right_samples, out);
}

/// Cells with fewer hints are not divided.
const HINTS_PER_CELL: usize = 64;

#[test]
fn integrals_over_cells_are_right_and_find_narrow_lobes() {
    // 1 over the sphere, z², a step at the equator, and a lobe a thousandth wide, given a few hints.
    let axis = Vec3::new(0.6, 0.0, 0.8);
    let f = |w: Local| {
        let lobe = (-0.5e6 * f64::from((w.0 - axis).length_squared())).exp() * 1e6 / (2.0 * PI);
        DVec4::new(1.0, f64::from(w.0.z * w.0.z), f64::from(u8::from(w.0.z > 0.0)), lobe)
    };
    let spot = |i: i32| Vec3::new(f64::from(i % 23 - 11) as f32, f64::from(i % 17 - 8) as f32, 0.0) * 3e-4;
    let hint = |w: Local| {
        let [z, phi] = coordinates(w);
        [z, phi, f(w).w]
    };
    let mut hints: Vec<_> = (0..400).map(|i| hint(Local((axis + spot(i)).normalize()))).collect();
    let mut samples: Vec<_> = (0..1000).map(|i| [f64::from(i) / 500.0 - 0.999, (f64::from(i) * 0.37) % PI]).collect();
    let tally = tally(&f, &mut hints, &mut samples);
    assert!(tally.len() > 8 && tally.iter().map(|t| t.0).sum::<f64>() == 1000.0);
    let sum: DVec4 = tally.iter().map(|t| t.1).sum();
    let want = DVec4::new(4.0 * PI, 4.0 * PI / 3.0, 2.0 * PI, 1.0);
    // The allowance that the contracts make for these integrals.
    assert!(((sum - want) / want).abs().max_element() < 4e-3, "{sum} {want}");
}
