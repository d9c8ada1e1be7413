//! Sampling draws what `pdf` says, and weighs it by what `eval` says.
use crate::{
    models::{Case, cases, outgoing},
    sphere::{coordinates, tally},
    statistics::{Random, chi2_sigmas},
};
use glam::{DVec3, DVec4};
use rayon::prelude::*;
use std::sync::OnceLock;
use sunfleck::{
    bsdf::{Bsdf, Scatter, Transport},
    math::Local,
    spectrum::Wavelengths,
};

const SAMPLES: u32 = 20_000;
/// Samples that decide the cells of the test, and where their integrals look closely.
const HINTS: u32 = 2048;

/// What samples and integrals say about one model seen from one direction.
pub(crate) struct Survey {
    pub(crate) label: String,
    pub(crate) physical: bool,
    /// Counted and expected samples by cell of the sphere; the last cell is that of failed samples.
    cells: Vec<(f64, f64)>,
    /// `∫ pdf`.
    total: f64,
    /// `∫ f cos` for flux by colour.
    pub(crate) albedo: DVec3,
    /// Mean weight of samples for flux by colour, and its standard deviation.
    sampled: DVec3,
    deviation: DVec3,
}

/// Surveys every model with a density from every direction; from above only, if it has no inside.
pub(crate) fn surveys() -> &'static [Survey] {
    static SURVEYS: OnceLock<Vec<Survey>> = OnceLock::new();
    SURVEYS.get_or_init(|| {
        let cases = cases();
        let sides = |c: &Case, wo: &Local| c.transmits() || wo.cos_theta() > 0.0;
        let views: Vec<_> = cases
            .iter()
            .filter(|c| c.bsdf.is_connectible())
            .flat_map(|c| outgoing().into_iter().filter(|wo| sides(c, wo)).map(move |wo| (c, wo)))
            .collect();
        views.into_par_iter().map(|(c, wo)| survey(c, wo)).collect()
    })
}

fn survey(case: &Case, wo: Local) -> Survey {
    let mut random = Random(1);
    let bsdf = &case.bsdf;
    let mut draw = |n: u32| -> Vec<_> {
        // Of lobes with a density; a delta lobe counts as a sample that failed.
        let sample = |_| bsdf.sample(wo, random.unit(), random.unit2(), Transport::Flux).filter(|s| !s.delta);
        (0..n).filter_map(sample).collect()
    };
    let hints = draw(HINTS);
    let samples = draw(SAMPLES);
    let mut directions: Vec<_> = samples.iter().map(|s| coordinates(s.wi)).collect();
    let f = |wi: Local| {
        let f_cos = bsdf.eval(wo, wi, Transport::Flux).to_rgb(Wavelengths::Rgb) * wi.abs_cos_theta();
        f_cos.as_dvec3().extend(f64::from(bsdf.pdf(wo, wi)))
    };
    let hint = |wi| {
        let [z, phi] = coordinates(wi);
        [z, phi, f(wi).w]
    };
    let mut hints: Vec<_> = hints.iter().map(|s| hint(s.wi)).collect();
    let tally = tally(&f, &mut hints, &mut directions);
    let all: DVec4 = tally.iter().map(|t| t.1).sum();
    let n = f64::from(SAMPLES);
    let mut cells: Vec<_> = tally.iter().map(|t| (t.0, n * t.1.w)).collect();
    cells.push((n - samples.len() as f64, n * (1.0 - all.w).max(0.0)));
    let weights = samples.iter().map(|s| s.weight.to_rgb(Wavelengths::Rgb).as_dvec3());
    let (sum, squares) = weights.fold((DVec3::ZERO, DVec3::ZERO), |(s, q), w| (s + w, q + w * w));
    let mean = sum / n;
    Survey {
        label: format!("{} seen from {}", case.label, wo.0),
        physical: case.is_physical(),
        cells,
        total: all.w,
        albedo: all.truncate(),
        sampled: mean,
        deviation: ((squares / n - mean * mean).max(DVec3::ZERO) / n).map(f64::sqrt),
    }
}

/// With some 500 views a false alarm at this level has a probability of 10⁻⁵ (and the numbers are always the same).
const SIGMAS: f64 = 5.5;

#[test]
fn samples_follow_their_density_and_fail_as_often_as_it_lacks() {
    let mut bad = Vec::new();
    for s in surveys() {
        let sigmas = chi2_sigmas(&s.cells);
        if sigmas > SIGMAS {
            bad.push(format!("{}: {sigmas:.1} sigma", s.label));
        }
        if s.total > 1.0 + 4e-3 {
            bad.push(format!("{}: density integrates to {}", s.label, s.total));
        }
        let off = ((s.sampled - s.albedo).abs() - DVec3::splat(4e-3)) / s.deviation.max(DVec3::splat(1e-9));
        if off.max_element() > SIGMAS {
            bad.push(format!("{}: sampled albedo {} but integral {}", s.label, s.sampled, s.albedo));
        }
    }
    assert!(bad.is_empty(), "{} views:\n{}", bad.len(), bad.join("\n"));
}

#[test]
fn a_weight_is_f_cos_over_pdf_and_a_sample_knows_its_pdf() {
    for case in cases() {
        for (wo, mode) in outgoing().into_iter().flat_map(|wo| [(wo, Transport::Radiance), (wo, Transport::Flux)]) {
            let mut random = Random(2);
            for _ in 0..300 {
                let Some(s) = case.bsdf.sample(wo, random.unit(), random.unit2(), mode) else { continue };
                if s.delta {
                    continue;
                }
                let pdf = case.bsdf.pdf(wo, s.wi);
                let want = case.bsdf.eval(wo, s.wi, mode) * (s.wi.abs_cos_theta() / pdf);
                let what = format!("{} from {} to {}", case.label, wo.0, s.wi.0);
                assert!((s.pdf - pdf).abs() <= case.tolerance() * pdf, "{what}: pdf {} but {pdf}", s.pdf);
                let (got, want) = (s.weight.to_rgb(Wavelengths::Rgb), want.to_rgb(Wavelengths::Rgb));
                assert!(
                    (got - want).abs().max_element() <= case.tolerance() * want.max_element(),
                    "{what}: {got} but {want}"
                );
            }
        }
    }
}

#[test]
fn delta_lobes_have_no_density() {
    for case in cases() {
        for wo in outgoing() {
            let mut random = Random(3);
            for _ in 0..20 {
                let Some(s) = case.bsdf.sample(wo, random.unit(), random.unit2(), Transport::Radiance) else {
                    continue;
                };
                // Smooth plastic has a mirror's lobe and a matt one.
                let both = matches!(case.bsdf, Bsdf::Plastic(_));
                assert!(s.delta != case.bsdf.is_connectible() || both, "{}", case.label);
                if s.delta {
                    assert!(s.pdf > 0.0 && s.pdf <= 1.0);
                    if both {
                        continue;
                    }
                    assert_eq!(case.bsdf.pdf(wo, s.wi), 0.0);
                    assert!(case.bsdf.eval(wo, s.wi, Transport::Radiance).is_black());
                }
            }
        }
    }
}
