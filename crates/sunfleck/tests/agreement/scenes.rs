//! Tiny scenes, each with one thing that algorithms get wrong.
mod covered;
mod filled;
mod lights;
mod moving;

use glam::{Affine3A, Quat, Vec3};
use sunfleck::{
    bsdf::{
        ConductorMaterial, CookTorranceMaterial, DielectricMaterial, DiffuseMaterial, MirrorMaterial, MixMaterial,
        PhongMaterial, RoughConductorMaterial, RoughDielectricMaterial,
    },
    camera::{Orthographic, Perspective, Spherical, Unrolling, View},
    light::{PointLight, Sides},
    scene::{MaterialId, Scene, SceneBuilder, SurfaceDef},
    shape::{Mesh, Parallelogram, Shape, Sphere},
    spectrum::Ior,
    texture::{ImageTexture, Texture, Wrap},
};

pub(crate) struct TinyScene {
    pub(crate) name: &'static str,
    /// What is difficult, for the table in the book.
    pub(crate) about: &'static str,
    /// Algorithms that cannot find all its light, or only with sparks that no test can wait for.
    pub(crate) blind: &'static [&'static str],
    pub(crate) build: fn() -> Scene,
}

/// Every algorithm sees everything.
const NONE: &[&str] = &[];
/// Mirrors and glass before the camera.
const LIGHT: &[&str] = &["light"];
/// A caustic of a point light, seen through glass: no light can be met by chance, and nothing be connected.
const ALL_BUT_PHOTONS: &[&str] = &["path", "light", "bdpt"];

/// Of the photons on narrow lobes hardly any is scattered to the eye, and those are very bright.
const NEAREST_PHOTONS: &[&str] = &["photonmap"];

const fn tiny(
    name: &'static str,
    about: &'static str,
    blind: &'static [&'static str],
    build: fn() -> Scene,
) -> TinyScene {
    TinyScene { name, about, blind, build }
}

pub(crate) const SCENES: &[TinyScene] = &[
    tiny("diffuse_room", "matt surfaces", NONE, diffuse_room),
    tiny("bumped_normals", "shading normals far from the true ones", NONE, bumped_normals),
    tiny("point_light", "a point light", NONE, point_light),
    tiny("two_sided_light", "a lamp that shines both ways", NONE, two_sided_light),
    tiny("caustic_of_a_glass_ball", "a caustic seen through the glass that makes it", LIGHT, caustic_of_a_glass_ball),
    tiny(
        "point_light_through_glass",
        "a caustic of a point light, seen through glass",
        ALL_BUT_PHOTONS,
        point_light_through_glass,
    ),
    tiny("nested_glass", "water in a ball of glass, with a bubble of air", LIGHT, nested_glass),
    tiny("mirror_room", "a mirror", LIGHT, mirror_room),
    tiny("instance", "turned, stretched and mirrored copies", NONE, instance),
    tiny("thin_lens", "depth of field", NONE, thin_lens),
    tiny("parallel_rays", "an orthographic camera with lenses", NONE, parallel_rays),
    tiny("all_around", "a spherical camera", NONE, all_around),
    tiny("mesh_light", "a lamp of unlike triangles", NONE, lights::mesh_light),
    tiny("sphere_light", "a shining ball", NONE, lights::sphere_light),
    tiny("spot_light", "a spot light", NONE, lights::spot_light),
    tiny("directional_light", "a light from infinity", NONE, lights::directional_light),
    tiny("environment_light", "a sky with a bright patch", NONE, lights::environment_light),
    tiny("rough_glass", "frosted glass", NONE, rough_glass),
    tiny("rough_metal", "rough gold", NONE, rough_metal),
    tiny("haze", "glass with a lamp in it, and metal beside matt metal, both with a haze", NEAREST_PHOTONS, haze),
    tiny("glossy_paint", "highlights on paint", NONE, glossy_paint),
    tiny("textures", "a texture", NONE, textures),
    tiny("unlike_lights", "lights of unlike power", NONE, lights::unlike_lights),
    tiny("an_eye_in_glass", "the eye in glass: η² of radiance", LIGHT, an_eye_in_glass),
    tiny("moving_instance", "objects that move", NONE, moving::moving_instance),
    tiny("moving_light", "a lamp that moves", NONE, moving::moving_light),
    tiny("moving_camera", "an eye that moves", NONE, moving::moving_camera),
    tiny("moving_thin_lens", "a lens that moves and is focused", NONE, moving::moving_thin_lens),
    tiny("dispersive_ball", "dispersion seen through glass", LIGHT, dispersive_ball),
    tiny("dispersive_caustic", "a caustic of many colours", NONE, dispersive_caustic),
    tiny("dispersive_rough_glass", "dispersion in frosted glass", NONE, dispersive_rough_glass),
    tiny("coverings", "holes, two sides, normals and bumps from pictures, brushed metal", NONE, covered::coverings),
    tiny("mixed_mirror", "a mirror mixed with paint behind a pane", LIGHT, covered::mixed_mirror),
    tiny("layers", "polished plastic, a principled ball that is partly clear, paper", LIGHT, covered::layers),
    tiny("absorbing_ball", "green glass around a lamp and a matt ball", LIGHT, filled::absorbing_ball),
    tiny(
        "overlapping_balls",
        "glass and water in the same place, and a lamp in both",
        LIGHT,
        filled::overlapping_balls,
    ),
    tiny("under_water", "eye, lamp and room in water, with a bubble", LIGHT, filled::under_water),
    tiny(
        "frosted_wine",
        "frosted glass that absorbs, with a point light in it, in a pool",
        LIGHT,
        filled::frosted_wine,
    ),
    tiny("filled_holes", "a filled shell with holes", LIGHT, filled::filled_holes),
];

