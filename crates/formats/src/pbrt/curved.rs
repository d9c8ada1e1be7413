//! Shapes that are cut into triangles. Normals lie on pbrt's outer side, that of ∂p/∂u × ∂p/∂v.

use super::params::{Found, Params, single};
use super::shapes::valid;
use super::{curve, subdivide};
use crate::ply::PlyMesh;
use glam::{DVec2, DVec3};
use std::f64::consts::TAU;

/// Pieces around a full turn.
const TURN: f64 = 256.0;
/// Pieces along a curved profile, and along each side of a bent patch.
const ALONG: usize = 128;
const BENT: usize = 16;

/// The radius of a sphere without parts cut off.
pub(super) fn whole_sphere(params: &Params) -> Found<Option<f64>> {
    let radius = params.number("radius", 1.0)?;
    let low = params.number("zmin", -radius)?;
    let high = params.number("zmax", radius)?;
    let phi = params.number("phimax", 360.0)?;
    let whole = radius > 0.0 && low.min(high) <= -radius && low.max(high) >= radius && phi >= 360.0;
    Ok(whole.then_some(radius))
}

/// The mesh of a shape; `None` for what cannot be shown.
pub(super) fn mesh(name: &str, params: &Params, detail: f64) -> Found<Option<PlyMesh>> {
    let revolve = |turn: f64, rows: usize, profile: &dyn Fn(f64) -> DVec3| {
        revolve(turn, [TURN * detail, (rows as f64 * detail).ceil()], profile)
    };
    let radius = params.number("radius", 1.0)?;
    let turn = params.number("phimax", 360.0)?.clamp(0.0, 360.0).to_radians();
    let mesh = match name {
        "sphere" => {
            let (low, high) = (params.number("zmin", -radius)?, params.number("zmax", radius)?);
            let (low, high) = (low.min(high).max(-radius.abs()), low.max(high).min(radius.abs()));
            let (from, to) = ((low / radius).clamp(-1.0, 1.0).acos(), (high / radius).clamp(-1.0, 1.0).acos());
            let at = |v: f64| {
                let theta = from + v * (to - from);
                radius * DVec3::new(theta.sin(), 0.0, theta.cos())
            };
            revolve(turn, ALONG, &at)
        }
        "cylinder" => {
            let (low, high) = (params.number("zmin", -1.0)?, params.number("zmax", 1.0)?);
            revolve(turn, 1, &|v| DVec3::new(radius, 0.0, low + v * (high - low)))
        }
        "disk" => {
            let (height, inner) = (params.number("height", 0.0)?, params.number("innerradius", 0.0)?);
            revolve(turn, 1, &|v| DVec3::new(radius + v * (inner - radius), 0.0, height))
        }
        "cone" => {
            let height = params.number("height", 1.0)?;
            revolve(turn, BENT, &|v| DVec3::new(radius * (1.0 - v), 0.0, height * v))
        }
        "paraboloid" => {
            let (low, high) = (params.number("zmin", 0.0)?, params.number("zmax", 1.0)?);
            let at = |v: f64| {
                // Even in radius rather than in height, for the sake of the round end.
                let [a, b] = [low, high].map(|z| (z / high).max(0.0).sqrt());
                let r = a + v * (b - a);
                DVec3::new(radius * r, 0.0, high * r * r)
            };
            revolve(turn, ALONG, &at)
        }
        "hyperboloid" => {
            let (p1, p2) = (params.vec3("p1")?.unwrap_or_default(), params.vec3("p2")?.unwrap_or(DVec3::ONE));
            revolve(turn, ALONG, &|v| p1.lerp(p2, v))
        }
        "bilinearmesh" => bilinear(params, detail)?,
        "loopsubdiv" => subdivide::mesh(params)?,
        "curve" => curve::mesh(params)?,
        _ => return Ok(None),
    };
    Ok(Some(mesh))
}

/// Turns a profile around z. There are so many pieces around a full turn and along v.
fn revolve(turn: f64, [around_turn, along]: [f64; 2], profile: &dyn Fn(f64) -> DVec3) -> PlyMesh {
    let (columns, rows) = (((around_turn * turn / TAU).ceil() as usize).max(3), along as usize);
    let around = |p: DVec3, phi: f64| {
        let (sin, cos) = phi.sin_cos();
        DVec3::new(p.x * cos - p.y * sin, p.x * sin + p.y * cos, p.z)
    };
    let normal = |v: f64| {
        let step = 1e-5;
        let (a, b) = ((v - step).max(0.0), (v + step).min(1.0));
        let (pa, pb) = (profile(a), profile(b));
        // On the axis there is no direction around it; a little beside it there is.
        let middle = profile(v.clamp(1e-4, 1.0 - 1e-4));
        DVec3::Z.cross(middle).cross(pb - pa).normalize_or_zero()
    };
    grid(columns, rows, |u, v| (around(profile(v), u * turn), around(normal(v), u * turn)))
}

