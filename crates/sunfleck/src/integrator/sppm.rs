//! Stochastic progressive photon mapping (Hachisuka & Jensen 2009): each pixel keeps a radius, a number of photons and the
//! flux gathered so far, shared by all places that its camera paths meet; the radius shrinks by what was found.
//!
//! It is here to compare with other renderers. A pass depends on all passes before it, so films of separate sets of passes
//! cannot be merged, and a pass asked for out of turn renders those before it again. For everything else `ppm` reaches the
//! same picture with passes that stand alone.
use super::{
    Entry, Integrator, ParamError, ParamInfo, Params, Pass, PassRenderer,
    eye_ray::EyeRay,
    path::{direct, power_heuristic},
};
use crate::{
    film::{Counts, FilmSpec, PassImage},
    photon::{CameraEnd, Gathered, Keep, Radii, RadiusMap, Shower, Source, Span, gather_counted},
    sampler::{Domain, Sampler},
    scene::{Scene, Sky, World},
    spectrum::{Rgb, Spectrum},
    walk::{Arrival, Escape, Limits, Step, Visit, walk},
};
use glam::Vec3;
use rayon::prelude::*;
use std::sync::Mutex;

pub(super) const ENTRY: Entry = Entry {
    name: "sppm",
    about: "stochastic progressive photon mapping with statistics by pixel, to compare with other renderers; not mergeable",
    params: &[
        ParamInfo { name: "photons", about: "light paths a pass, 1 to 1e9 (default: one per pixel)" },
        ParamInfo { name: "radius", about: "first radius, world units > 0 (default: 4 pixel widths)" },
        ParamInfo { name: "alpha", about: "share of new photons that is kept, 0.01 to 1 (default 2/3)" },
    ],
    mergeable: false,
    make: |p| Ok(Box::new(Sppm::from_params(p)?)),
};

/// First radius in pixel widths.
const PIXELS: f32 = 4.0;

/// Settings of stochastic progressive photon mapping.
#[derive(Clone, Copy, Debug)]
pub(super) struct Sppm {
    /// When paths end.
    pub limits: Limits,
    /// Light paths a pass; `None`: one per pixel.
    pub photons: Option<u64>,
    /// First radius (world units); `None`: from what pixels cover.
    pub radius: Option<f32>,
    /// Share of the photons of a pass that is kept.
    pub alpha: f32,
}

impl Sppm {
    fn from_params(p: &mut Params) -> Result<Self, ParamError> {
        let photons = p.count("photons", 0, 1..=1_000_000_000)?;
        let radius = p.number("radius", 0.0, f64::from(f32::MIN_POSITIVE)..=1e30)? as f32;
        Ok(Self {
            limits: p.limits()?,
            photons: (photons > 0).then_some(photons),
            radius: (radius > 0.0).then_some(radius),
            alpha: p.number("alpha", 2.0 / 3.0, 0.01..=1.0)? as f32,
        })
    }
}

impl Integrator for Sppm {
    fn prepare<'s>(&'s self, scene: &'s Scene, spec: FilmSpec, seed: u64) -> Box<dyn PassRenderer + 's> {
        let fallback = 1e-3 * scene.bounding_sphere().1;
        let radii = self
            .radius
            .map_or_else(|| Radii::from_footprints(scene, spec, &self.limits, seed, PIXELS, fallback), Radii::fixed);
        Box::new(Prepared { scene, settings: self, radii, state: Mutex::default() })
    }
}

struct Prepared<'s> {
    scene: &'s Scene,
    settings: &'s Sppm,
    radii: Radii,
    state: Mutex<State>,
}

/// What the passes so far have left.
#[derive(Default)]
struct State {
    passes: u64,
    pixels: Vec<Statistics>,
}

/// One pixel's.
#[derive(Clone, Copy)]
struct Statistics {
    /// Squared radius.
    r2: f32,
    /// Photons kept, the N of the paper.
    kept: f32,
    /// Flux within the radius times what scatters it to the eye, summed over passes: the τ of the paper.
    tau: Rgb,
    /// Direct and directly seen light, summed over passes.
    direct: Rgb,
}

