//! Scenes of materials laid over others.
use super::{ball, diffuse, emit, finish, lamp, room};
use glam::Vec3;
use sunfleck::{
    bsdf::{
        BumpMapMaterial, ConductorMaterial, DiffuseTransmissionMaterial, MaskMaterial, MirrorMaterial, MixMaterial,
        NormalMapMaterial, PlasticMaterial, PrincipledMaterial, RoughConductorMaterial, Roughness,
        ThinDielectricMaterial, TwoSidedMaterial,
    },
    light::Sides,
    scene::{Scene, SceneBuilder, TextureId, Transmission},
    shape::{Parallelogram, Shape},
    spectrum::Rgb,
    texture::{ImageTexture, Texture, Wrap},
};

fn picture(b: &mut SceneBuilder, pixel: impl Fn(f32, f32) -> Rgb) -> TextureId {
    let at = |i: usize| pixel((i % 16) as f32 / 16.0, (i / 16) as f32 / 16.0);
    b.texture(Texture::Image(ImageTexture::new(16, 16, (0..256).map(at).collect(), Wrap::Repeat).unwrap()))
}

/// A curtain with holes of every opacity under the lamp, a ball of brushed metal with bumps, and a wall with normals.
pub(super) fn coverings() -> Scene {
    let mut b = room();
    let [grey, blue] = [Vec3::splat(0.6), Vec3::new(0.2, 0.3, 0.8)].map(|c| diffuse(&mut b, c));
    let veil = picture(&mut b, |x, y| Rgb::splat(0.5 + 0.6 * (6.3 * x).sin() * (6.3 * y).sin()));
    let sides = b.material(TwoSidedMaterial { front: Some(grey), back: Some(blue) });
    let lace = b.material(MaskMaterial { of: sides, opacity: veil.into() });
    let half = |side: Vec3, up: Vec3| Parallelogram::new(-0.5 * (side + up), side, up);
    let curtain = half(1.3 * Vec3::X, 1.3 * Vec3::Z);
    b.add(Shape::Parallelogram(Parallelogram::new(curtain.p() + 0.4 * Vec3::Y, curtain.u(), curtain.v())), lace);
    let [eta, k, reflectance] = [Vec3::new(0.2, 0.9, 1.1), Vec3::new(3.9, 2.4, 2.3), Vec3::ONE].map(|c| b.constant(c));
    let metal = ConductorMaterial { eta, k, reflectance };
    let alpha = Roughness::aligned(0.5.into(), 0.2.into());
    let brushed = b.material(RoughConductorMaterial { metal, alpha });
    let waves = picture(&mut b, |x, y| Rgb::splat(0.01 * ((6.3 * x).sin() + (6.3 * y).cos())));
    let wavy = b.material(BumpMapMaterial { of: brushed, height: waves.into(), scale: 4.0 });
    b.add(ball([-0.4, -0.5, 0.1], 0.45), wavy);
    let lean = picture(&mut b, |x, y| 0.5 + 0.5 * Rgb::new(0.5 * (6.3 * x).sin(), 0.5 * (6.3 * y).cos(), 0.7));
    let tiles = b.material(NormalMapMaterial { of: grey, map: lean, scale: 1.0 });
    let board = Parallelogram::new(Vec3::new(-0.1, -0.9, -0.6), Vec3::X, Vec3::new(0.0, 1.0, -0.3));
    b.add(Shape::Parallelogram(board), tiles);
    emit(&mut b, lamp(1.0, 0.95), Vec3::new(9.0, 8.0, 7.0), Sides::One);
    finish(b)
}

/// A ball that is half a mirror and a small lamp, behind a pane.
pub(super) fn mixed_mirror() -> Scene {
    let mut b = room();
    let grey = diffuse(&mut b, Vec3::splat(0.6));
    let white = b.constant(Vec3::ONE);
    let mirror = b.material(MirrorMaterial { reflect: white });
    let stripes = picture(&mut b, |x, _| Rgb::splat(0.5 + 0.5 * (25.0 * x).sin()));
    let mixed = b.material(MixMaterial { of: [grey, mirror], amount: stripes.into() });
    b.add(ball([-0.2, -0.5, 0.0], 0.5), mixed);
    let pane = b.material(ThinDielectricMaterial { eta: 1.5.into(), reflectance: white, transmittance: white });
    let board = Parallelogram::new(Vec3::new(-0.6, -0.9, 0.6), Vec3::X, 1.4 * Vec3::Y);
    b.add(Shape::Parallelogram(board), pane);
    emit(&mut b, ball([0.1, 0.1, 0.2], 0.08), Vec3::splat(6.0), Sides::One);
    emit(&mut b, lamp(1.6, 0.95), Vec3::splat(3.0), Sides::One);
    finish(b)
}

/// Polished plastic, a coated ball of which a third is frosted glass, and a sheet of paper before the lamp.
pub(super) fn layers() -> Scene {
    let mut b = room();
    let [red, white, paper] = [Vec3::new(0.7, 0.2, 0.1), Vec3::ONE, Vec3::splat(0.4)].map(|c| b.constant(c));
    let plastic = PlasticMaterial { diffuse: red, specular: white, ior: 1.5, alpha: 0.0.into(), nonlinear: true };
    let plastic = b.material(plastic);
    b.add(ball([-0.5, -0.55, 0.1], 0.4), plastic);
    let opaque = PrincipledMaterial {
        metallic: 0.3.into(),
        coat: 0.8.into(),
        coat_roughness: 0.4.into(),
        sheen: Some(red),
        ..PrincipledMaterial::new(paper)
    };
    let clear = Transmission { amount: 0.5.into(), color: white, ior: 1.5.into(), thin: false };
    let mixed = b.principled(opaque, Some(clear));
    b.add(ball([0.45, -0.5, 0.0], 0.45), mixed);
    let sheet = b.material(DiffuseTransmissionMaterial { reflectance: paper, transmittance: paper });
    let shade = Parallelogram::new(Vec3::new(-0.3, 0.6, -0.4), 0.8 * Vec3::X, Vec3::new(0.0, -0.3, 0.8));
    b.add(Shape::Parallelogram(shade), sheet);
    emit(&mut b, lamp(1.2, 0.95), Vec3::splat(6.0), Sides::One);
    finish(b)
}
