use super::{
    Bandwidth,
    ladder::{CANDIDATES, Ladder, STEP, Sets},
    spots::Spots,
};
use crate::{
    bsdf::DiffuseMaterial,
    camera::{Orthographic, View},
    film::{FilmSpec, Filter},
    light::PointLight,
    photon::{Keep, Kernel, Radii, Schedule, Source},
    scene::{MID_SHUTTER, SceneBuilder},
    shape::{Parallelogram, Shape},
    spectrum::Wavelengths,
    walk::Limits,
};
use glam::Vec3;

/// The irradiance under a point light at height 1 falls as (1 + ρ²)^(−3/2) with the distance ρ from its foot: what the kernel
/// of `radius` makes of it, over what it is at the foot.
fn blurred(radius: f64) -> f64 {
    let steps = 1000;
    let part = |i: i32| {
        let t = (f64::from(i) + 0.5) / f64::from(steps);
        (1.0 + (radius * t).powi(2)).powf(-1.5) * 2.0 * (1.0 - t * t) * 2.0 * t / f64::from(steps)
    };
    (0..steps).map(part).sum()
}

#[test]
fn the_bias_under_a_point_light_is_that_of_the_integral_over_the_kernel() {
    let mut b = SceneBuilder::new();
    let grey = b.constant(Vec3::splat(0.5));
    let matt = b.material(DiffuseMaterial { reflectance: grey });
    let corner = Vec3::new(-3.0, 0.0, -3.0);
    b.add(Shape::Parallelogram(Parallelogram::new(corner, 6.0 * Vec3::Z, 6.0 * Vec3::X)), matt);
    b.light(PointLight { p: Vec3::Y, intensity: Vec3::ONE.into() });
    let view = View { position: 0.5 * Vec3::Y, look_at: Vec3::ZERO, up: Vec3::Z };
    b.camera(Orthographic::new(&view, 0.01, 1.0).unwrap());
    let scene = b.build().unwrap();
    let world = &scene.world(Wavelengths::Rgb, MID_SHUTTER);
    let how = Bandwidth {
        source: &Source::plain(),
        spec: FilmSpec { width: 16, height: 16, filter: Filter::Box },
        limits: Limits::default(),
        keep: Keep::All,
        kernel: Kernel::Epanechnikov,
        schedule: Schedule::default(),
        seed: 5,
        paths: 400_000,
    };
    let radii = Radii::fixed(0.8);
    let spots = Spots::every_tile(world, &radii, &how, 4);
    let sets = Sets::shoot(&how, world, 16, 100_000);
    let ladder = Ladder { bandwidth: &how, top: 1.0, sets: &sets };
    let measured = ladder.climb(&radii, &spots);
    // Radiance of 0.5 / π under an irradiance of 1.
    let radiance = 0.5 / std::f64::consts::PI;
    for spot in &measured.spots {
        let rungs: Vec<_> = (0..CANDIDATES).map(|r| spot[0].rung(r)).collect();
        for (r, rung) in rungs.iter().enumerate().take(2) {
            let bias = (rung.error.bias2.sqrt()) / radiance;
            let want = 1.0 - blurred(0.8 * f64::from(STEP).powi(-(r as i32)));
            assert!((bias / want - 1.0).abs() < 0.2, "rung {r}: {bias} against {want}");
        }
        // A pass has as many more photons as light paths, and half the radius a quarter of them.
        let expected = 400_000.0 * 0.5 * (1.0 - (1.0 + 0.64f64).sqrt().recip());
        assert!((rungs[0].photons / expected - 1.0).abs() < 0.05, "{} photons against {expected}", rungs[0].photons);
        assert!((4.0 * rungs[3].photons / rungs[2].photons - 1.0).abs() < 0.1, "{rungs:?}");
        // None of them came from a mirror.
        assert!(spot[1].is_dark());
    }
}
