//! Scenes of things that are filled.
use super::{ball, clear_glass, diffuse, emit, finish, glass, lamp, prism_glass, room};
use glam::Vec3;
use sunfleck::{
    bsdf::{DielectricMaterial, MaskMaterial, RoughDielectricMaterial},
    light::{PointLight, Sides},
    medium::Interior,
    scene::{MaterialId, Scene, SceneBuilder},
    spectrum::{Ior, Rgb},
};

/// Glass or liquid of index `eta`, filled with `interior`.
fn filled(b: &mut SceneBuilder, eta: impl Into<Ior>, interior: Interior) -> MaterialId {
    let glass = DielectricMaterial { eta: eta.into(), ..clear_glass(b) };
    let (material, interior) = (b.material(glass), b.interior(interior));
    b.fill(material, interior);
    material
}

/// A ball of green glass, which parts colours where wavelengths are carried, with a matt ball and a lamp in it.
pub(super) fn absorbing_ball() -> Scene {
    let mut b = room();
    let grey = diffuse(&mut b, Vec3::splat(0.6));
    let eta = prism_glass(&mut b).eta;
    let green = filled(&mut b, eta, Interior::passing(Rgb::new(0.2, 0.8, 0.4), 0.5, eta));
    b.add(ball([0.1, -0.3, 0.1], 0.6), green);
    b.add(ball([0.0, -0.6, 0.1], 0.2), grey);
    emit(&mut b, ball([0.2, -0.1, 0.1], 0.1), Vec3::splat(6.0), Sides::One);
    emit(&mut b, lamp(1.6, 0.95), Vec3::splat(3.0), Sides::One);
    finish(b)
}

/// Two balls that overlap, the thicker of higher priority; where they do there is a lamp, a matt ball, and between these the
/// hidden half of the thinner.
pub(super) fn overlapping_balls() -> Scene {
    let mut b = room();
    let grey = diffuse(&mut b, Vec3::splat(0.6));
    let glass = Interior::absorbing(Rgb::new(0.2, 0.4, 1.0), 1.5).with_priority(2);
    let water = Interior::absorbing(Rgb::new(1.5, 0.2, 0.1), 1.33).with_priority(1);
    let [glass, water] = [(1.5, glass), (1.33, water)].map(|(eta, i)| filled(&mut b, eta, i));
    b.add(ball([-0.3, -0.35, 0.1], 0.6), glass);
    b.add(ball([0.3, -0.45, 0.1], 0.5), water);
    b.add(ball([-0.4, -0.5, 0.1], 0.2), grey);
    emit(&mut b, ball([0.1, -0.2, 0.1], 0.1), Vec3::splat(8.0), Sides::One);
    emit(&mut b, lamp(1.6, 0.95), Vec3::splat(3.0), Sides::One);
    finish(b)
}

/// The room, its lamp and the eye in a ball of water, and a bubble of air in that.
pub(super) fn under_water() -> Scene {
    let mut b = room();
    let grey = diffuse(&mut b, Vec3::splat(0.4));
    let water = filled(&mut b, 1.33, Interior::absorbing(Rgb::new(0.5, 0.15, 0.05), 1.33).with_priority(1));
    let air = filled(&mut b, 1.0, Interior::clear(1.0).with_priority(2));
    b.add(ball([0.0, 0.0, 0.0], 5.0), water);
    b.add(ball([-0.4, -0.1, 0.2], 0.3), air);
    b.add(ball([0.3, -0.5, 0.0], 0.4), grey);
    emit(&mut b, lamp(0.8, 0.95), Vec3::new(9.0, 12.0, 14.0), Sides::One);
    finish(b)
}

/// Frosted glass of one colour, half of it in a pool without surface but with a priority, and a point light in it.
pub(super) fn frosted_wine() -> Scene {
    let mut b = room();
    let clear = clear_glass(&mut b);
    let frosted = b.material(RoughDielectricMaterial { glass: clear, alpha: 0.4.into() });
    let wine = b.interior(Interior::passing(Rgb::new(0.7, 0.2, 0.3), 0.4, 1.5).with_priority(2));
    b.fill(frosted, wine);
    let pool = filled(&mut b, 1.2, Interior::absorbing(Rgb::new(0.1, 0.3, 0.6), 1.2).with_priority(1));
    b.add(ball([0.1, -0.4, 0.1], 0.5), frosted);
    b.add(ball([0.0, -1.8, 0.0], 1.4), pool);
    b.light(PointLight { p: Vec3::new(0.1, -0.3, 0.1), intensity: Vec3::splat(1.0).into() });
    emit(&mut b, lamp(1.2, 0.95), Vec3::splat(5.0), Sides::One);
    finish(b)
}

/// A shell of glass with holes, filled: what comes through a hole is inside as well.
pub(super) fn filled_holes() -> Scene {
    let mut b = room();
    let glass = glass(&mut b);
    let shell = b.material(MaskMaterial { of: glass, opacity: 0.6.into() });
    let amber = b.interior(Interior::passing(Rgb::new(0.9, 0.5, 0.1), 0.5, 1.5));
    b.fill(shell, amber);
    b.add(ball([0.1, -0.4, 0.1], 0.5), shell);
    emit(&mut b, lamp(1.6, 0.95), Vec3::splat(3.0), Sides::One);
    finish(b)
}
