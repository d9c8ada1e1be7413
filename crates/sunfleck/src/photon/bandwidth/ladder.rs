//! Gathers with many radii at once, and what their scatter says.
use super::{Bandwidth, FAMILIES, GatherError, spots::Spot};
use crate::{
    photon::{Catch, Photon, Radii, RadiusMap, Shower},
    sampler::Domain,
    scene::World,
    spectrum::{Spectrum, Wavelengths},
};
use rayon::prelude::*;
use std::{f32::consts::PI, iter::Sum, ops::AddAssign};

/// A rung over the next.
pub(super) const STEP: f32 = 2.0;
/// Rungs to choose from; one more below them shows what the last of them blurs.
pub const CANDIDATES: usize = 4;
const RUNGS: usize = CANDIDATES + 1;
/// The bias of a rung over what it is off the next, where light is smooth: 1 / (1 - 1/STEP²).
const BIAS_OVER_STEP: f64 = 4.0 / 3.0;

/// Photons of a set that are looked at between one rung and the next at a spot. Of more, one in so many stands for all: where it
/// lies is not left to that, so that what remains of chance is how unlike they are in flux and direction.
const PLENTY: u32 = 128;

/// The photons between one rung and the next.
#[derive(Clone, Copy, Default)]
struct Ring {
    met: u32,
    /// How many were asked about so far.
    asked: u32,
    /// Sums of the kernels of the rungs over all photons, and over those that were taken.
    shapes: [f32; RUNGS],
    taken_shapes: [f32; RUNGS],
    /// The same of their light, by family; and their number.
    light: [[f32; RUNGS]; FAMILIES],
    photons: [u32; FAMILIES],
}

impl Ring {
    /// One in how many is taken.
    fn stride(&self) -> u32 {
        self.met.div_ceil(PLENTY).max(1)
    }
    /// Whether the next photon is taken, in the order in which they are met, which is that of places.
    fn takes(&mut self) -> bool {
        let stride = self.stride();
        self.asked += 1;
        self.asked % stride == stride / 2
    }
    /// Light of all photons by a rung's kernel, after those that were taken.
    fn all_light(&self, family: usize, rung: usize) -> f32 {
        let taken = self.taken_shapes[rung];
        if taken > 0.0 { self.light[family][rung] * (self.shapes[rung] / taken) } else { 0.0 }
    }
}

/// Sets of photons that share nothing, to try radii on. They do not depend on radii, so all trials share them.
pub(super) struct Sets {
    /// Light paths of a set.
    pub(super) paths: u64,
    catches: Vec<Catch>,
}

impl Sets {
    /// `count` sets of so many paths each.
    pub(super) fn shoot(how: &Bandwidth, world: &World, count: u64, paths: u64) -> Self {
        let mut sets = Self { paths, catches: Vec::new() };
        sets.add(how, world, count);
        sets
    }
    /// More sets, if there are less than `count`.
    pub(super) fn add(&mut self, how: &Bandwidth, world: &World, count: u64) {
        for set in self.catches.len() as u64..count {
            let shower = Shower {
                seed: how.seed,
                domain: Domain::Prepare,
                pass: u64::MAX - 64 - set,
                first: 0,
                paths: self.paths,
                keep: how.keep,
                limits: how.limits,
            };
            self.catches.push(shower.shoot(world, how.source));
        }
    }
}

/// A ladder of radii and photons to try them on.
#[derive(Clone, Copy)]
pub(super) struct Ladder<'b> {
    pub(super) bandwidth: &'b Bandwidth<'b>,
    /// The top rung over the radius of a spot.
    pub(super) top: f32,
    pub(super) sets: &'b Sets,
}

/// What one climb found.
pub(super) struct Measured {
    /// By spot and family.
    pub(super) spots: Vec<[Rungs; FAMILIES]>,
    /// Radiance (mean of the channels) at each spot by the top rung.
    light: Vec<f64>,
    /// Photons in the mean at the top rung of a set.
    pub(super) found: f64,
}

impl Measured {
    /// Sums of all spots over the square of their light, of the first family.
    pub(super) fn relative(&self) -> Rungs {
        let mean = self.light.iter().sum::<f64>() / self.light.len().max(1) as f64;
        let mut sum = Rungs::default();
        for (rungs, light) in self.spots.iter().zip(&self.light) {
            let scale = 1.0 / (light * light + mean * mean).max(f64::MIN_POSITIVE);
            sum += rungs[0].scaled(scale);
        }
        sum
    }
}