/// A room 2 x 2 x 2 around the origin with an open front at z = 1, walls of three colours, and the eye before it.
fn room() -> SceneBuilder {
    let mut b = SceneBuilder::new();
    let [white, red, green] =
        [Vec3::splat(0.7), Vec3::new(0.6, 0.1, 0.1), Vec3::new(0.1, 0.5, 0.2)].map(|c| diffuse(&mut b, c));
    let wall =
        |p: [f32; 3], u: Vec3, v: Vec3| Shape::Parallelogram(Parallelogram::new(Vec3::from(p), 2.0 * u, 2.0 * v));
    b.add(wall([-1.0, -1.0, -1.0], Vec3::Z, Vec3::X), white); // floor, facing up
    b.add(wall([-1.0, 1.0, -1.0], Vec3::X, Vec3::Z), white); // ceiling, facing down
    b.add(wall([-1.0, -1.0, -1.0], Vec3::X, Vec3::Y), white); // back
    b.add(wall([-1.0, -1.0, -1.0], Vec3::Y, Vec3::Z), red);
    b.add(wall([1.0, -1.0, -1.0], Vec3::Z, Vec3::Y), green);
    b.camera(eye());
    b
}

fn eye() -> Perspective {
    Perspective::new(&View { position: Vec3::new(0.0, 0.0, 3.4), look_at: Vec3::ZERO, up: Vec3::Y }, 42.0, 1.0).unwrap()
}

fn diffuse(b: &mut SceneBuilder, c: Vec3) -> MaterialId {
    let reflectance = b.constant(c);
    b.material(DiffuseMaterial { reflectance })
}

/// A quad `side` wide that faces down from height `y`.
fn lamp(side: f32, y: f32) -> Shape {
    let p = Vec3::new(-0.5 * side, y, -0.5 * side);
    Shape::Parallelogram(Parallelogram::new(p, side * Vec3::X, side * Vec3::Z))
}

fn emit(b: &mut SceneBuilder, shape: Shape, radiance: Vec3, sides: Sides) {
    let material = diffuse(b, Vec3::ZERO);
    b.surface(SurfaceDef { shape, material, emission: Some((radiance.into(), sides)) });
}

fn clear_glass(b: &mut SceneBuilder) -> DielectricMaterial {
    let white = b.constant(Vec3::ONE);
    DielectricMaterial { eta: 1.5.into(), reflectance: white, transmittance: white }
}

fn glass(b: &mut SceneBuilder) -> MaterialId {
    let glass = clear_glass(b);
    b.material(glass)
}

fn ball(centre: [f32; 3], radius: f32) -> Shape {
    Shape::Sphere(Sphere { centre: Vec3::from(centre), radius })
}

