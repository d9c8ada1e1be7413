//! From flags to an integrator.
use crate::{args::AlgorithmArgs, compat::Habits, failure::Failure, machine};
use formats::load::Hints;
use std::collections::BTreeMap;
use sunfleck::integrator::{Entry, Integrator, Params, find};

/// An integrator and what the user said about it.
pub(super) struct Algorithm {
    name: &'static str,
    settings: BTreeMap<String, String>,
    made: Box<dyn Integrator>,
}

impl Algorithm {
    pub(super) fn new(args: &AlgorithmArgs, habits: &Habits, hints: &Hints) -> Result<Self, Failure> {
        // The command line accepts names of the registry only.
        let entry = find(args.name()).ok_or_else(|| Failure::input(format!("no integrator `{}`", args.name())))?;
        let mut settings = settings(args, habits).map_err(Failure::input)?;
        add_hints(&mut settings, args, entry, hints);
        let mut params = Params::default();
        if entry.settings().any(|p| p.name == "memory") {
            // Not among the settings that are told: it is the machine's, and where it is enough, nothing depends on it.
            params.set("memory", (machine::memory() / 4).to_string());
        }
        settings.iter().for_each(|(key, value)| params.set(key, value));
        let made = entry.build(params).map_err(|e| Failure::input(e.to_string()))?;
        Ok(Self { name: entry.name, settings, made })
    }
    /// Its word.
    pub(super) fn name(&self) -> &'static str {
        self.name
    }
    /// Settings that differ from the integrator's own defaults, or may.
    pub(super) fn settings(&self) -> &BTreeMap<String, String> {
        &self.settings
    }
    pub(super) fn integrator(&self) -> &dyn Integrator {
        &*self.made
    }
    /// Camera rays a pixel in one pass: one, unless the algorithm has a setting for it.
    pub(super) fn samples_per_pass(&self) -> u64 {
        self.settings.get("samples").and_then(|n| n.parse::<f64>().ok()).map_or(1, |n| n.max(1.0) as u64)
    }
    /// Name and settings in one line.
    pub(super) fn words(&self) -> String {
        let settings: Vec<String> = self.settings.iter().map(|(k, v)| format!("{k}={v}")).collect();
        if settings.is_empty() { self.name.to_owned() } else { format!("{} ({})", self.name, settings.join(", ")) }
    }
}

/// What the file says, where nothing else was said. How photons are sent is the file's business only where the user asks
/// for the algorithm that files of this kind mean: all others find better values by themselves.
fn add_hints(settings: &mut BTreeMap<String, String>, args: &AlgorithmArgs, entry: &Entry, hints: &Hints) {
    // A file's photons and radius are meant for the progressive photon mapper that it names.
    let asked = args.integrator.as_deref().filter(|name| ["ppm", "sppm"].contains(name));
    let photons = asked.and(hints.photons.map(|n| n.to_string()));
    let radius = asked.and(hints.radius.map(|r| r.to_string()));
    let scatterings = hints.scatterings.map(|n| n.to_string());
    for (name, value) in [("scatterings", scatterings), ("photons", photons), ("radius", radius)] {
        if let Some(value) = value.filter(|_| entry.settings().any(|p| p.name == name)) {
            settings.entry(name.to_owned()).or_insert(value);
        }
    }
}

/// All settings by name. One said twice in different words is a mistake, not an order of precedence.
fn settings(args: &AlgorithmArgs, habits: &Habits) -> Result<BTreeMap<String, String>, String> {
    let short = [
        ("photons", args.photons.clone()),
        ("nearest", args.nearest.clone()),
        ("radius", args.radius.clone()),
        ("alpha", args.alpha.clone()),
        ("aim", args.aim.clone()),
        ("memory", args.memory.map(|n| n.to_string())),
        ("final-gather", args.final_gather.clone()),
    ];
    let shorthands = short.into_iter().filter_map(|(key, value)| Some((key.to_owned(), value?)));
    let mut all = BTreeMap::new();
    for (key, value) in shorthands.chain(args.settings.iter().cloned()) {
        if all.insert(key.clone(), value).is_some() {
            return Err(format!("the setting `{key}` is given twice"));
        }
    }
    match (habits.scatterings(args.depth)?, all.get("scatterings")) {
        (Some(_), Some(said)) if args.depth.is_some() => {
            return Err(format!("--depth and --set scatterings={said} say the same thing twice"));
        }
        (Some(n), None) => drop(all.insert("scatterings".to_owned(), n.to_string())),
        // A habit gives way to what was said.
        _ => {}
    }
    Ok(all)
}
