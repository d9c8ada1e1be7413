//! Lamps and skies seen through mirrors and glass alone.
//!
//! No light path can be joined to such a view, and a lamp behind several faint reflections is as bright as it is rare: a
//! walk that follows one way at each boundary makes a few pixels sparkle for hours. So these views are left to a tree of
//! walks from the same camera ray that follows both ways, each with what it carries (splitting: Arvo & Kirk 1990, "Particle
//! Transport and Image Synthesis"). Ways that carry little are followed now and then, by Russian roulette, so that nothing
//! is lost, no lamp is ever seen much brighter than it looks, and the tree stays small.
use crate::{
    bsdf::Transport,
    math::Ray,
    medium::Inside,
    sampler::Sampler,
    scene::{Interaction, Scattered, World},
    spectrum::Spectrum,
    walk::{Arrival, Escape, Limits, Start, Step, Visit, walk},
};
use glam::Vec2;

/// Ways that carry at least this part of the camera ray are followed surely.
const LEAST: f32 = 1.0 / 256.0;
/// Rays after which [`LEAST`] doubles, again and again: some gems have more ways than there is time for.
const PATIENCE: u32 = 32;

/// A way that waits to be followed.
#[derive(Clone, Copy)]
struct Branch {
    start: Start,
    /// Part of the camera ray that it carries, the compression of radiance inside glass undone.
    carries: f32,
    /// η² of the medium it is in.
    eta_scale: f32,
    scatterings: u32,
}

/// Where a camera ray met a mirror or glass first.
pub(super) struct First {
    at: Interaction,
    ray: Ray,
    /// Throughput that arrives.
    beta: Spectrum,
    inside: Inside,
}

impl First {
    /// `a`, of the camera ray itself.
    pub(super) fn new(a: &Arrival) -> Self {
        Self { at: *a.at, ray: *a.ray, beta: a.beta, inside: *a.inside }
    }
    fn arrival(&self) -> Arrival<'_> {
        let Self { at, ray, beta, inside } = self;
        Arrival {
            at,
            ray,
            beta: *beta,
            departed: Spectrum::ONE,
            scatterings: 0,
            pdf: 1.0,
            delta: true,
            caustic: false,
            all_delta: true,
            dispersed: false,
            travelled: at.distance,
            inside,
        }
    }
}

/// What is seen past the first surface, which is a mirror or glass.
pub(super) struct Lamps<'w> {
    world: &'w World<'w>,
    /// Scatterings at most.
    most: u32,
    /// Of the way that is being followed, as in [`Branch`].
    eta_scale: f32,
    scatterings: u32,
    waiting: Vec<Branch>,
    /// Radiance.
    pub(super) sum: Spectrum,
    /// Rays traced.
    pub(super) rays: u32,
}