fn finish(b: SceneBuilder) -> Scene {
    b.build().expect("a valid scene")
}

fn diffuse_room() -> Scene {
    let mut b = room();
    let grey = diffuse(&mut b, Vec3::splat(0.4));
    b.add(ball([0.3, -0.5, 0.0], 0.5), grey);
    emit(&mut b, lamp(0.8, 0.95), Vec3::new(9.0, 7.0, 5.0), Sides::One);
    finish(b)
}

/// A ball of few flat triangles with the normals of a sphere, tilted further: shading and true normals differ much.
fn bumped_normals() -> Scene {
    let mut b = room();
    let grey = diffuse(&mut b, Vec3::splat(0.8));
    let (mut positions, mut normals, mut indices) = (vec![], vec![], vec![]);
    let (rows, columns) = (5u32, 8u32);
    for i in 0..=rows {
        for j in 0..columns {
            let (theta, phi) =
                (std::f32::consts::PI * i as f32 / rows as f32, std::f32::consts::TAU * j as f32 / columns as f32);
            let n = Vec3::new(theta.sin() * phi.cos(), theta.cos(), theta.sin() * phi.sin());
            positions.push(Vec3::new(0.0, -0.3, 0.0) + 0.6 * n);
            normals.push((n + 0.3 * Vec3::new(0.0, (3.0 * phi).sin(), 0.0)).normalize());
        }
    }
    for i in 0..rows {
        for j in 0..columns {
            let at = |i: u32, j: u32| i * columns + j % columns;
            indices.push([at(i, j), at(i + 1, j + 1), at(i + 1, j)]);
            indices.push([at(i, j), at(i, j + 1), at(i + 1, j + 1)]);
        }
    }
    b.add(Shape::Mesh(Mesh::new(positions, normals, vec![], indices).unwrap()), grey);
    emit(&mut b, lamp(0.8, 0.95), Vec3::splat(8.0), Sides::One);
    finish(b)
}

fn point_light() -> Scene {
    let mut b = room();
    let grey = diffuse(&mut b, Vec3::splat(0.6));
    b.add(ball([-0.3, -0.6, 0.1], 0.4), grey);
    b.light(PointLight { p: Vec3::new(0.2, 0.5, 0.3), intensity: Vec3::new(1.0, 0.8, 0.6).into() });
    finish(b)
}

fn two_sided_light() -> Scene {
    let mut b = room();
    emit(&mut b, lamp(0.7, 0.2), Vec3::splat(4.0), Sides::Two);
    finish(b)
}

fn caustic_of_a_glass_ball() -> Scene {
    let mut b = room();
    let glass = glass(&mut b);
    b.add(ball([0.1, -0.4, 0.1], 0.5), glass);
    emit(&mut b, lamp(1.6, 0.95), Vec3::splat(3.0), Sides::One);
    finish(b)
}

fn point_light_through_glass() -> Scene {
    let mut b = room();
    let glass = glass(&mut b);
    b.add(ball([0.1, -0.4, 0.1], 0.5), glass);
    b.light(PointLight { p: Vec3::new(0.2, 0.8, 0.2), intensity: Vec3::new(1.0, 0.8, 0.6).into() });
    finish(b)
}

/// Boundaries between glass and water and between water and air: each has the ratio of its two sides.
fn nested_glass() -> Scene {
    let mut b = room();
    let outer = glass(&mut b);
    let [water, air] = [1.33 / 1.5, 1.0 / 1.33].map(|eta: f32| {
        let inner = DielectricMaterial { eta: eta.into(), ..clear_glass(&mut b) };
        b.material(inner)
    });
    b.add(ball([0.1, -0.3, 0.1], 0.6), outer);
    b.add(ball([0.1, -0.3, 0.1], 0.5), water);
    b.add(ball([0.2, -0.2, 0.2], 0.2), air);
    emit(&mut b, lamp(1.6, 0.95), Vec3::splat(3.0), Sides::One);
    finish(b)
}

fn mirror_room() -> Scene {
    let mut b = room();
    let reflect = b.constant(Vec3::new(0.9, 0.8, 0.7));
    let mirror = b.material(MirrorMaterial { reflect });
    b.add(ball([-0.3, -0.5, 0.1], 0.5), mirror);
    emit(&mut b, lamp(1.6, 0.95), Vec3::splat(3.0), Sides::One);
    finish(b)
}

