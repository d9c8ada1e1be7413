//! Scenes in which something moves while the shutter is open.
use super::{ball, diffuse, emit, eye, finish, lamp, room};
use glam::{Affine3A, Mat3, Quat, Vec3};
use sunfleck::{
    camera::{Perspective, View},
    light::Sides,
    scene::{Scene, SurfaceDef},
    shape::{Parallelogram, Shape},
};

/// A ball that flies across the room and a tile that turns, grows and is sheared on its way.
pub(super) fn moving_instance() -> Scene {
    let mut b = room();
    let grey = diffuse(&mut b, Vec3::splat(0.6));
    let tile = Shape::Parallelogram(Parallelogram::new(Vec3::new(-0.5, 0.0, -0.5), Vec3::Z, Vec3::X));
    let tile = b.object(vec![SurfaceDef { shape: tile, material: grey, emission: None }]);
    let flying = b.object(vec![SurfaceDef { shape: ball([0.0; 3], 0.3), material: grey, emission: None }]);
    let at = |x: f32, y: f32| Affine3A::from_translation(Vec3::new(x, y, 0.2));
    b.place_moving(flying, at(-0.6, -0.6), at(0.5, 0.3));
    let sheared = Affine3A::from_mat3_translation(
        Mat3::from_rotation_z(0.9) * Mat3::from_cols(1.4 * Vec3::X, Vec3::Y, Vec3::new(0.5, 0.0, 1.0)),
        Vec3::new(0.4, -0.5, 0.0),
    );
    b.place_moving(tile, Affine3A::from_translation(Vec3::new(-0.4, 0.2, -0.5)), sheared);
    emit(&mut b, lamp(0.8, 0.95), Vec3::splat(8.0), Sides::One);
    finish(b)
}

/// A lamp that swings above a grey ball, and a lamp that stands still.
pub(super) fn moving_light() -> Scene {
    let mut b = room();
    let [black, grey] = [Vec3::ZERO, Vec3::splat(0.5)].map(|c| diffuse(&mut b, c));
    b.add(ball([0.1, -0.6, 0.0], 0.4), grey);
    let shine = |shape, radiance| SurfaceDef { shape, material: black, emission: Some((radiance, Sides::One)) };
    let shade = SurfaceDef { shape: ball([0.0, 0.2, 0.0], 0.15), material: grey, emission: None };
    let swing = b.object(vec![shine(lamp(0.5, 0.0), Vec3::new(9.0, 8.0, 7.0).into()), shade]);
    let at = |x: f32, turn: f32| {
        Affine3A::from_rotation_translation(Quat::from_rotation_z(turn), Vec3::new(x, 0.6 - 0.3 * turn.abs(), 0.1))
    };
    b.place_moving(swing, at(-0.5, -0.6), at(0.6, 0.8));
    emit(&mut b, lamp(0.4, 0.95), Vec3::new(1.0, 3.0, 6.0), Sides::One);
    finish(b)
}

fn with_moving_eye(from: Perspective, change: impl Fn(Perspective) -> Perspective) -> Scene {
    let mut b = room();
    let grey = diffuse(&mut b, Vec3::splat(0.4));
    b.add(ball([0.2, -0.4, 0.5], 0.35), grey);
    let view =
        View { position: Vec3::new(0.5, 0.3, 3.0), look_at: Vec3::new(-0.2, 0.1, 0.0), up: Vec3::new(0.2, 1.0, 0.0) };
    let to = Perspective::new(&view, 48.0, 1.0).unwrap();
    b.camera_moving(from, change(to));
    emit(&mut b, lamp(0.8, 0.95), Vec3::splat(8.0), Sides::One);
    finish(b)
}

pub(super) fn moving_camera() -> Scene {
    with_moving_eye(eye(), |to| to)
}

/// The eye moves while its aperture opens and its focus is pulled.
pub(super) fn moving_thin_lens() -> Scene {
    with_moving_eye(eye().with_lens(0.2, 2.8).unwrap(), |to| to.with_lens(0.5, 3.6).unwrap())
}
