//! Shapes that are cut into triangles. Normals lie on pbrt's outer side, that of ∂p/∂u × ∂p/∂v.

use super::params::{Found, Params};
use super::{curve, subdivide};
use crate::ply::PlyMesh;
use crate::tessellate::{append, grid, revolve};
use glam::{DVec2, DVec3};

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
