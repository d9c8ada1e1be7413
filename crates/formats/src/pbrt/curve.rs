//! `curve`: hairs and blades as thin tubes of triangles, ribbons as strips.

use super::params::{Found, Params, single};
use crate::ply::PlyMesh;
use glam::DVec3;
use std::f64::consts::TAU;

/// Steps along one piece of a curve, and sides of a tube.
const STEPS: usize = 8;
const SIDES: u32 = 5;

/// The mesh of one curve of any number of pieces.
pub(super) fn mesh(params: &Params) -> Found<PlyMesh> {
    params.ignore(&["splitdepth"]);
    let degree = params.integer("degree", 2..=3)?.unwrap_or(3) as usize;
    let is_bspline = params.word("basis", "bezier", &["bezier", "bspline"])? == "bspline";
    let is_ribbon = params.word("type", "flat", &["flat", "ribbon", "cylinder"])? == "ribbon";
    let width = params.number("width", 1.0)?;
    let widths = [params.number("width0", width)?, params.number("width1", width)?];
    let (points, normals) = (params.triples("P")?, params.triples("N")?);
    let pieces = if is_bspline { points.len().saturating_sub(degree) } else { points.len().saturating_sub(1) / degree };
    if pieces == 0 {
        return Err(params.bad("pbrt::curve", "a curve needs more points `P`"));
    }
    let at = |t: f64| {
        let piece = (t as usize).min(pieces - 1);
        let first = if is_bspline { piece } else { piece * degree };
        blend(&points[first..=first + degree], t - piece as f64, is_bspline)
    };
    let steps = STEPS * pieces;
    let line: Vec<DVec3> = (0..=steps).map(|i| at(i as f64 / STEPS as f64)).collect();
    let radius = |i: usize| 0.5 * (widths[0] + (widths[1] - widths[0]) * i as f64 / steps as f64);
    Ok(match normals[..] {
        [first, .., last] if is_ribbon => {
            ribbon(&line, radius, |i| first.lerp(last, i as f64 / steps as f64).normalize_or(DVec3::Z))
        }
        _ => tube(&line, radius),
    })
}

/// The point of a piece at `t` in [0, 1], by de Casteljau's scheme, or by the basis of even B-splines.
fn blend(points: &[DVec3], t: f64, is_bspline: bool) -> DVec3 {
    let s = 1.0 - t;
    match (points, is_bspline) {
        (&[a, b, c, d], true) => {
            let weights = [s * s * s, 4.0 + 3.0 * t * t * (t - 2.0), 4.0 + 3.0 * s * s * (s - 2.0), t * t * t];
            (weights[0] * a + weights[1] * b + weights[2] * c + weights[3] * d) / 6.0
        }
        (&[a, b, c], true) => 0.5 * (s * s * a + (1.0 + 2.0 * t * s) * b + t * t * c),
        _ => {
            let mut rest = points.to_vec();
            while rest.len() > 1 {
                rest = rest.windows(2).map(|w| w[0].lerp(w[1], t)).collect();
            }
            rest.first().copied().unwrap_or_default()
        }
    }
}

fn direction(line: &[DVec3], i: usize) -> DVec3 {
    let (before, after) = (i.saturating_sub(1), (i + 1).min(line.len() - 1));
    (line[after] - line[before]).normalize_or_zero()
}

fn tube(line: &[DVec3], radius: impl Fn(usize) -> f64) -> PlyMesh {
    let mut mesh = PlyMesh::default();
    let mut side = direction(line, 0).any_orthonormal_vector();
    for (i, p) in line.iter().enumerate() {
        let along = direction(line, i);
        // Carried along without twist.
        side = (side - along * along.dot(side)).normalize_or(side);
        let other = along.cross(side);
        for k in 0..=SIDES {
            let (sin, cos) = (TAU * f64::from(k) / f64::from(SIDES)).sin_cos();
            let n = cos * side + sin * other;
            push(&mut mesh, *p + radius(i) * n, n, [k as f32 / SIDES as f32, i as f32 / (line.len() - 1) as f32]);
        }
    }
    strips(&mut mesh, line.len() as u32, SIDES + 1);
    mesh
}

fn ribbon(line: &[DVec3], radius: impl Fn(usize) -> f64, normal: impl Fn(usize) -> DVec3) -> PlyMesh {
    let mut mesh = PlyMesh::default();
    for (i, p) in line.iter().enumerate() {
        let n = normal(i);
        let across = n.cross(direction(line, i)).normalize_or_zero() * radius(i);
        let v = i as f32 / (line.len() - 1) as f32;
        push(&mut mesh, *p - across, n, [0.0, v]);
        push(&mut mesh, *p + across, n, [1.0, v]);
    }
    strips(&mut mesh, line.len() as u32, 2);
    mesh
}

fn push(mesh: &mut PlyMesh, p: DVec3, n: DVec3, uv: [f32; 2]) {
    mesh.positions.push(single(p).to_array());
    mesh.normals.push(single(n).to_array());
    mesh.uvs.push(uv);
}

/// Joins rows of `width` vertices.
fn strips(mesh: &mut PlyMesh, rows: u32, width: u32) {
    for row in 0..rows - 1 {
        for k in 0..width - 1 {
            let i = row * width + k;
            mesh.triangles.extend([[i, i + 1, i + width + 1], [i, i + width + 1, i + width]]);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn pieces_begin_and_end_where_their_basis_says() {
        let p = [DVec3::ZERO, DVec3::X, DVec3::new(1.0, 1.0, 0.0), DVec3::Y];
        assert_eq!(blend(&p, 0.0, false), p[0]);
        assert_eq!(blend(&p, 1.0, false), p[3]);
        let third = |a: DVec3, b: DVec3, c: DVec3| (a + 4.0 * b + c) / 6.0;
        assert!((blend(&p, 0.0, true) - third(p[0], p[1], p[2])).length() < 1e-12);
        assert!((blend(&p, 1.0, true) - third(p[1], p[2], p[3])).length() < 1e-12);
        assert!((blend(&p[..3], 1.0, true) - 0.5 * (p[1] + p[2])).length() < 1e-12);
        // Weights sum to one: a constant stays.
        assert!((blend(&[DVec3::ONE; 4], 0.3, true) - 1.0).length() < 1e-12);
        assert!((blend(&[DVec3::ONE; 3], 0.3, true) - 1.0).length() < 1e-12);
    }

    #[test]
    fn a_tube_keeps_its_distance_from_its_line() {
        let line: Vec<DVec3> = (0..20).map(|i| DVec3::new(f64::from(i), (f64::from(i) * 0.3).sin(), 0.0)).collect();
        let mesh = tube(&line, |_| 0.25);
        for (k, p) in mesh.positions.iter().enumerate() {
            let p = DVec3::from_array(p.map(f64::from));
            assert!((p.distance(line[k / (SIDES as usize + 1)]) - 0.25).abs() < 1e-6);
        }
        assert_eq!(mesh.triangles.len(), 19 * 2 * SIDES as usize);
    }
}