/// What one pass finds for a pixel.
struct Found {
    direct: Rgb,
    tau: Rgb,
    photons: u32,
}

impl PassRenderer for Prepared<'_> {
    fn render_pass(&self, pass: &Pass, image: &mut PassImage) {
        // A panic elsewhere leaves whole statistics behind: they are replaced, pixel by pixel, only when a pass is done.
        let mut state = self.state.lock().unwrap_or_else(std::sync::PoisonError::into_inner);
        if state.passes > pass.index || state.pixels.len() != image.spec().pixels() {
            *state = self.fresh(image.spec());
        }
        while state.passes < pass.index {
            let earlier = pass.at_index(state.passes);
            self.advance(&earlier, &mut state, &mut PassImage::new(image.spec()));
        }
        self.advance(pass, &mut state, image);
    }
}

impl Prepared<'_> {
    fn fresh(&self, spec: FilmSpec) -> State {
        let one = |i: usize| {
            let (x, y) = (i as u32 % spec.width, i as u32 / spec.width);
            let r = self.radii.at(spec.middle(x, y));
            Statistics { r2: r * r, kept: 0.0, tau: Rgb::ZERO, direct: Rgb::ZERO }
        };
        State { passes: 0, pixels: (0..spec.pixels()).map(one).collect() }
    }

    /// Renders the next pass. The film takes means over passes, while the picture is an estimate from all of them: each pass
    /// adds what makes the mean that estimate.
    fn advance(&self, pass: &Pass, state: &mut State, image: &mut PassImage) {
        let world = self.scene.world(pass.lambda, pass.time);
        let map = self.shoot(&world, pass, state, image);
        let (before, after) = (state.passes as f32, state.passes as f32 + 1.0);
        let spec = image.spec();
        let found: Vec<(Found, Counts)> = state
            .pixels
            .par_iter()
            .enumerate()
            .map(|(i, s)| {
                let at = (i as u32 % spec.width, i as u32 / spec.width);
                self.look(&world, &map, pass, spec, at, s.r2.sqrt())
            })
            .collect();
        found.iter().for_each(|(_, counts)| image.counts += *counts);
        let add = |(s, (f, _)): (&mut Statistics, &(Found, Counts))| {
            let old = if before > 0.0 { s.estimate(before) } else { Rgb::ZERO };
            s.add(f, self.settings.alpha);
            after * s.estimate(after) - before * old
        };
        let values: Vec<Rgb> = state.pixels.par_iter_mut().zip(&found).map(add).collect();
        state.passes += 1;
        image.fill(|x, y, _| values[y as usize * spec.width as usize + x as usize]);
    }

    fn shoot(&self, world: &World, pass: &Pass, state: &State, image: &mut PassImage) -> RadiusMap {
        let shower = Shower {
            seed: pass.seed,
            domain: Domain::Light,
            pass: pass.index,
            first: 0,
            paths: self.settings.photons.unwrap_or(image.spec().pixels() as u64),
            keep: Keep::Scattered,
            limits: self.settings.limits,
        };
        let catch = shower.shoot(world, &Source::plain());
        image.counts += catch.counts;
        // Every hundredth pixel tells the radii well enough.
        let some = state.pixels.iter().step_by(101).map(|s| s.r2.sqrt()).collect();
        RadiusMap::spanning(&catch.positions, &catch.photons, Span::of(some))
    }

    fn look(
        &self,
        world: &World,
        map: &RadiusMap,
        pass: &Pass,
        spec: FilmSpec,
        at: (u32, u32),
        radius: f32,
    ) -> (Found, Counts) {
        let mut eye = EyeRay::new(world, spec, pass, pass.index, at);
        let (limits, black) = (self.settings.limits, Spectrum::BLACK);
        let gathered = Gathered { flux: black, photons: 0 };
        let mut look = Look {
            world,
            map,
            limits,
            radius,
            direct: black,
            gathered,
            from: eye.camera.ray.o,
            hit_share: 1.0,
            rays: 0,
        };
        let rays = walk(world, &eye.start(world), &limits, &mut eye.sampler, &mut look);
        let rgb = |s: Spectrum| s.to_rgb(pass.lambda) * eye.weight;
        let whole = |c: Rgb| if c.is_finite() { c } else { Rgb::ZERO };
        let found = Found {
            direct: whole(rgb(look.direct)),
            tau: whole(rgb(look.gathered.flux)),
            photons: look.gathered.photons,
        };
        (found, Counts { rays: rays + look.rays, ..Counts::default() })
    }
}