/// What each rung of a ladder leaves, summed over spots.
#[derive(Clone, Copy, Debug, Default)]
pub struct Rungs {
    errors: [GatherError; CANDIDATES],
    photons: [f64; CANDIDATES],
    /// Of the top rung.
    pixels: f64,
    spots: f64,
}

/// What one rung leaves, in the mean.
#[derive(Clone, Copy, Debug, Default)]
pub struct Rung {
    /// Its error.
    pub error: GatherError,
    /// Photons that a gather finds in a pass.
    pub photons: f64,
    /// Pixels that a gather covers.
    pub pixels: f64,
}

impl Rungs {
    /// Rung number `rung`, from the widest.
    pub fn rung(&self, rung: usize) -> Rung {
        let (n, e) = (self.spots.max(1.0), self.errors[rung]);
        // Estimates of squares may be below zero where there is little to see.
        let error = GatherError { variance: e.variance / n, bias2: (e.bias2 / n).max(0.0) };
        Rung {
            error,
            photons: self.photons[rung] / n,
            pixels: self.pixels / n * f64::from(STEP).powi(-2 * rung as i32),
        }
    }
    /// Whether no photon was found.
    pub fn is_dark(&self) -> bool {
        self.photons[0] == 0.0
    }
    /// The rung for which `price` is least; the one that suits the whole picture if there is
    /// nothing to tell.
    pub fn least(&self, price: impl Fn(Rung) -> f64) -> usize {
        if self.is_dark() {
            return 1;
        }
        let prices: [f64; CANDIDATES] = std::array::from_fn(|r| price(self.rung(r)));
        (1..CANDIDATES).fold(0, |best, r| if prices[r] < prices[best] { r } else { best })
    }
    fn scaled(mut self, by: f64) -> Self {
        for e in &mut self.errors {
            e.variance *= by;
            e.bias2 *= by;
        }
        self
    }
}

impl AddAssign for Rungs {
    fn add_assign(&mut self, other: Self) {
        for i in 0..CANDIDATES {
            self.errors[i].variance += other.errors[i].variance;
            self.errors[i].bias2 += other.errors[i].bias2;
            self.photons[i] += other.photons[i];
        }
        self.pixels += other.pixels;
        self.spots += other.spots;
    }
}

impl Sum for Rungs {
    fn sum<I: Iterator<Item = Self>>(all: I) -> Self {
        all.fold(Self::default(), |mut sum, r| {
            sum += r;
            sum
        })
    }
}

/// By family and rung, of one set of photons.
#[derive(Clone, Copy, Default)]
struct Gathers {
    radiance: [[f32; RUNGS]; FAMILIES],
    photons: [[u32; CANDIDATES]; FAMILIES],
}

/// Sums over sets of the radiance of each rung and of its differences to the next, and of their squares.
#[derive(Clone, Copy, Default)]
struct Sums {
    value: [[f64; RUNGS]; FAMILIES],
    value2: [[f64; RUNGS]; FAMILIES],
    step: [[f64; CANDIDATES]; FAMILIES],
    step2: [[f64; CANDIDATES]; FAMILIES],
    photons: [[f64; CANDIDATES]; FAMILIES],
}

impl Sums {
    fn add(&mut self, gathers: &Gathers) {
        for (f, rungs) in gathers.radiance.iter().enumerate() {
            for (r, v) in rungs.iter().map(|v| f64::from(*v)).enumerate() {
                self.value[f][r] += v;
                self.value2[f][r] += v * v;
                if r < CANDIDATES {
                    let step = v - f64::from(rungs[r + 1]);
                    self.step[f][r] += step;
                    self.step2[f][r] += step * step;
                }
            }
        }
        for (sums, found) in self.photons.iter_mut().zip(&gathers.photons) {
            for (sum, n) in sums.iter_mut().zip(found) {
                *sum += f64::from(*n);
            }
        }
    }
    /// Unbiased estimates from `n` sets; `share`: variance of a pass over that of a set.
    fn rungs(&self, n: f64, share: f64, pixels: f64) -> [Rungs; FAMILIES] {
        let error = |f: usize, r: usize| {
            let pairs = self.step[f][r] * self.step[f][r] - self.step2[f][r];
            let variance = (self.value2[f][r] - self.value[f][r] * self.value[f][r] / n).max(0.0) / (n - 1.0);
            let bias2 = BIAS_OVER_STEP * BIAS_OVER_STEP * pairs / (n * (n - 1.0));
            GatherError { variance: share * variance, bias2 }
        };
        std::array::from_fn(|f| Rungs {
            errors: std::array::from_fn(|r| error(f, r)),
            photons: self.photons[f].map(|p| p / (n * share)),
            pixels,
            spots: 1.0,
        })
    }
}

