//! What the books say should be done otherwise.
use super::books::{Books, LightBook};
use crate::render::algorithm::Algorithm;

/// Lights of which fewer paths were followed say nothing.
const ENOUGH: u64 = 200;
/// Fewer useful paths than this part are too few.
const USEFUL: f64 = 0.05;
/// More light than this part must not be cut off, or leave the scene.
const CUT: f64 = 0.01;
const ESCAPED: f64 = 0.5;
/// Advice on so many lights at most.
const LIGHTS: usize = 5;

/// One sentence for each thing that is off.
pub(super) fn give(books: &Books, algorithm: &Algorithm) -> Vec<String> {
    let enough = books.lights.iter().filter(|l| l.emitted.count >= ENOUGH);
    let odd = enough.map(|l| on(l, algorithm)).filter(|advice| !advice.is_empty());
    odd.take(LIGHTS).flatten().collect()
}

fn on(light: &LightBook, algorithm: &Algorithm) -> Vec<String> {
    let name = &light.name;
    let of_watts = |part: f64| part / light.emitted.watts().max(f64::MIN_POSITIVE);
    let cut = of_watts(light.cut.watts());
    let mut advice = Vec::new();
    if light.stored.count == 0 {
        let instead = if aim_is_off(algorithm) {
            "`--aim on` looks for what could focus its light"
        } else {
            "`--integrator path` does as well without"
        };
        advice.push(format!("no photon of light `{name}` is ever stored: {instead}"));
    } else if light.useful_share() < USEFUL {
        let missed = 100.0 * (1.0 - light.useful_share());
        let what = what_to_do(light, of_watts(light.escaped.watts()), algorithm);
        advice.push(format!("{missed:.1} % of the photons of light `{name}` never reach a visible kernel: {what}"));
    }
    if cut > CUT {
        let percent = 100.0 * cut;
        advice.push(format!(
            "{percent:.1} % of the light of `{name}` is cut off by the limit on scatterings: raise `--depth`"
        ));
    }
    advice
}

/// Whether the user chose so.
fn aim_is_off(algorithm: &Algorithm) -> bool {
    algorithm.settings().get("aim").is_some_and(|v| v == "off")
}

fn what_to_do(light: &LightBook, escaped: f64, algorithm: &Algorithm) -> String {
    if aim_is_off(algorithm) {
        return "`--aim on` sends them where they are needed".to_owned();
    }
    match light.kind {
        "point" if escaped > ESCAPED => "most leave the scene; a spot light would not send them there".to_owned(),
        "directional" | "environment" => "the scene is much larger than what the camera sees of it; leave out what is \
            not needed, or send more with `--photons`"
            .to_owned(),
        _ => "send more with `--photons`; if the picture lacks nothing, `--integrator path` may be faster".to_owned(),
    }
}