/// A rectangle of u and v in [0, 1], cut evenly: position and normal at each place.
fn grid(columns: usize, rows: usize, at: impl Fn(f64, f64) -> (DVec3, DVec3)) -> PlyMesh {
    let mut mesh = PlyMesh::default();
    for y in 0..=rows {
        for x in 0..=columns {
            let (u, v) = (x as f64 / columns as f64, y as f64 / rows as f64);
            let (p, n) = at(u, v);
            mesh.positions.push(single(p).to_array());
            mesh.normals.push(single(n).to_array());
            mesh.uvs.push([u as f32, v as f32]);
        }
    }
    let width = columns as u32 + 1;
    // At a pole, one side of each square is nothing.
    let has_area = |t: &[u32; 3]| {
        let [a, b, c] = t.map(|i| DVec3::from_array(mesh.positions[i as usize].map(f64::from)));
        (b - a).cross(c - a).length() > 1e-9 * (b - a).length().max((c - a).length()).powi(2)
    };
    let mut triangles = Vec::with_capacity(2 * rows * columns);
    for y in 0..rows as u32 {
        for x in 0..columns as u32 {
            let i = y * width + x;
            triangles.extend([[i, i + 1, i + width + 1], [i, i + width + 1, i + width]].into_iter().filter(has_area));
        }
    }
    PlyMesh { triangles, ..mesh }
}

/// Patches with corners at (u, v) = (0, 0), (1, 0), (0, 1) and (1, 1); flat ones are two triangles.
fn bilinear(params: &Params, detail: f64) -> Found<PlyMesh> {
    let positions = params.triples("P")?;
    let (uvs, normals) = (params.pairs("uv")?, params.triples("N")?);
    params.ignore(&["faceIndices", "emissionfilename"]);
    let indices = match params.indices("indices")? {
        Some(indices) => indices,
        None if positions.len() == 4 => vec![0, 1, 2, 3],
        None => return Err(params.bad("pbrt::no-indices", "a mesh needs `indices`")),
    };
    let mut mesh = PlyMesh::default();
    for patch in indices.chunks_exact(4) {
        if patch.iter().any(|i| *i as usize >= positions.len()) {
            mesh.bad_faces += 1;
            continue;
        }
        let corner = |k: usize| patch[k] as usize;
        let [p00, p10, p01, p11] = [0, 1, 2, 3].map(|k| positions[corner(k)]);
        let mix = |c: [DVec3; 4], u: f64, v: f64| c[0].lerp(c[1], u).lerp(c[2].lerp(c[3], u), v);
        let bend = (p11 - p00).dot((p10 - p00).cross(p01 - p00)).abs();
        let is_flat = bend <= 1e-6 * (p10 - p00).length() * (p01 - p00).length() * (p11 - p00).length();
        // Many patches are small ones.
        let bent = if indices.len() > 4000 { 2 } else { (BENT as f64 * detail).ceil() as usize };
        let pieces = if is_flat { 1 } else { bent };
        let normal = |u: f64, v: f64| {
            if normals.len() == positions.len() {
                return mix([0, 1, 2, 3].map(|k| normals[corner(k)]), u, v);
            }
            let du = (p10 - p00).lerp(p11 - p01, v);
            let dv = (p01 - p00).lerp(p11 - p10, u);
            du.cross(dv).normalize_or_zero()
        };
        let mut part = grid(pieces, pieces, |u, v| (mix([p00, p10, p01, p11], u, v), normal(u, v)));
        if uvs.len() == positions.len() {
            let at = |k: usize| uvs[corner(k)].as_dvec2();
            for uv in &mut part.uvs {
                let [u, v] = uv.map(f64::from);
                let mixed: DVec2 = at(0).lerp(at(1), u).lerp(at(2).lerp(at(3), u), v);
                *uv = mixed.as_vec2().to_array();
            }
        }
        append(&mut mesh, part);
    }
    Ok(mesh)
}

/// Adds all of `part`.
pub(super) fn append(mesh: &mut PlyMesh, part: PlyMesh) {
    let first = mesh.positions.len() as u32;
    mesh.positions.extend(part.positions);
    mesh.normals.extend(part.normals);
    mesh.uvs.extend(part.uvs);
    let (triangles, _) = valid(part.triangles.into_iter().map(|t| t.map(|i| first + i)), mesh.positions.len());
    mesh.triangles.extend(triangles);
}
