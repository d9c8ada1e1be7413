//! `loopsubdiv`: smooth surfaces from coarse triangles (Loop 1987, "Smooth Subdivision Surfaces Based on Triangles").

use super::params::{Found, Params, single};
use crate::ply::PlyMesh;
use crate::tessellate::valid;
use glam::DVec3;
use std::collections::{BTreeMap, BTreeSet};
use std::f64::consts::TAU;

/// Subdividing stops before there are more triangles than this.
const MAX_TRIANGLES: usize = 1_000_000;

/// The mesh after `levels` steps, its vertices moved to the limit surface, with the normals there.
pub(super) fn mesh(params: &Params) -> Found<PlyMesh> {
    let positions = params.triples("P")?;
    let levels = params.integer("levels", 0..=16)?.or(params.integer("nlevels", 0..=16)?).unwrap_or(3);
    params.ignore(&["scheme"]);
    let Some(indices) = params.indices("indices")? else {
        return Err(params.bad("pbrt::no-indices", "a mesh needs `indices`"));
    };
    let (triangles, bad_faces) = valid(indices.chunks_exact(3).map(|t| [t[0], t[1], t[2]]), positions.len());
    let mut surface = Surface { positions, triangles };
    for _ in 0..levels {
        if surface.triangles.len() * 4 > MAX_TRIANGLES {
            break;
        }
        surface = surface.finer();
    }
    let (positions, normals) = surface.limit();
    Ok(PlyMesh {
        positions: positions.iter().map(|p| single(*p).to_array()).collect(),
        normals: normals.iter().map(|n| single(*n).to_array()).collect(),
        uvs: Vec::new(),
        triangles: surface.triangles,
        bad_faces,
        ..PlyMesh::default()
    })
}

struct Surface {
    positions: Vec<DVec3>,
    triangles: Vec<[u32; 3]>,
}

/// What surrounds a vertex.
struct Ring {
    /// Neighbours, around the vertex if they are in order.
    around: Vec<u32>,
    /// The two neighbours along the border, if the vertex lies on it.
    border: Option<[u32; 2]>,
}

impl Surface {
    /// Each triangle becomes four.
    fn finer(&self) -> Self {
        let edges = self.edges();
        let rings = self.rings(&edges);
        let mut positions: Vec<DVec3> = rings.iter().zip(&self.positions).map(|(r, p)| self.moved(r, *p)).collect();
        let mut middle = BTreeMap::new();
        for (edge, opposite) in &edges {
            let at = |i: u32| self.positions[i as usize];
            let (a, b) = (at(edge[0]), at(edge[1]));
            let point = match opposite[..] {
                [c, d] => 0.375 * (a + b) + 0.125 * (at(c) + at(d)),
                _ => 0.5 * (a + b),
            };
            middle.insert(*edge, positions.len() as u32);
            positions.push(point);
        }
        let mut triangles = Vec::with_capacity(4 * self.triangles.len());
        for &[a, b, c] in &self.triangles {
            let [ab, bc, ca] = [[a, b], [b, c], [c, a]].map(|e| middle[&sorted(e)]);
            triangles.extend([[a, ab, ca], [b, bc, ab], [c, ca, bc], [ab, bc, ca]]);
        }
        Self { positions, triangles }
    }

    /// The vertices opposite of each edge.
    fn edges(&self) -> BTreeMap<[u32; 2], Vec<u32>> {
        let mut edges: BTreeMap<[u32; 2], Vec<u32>> = BTreeMap::new();
        for &[a, b, c] in &self.triangles {
            for (edge, opposite) in [([a, b], c), ([b, c], a), ([c, a], b)] {
                edges.entry(sorted(edge)).or_default().push(opposite);
            }
        }
        edges
    }

    fn rings(&self, edges: &BTreeMap<[u32; 2], Vec<u32>>) -> Vec<Ring> {
        let mut next: Vec<BTreeMap<u32, u32>> = vec![BTreeMap::new(); self.positions.len()];
        for &[a, b, c] in &self.triangles {
            for [v, from, to] in [[a, b, c], [b, c, a], [c, a, b]] {
                next[v as usize].insert(from, to);
            }
        }
        let mut borders: Vec<BTreeSet<u32>> = vec![BTreeSet::new(); self.positions.len()];
        for (&[a, b], opposite) in edges {
            if opposite.len() == 1 {
                borders[a as usize].insert(b);
                borders[b as usize].insert(a);
            }
        }
        let ring = |(next, border): (&BTreeMap<u32, u32>, &BTreeSet<u32>)| {
            let ends: Vec<u32> = border.iter().copied().collect();
            // An open ring begins at the neighbour that no other one leads to.
            let targets: BTreeSet<u32> = next.values().copied().collect();
            let first = next.keys().find(|k| !targets.contains(k)).or_else(|| next.keys().next());
            let mut around: Vec<u32> = first.copied().into_iter().collect();
            while let Some(&to) = around.last().and_then(|last| next.get(last)) {
                if around.len() > next.len() || around.first() == Some(&to) {
                    break;
                }
                around.push(to);
            }
            Ring { around, border: if let [a, b] = ends[..] { Some([a, b]) } else { None } }
        };
        next.iter().zip(&borders).map(ring).collect()
    }

