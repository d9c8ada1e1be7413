//! Markov chains of light paths: the same picture in the mean, with less noise where few photons are seen.
use crate::scenes::{ball, eye, glass, make, room, spec};
use glam::{DVec3, Vec3};
use sunfleck::{
    film::PassImage,
    integrator::{ParamError, Params, Pass, find},
    scene::Scene,
    spectrum::Rgb,
};

/// A room with a ball of glass, of which the camera sees a little of the caustic on the floor.
fn close_up() -> Scene {
    let mut b = room(Rgb::splat(4.0), 1.2);
    let clear = glass(&mut b, 1.5);
    b.add(ball([0.0, -0.7, 0.0], 0.15), clear);
    b.camera(eye(Vec3::new(0.3, -0.4, -0.8), Vec3::new(0.05, -1.0, 0.05), 3.0));
    b.build().unwrap()
}

/// What some passes tell.
struct Told {
    /// Mean of the picture in each pass.
    means: Vec<DVec3>,
    /// Variance of a pixel from pass to pass, mean over the picture.
    noise: f64,
    /// Rays cast on light paths in a pass.
    rays: f64,
}

fn passes(scene: &Scene, settings: &str, count: u64) -> Told {
    let algorithm = make("ppm", settings);
    let prepared = algorithm.prepare(scene, spec(16), 3);
    let (mut means, mut rays, mut pixels) = (Vec::new(), 0.0, vec![Vec::new(); 256]);
    for index in 0..count {
        let mut image = PassImage::new(spec(16));
        prepared.render_pass(&Pass::new(3, index), &mut image);
        rays += image.counts.light_rays as f64 / count as f64;
        means.push(image.pixels().iter().map(|p| p.as_dvec3()).sum::<DVec3>() / 256.0);
        pixels.iter_mut().zip(image.pixels()).for_each(|(all, p)| all.push(p.as_dvec3()));
    }
    let noise = pixels.iter().map(|p| moments(p).1.element_sum()).sum::<f64>() / 256.0;
    Told { means, noise, rays }
}

/// Mean, and variance of one value.
fn moments(values: &[DVec3]) -> (DVec3, DVec3) {
    let n = values.len() as f64;
    let mean = values.iter().sum::<DVec3>() / n;
    (mean, values.iter().map(|v| (v - mean).powf(2.0)).sum::<DVec3>() / (n - 1.0))
}

#[test]
fn chains_change_the_noise_of_photons_and_not_their_mean() {
    let scene = close_up();
    for direct in ["connect", "photons"] {
        let settings = format!("radius=0.004 photons=30000 alpha=1 aim=off direct={direct}");
        let plain = passes(&scene, &settings, 48);
        let chained = passes(&scene, &format!("{settings} chains=on"), 48);
        let [a, b] = [&plain, &chained].map(|t| moments(&t.means));
        let z = (a.0 - b.0) / ((a.1 + b.1) / plain.means.len() as f64).map(f64::sqrt);
        assert!(z.abs().max_element() < 4.0, "{direct}: {} and {}, {z} standard errors apart", a.0, b.0);
        let (rays, noise) = (chained.rays / plain.rays, plain.noise / chained.noise);
        assert!((0.4..2.5).contains(&rays), "{direct}: {rays} times the rays");
        assert!(noise > 6.0, "{direct}: {noise} times less variance");
    }
}

#[test]
fn chains_need_light_paths_that_serve_gathers_alone() {
    let with = |name| {
        let mut params = Params::default();
        params.set("chains", "on");
        find(name).unwrap().build(params).map(|_| ())
    };
    for name in ["ppm", "unified"] {
        assert!(with(name).is_ok());
    }
    for name in ["vcm", "bdpt"] {
        assert!(matches!(with(name), Err(ParamError::Value { name: "chains", .. })));
    }
}