impl<'w> Lamps<'w> {
    /// Follows all ways on from `first`, where the camera ray met a mirror or glass.
    pub(super) fn look(world: &'w World<'w>, first: &First, limits: Limits, sampler: &mut Sampler) -> Self {
        let (sum, waiting, most) = (Spectrum::BLACK, Vec::new(), limits.scatterings);
        let mut lamps = Self { world, most, eta_scale: 1.0, scatterings: 0, waiting, sum, rays: 0 };
        if most > 0 {
            lamps.part(&first.arrival(), sampler);
        }
        while let Some(Branch { start, eta_scale, scatterings, .. }) = lamps.brightest() {
            (lamps.eta_scale, lamps.scatterings) = (eta_scale, scatterings);
            lamps.rays += 1;
            walk(world, &start, &limits, sampler, &mut lamps);
        }
        lamps
    }
    /// Takes the way that carries most, so that the rays are spent there.
    fn brightest(&mut self) -> Option<Branch> {
        let most =
            (0..self.waiting.len()).max_by(|&i, &j| self.waiting[i].carries.total_cmp(&self.waiting[j].carries))?;
        Some(self.waiting.swap_remove(most))
    }
    /// Both ways on from a surface without other lobes.
    fn part(&mut self, a: &Arrival, sampler: &mut Sampler) {
        let u = if a.at.bsdf.is_polished() { Vec2::ZERO } else { sampler.next_2d() };
        // Reflections have the lower numbers.
        let first = a.at.sample(0.0, u, Transport::Radiance);
        let second = match &first {
            Some(s) if s.pdf >= 1.0 => None,
            _ => a.at.sample(1.0 - f32::EPSILON, u, Transport::Radiance),
        };
        let second = second.filter(|s| first.is_none_or(|f| f.crosses != s.crosses));
        for s in [first, second].into_iter().flatten() {
            self.follow_later(a, &s, sampler);
        }
    }
    fn follow_later(&mut self, a: &Arrival, s: &Scattered, sampler: &mut Sampler) {
        let mut beta = a.beta * s.weight * s.pdf;
        let mut dispersed = a.dispersed;
        if s.disperses && !dispersed {
            beta = beta.hero_only();
            dispersed = true;
        }
        let eta_scale = self.eta_scale * s.eta * s.eta;
        let mut carries = beta.max() * eta_scale;
        let least = (LEAST * (1u64 << (self.rays / PATIENCE).min(32)) as f32).min(1.0);
        if carries < least {
            let survive = carries / least;
            if sampler.next_1d() >= survive {
                return;
            }
            beta = beta / survive;
            carries = least;
        }
        let start = Start { beta, dispersed, ..a.branch(self.world, s, Transport::Radiance) };
        self.waiting.push(Branch { start, carries, eta_scale, scatterings: self.scatterings + 1 });
    }
}