/// A patch and a ball placed with rotation and uneven scaling, and a mirrored copy.
fn instance() -> Scene {
    let mut b = room();
    let grey = diffuse(&mut b, Vec3::splat(0.6));
    let tile = Shape::Parallelogram(Parallelogram::new(Vec3::new(-0.5, 0.0, -0.5), Vec3::Z, Vec3::X));
    let object = b.object(vec![
        SurfaceDef { shape: tile, material: grey, emission: None },
        SurfaceDef { shape: ball([0.0, 0.3, 0.0], 0.3), material: grey, emission: None },
    ]);
    let place = |x: f32, s: Vec3| {
        Affine3A::from_scale_rotation_translation(s, Quat::from_rotation_z(0.4), Vec3::new(x, -0.6, 0.0))
    };
    b.place(object, place(0.4, Vec3::new(1.0, 1.5, 0.7)));
    b.place(object, place(-0.5, Vec3::new(-0.8, 0.8, 0.8)));
    emit(&mut b, lamp(0.8, 0.95), Vec3::splat(8.0), Sides::One);
    finish(b)
}

fn thin_lens() -> Scene {
    let mut b = room();
    let grey = diffuse(&mut b, Vec3::splat(0.4));
    b.add(ball([0.2, -0.4, 0.5], 0.35), grey);
    b.camera(eye().with_lens(0.5, 3.0).unwrap());
    emit(&mut b, lamp(0.8, 0.95), Vec3::splat(8.0), Sides::One);
    finish(b)
}

fn parallel_rays() -> Scene {
    let mut b = room();
    let grey = diffuse(&mut b, Vec3::splat(0.4));
    b.add(ball([0.2, -0.4, 0.5], 0.35), grey);
    let view = View { position: Vec3::new(0.3, 0.2, 3.4), look_at: Vec3::ZERO, up: Vec3::Y };
    b.camera(Orthographic::new(&view, 2.2, 1.0).unwrap().with_lens(0.5, 3.0).unwrap());
    emit(&mut b, lamp(0.8, 0.95), Vec3::splat(8.0), Sides::One);
    finish(b)
}

/// The poles of the picture look at the floor and at the lamp.
fn all_around() -> Scene {
    let mut b = room();
    let grey = diffuse(&mut b, Vec3::splat(0.4));
    b.add(ball([0.2, -0.4, 0.5], 0.35), grey);
    let view = View { position: Vec3::new(-0.2, 0.1, 0.2), look_at: Vec3::ZERO, up: Vec3::Y };
    b.camera(Spherical::new(&view, Unrolling::Equirectangular).unwrap());
    emit(&mut b, lamp(0.8, 0.95), Vec3::splat(8.0), Sides::One);
    finish(b)
}

fn rough_glass() -> Scene {
    let mut b = room();
    let glass = clear_glass(&mut b);
    let frosted = b.material(RoughDielectricMaterial { glass, alpha: 0.4.into() });
    b.add(ball([0.1, -0.4, 0.1], 0.5), frosted);
    emit(&mut b, lamp(1.2, 0.95), Vec3::splat(5.0), Sides::One);
    finish(b)
}

fn rough_metal() -> Scene {
    let mut b = room();
    let [eta, k, reflectance] = [Vec3::new(0.2, 0.9, 1.1), Vec3::new(3.9, 2.4, 2.3), Vec3::ONE].map(|c| b.constant(c));
    let gold =
        b.material(RoughConductorMaterial { metal: ConductorMaterial { eta, k, reflectance }, alpha: 0.3.into() });
    b.add(ball([-0.2, -0.4, 0.0], 0.6), gold);
    emit(&mut b, lamp(1.2, 0.95), Vec3::splat(5.0), Sides::One);
    finish(b)
}

