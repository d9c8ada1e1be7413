//! What becomes of the light of each lamp, in watts and counts.
use crate::{
    render::Job,
    table::aligned,
    words::{count, quantity, things},
};
use glam::DVec3;
use serde::Serialize;
use std::collections::BTreeMap;
use sunfleck::{
    integrator::{Params, PassRenderer},
    light::Emitter,
    photon::{Account, Amount, Audit, Ledger},
    scene::MID_SHUTTER,
    spectrum::Wavelengths,
};

/// Light paths that are followed: shares to about a third of a percent.
const PATHS: u64 = 1 << 17;
/// Lights that are told of one by one to people, brightest first.
const SHOWN: usize = 12;

/// The books of all lights.
#[derive(Debug, Serialize)]
pub(super) struct Books {
    /// Light paths followed.
    paths: u64,
    pub(super) lights: Vec<LightBook>,
}

/// The books of one light.
#[derive(Debug, Serialize)]
pub(super) struct LightBook {
    /// Kind, and number among its kind.
    pub(super) name: String,
    pub(super) kind: &'static str,
    pub(super) emitted: Part,
    pub(super) absorbed: Part,
    pub(super) escaped: Part,
    /// Ended by the limit on scatterings.
    pub(super) cut: Part,
    /// Watts that roulette took, less what it gave.
    roulette_watts: [f64; 3],
    /// Photons, of which a path may leave several.
    pub(super) stored: Part,
    pub(super) gathered: Part,
    /// Paths of which some photon was gathered.
    pub(super) useful: u64,
}

/// So many, with so much flux by channel.
#[derive(Debug, Serialize)]
pub(super) struct Part {
    pub(super) count: u64,
    watts: [f64; 3],
}

/// Keeps the books, if light paths are sent at all.
pub(super) fn keep(renderer: &dyn PassRenderer, job: &Job, emitted: u64) -> Option<Books> {
    let (scene, settings) = (&job.loaded.scene, &job.settings);
    let audit = renderer.audit(settings.seed, PATHS).or_else(|| {
        let mut params = Params::default();
        job.algorithm.settings().iter().for_each(|(key, value)| params.set(key, value));
        let limits = params.limits().unwrap_or_default();
        (emitted > 0).then(|| Audit::plain(scene, settings.spec, limits, settings.seed, PATHS))
    })?;
    let ledger = audit.of(scene, settings.spec);
    let world = scene.world(Wavelengths::Rgb, MID_SHUTTER);
    Some(Books::new(&ledger, world.lights().map(Emitter::name)))
}

impl Books {
    fn new(ledger: &Ledger, kinds: impl Iterator<Item = &'static str>) -> Self {
        let mut numbers = BTreeMap::<&str, u64>::new();
        let mut book = |(kind, account): (&'static str, &Account)| {
            let number = numbers.entry(kind).or_default();
            *number += 1;
            LightBook::new(kind, *number, account)
        };
        Self { paths: ledger.paths, lights: kinds.zip(ledger.accounts()).map(&mut book).collect() }
    }

    /// For people.
    pub(super) fn table(&self) -> String {
        let mut brightest: Vec<&LightBook> = self.lights.iter().collect();
        brightest.sort_by(|a, b| b.emitted.watts().total_cmp(&a.emitted.watts()));
        let head = ["light", "emitted", "absorbed", "escaped", "cut", "stored", "gathered", "paths gathered"];
        let mut rows = vec![head.map(str::to_owned)];
        rows.extend(brightest.iter().take(SHOWN).map(|l| l.row()));
        let more = match brightest.len().saturating_sub(SHOWN) {
            0 => String::new(),
            n => format!("and {}\n", things(n as u64, "light more", "lights more")),
        };
        let legend =
            "Watts (mean of the channels) and, of the paths followed, how many; stored and gathered count photons.";
        aligned(&rows) + &more + legend + "\n"
    }
}

impl LightBook {
    fn new(kind: &'static str, number: u64, a: &Account) -> Self {
        Self {
            name: format!("{kind} {number}"),
            kind,
            emitted: a.emitted.into(),
            absorbed: a.absorbed.into(),
            escaped: a.escaped.into(),
            cut: a.cut.into(),
            roulette_watts: a.roulette.to_array(),
            stored: a.stored.into(),
            gathered: a.gathered.into(),
            useful: a.useful,
        }
    }
    /// Part of its paths of which a photon was gathered, 0 to 1.
    pub(super) fn useful_share(&self) -> f64 {
        self.useful as f64 / self.emitted.count.max(1) as f64
    }
    fn row(&self) -> [String; 8] {
        let Self { emitted, absorbed, escaped, cut, stored, gathered, .. } = self;
        let [a, b, c, d, e, f] = [emitted, absorbed, escaped, cut, stored, gathered].map(Part::words);
        [self.name.clone(), a, b, c, d, e, f, format!("{:.1} %", 100.0 * self.useful_share())]
    }
}

impl Part {
    /// Mean of the channels.
    pub(super) fn watts(&self) -> f64 {
        DVec3::from(self.watts).element_sum() / 3.0
    }
    fn words(&self) -> String {
        if self.count == 0 && self.watts() == 0.0 {
            "–".to_owned()
        } else {
            format!("{} W, {}", quantity(self.watts()), count(self.count as f64))
        }
    }
}

impl From<Amount> for Part {
    fn from(a: Amount) -> Self {
        Self { count: a.count, watts: a.watts.to_array() }
    }
}