impl Visit for Lamps<'_> {
    fn surface(&mut self, a: &Arrival, sampler: &mut Sampler) -> Step {
        self.sum += a.beta * self.world.emitted(a.at);
        if self.scatterings < self.most && !a.at.is_connectible() {
            self.part(a, sampler);
        }
        Step::Stop
    }
    fn escape(&mut self, e: &Escape) {
        for sky in self.world.escaped(e.ray.o, e.ray.d) {
            self.sum += e.beta * sky.le;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{
        bsdf::{BlackMaterial, DielectricMaterial, MirrorMaterial, ThinDielectricMaterial},
        camera::{Perspective, Project, View},
        light::{EnvironmentLight, Sides},
        sampler::Domain,
        scene::{MID_SHUTTER, Scene, SceneBuilder, SurfaceDef},
        shape::{Parallelogram, Shape, Sphere},
        spectrum::Wavelengths,
    };
    use glam::Vec3;

    /// A small lamp in a shell of glass over a mirror, behind a pane, under a dim sky.
    fn lamp_in_glass() -> Scene {
        let mut b = SceneBuilder::new();
        let white = b.constant(Vec3::ONE);
        let glass = |eta: f32| DielectricMaterial { eta: eta.into(), reflectance: white, transmittance: white };
        let (outer, inner) = (b.material(glass(1.5)), b.material(glass(1.0 / 1.5)));
        let pane = b.material(ThinDielectricMaterial { eta: 1.5.into(), reflectance: white, transmittance: white });
        let mirror = b.material(MirrorMaterial { reflect: white });
        let black = b.material(BlackMaterial);
        let ball = |radius| Shape::Sphere(Sphere { centre: Vec3::ZERO, radius });
        let sheet = |p: Vec3, u: Vec3, v: Vec3| Shape::Parallelogram(Parallelogram::new(p - 0.5 * (u + v), u, v));
        b.add(ball(1.0), outer);
        b.add(ball(0.9), inner);
        b.add(sheet(2.0 * Vec3::Z, 6.0 * Vec3::X, 6.0 * Vec3::Y), pane);
        b.add(sheet(-1.2 * Vec3::Y, 6.0 * Vec3::Z, 6.0 * Vec3::X), mirror);
        let emission = Some((Vec3::splat(100.0).into(), Sides::One));
        let shape = sheet(Vec3::ZERO, 0.3 * Vec3::X, 0.3 * Vec3::Z);
        b.surface(SurfaceDef { shape, material: black, emission });
        b.light(EnvironmentLight::constant(Vec3::splat(0.5)));
        let view = View { position: Vec3::new(0.0, 0.3, 5.0), look_at: Vec3::ZERO, up: Vec3::Y };
        b.camera(Perspective::new(&view, 30.0, 1.0).unwrap());
        b.build().unwrap()
    }

    /// Follows one way at each boundary.
    struct OneWay<'w>(&'w World<'w>, f32);

    impl Visit for OneWay<'_> {
        fn surface(&mut self, a: &Arrival, _: &mut Sampler) -> Step {
            if a.scatterings > 0 {
                self.1 += (a.beta * self.0.emitted(a.at)).max();
            }
            if a.at.is_connectible() { Step::Stop } else { Step::On }
        }
        fn escape(&mut self, e: &Escape) {
            if e.scatterings > 0 {
                self.1 += self.0.escaped(e.ray.o, e.ray.d).map(|s| (e.beta * s.le).max()).sum::<f32>();
            }
        }
    }

    /// The mirror or glass that a camera ray meets first.
    struct Met(Option<First>);

    impl Visit for Met {
        fn surface(&mut self, a: &Arrival, _: &mut Sampler) -> Step {
            self.0 = (!a.at.is_connectible()).then(|| First::new(a));
            Step::Stop
        }
    }

    /// Mean and variance.
    fn moments(n: u64, mut sample: impl FnMut(u64) -> f64) -> (f64, f64) {
        let (sum, squares) = (0..n).map(&mut sample).fold((0.0, 0.0), |(s, q), x| (s + x, q + x * x));
        let mean = sum / n as f64;
        (mean, squares / n as f64 - mean * mean)
    }

    #[test]
    fn both_ways_at_each_boundary_show_what_one_way_shows_without_its_sparks() {
        let scene = lamp_in_glass();
        let world = scene.world(Wavelengths::Rgb, MID_SHUTTER);
        let limits = Limits { roulette_after: u32::MAX, ..Limits::default() };
        let (mut rays, n) = (0, 1 << 16);
        let mut of = |tree: bool, pixel: Option<Vec2>| {
            moments(if pixel.is_some() { 1 << 10 } else { n }, |i| {
                let mut sampler = Sampler::new(u64::from(tree), Domain::Prepare, 0, i);
                let raster = sampler.next_2d();
                let ray = world.camera().ray(pixel.unwrap_or(raster), Vec2::ZERO).ray;
                let start = Start::from_camera(&world, ray);
                if tree {
                    let mut met = Met(None);
                    rays += walk(&world, &start, &limits, &mut sampler, &mut met);
                    met.0.map_or(0.0, |first| {
                        let lamps = Lamps::look(&world, &first, limits, &mut sampler);
                        rays += u64::from(lamps.rays);
                        f64::from(lamps.sum.max())
                    })
                } else {
                    let mut one = OneWay(&world, 0.0);
                    walk(&world, &start, &limits, &mut sampler, &mut one);
                    f64::from(one.1)
                }
            })
        };
        let ((one, v), (both, w)) = (of(false, None), of(true, None));
        let z = (both - one) / ((v + w) / n as f64).sqrt();
        assert!(z.abs() < 4.0 && one > 0.5, "{one} one way, {both} both ways, z = {z}");
        let (mut sparks, mut left) = (0.0, 0.0);
        for i in 0..64 {
            let pixel = Some(Vec2::new(0.3 + 0.05 * (i % 8) as f32, 0.3 + 0.05 * (i / 8) as f32));
            sparks += of(false, pixel).1;
            left += of(true, pixel).1;
        }
        assert!(left * 100.0 < sparks, "variance {left} of {sparks} is left");
        let mean = rays as f64 / (n + (64 << 10)) as f64;
        assert!(mean < 100.0, "{mean} rays");
    }
}