    fn sum(&self, around: &[u32]) -> DVec3 {
        around.iter().map(|i| self.positions[*i as usize]).sum()
    }

    /// Where a vertex is after one step.
    fn moved(&self, ring: &Ring, p: DVec3) -> DVec3 {
        if let Some(border) = ring.border {
            return 0.75 * p + 0.125 * self.sum(&border);
        }
        let n = ring.around.len() as f64;
        let beta = if n == 3.0 { 3.0 / 16.0 } else { 3.0 / (8.0 * n) };
        if n < 3.0 { p } else { (1.0 - n * beta) * p + beta * self.sum(&ring.around) }
    }

    /// Positions and normals on the surface that endless subdivision leads to.
    fn limit(&self) -> (Vec<DVec3>, Vec<DVec3>) {
        let rings = self.rings(&self.edges());
        let at = |(ring, p): (&Ring, &DVec3)| {
            if let Some(border) = ring.border {
                return (0.6 * *p + 0.2 * self.sum(&border), self.border_normal(ring, *p));
            }
            let n = ring.around.len() as f64;
            if n < 3.0 {
                return (*p, DVec3::ZERO);
            }
            let beta = if n == 3.0 { 3.0 / 16.0 } else { 3.0 / (8.0 * n) };
            let gamma = 1.0 / (n + 3.0 / (8.0 * beta));
            let limit = (1.0 - n * gamma) * *p + gamma * self.sum(&ring.around);
            let tangent = |turned: f64| -> DVec3 {
                let term = |(k, i): (usize, &u32)| (TAU * (k as f64 + turned) / n).cos() * self.positions[*i as usize];
                ring.around.iter().enumerate().map(term).sum()
            };
            // The second tangent is a quarter turn ahead: sines.
            (limit, tangent(0.0).cross(tangent(-0.25 * n)).normalize_or_zero())
        };
        rings.iter().zip(&self.positions).map(at).unzip()
    }

    /// On the border, the mean of the triangles around is near enough.
    fn border_normal(&self, ring: &Ring, p: DVec3) -> DVec3 {
        let edge = |i: u32| self.positions[i as usize] - p;
        let sum: DVec3 = ring.around.windows(2).map(|w| edge(w[0]).cross(edge(w[1]))).sum();
        sum.normalize_or_zero()
    }
}

fn sorted([a, b]: [u32; 2]) -> [u32; 2] {
    [a.min(b), a.max(b)]
}

#[cfg(test)]
mod tests {
    use super::*;

    /// An octahedron.
    fn octahedron() -> Surface {
        let positions = vec![DVec3::X, DVec3::Y, DVec3::Z, -DVec3::X, -DVec3::Y, -DVec3::Z];
        let triangles = vec![[0, 1, 2], [1, 3, 2], [3, 4, 2], [4, 0, 2], [1, 0, 5], [3, 1, 5], [4, 3, 5], [0, 4, 5]];
        Surface { positions, triangles }
    }

    #[test]
    fn a_closed_surface_gets_rounder_and_its_normals_point_outwards() {
        let fine = octahedron().finer().finer().finer();
        assert_eq!((fine.triangles.len(), fine.positions.len()), (512, 258));
        let (positions, normals) = fine.limit();
        for (p, n) in positions.iter().zip(&normals) {
            assert!(p.normalize().dot(*n) > 0.95, "{p} {n}");
            assert!((0.4..0.7).contains(&p.length()), "{p}");
        }
        let finer = fine.finer().limit().0;
        // The limit surface is the same from every level.
        assert!((positions[0] - finer[0]).length() < 1e-12, "{} {}", positions[0], finer[0]);
    }

    #[test]
    fn the_border_of_a_flat_sheet_stays_flat() {
        let positions = vec![DVec3::ZERO, DVec3::X, DVec3::new(1.0, 1.0, 0.0), DVec3::Y];
        let sheet = Surface { positions, triangles: vec![[0, 1, 2], [0, 2, 3]] }.finer().finer();
        let (positions, normals) = sheet.limit();
        assert!(positions.iter().all(|p| p.z == 0.0));
        assert!(normals.iter().all(|n| n.z > 0.99), "{normals:?}");
    }
}
