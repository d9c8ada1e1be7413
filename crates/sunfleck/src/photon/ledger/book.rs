//! Books every watt of light paths.
use super::{Account, Audit};
use crate::{
    light::LightId,
    sampler::{Domain, Sampler},
    scene::{Interaction, Scattered, World},
    spectrum::Spectrum,
    walk::{Arrival, Escape, Limits, Step, Visit, walk},
};
use glam::{DVec3, Vec3};
use rayon::prelude::*;

/// What some paths came to.
pub(super) struct Page {
    /// By light.
    pub(super) accounts: Vec<Account>,
    /// Where each photon lies.
    pub(super) positions: Vec<Vec3>,
    /// In the order of paths and of arrivals on each.
    pub(super) photons: Vec<Kept>,
}

/// A photon that is kept.
#[derive(Clone, Copy)]
pub(super) struct Kept {
    pub(super) light: LightId,
    /// Number of its path.
    pub(super) path: u64,
    /// Unit direction back to where it came from.
    pub(super) wi: Vec3,
    /// Flux (W) by channel.
    pub(super) flux: DVec3,
}

/// Walks the paths of an audit.
pub(super) struct Tracer<'a> {
    pub(super) audit: &'a Audit,
    pub(super) world: &'a World<'a>,
    /// How many lights there are.
    pub(super) lights: usize,
}

/// Paths a page. Pages are joined in path order, so that sums do not depend on threads.
const PAGE: u64 = 4096;

impl Page {
    pub(super) fn new(lights: usize) -> Self {
        Self { accounts: vec![Account::default(); lights], positions: Vec::new(), photons: Vec::new() }
    }
    pub(super) fn append(&mut self, other: Self) {
        self.accounts.iter_mut().zip(other.accounts).for_each(|(a, b)| *a += b);
        self.positions.extend(other.positions);
        self.photons.extend(other.photons);
    }
}

impl Tracer<'_> {
    pub(super) fn pages(&self) -> Vec<Page> {
        let paths = self.audit.paths;
        let page = |c: u64| {
            let mut page = Page::new(self.lights);
            (c * PAGE..((c + 1) * PAGE).min(paths)).for_each(|path| self.trace(path, &mut page));
            page
        };
        (0..paths.div_ceil(PAGE)).into_par_iter().map(page).collect()
    }

    fn trace(&self, path: u64, page: &mut Page) {
        let Audit { ref source, limits, seed, paths, .. } = *self.audit;
        let mut sampler = Sampler::new(seed, Domain::Prepare, PASS, path);
        let Some(emission) = source.emit(self.world, &mut sampler) else { return };
        let mut start = emission.start;
        start.beta = start.beta / paths as f32;
        // The last scattering belongs to the camera's side.
        let limits = Limits { scatterings: limits.scatterings.saturating_sub(1), ..limits };
        let mut clerk = Clerk { tracer: self, limits, light: emission.light, path, page, at: Place::Under(start.beta) };
        clerk.account().emitted.add(watts(start.beta));
        walk(self.world, &start, &limits, &mut sampler, &mut clerk);
        clerk.close();
    }
}

/// A family of random numbers of its own among those of [`Domain::Prepare`].
const PASS: u64 = u64::MAX - 2;

fn watts(flux: Spectrum) -> DVec3 {
    flux.to_rgb(crate::spectrum::Wavelengths::Rgb).as_dvec3()
}

/// Where a path is, as far as it was heard of.
#[derive(Clone, Copy)]
enum Place {
    /// On its way, with what it carries before roulette gives to it.
    Under(Spectrum),
    /// At a surface that this arrived at.
    Surface(Spectrum),
    /// Ended, and booked.
    Ended,
}

/// Follows one path.
struct Clerk<'w> {
    tracer: &'w Tracer<'w>,
    limits: Limits,
    light: LightId,
    path: u64,
    page: &'w mut Page,
    at: Place,
}

impl Clerk<'_> {
    fn account(&mut self) -> &mut Account {
        &mut self.page.accounts[self.light.0 as usize]
    }
    /// It came to a new place with `beta`, whatever roulette gave included.
    fn arrive(&mut self, beta: Spectrum) {
        if let Place::Under(carried) = self.at {
            self.account().roulette += watts(carried) - watts(beta);
        }
    }
    /// It ended at a surface, where `arrived` came in and `next` would have gone on.
    fn end_at_surface(&mut self, arrived: Spectrum, next: Spectrum) {
        let account = self.account();
        account.absorbed.add(watts(arrived) - watts(next));
        account.roulette += watts(next);
        self.at = Place::Ended;
    }
    /// The walk is over.
    fn close(&mut self) {
        if let Place::Surface(arrived) = self.at {
            self.end_at_surface(arrived, Spectrum::BLACK);
        }
    }
}

impl Visit for Clerk<'_> {
    fn surface(&mut self, a: &Arrival, _: &mut Sampler) -> Step {
        self.arrive(a.departed);
        let flux = watts(a.beta);
        self.account().absorbed.watts += watts(a.departed) - flux;
        if self.tracer.audit.keep.keeps(a) && a.at.widest >= self.limits.gathers {
            self.account().stored.add(flux);
            self.page.positions.push(a.at.p);
            self.page.photons.push(Kept { light: self.light, path: self.path, wi: a.at.wo, flux });
        }
        if a.scatterings >= self.limits.scatterings {
            self.account().cut.add(flux);
            self.at = Place::Ended;
            return Step::Stop;
        }
        self.at = Place::Surface(a.beta);
        Step::On
    }
    fn scatter(&mut self, _: &Interaction, s: &Scattered) {
        let Place::Surface(arrived) = self.at else { return };
        let next = arrived * s.weight;
        self.account().absorbed.watts += watts(arrived) - watts(next);
        self.at = Place::Under(next);
    }
    fn roulette(&mut self, next: Spectrum) {
        let Place::Surface(arrived) = self.at else { return };
        self.end_at_surface(arrived, next);
    }
    fn escape(&mut self, e: &Escape) {
        self.arrive(e.beta);
        self.account().escaped.add(watts(e.beta));
        self.at = Place::Ended;
    }
}