impl Statistics {
    /// Takes in a pass (Hachisuka & Jensen 2009, eqs. 8 to 11).
    fn add(&mut self, f: &Found, alpha: f32) {
        self.direct += f.direct;
        let found = f.photons as f32;
        let all = self.kept + found;
        let shrink = if found > 0.0 { (self.kept + alpha * found) / all } else { 1.0 };
        self.tau = (self.tau + f.tau) * shrink;
        self.kept += alpha * found;
        self.r2 *= shrink;
    }
    /// The picture's value after `passes` passes.
    fn estimate(&self, passes: f32) -> Rgb {
        (self.direct + self.tau / (std::f32::consts::PI * self.r2)) / passes
    }
}

/// Follows a camera path to the first place with photons.
struct Look<'w> {
    world: &'w World<'w>,
    map: &'w RadiusMap,
    limits: Limits,
    radius: f32,
    direct: Spectrum,
    gathered: Gathered,
    /// Where the camera path gathered.
    from: Vec3,
    /// [`World::hit_share`] there.
    hit_share: f32,
    rays: u64,
}

/// Weight of a light met by a direction of density `pdf` that is followed with probability `share`, over that probability;
/// light samples of density `pdf_light` weigh `power_heuristic(pdf_light, share * pdf)`.
#[inline]
fn hit_weight(share: f32, pdf: f32, pdf_light: f32) -> f32 {
    power_heuristic(share * pdf, pdf_light) / share
}

impl Visit for Look<'_> {
    fn surface(&mut self, a: &Arrival, sampler: &mut Sampler) -> Step {
        let le = self.world.emitted(a.at);
        if !a.delta {
            // The one ray past the gather finds what connections to lights find badly.
            if !le.is_black() {
                let pdf_light = self.world.pdf_direct(self.from, -a.at.wo, a.at);
                self.direct += a.beta * le * hit_weight(self.hit_share, a.pdf, pdf_light);
            }
            return Step::Stop;
        }
        self.direct += a.beta * le;
        let Some(most) = self.limits.scatterings.checked_sub(a.scatterings + 1) else { return Step::Stop };
        if !a.at.is_connectible() {
            sampler.skip_many(2);
            return Step::On;
        }
        let share = self.world.hit_share(a.at);
        (self.from, self.hit_share) = (a.at.p, share);
        let (u_light, u) = (self.world.light_number(sampler), sampler.next_2d());
        self.rays += 1;
        self.direct += a.beta * direct(self.world, a.at, u_light, u, |pdf, hit| power_heuristic(pdf, share * hit));
        let found = gather_counted(self.map, a.at, self.radius, CameraEnd { most, dispersed: a.dispersed });
        self.gathered.flux += a.beta * found.flux;
        self.gathered.photons += found.photons;
        if share >= 1.0 || sampler.next_1d() < share { Step::On } else { Step::OnIfDelta }
    }
    fn escape(&mut self, e: &Escape) {
        for Sky { le, pdf_direct, .. } in self.world.escaped(self.from, e.ray.d) {
            self.direct += e.beta * le * if e.delta { 1.0 } else { hit_weight(self.hit_share, e.pdf, pdf_direct) };
        }
    }
}

#[cfg(test)]
mod tests {
    use super::{hit_weight, power_heuristic};

    #[test]
    fn what_is_rarely_followed_counts_as_much_more() {
        for (share, pdf, light) in [(1.0, 0.3, 2.0), (0.25, 0.3, 0.1), (0.01, 0.3, 1e-3)] {
            let sum = power_heuristic(light, share * pdf) + share * hit_weight(share, pdf, light);
            assert!((sum - 1.0).abs() < 1e-6, "{share} {pdf} {light}: {sum}");
        }
    }
}