impl Ladder<'_> {
    /// Candidate `rung` over the radius of a spot.
    pub(super) fn factor(&self, rung: usize) -> f32 {
        self.top * STEP.powi(-(rung as i32))
    }

    pub(super) fn climb(&self, radii: &Radii, spots: &[Spot]) -> Measured {
        let Sets { paths, catches } = self.sets;
        let mut sums = vec![Sums::default(); spots.len()];
        let span = radii.span().scaled(self.top);
        for catch in catches {
            let map = RadiusMap::spanning(&catch.positions, &catch.photons, span);
            sums.par_iter_mut().zip(spots).for_each(|(sum, spot)| {
                sum.add(&self.gather(&map, spot));
            });
        }
        let n = catches.len() as f64;
        let share = *paths as f64 / self.bandwidth.paths as f64;
        Measured {
            spots: sums.iter().zip(spots).map(|(sum, spot)| sum.rungs(n, share, self.pixels(spot))).collect(),
            light: sums.iter().map(|s| s.value[0][0] / n).collect(),
            found: sums.iter().map(|s| s.photons[0][0]).sum::<f64>() / (n * spots.len().max(1) as f64),
        }
    }

    /// Pixels that the top rung covers at `spot`.
    fn pixels(&self, spot: &Spot) -> f64 {
        let radius = f64::from(spot.radius * self.top / spot.seen.width(self.bandwidth.spec));
        std::f64::consts::PI * radius * radius
    }

    /// Gathers with all rungs from the photons within the top one.
    fn gather(&self, map: &RadiusMap, spot: &Spot) -> Gathers {
        let (seen, kernel) = (&spot.seen, self.bandwidth.kernel);
        let mut out = Gathers::default();
        let Some(most) = self.bandwidth.limits.scatterings.checked_sub(seen.scatterings + 1) else { return out };
        let top = spot.radius * self.top;
        let r2: [f32; RUNGS] = std::array::from_fn(|r| (top * STEP.powi(-(r as i32))).powi(2));
        let ring = |d2: f32| (1..RUNGS).take_while(|r| d2 <= r2[*r]).count();
        let shapes = |d2: f32, ring: usize| r2.iter().take(ring + 1).map(move |r2| kernel.shape(d2, *r2)).enumerate();
        let mut rings = [Ring::default(); RUNGS];
        map.within(seen.at.p, top, |_, d2| {
            let i = ring(d2);
            rings[i].met += 1;
            shapes(d2, i).for_each(|(r, shape)| rings[i].shapes[r] += shape);
        });
        let at = seen.at.toward_eye();
        map.within(seen.at.p, top, |photon: &Photon, d2| {
            let i = ring(d2);
            let ring = &mut rings[i];
            if !ring.takes() {
                return;
            }
            shapes(d2, i).for_each(|(r, shape)| ring.taken_shapes[r] += shape);
            let f = at.f_photon(photon.wi);
            if u32::from(photon.scatterings) > most || f.is_black() {
                return;
            }
            let value = f * photon.flux * seen.beta * Spectrum::join(seen.dispersed, photon.dispersed);
            let value = value.to_rgb(Wavelengths::Rgb).element_sum() / 3.0;
            for family in 0..=usize::from(photon.caustic) {
                ring.photons[family] += 1;
                shapes(d2, i).for_each(|(r, shape)| ring.light[family][r] += value * shape);
            }
        });
        for (i, ring) in rings.iter().enumerate() {
            for (family, r) in (0..FAMILIES).flat_map(|family| (0..=i).map(move |r| (family, r))) {
                out.radiance[family][r] += ring.all_light(family, r) / (PI * r2[r]);
                if r < CANDIDATES {
                    out.photons[family][r] += ring.photons[family] * ring.stride();
                }
            }
        }
        out
    }
}
