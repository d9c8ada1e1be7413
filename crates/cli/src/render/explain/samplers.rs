//! Each sampler of an algorithm alone.
use super::Pictures;
use crate::{render::interrupt::Interrupt, table::aligned};
use formats::image::RgbImage32;
use glam::Vec3;
use serde::Serialize;
use sunfleck::{
    film::{Film, PassImage},
    integrator::{Pass, PassRenderer, Technique},
    render::Settings,
};

/// What one sampler brings.
#[derive(Debug, Serialize)]
pub(super) struct Shown {
    name: &'static str,
    /// Its part of the picture's mean, 0 to 1.
    share: f64,
    /// Mean radiance by channel, as it counts in the picture.
    mean: [f64; 3],
    /// The same if it were the only sampler: all that it can find.
    mean_unweighted: [f64; 3],
}

/// Shows every sampler in the first `passes`; `None` if the user has had enough.
pub(super) fn show(
    renderer: &dyn PassRenderer,
    settings: &Settings,
    passes: u64,
    interrupt: &Interrupt,
) -> Option<(Vec<Shown>, Pictures)> {
    let spec = settings.spec;
    let mut pictures = Pictures { sum: RgbImage32::filled(spec.width, spec.height, [0.0; 3]), layers: Vec::new() };
    let mut shares = Vec::new();
    for technique in renderer.techniques() {
        let alone = |weighted| alone(renderer, settings, passes, (technique, weighted), interrupt);
        let (weighted, unweighted) = (alone(true)?, alone(false)?);
        pictures
            .sum
            .data
            .iter_mut()
            .zip(&weighted.data)
            .for_each(|(s, v)| *s = (Vec3::from(*s) + Vec3::from(*v)).into());
        let name = technique.name();
        shares.push(Shown { name, share: 0.0, mean: mean(&weighted), mean_unweighted: mean(&unweighted) });
        pictures.layers.extend([(name.to_owned(), weighted), (format!("{name}-unweighted"), unweighted)]);
    }
    let sum = |s: &Shown| s.mean.iter().sum::<f64>();
    let total: f64 = shares.iter().map(sum).sum();
    shares.iter_mut().for_each(|s| s.share = if total > 0.0 { sum(s) / total } else { 0.0 });
    Some((shares, pictures))
}

fn alone(
    renderer: &dyn PassRenderer,
    settings: &Settings,
    passes: u64,
    (technique, weighted): (Technique, bool),
    interrupt: &Interrupt,
) -> Option<RgbImage32> {
    let spec = settings.spec;
    let (mut film, mut image) = (Film::new(spec), PassImage::new(spec));
    for index in 0..passes {
        if interrupt.requested() {
            return None;
        }
        image.clear();
        let pass = Pass::new(settings.seed, index).colored(settings.color);
        renderer.render_technique(&pass, technique, weighted, &mut image);
        film.add(&image);
    }
    let data = film.mean().iter().map(Vec3::to_array).collect();
    Some(RgbImage32 { width: spec.width, height: spec.height, data })
}

fn mean(image: &RgbImage32) -> [f64; 3] {
    let n = image.data.len().max(1) as f64;
    [0, 1, 2].map(|c| image.data.iter().map(|p| f64::from(p[c])).sum::<f64>() / n)
}

/// For people.
pub(super) fn table(shares: &[Shown]) -> String {
    let whole: f64 = shares.iter().flat_map(|s| s.mean).sum();
    let percent = |part: f64| if whole > 0.0 { format!("{:.1} %", 100.0 * part / whole) } else { "–".to_owned() };
    let mut rows = vec![["sampler", "of the picture", "alone", "what it is"].map(str::to_owned)];
    rows.extend(shares.iter().map(|s| {
        let sum = |mean: &[f64; 3]| percent(mean.iter().sum());
        [s.name.to_owned(), sum(&s.mean), sum(&s.mean_unweighted), about(s.name).to_owned()]
    }));
    aligned(&rows)
}

fn about(name: &str) -> &'static str {
    match name {
        "hit" => "camera paths that meet a light by themselves",
        "nee" => "a point of a light, connected to a camera path",
        "light-image" => "light paths connected to the lens",
        "connect" => "camera paths connected to light paths",
        "merge" => "photons around a point of a camera path",
        _ => "",
    }
}
