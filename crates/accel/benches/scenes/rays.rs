//! The rays a path tracer would send, one million per set.

use super::Rng;
use accel::{Bvh, Hit, Ray};
use glam::Vec3;

/// Rays of one kind.
pub(crate) struct RaySet {
    pub(crate) name: &'static str,
    pub(crate) rays: Vec<Ray>,
    /// Whether only occlusion is asked for.
    pub(crate) any: bool,
}

/// Camera rays in tiles of 8 by 8 pixels; cosine-distributed rays after one and three hits, the latter also in random
/// order; shadow rays to the lamp from the first and third hit; and the first bounce again as occlusion rays. `normal` tells the
/// normal at a hit.
pub(crate) fn ray_sets(normal: impl Fn(&Hit) -> Vec3, bvh: &Bvh, side: u32) -> Vec<RaySet> {
    let primary = camera(side);
    let mut rng = Rng::new(12345);
    let (cosine1, shadow1) = bounce(&normal, bvh, &primary, &mut rng);
    let (cosine2, _) = bounce(&normal, bvh, &cosine1, &mut rng);
    let (cosine3, shadow3) = bounce(&normal, bvh, &cosine2, &mut rng);
    let mut shuffled = cosine3.clone();
    for i in (1..shuffled.len()).rev() {
        let j = (f64::from(rng.uniform()) * (i + 1) as f64) as usize;
        shuffled.swap(i, j.min(i));
    }
    let set = |name, rays, any| RaySet { name, rays, any };
    vec![
        set("primary", primary, false),
        set("cosine1", cosine1.clone(), false),
        set("cosine3", cosine3, false),
        set("shuffled", shuffled, false),
        set("shadow1", shadow1, true),
        set("shadow3", shadow3, true),
        set("ao", cosine1, true),
    ]
}

fn camera(side: u32) -> Vec<Ray> {
    let tiles = side / 8;
    let pixels =
        (0..tiles * tiles).flat_map(|tile| (0..64).map(move |k| (tile % tiles * 8 + k % 8, tile / tiles * 8 + k / 8)));
    let screen = |i: u32| (i as f32 + 0.5) / side as f32 * 2.0 - 1.0;
    pixels
        .map(|(x, y)| Ray::new(Vec3::new(0.0, 0.0, 3.5), Vec3::new(screen(x), -screen(y), -2.6).normalize()))
        .collect()
}

/// From the hit of each ray, a cosine-distributed ray and a ray to a point of the lamp.
fn bounce(normal: impl Fn(&Hit) -> Vec3, bvh: &Bvh, rays: &[Ray], rng: &mut Rng) -> (Vec<Ray>, Vec<Ray>) {
    let mut onward = Vec::new();
    let mut shadow = Vec::new();
    for ray in rays {
        let Some(hit) = bvh.closest(ray) else { continue };
        let normal = normal(&hit);
        let normal = if normal.dot(ray.d) > 0.0 { -normal } else { normal };
        let o = ray.at(hit.t) + normal * 1e-4;
        onward.push(Ray { o, d: cosine_direction(normal, rng), tmin: 1e-4, tmax: f32::INFINITY });
        let lamp = Vec3::new(rng.uniform() * 0.5 - 0.25, 0.99, rng.uniform() * 0.5 - 0.25) - o;
        shadow.push(Ray { o, d: lamp.normalize(), tmin: 1e-4, tmax: lamp.length() * 0.999 });
    }
    (onward, shadow)
}

fn cosine_direction(normal: Vec3, rng: &mut Rng) -> Vec3 {
    let (tangent, bitangent) = normal.any_orthonormal_pair();
    let u = rng.uniform();
    let (sin, cos) = (rng.uniform() * std::f32::consts::TAU).sin_cos();
    ((tangent * cos + bitangent * sin) * u.sqrt() + normal * (1.0 - u).sqrt()).normalize()
}