/// Lobes so narrow that some algorithms treat them as mirrors; half of the metal is matt.
fn haze() -> Scene {
    let mut b = room();
    let glass = clear_glass(&mut b);
    let hazy = b.material(RoughDielectricMaterial { glass, alpha: 0.1.into() });
    b.add(ball([0.35, -0.35, 0.1], 0.4), hazy);
    emit(&mut b, ball([0.35, -0.35, 0.1], 0.25), Vec3::splat(5.0), Sides::One);
    let [eta, k, reflectance] = [0.2, 3.5, 0.9].map(|c| b.constant(Vec3::splat(c)));
    let metal = ConductorMaterial { eta, k, reflectance };
    let [bright, dull] = [0.1, 0.5].map(|a| b.material(RoughConductorMaterial { metal, alpha: a.into() }));
    let half = b.material(MixMaterial { of: [bright, dull], amount: 0.5.into() });
    b.add(ball([-0.45, -0.5, 0.2], 0.35), half);
    finish(b)
}

fn glossy_paint() -> Scene {
    let mut b = room();
    let [body, shine, f0] = [Vec3::new(0.4, 0.2, 0.1), Vec3::splat(0.5), Vec3::splat(0.04)].map(|c| b.constant(c));
    let phong = b.material(PhongMaterial { diffuse: body, specular: shine, exponent: 12.0 });
    let varnish = b.material(CookTorranceMaterial { albedo: body, f0, roughness: 0.5, metallic: 0.3 });
    b.add(ball([-0.45, -0.5, 0.0], 0.4), phong);
    b.add(ball([0.45, -0.5, 0.0], 0.4), varnish);
    emit(&mut b, lamp(1.2, 0.95), Vec3::splat(5.0), Sides::One);
    finish(b)
}

fn textures() -> Scene {
    let mut b = room();
    let checks =
        (0..64).map(|i| if (i + i / 8) % 2 == 0 { Vec3::new(0.8, 0.3, 0.1) } else { Vec3::splat(0.1) }).collect();
    let reflectance = b.texture(Texture::Image(ImageTexture::new(8, 8, checks, Wrap::Repeat).unwrap()));
    let tiles = b.material(DiffuseMaterial { reflectance });
    let board = Parallelogram::new(Vec3::new(-0.9, -0.8, -0.5), 1.8 * Vec3::X, Vec3::new(0.0, 1.4, -0.4));
    b.add(Shape::Parallelogram(board), tiles);
    emit(&mut b, lamp(0.8, 0.95), Vec3::splat(8.0), Sides::One);
    finish(b)
}

/// The eye sits in a ball of glass: radiance it sees is larger by η², flux is not.
fn an_eye_in_glass() -> Scene {
    let mut b = room();
    let glass = glass(&mut b);
    b.add(ball([0.0, 0.0, 3.4], 0.5), glass);
    emit(&mut b, lamp(1.6, 0.95), Vec3::splat(3.0), Sides::One);
    finish(b)
}

/// Glass with more dispersion than any real one.
fn prism_glass(b: &mut SceneBuilder) -> DielectricMaterial {
    DielectricMaterial { eta: Ior::Cauchy([1.35, 0.06, 0.0]), ..clear_glass(b) }
}

fn dispersive_ball() -> Scene {
    let mut b = room();
    let glass = prism_glass(&mut b);
    let glass = b.material(glass);
    b.add(ball([0.1, -0.4, 0.1], 0.5), glass);
    emit(&mut b, lamp(1.6, 0.95), Vec3::new(3.0, 2.5, 2.0), Sides::One);
    finish(b)
}

/// The eye is below the ball, so that nothing but matt surfaces is seen.
fn dispersive_caustic() -> Scene {
    let mut b = room();
    let glass = prism_glass(&mut b);
    let glass = b.material(glass);
    b.add(ball([0.0, 0.15, 0.0], 0.45), glass);
    let view = View { position: Vec3::new(0.0, -0.35, 0.0), look_at: Vec3::NEG_Y, up: Vec3::Z };
    b.camera(Perspective::new(&view, 80.0, 1.0).unwrap());
    emit(&mut b, lamp(1.6, 0.95), Vec3::splat(3.0), Sides::One);
    finish(b)
}

fn dispersive_rough_glass() -> Scene {
    let mut b = room();
    let glass = prism_glass(&mut b);
    let frosted = b.material(RoughDielectricMaterial { glass, alpha: 0.3.into() });
    b.add(ball([0.1, -0.4, 0.1], 0.5), frosted);
    emit(&mut b, lamp(1.2, 0.95), Vec3::splat(5.0), Sides::One);
    finish(b)
}
