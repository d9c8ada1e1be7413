//! Writes the canopy of leaves for `scenes/many-triangles.scn`: an OBJ mesh and its materials.
//!
//! `cargo run --release --example make_many_triangles -- scenes/many-triangles.obj [leaves]`; without a number, 60 000 leaves
//! of 8 triangles each. The same number gives the same file, byte for byte.
use std::{
    fmt::Write as _,
    fs, io,
    path::{Path, PathBuf},
};
use sunfleck::{
    math::{Frame, Vec2, Vec3, warp::square_to_disk},
    sampler::{Domain, Sampler},
};

/// Where the crown is, and the half-axes of the flat ellipsoid it fills.
const CROWN: Vec3 = Vec3::new(0.0, 230.0, 950.0);
const HALF_AXES: Vec3 = Vec3::new(460.0, 50.0, 420.0);
/// Length of a leaf from stalk to tip; its width is half of that.
const LENGTH: f32 = 9.0;
/// Colours of leaves: name and reflectance.
const GREENS: [(&str, [f32; 3]); 3] =
    [("Fresh", [0.22, 0.40, 0.06]), ("Deep", [0.07, 0.22, 0.05]), ("Turning", [0.55, 0.42, 0.07])];
/// One leaf: outline and midrib from stalk to tip as (across, along), the sides folded up by `FOLD`.
const OUTLINE: [(f32, f32); 8] =
    [(0.0, 0.0), (-0.22, 0.3), (0.0, 0.33), (0.22, 0.3), (-0.16, 0.7), (0.0, 0.7), (0.16, 0.7), (0.0, 1.0)];
const TRIANGLES: [[usize; 3]; 8] =
    [[0, 2, 1], [0, 3, 2], [1, 2, 5], [1, 5, 4], [2, 3, 6], [2, 6, 5], [4, 5, 7], [5, 6, 7]];
const FOLD: f32 = 0.35;

/// The corners of a leaf.
fn leaf(s: &mut Sampler) -> [Vec3; 8] {
    // Clumped: leaves gather around branches, which leaves gaps for the light.
    let branch = &mut Sampler::new(1, Domain::Prepare, 1, (s.next_1d() * 170.0) as u64);
    let middle = square_to_disk(branch.next_2d()).extend(2.0 * branch.next_1d() - 1.0);
    let around = 0.16 * (Vec3::new(s.next_1d(), s.next_1d(), s.next_1d()) + s.next_1d() - 1.0);
    let place = Vec3::new(middle.x, middle.z, middle.y) + around;
    let stalk = CROWN + HALF_AXES * place;
    // Leaves face up, more or less, and point anywhere.
    let tilt = 0.7 * square_to_disk(s.next_2d());
    let frame = Frame::from_normal(Vec3::new(tilt.x, 1.0, tilt.y).normalize());
    let turn = Vec2::from_angle(std::f32::consts::TAU * s.next_1d());
    let size = LENGTH * (0.6 + 0.8 * s.next_1d());
    OUTLINE.map(|(across, along)| {
        let flat = turn.rotate(Vec2::new(across, along));
        stalk + size * (flat.x * frame.s + flat.y * frame.t + FOLD * across.abs() * frame.n)
    })
}

/// The mesh, leaves sorted by material.
fn obj(leaves: u64, library: &str) -> String {
    let mut text = format!("# {leaves} leaves, written by the example make_many_triangles\nmtllib {library}\n");
    let mut vertices = 0;
    for (kind, (name, _)) in GREENS.iter().enumerate() {
        writeln!(text, "o {name}\nusemtl {name}").expect("a string takes what is written");
        for i in (0..leaves).filter(|i| (i * 7 % 11) as usize % GREENS.len() == kind) {
            for p in leaf(&mut Sampler::new(0, Domain::Prepare, 0, i)) {
                writeln!(text, "v {:.3} {:.3} {:.3}", p.x, p.y, p.z).expect("a string takes what is written");
            }
            for [a, b, c] in TRIANGLES.map(|t| t.map(|k| vertices + k + 1)) {
                writeln!(text, "f {a} {b} {c}").expect("a string takes what is written");
            }
            vertices += OUTLINE.len();
        }
    }
    text
}

fn mtl() -> String {
    GREENS.map(|(name, [r, g, b])| format!("newmtl {name}\nKd {r} {g} {b}\n")).concat()
}

fn main() -> io::Result<()> {
    let mut args = std::env::args().skip(1);
    let path = args.next().map_or_else(|| PathBuf::from("many-triangles.obj"), PathBuf::from);
    let leaves = args.next().map_or(Ok(60_000), |n| n.parse()).map_err(io::Error::other)?;
    let library = path.with_extension("mtl");
    let name = library.file_name().and_then(|n| n.to_str()).unwrap_or("many-triangles.mtl");
    fs::write(&path, obj(leaves, name))?;
    fs::write(Path::new(&library), mtl())
}
