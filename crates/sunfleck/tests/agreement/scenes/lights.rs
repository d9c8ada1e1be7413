//! Scenes of lights of all kinds.
use super::{ball, diffuse, emit, finish, lamp, room};
use glam::{Vec2, Vec3};
use sunfleck::{
    light::{DirectionalLight, EnvironmentLight, PointLight, Sides, SpotLight},
    scene::Scene,
    shape::{Mesh, Shape},
    texture::{ImageTexture, Wrap},
};

/// Two triangles of unlike size emit, so that picking by area matters.
pub(super) fn mesh_light() -> Scene {
    let mut b = room();
    let p = vec![
        Vec3::new(-0.6, 0.9, -0.4),
        Vec3::new(0.6, 0.8, -0.4),
        Vec3::new(0.0, 0.9, 0.6),
        Vec3::new(-0.8, 0.6, 0.2),
    ];
    let uvs = vec![Vec2::ZERO, Vec2::X, Vec2::Y, Vec2::ONE];
    let mesh = Mesh::new(p, vec![], uvs, vec![[0, 1, 2], [0, 2, 3]]).unwrap();
    emit(&mut b, Shape::Mesh(mesh), Vec3::new(5.0, 6.0, 7.0), Sides::Two);
    finish(b)
}

pub(super) fn sphere_light() -> Scene {
    let mut b = room();
    emit(&mut b, ball([0.2, 0.3, 0.0], 0.25), Vec3::new(6.0, 5.0, 4.0), Sides::One);
    finish(b)
}

pub(super) fn spot_light() -> Scene {
    let mut b = room();
    let grey = diffuse(&mut b, Vec3::splat(0.6));
    b.add(ball([0.2, -0.6, 0.0], 0.4), grey);
    let spot = SpotLight::new(Vec3::new(-0.5, 0.7, 0.4), Vec3::new(0.6, -1.0, -0.3), Vec3::splat(4.0), [0.3, 0.8]);
    b.light(spot.unwrap());
    finish(b)
}

pub(super) fn directional_light() -> Scene {
    let mut b = room();
    let grey = diffuse(&mut b, Vec3::splat(0.6));
    b.add(ball([0.2, -0.5, 0.0], 0.5), grey);
    b.light(DirectionalLight::new(Vec3::new(0.3, -0.4, -1.0), Vec3::new(3.0, 2.5, 2.0)).unwrap());
    finish(b)
}

/// A sky with a bright patch, seen through the open front.
pub(super) fn environment_light() -> Scene {
    let mut b = room();
    let (w, h) = (16usize, 8usize);
    let sky = |i: usize| {
        let (x, y) = (i % w, i / w);
        let patch = if (10..13).contains(&x) && (2..4).contains(&y) { 12.0 } else { 0.0 };
        Vec3::new(0.5 + patch, 0.6 + patch, 1.0 + 0.1 * y as f32)
    };
    let image = ImageTexture::new(w, h, (0..w * h).map(sky).collect(), Wrap::Repeat).unwrap();
    b.light(EnvironmentLight::panorama(image, Vec3::ONE, glam::Mat3::IDENTITY).unwrap());
    let grey = diffuse(&mut b, Vec3::splat(0.6));
    b.add(ball([0.0, -0.5, 0.6], 0.4), grey);
    finish(b)
}

/// A strong quad, a weak ball and a point: the choice between lights must cancel out.
pub(super) fn unlike_lights() -> Scene {
    let mut b = room();
    emit(&mut b, lamp(0.6, 0.95), Vec3::new(6.0, 5.0, 4.0), Sides::One);
    emit(&mut b, ball([0.5, -0.7, 0.2], 0.2), Vec3::new(0.5, 2.0, 0.5), Sides::One);
    b.light(PointLight { p: Vec3::new(-0.6, -0.2, 0.3), intensity: Vec3::new(0.1, 0.1, 0.4).into() });
    finish(b)
}
