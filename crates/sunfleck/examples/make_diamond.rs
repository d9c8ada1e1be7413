//! Writes the brilliant for `scenes/diamond.pbrt`: a round cut of 57 facets and a girdle, as a PLY mesh.
//!
//! `cargo run --release --example make_diamond -- scenes/diamond.ply`. The stone is the intersection of half-spaces, one for
//! each facet, in the proportions of Tolkowsky 1919 ("Diamond Design"): of diameter 1, its girdle around the origin, its
//! table up along +y.
use std::{f64::consts::TAU, fmt::Write as _, fs, io};
use sunfleck::math::Vec3;

/// A facet: the stone lies where `n·p <= d`.
struct Facet {
    n: [f64; 3],
    d: f64,
}

fn dot(a: [f64; 3], b: [f64; 3]) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}
fn cross(a: [f64; 3], b: [f64; 3]) -> [f64; 3] {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}

/// Half the thickness of the girdle, height of the table above it, and angles of facets with the girdle's plane in degrees.
const GIRDLE: f64 = 0.012;
const CROWN: f64 = 0.162;
const MAIN: f64 = 34.5;
const STAR: f64 = 21.0;
const UPPER: f64 = 40.5;
const PAVILION: f64 = 40.75;
const LOWER: f64 = 41.9;
/// Sides of the girdle.
const SIDES: usize = 64;

/// A facet that slopes by `degrees` toward the azimuth of `turn` (in whole turns), through a point at `radius` and `height` on
/// that azimuth; upward for `up` 1, downward for −1.
fn sloping(degrees: f64, turn: f64, radius: f64, height: f64, up: f64) -> Facet {
    let (sin, cos) = degrees.to_radians().sin_cos();
    let (z, x) = (TAU * turn).sin_cos();
    Facet { n: [sin * x, up * cos, sin * z], d: sin * radius + up * cos * height }
}

fn facets() -> Vec<Facet> {
    let top = GIRDLE + CROWN;
    let mut all = vec![Facet { n: [0.0, 1.0, 0.0], d: top }];
    // The table's corners lie on the ridges of the main facets; its edges are those of the star facets.
    let corner = 0.5 - CROWN / MAIN.to_radians().tan();
    for k in 0..8 {
        let (main, star) = (f64::from(k) / 8.0, (f64::from(k) + 0.5) / 8.0);
        all.push(sloping(MAIN, main, 0.5, GIRDLE, 1.0));
        all.push(sloping(STAR, star, corner * (TAU / 16.0).cos(), top, 1.0));
        all.push(sloping(PAVILION, main, 0.5, -GIRDLE, -1.0));
        for side in [-1.0, 1.0] {
            let half = star + side / 32.0;
            all.push(sloping(UPPER, half, 0.5, GIRDLE, 1.0));
            all.push(sloping(LOWER, half, 0.5, -GIRDLE, -1.0));
        }
    }
    all.extend((0..SIDES).map(|k| sloping(90.0, (k as f64 + 0.5) / SIDES as f64, 0.498, 0.0, 1.0)));
    all
}

/// The corner where three facets meet, if it belongs to the stone.
fn corner(all: &[Facet], [a, b, c]: [usize; 3]) -> Option<[f64; 3]> {
    let (a, b, c) = (&all[a], &all[b], &all[c]);
    let (bc, ca, ab) = (cross(b.n, c.n), cross(c.n, a.n), cross(a.n, b.n));
    let volume = dot(a.n, bc);
    if volume.abs() < 1e-9 {
        return None;
    }
    let p = std::array::from_fn(|i| (a.d * bc[i] + b.d * ca[i] + c.d * ab[i]) / volume);
    all.iter().all(|f| dot(f.n, p) <= f.d + 1e-9).then_some(p)
}

/// All corners, each once, and the outlines of the facets, counter-clockwise from outside.
fn polyhedron(all: &[Facet]) -> (Vec<[f64; 3]>, Vec<Vec<usize>>) {
    let mut corners: Vec<[f64; 3]> = Vec::new();
    let n = all.len();
    for p in (0..n).flat_map(|i| (i + 1..n).flat_map(move |j| (j + 1..n).map(move |k| [i, j, k]))) {
        let Some(p) = corner(all, p) else { continue };
        if corners.iter().all(|q| (0..3).any(|i| (p[i] - q[i]).abs() > 1e-7)) {
            corners.push(p);
        }
    }
    let outline = |f: &Facet| {
        let mut on: Vec<usize> = (0..corners.len()).filter(|&i| (dot(f.n, corners[i]) - f.d).abs() < 1e-7).collect();
        let middle: [f64; 3] =
            std::array::from_fn(|k| on.iter().map(|&i| corners[i][k]).sum::<f64>() / on.len() as f64);
        let first = std::array::from_fn(|k| corners[on[0]][k] - middle[k]);
        let second = cross(f.n, first);
        let angle = |i: usize| {
            let r = std::array::from_fn(|k| corners[i][k] - middle[k]);
            dot(second, r).atan2(dot(first, r))
        };
        on.sort_by(|&a, &b| angle(a).total_cmp(&angle(b)));
        on
    };
    let outlines = all.iter().map(outline).collect();
    (corners, outlines)
}

fn main() -> io::Result<()> {
    let path = std::env::args().nth(1).unwrap_or_else(|| "diamond.ply".into());
    let (corners, outlines) = polyhedron(&facets());
    let fan = |o: &Vec<usize>| (1..o.len() - 1).map(|i| [o[0], o[i], o[i + 1]]).collect::<Vec<_>>();
    let triangles: Vec<[usize; 3]> = outlines.iter().flat_map(fan).collect();
    let mut text = format!(
        "ply\nformat ascii 1.0\ncomment a round brilliant, written by the example make_diamond\nelement vertex {}\n\
         property float x\nproperty float y\nproperty float z\nelement face {}\nproperty list uchar int vertex_indices\n\
         end_header\n",
        corners.len(),
        triangles.len()
    );
    for p in &corners {
        let p = Vec3::from_array(p.map(|v| v as f32));
        writeln!(text, "{:.7} {:.7} {:.7}", p.x, p.y, p.z).expect("a string takes what is written");
    }
    for [a, b, c] in triangles {
        writeln!(text, "3 {a} {b} {c}").expect("a string takes what is written");
    }
    fs::write(path, text)
}
