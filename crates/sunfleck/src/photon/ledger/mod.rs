//! The books of a scene's light: what each lamp emits, where that ends, and how much of it a gather ever reaches.
//!
//! Light paths are walked as an algorithm walks them and every watt is booked. For each light, exactly but for rounding,
//!
//! ```text
//! emitted = absorbed + escaped + cut + roulette
//! ```
//!
//! where roulette's part is what it took from the paths that it ended less what it gave to those that it spared: zero on
//! average. What is kept along the way is held against the places that the camera sees.
mod book;
mod reached;

use super::{Keep, Radii, Source};
use crate::{
    film::FilmSpec,
    light::LightId,
    scene::{MID_SHUTTER, Scene},
    spectrum::Wavelengths,
    walk::Limits,
};
use book::{Page, Tracer};
use glam::DVec3;
use std::ops::AddAssign;

/// Light paths to audit, and what an algorithm does with them.
#[derive(Clone, Debug)]
pub struct Audit {
    /// Where paths start.
    pub source: Source,
    /// Which photons are kept.
    pub keep: Keep,
    /// How far gathers reach.
    pub radii: Radii,
    /// When whole paths, from light to eye, end.
    pub limits: Limits,
    /// The user's seed.
    pub seed: u64,
    /// Light paths, > 0. Shares are known to about 1 over the square root of it.
    pub paths: u64,
}

/// How many, and how much flux.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Amount {
    /// Paths, or photons where it says so.
    pub count: u64,
    /// Flux (W) by channel.
    pub watts: DVec3,
}

/// The books of one light.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Account {
    /// Paths that left the light.
    pub emitted: Amount,
    /// Watts that surfaces took, and paths that ended at one, by roulette or because nothing was scattered.
    pub absorbed: Amount,
    /// Paths that left the scene.
    pub escaped: Amount,
    /// Paths that were ended by the limit on scatterings.
    pub cut: Amount,
    /// Watts (by channel) that roulette took from the paths it ended, less what it gave to those it spared.
    pub roulette: DVec3,
    /// Photons kept. A path may leave several, so that their watts can be more than were emitted.
    pub stored: Amount,
    /// Those of them that the kernel around some visible place reaches.
    pub gathered: Amount,
    /// Paths that left at least one such photon.
    pub useful: u64,
}

/// The books of all lights, by [`LightId`].
#[derive(Clone, Debug, PartialEq)]
pub struct Ledger {
    accounts: Vec<Account>,
    /// Paths audited, those included that no light emitted.
    pub paths: u64,
}

impl Ledger {
    /// The books of `light`.
    pub fn account(&self, light: LightId) -> &Account {
        &self.accounts[light.0 as usize]
    }
    /// All books, in the order of [`crate::scene::World::lights`].
    pub fn accounts(&self) -> &[Account] {
        &self.accounts
    }
}

/// Widths of a pixel that a gather reaches by [`Audit::plain`].
const PIXELS: f32 = 4.0;

impl Audit {
    /// For an algorithm that does not say better: plain emission, every scattered photon, and what four pixels cover.
    pub fn plain(scene: &Scene, spec: FilmSpec, limits: Limits, seed: u64, paths: u64) -> Self {
        let radii = Radii::from_footprints(scene, spec, &limits, seed, PIXELS, 1e-3 * scene.bounding_sphere().1);
        Self { source: Source::plain(), keep: Keep::Scattered, radii, limits, seed, paths }
    }
    /// Keeps the books of `scene` as a picture of `spec` needs its light: in RGB and in the middle of the shutter's time.
    /// A place is visible if a camera path meets it first, or after mirrors and glass only. The same for any number of
    /// threads.
    pub fn of(&self, scene: &Scene, spec: FilmSpec) -> Ledger {
        let world = scene.world(Wavelengths::Rgb, MID_SHUTTER);
        let lights = world.lights().count();
        let pages = Tracer { audit: self, world: &world, lights }.pages();
        let mut all = Page::new(lights);
        pages.into_iter().for_each(|page| all.append(page));
        let reached = reached::marks(self, &world, spec, &all);
        let Page { mut accounts, photons, .. } = all;
        let mut last = None;
        for (photon, _) in photons.iter().zip(reached).filter(|(_, reached)| *reached) {
            let account = &mut accounts[photon.light.0 as usize];
            account.gathered.add(photon.flux);
            // Photons of a path lie side by side.
            account.useful += u64::from(last.replace(photon.path) != Some(photon.path));
        }
        Ledger { accounts, paths: self.paths }
    }
}

impl Amount {
    fn add(&mut self, watts: DVec3) {
        *self += Self { count: 1, watts };
    }
}

impl AddAssign for Amount {
    fn add_assign(&mut self, o: Self) {
        self.count += o.count;
        self.watts += o.watts;
    }
}

impl AddAssign for Account {
    fn add_assign(&mut self, o: Self) {
        self.emitted += o.emitted;
        self.absorbed += o.absorbed;
        self.escaped += o.escaped;
        self.cut += o.cut;
        self.roulette += o.roulette;
        self.stored += o.stored;
        self.gathered += o.gathered;
        self.useful += o.useful;
    }
}
