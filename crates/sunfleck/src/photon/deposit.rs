//! Which arrivals of light paths become photons, and showers of such paths.
use super::Source;
use crate::{
    bsdf::Lobes,
    film::Counts,
    sampler::{Domain, Sampler},
    scene::World,
    spectrum::Spectrum,
    walk::{Arrival, Limits, Step, Visit, walk},
};
use accel::concat;
use glam::Vec3;
use rayon::prelude::*;

/// A packet of flux that arrived at a surface. Its position is kept by the index that finds it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Photon {
    /// Flux (W) that arrives, before scattering.
    pub flux: Spectrum,
    /// Unit direction back to where it came from.
    pub wi: Vec3,
    /// Scatterings since the light; no path has more than [`u16::MAX`].
    pub scatterings: u16,
    /// Some boundary parted its wavelengths, and its flux is that of the hero alone: see [`crate::spectrum`].
    pub dispersed: bool,
    /// It came from a mirror or through glass last, or what is almost that: see [`Arrival::caustic`].
    pub caustic: bool,
}

/// Which arrivals are kept. All rules keep photons at surfaces that gather only ([`Limits::gathers`]).
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Keep {
    /// Every one: paths `L (S|D)*`.
    All,
    /// What is scattered at least once: all that a light connection does not find.
    Scattered,
    /// What came through delta scatterings only, and at least one: `L S⁺`. Paths end where they first scatter otherwise.
    Caustic,
    /// What was scattered last by a delta lobe, or a narrow one that gathers nothing: `L (S|D)* S`.
    LastDelta,
    /// What was scattered by some lobe with a density: `L S* D (S|D)*`.
    Indirect,
}

impl Keep {
    #[inline]
    pub(super) fn keeps(self, a: &Arrival) -> bool {
        match self {
            Self::All => true,
            Self::Scattered => a.scatterings > 0,
            Self::Caustic => a.scatterings > 0 && a.all_delta,
            Self::LastDelta => a.caustic,
            Self::Indirect => !a.all_delta,
        }
    }
}

/// Light paths to shoot.
#[derive(Clone, Copy, Debug)]
pub struct Shower {
    /// The user's seed.
    pub seed: u64,
    /// Whose random numbers: [`Domain::Light`] for photons of a pass, [`Domain::Prepare`] for those shot before.
    pub domain: Domain,
    /// Number of the pass.
    pub pass: u64,
    /// Number of the first path; two showers of a pass must not share numbers.
    pub first: u64,
    /// Paths to emit, > 0.
    pub paths: u64,
    /// What is stored.
    pub keep: Keep,
    /// When whole paths, from light to eye, end.
    pub limits: Limits,
}

/// What a shower left behind.
#[derive(Clone, Debug, Default)]
pub struct Catch {
    /// Where each photon lies.
    pub positions: Vec<Vec3>,
    /// The photons, in the order of paths and of arrivals on each.
    pub photons: Vec<Photon>,
    /// Work done.
    pub counts: Counts,
}

/// Light paths per task. The catch is joined in path order, so any value gives the same.
const CHUNK: u64 = 1024;

impl Shower {
    /// Shoots from `source`, in parallel; the catch does not depend on the number of threads. Flux is normalised: the photons kept
    /// by [`Keep::All`] in a closed room of black walls sum to the power of the lights.
    pub fn shoot(&self, world: &World, source: &Source) -> Catch {
        // A photon needs one more scattering, where it is gathered.
        let Some(scatterings) = self.limits.scatterings.checked_sub(1) else { return Catch::default() };
        let limits = Limits { scatterings, ..self.limits };
        let chunks: Vec<Catch> = (0..self.paths.div_ceil(CHUNK))
            .into_par_iter()
            .map(|c| {
                let mut deposit = Deposit { keep: self.keep, least: limits.gathers, catch: Catch::default() };
                for path in c * CHUNK..((c + 1) * CHUNK).min(self.paths) {
                    self.trace(world, source, limits, path, &mut deposit);
                }
                deposit.catch
            })
            .collect();
        Catch::join(&chunks)
    }

    fn trace(&self, world: &World, source: &Source, limits: Limits, path: u64, deposit: &mut Deposit) {
        let mut sampler = Sampler::new(self.seed, self.domain, self.pass, self.first + path);
        deposit.catch.counts.emitted += 1;
        let Some(mut start) = source.emit(world, &mut sampler).map(|e| e.start) else { return };
        start.beta = start.beta / self.paths as f32;
        deposit.catch.counts.rays += walk(world, &start, &limits, &mut sampler, deposit);
    }
}

impl Catch {
    fn join(chunks: &[Self]) -> Self {
        let mut counts = Counts::default();
        chunks.iter().for_each(|c| counts += c.counts);
        let positions: Vec<&[Vec3]> = chunks.iter().map(|c| c.positions.as_slice()).collect();
        let photons: Vec<&[Photon]> = chunks.iter().map(|c| c.photons.as_slice()).collect();
        counts.stored = photons.iter().map(|p| p.len() as u64).sum();
        Self { positions: concat(&positions), photons: concat(&photons), counts }
    }
}

/// Stores what arrives.
struct Deposit {
    keep: Keep,
    /// [`Limits::gathers`].
    least: Lobes,
    catch: Catch,
}

impl Visit for Deposit {
    #[inline]
    fn surface(&mut self, a: &Arrival, _: &mut Sampler) -> Step {
        if self.keep.keeps(a) && a.at.widest >= self.least {
            self.catch.positions.push(a.at.p);
            let scatterings = a.scatterings.min(u32::from(u16::MAX)) as u16;
            let (dispersed, caustic) = (a.dispersed, a.caustic);
            self.catch.photons.push(Photon { flux: a.beta, wi: a.at.wo, scatterings, dispersed, caustic });
        }
        if self.keep == Keep::Caustic { Step::OnIfDelta } else { Step::On }
    }
}
