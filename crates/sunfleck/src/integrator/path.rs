//! Path tracing with next-event estimation: the reference where light can be found from the camera.
use super::{Entry, Integrator, Pass, PassRenderer, eye_ray::EyeRay};
use crate::{
    bsdf::Transport,
    film::{Counts, FilmSpec, PassImage},
    sampler::Sampler,
    scene::{Interaction, Scene, Sky, World},
    spectrum::Spectrum,
    walk::{Arrival, Escape, Limits, Start, Step, Visit, walk},
};
use glam::Vec3;

pub(super) const ENTRY: Entry = Entry {
    name: "path",
    about: "path tracing: light connections and hits by multiple importance sampling; the reference without caustics",
    params: &[],
    mergeable: true,
    make: |p| Ok(Box::new(PathTracer { limits: p.limits()? })),
};

/// Settings of the path tracer.
#[derive(Clone, Copy, Debug, Default)]
pub struct PathTracer {
    /// When paths end.
    pub limits: Limits,
}

impl Integrator for PathTracer {
    fn prepare<'s>(&'s self, scene: &'s Scene, _: FilmSpec, _: u64) -> Box<dyn PassRenderer + 's> {
        Box::new(Prepared { scene, limits: self.limits })
    }
}

struct Prepared<'s> {
    scene: &'s Scene,
    limits: Limits,
}

impl PassRenderer for Prepared<'_> {
    fn render_pass(&self, pass: &Pass, image: &mut PassImage) {
        let world = self.scene.world(pass.lambda, pass.time);
        trace(&world, self.limits, pass, image);
    }
}

/// Adds a pass of path tracing to the black `image`.
pub(super) fn trace(world: &World, limits: Limits, pass: &Pass, image: &mut PassImage) {
    let spec = image.spec();
    image.fill(|x, y, counts| {
        let mut eye = EyeRay::new(world, spec, pass, pass.index, (x, y));
        radiance(world, limits, &eye.start(world), &mut eye.sampler, counts).to_rgb(pass.lambda) * eye.weight
    });
}

fn radiance(world: &World, limits: Limits, start: &Start, sampler: &mut Sampler, counts: &mut Counts) -> Spectrum {
    let mut v = Collect { world, limits, sum: Spectrum::BLACK, from: start.ray.o, rays: 0 };
    counts.rays += walk(world, start, &limits, sampler, &mut v) + v.rays;
    v.sum
}

/// Adds up what a camera walk finds.
struct Collect<'w> {
    world: &'w World<'w>,
    limits: Limits,
    sum: Spectrum,
    /// Where the current segment began.
    from: Vec3,
    rays: u64,
}

impl Visit for Collect<'_> {
    #[inline]
    fn surface(&mut self, a: &Arrival, sampler: &mut Sampler) -> Step {
        let le = self.world.emitted(a.at);
        if !le.is_black() {
            let weight =
                if a.delta { 1.0 } else { power_heuristic(a.pdf, self.world.pdf_direct(self.from, -a.at.wo, a.at)) };
            self.sum += a.beta * le * weight;
        }
        if a.scatterings < self.limits.scatterings && a.at.is_connectible() {
            let (u_light, u) = (self.world.light_number(sampler), sampler.next_2d());
            self.rays += 1;
            self.sum += a.beta * direct(self.world, a.at, u_light, u, power_heuristic);
        } else {
            // So that the dimensions of what follows do not depend on the material.
            sampler.skip_many(2);
        }
        self.from = a.at.p;
        Step::On
    }
    #[inline]
    fn escape(&mut self, e: &Escape) {
        for Sky { le, pdf_direct, .. } in self.world.escaped(self.from, e.ray.d) {
            self.sum += e.beta * le * if e.delta { 1.0 } else { power_heuristic(e.pdf, pdf_direct) };
        }
    }
}

/// One light sample at `at`: radiance toward `at.wo`. `weigh(pdf_light, pdf_bsdf)` is its weight against hitting the
/// light by chance; lights that cannot be hit always weigh 1.
#[inline]
pub(super) fn direct(
    world: &World,
    at: &Interaction,
    u_light: f32,
    u: glam::Vec2,
    weigh: impl Fn(f32, f32) -> f32,
) -> Spectrum {
    let Some(d) = world.sample_direct(at.p, u_light, u) else { return Spectrum::BLACK };
    let li = &d.li;
    let f = at.f_cos(li.wi, Transport::Radiance);
    if f.is_black() {
        return Spectrum::BLACK;
    }
    let Some(passed) = world.passed(at, &at.spawn_toward(li.wi, &li.end)) else { return Spectrum::BLACK };
    let weight = if li.delta { 1.0 } else { weigh(li.pdf, at.pdf(li.wi)) };
    f * li.li * passed * (weight / li.pdf)
}

/// Weight of a technique of density `a` beside one of density `b` (Veach 1997, section 9.2.3, β = 2).
#[inline]
pub(super) fn power_heuristic(a: f32, b: f32) -> f32 {
    // In ratios, so that neither square overflows.
    if a <= 0.0 {
        0.0
    } else {
        let r = b / a;
        1.0 / (1.0 + r * r)
    }
}

#[cfg(test)]
mod tests {
    use super::power_heuristic;

    #[test]
    fn two_heuristic_weights_sum_to_one() {
        for (a, b) in [(1.0, 2.0), (1e30, 1e28), (1e-30, 3e-30), (5.0, 0.0)] {
            assert!((power_heuristic(a, b) + power_heuristic(b, a) - 1.0).abs() < 1e-6, "{a} {b}");
        }
    }
}
