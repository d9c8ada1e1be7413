//! Scenes with as many triangles as asked for: a bumpy ball on a floor, under a lamp.
use super::args::SCRATCH;
use anyhow::bail;
use std::f32::consts::{PI, TAU};
use std::fmt::Write as _;
use std::fs;
use std::path::{Path, PathBuf};

/// The ball's mesh: rows of a sphere from pole to pole, bumped.
struct Ball {
    /// Quads around; half as many from pole to pole.
    around: usize,
}

impl Ball {
    fn new(triangles: u64) -> Self {
        Self { around: ((triangles as f64).sqrt() as usize).max(4) & !1 }
    }
    fn triangles(&self) -> u64 {
        self.around as u64 * self.around as u64
    }
    fn points(&self) -> impl Iterator<Item = [f32; 3]> {
        let (around, down) = (self.around, self.around / 2);
        (0..=down).flat_map(move |i| (0..=around).map(move |j| point(i as f32 / down as f32, j as f32 / around as f32)))
    }
    fn faces(&self) -> impl Iterator<Item = [u32; 3]> {
        let (around, down) = (self.around as u32, self.around as u32 / 2);
        (0..down).flat_map(move |i| {
            (0..around).flat_map(move |j| {
                let a = i * (around + 1) + j;
                let b = a + around + 1;
                [[a, b, a + 1], [a + 1, b, b + 1]]
            })
        })
    }
}

/// The place at `v` of the way from pole to pole and `u` of the way around.
fn point(v: f32, u: f32) -> [f32; 3] {
    let (theta, phi) = (PI * v, TAU * u);
    let bumps = (40.0 * theta).sin() * (40.0 * phi).sin() + 0.3 * (311.0 * theta).sin() * (287.0 * phi).cos();
    let r = 1.0 + 0.03 * theta.sin() * bumps;
    [r * theta.sin() * phi.cos(), r * theta.cos(), r * theta.sin() * phi.sin()]
}

/// Writes the scene unless it is there; returns its file, its triangles, and the bytes of the mesh.
pub(crate) fn write_scene(triangles: u64, mesh: &str) -> anyhow::Result<(PathBuf, u64, u64)> {
    let ball = Ball::new(triangles);
    let name = format!("ball-{}.{mesh}", ball.triangles());
    let path = Path::new(SCRATCH).join(&name);
    if !path.is_file() {
        match mesh {
            "ply" => fs::write(&path, ply(&ball))?,
            "obj" => fs::write(&path, obj(&ball))?,
            _ => bail!("no mesh file is called .{mesh}: ply or obj"),
        }
    }
    let bytes = fs::metadata(&path)?.len();
    if mesh == "obj" {
        // A mesh alone is put on a floor, under a sky.
        return Ok((path, ball.triangles(), bytes));
    }
    let scene = path.with_extension("pbrt");
    fs::write(&scene, PBRT.replace("MESH", &name))?;
    Ok((scene, ball.triangles(), bytes))
}

const PBRT: &str = r#"LookAt 0 1.5 -4  0 0 0  0 1 0
Camera "perspective" "float fov" [40]
WorldBegin
AttributeBegin
AreaLightSource "diffuse" "rgb L" [10 10 10]
Shape "trianglemesh" "point3 P" [-1 4 -1  1 4 -1  1 4 1  -1 4 1] "integer indices" [0 1 2  0 2 3]
AttributeEnd
Material "diffuse" "rgb reflectance" [0.6 0.5 0.4]
Shape "trianglemesh" "point3 P" [-9 -1.1 -9  -9 -1.1 9  9 -1.1 9  9 -1.1 -9] "integer indices" [0 1 2  0 2 3]
Shape "plymesh" "string filename" "MESH"
"#;

fn ply(ball: &Ball) -> Vec<u8> {
    let mut bytes = format!(
        "ply\nformat binary_little_endian 1.0\nelement vertex {}\nproperty float x\nproperty float y\nproperty float z\n\
         element face {}\nproperty list uchar int vertex_indices\nend_header\n",
        ball.points().count(),
        ball.triangles()
    )
    .into_bytes();
    ball.points().flatten().for_each(|x| bytes.extend(x.to_le_bytes()));
    for face in ball.faces() {
        bytes.push(3);
        face.iter().for_each(|i| bytes.extend(i.to_le_bytes()));
    }
    bytes
}

fn obj(ball: &Ball) -> String {
    let mut text = String::new();
    ball.points().for_each(|[x, y, z]| writeln!(text, "v {x:.6} {y:.6} {z:.6}").expect("a string takes it"));
    for face in ball.faces() {
        let [a, b, c] = face.map(|i| i + 1);
        writeln!(text, "f {a} {b} {c}").expect("a string takes it");
    }
    text
}
