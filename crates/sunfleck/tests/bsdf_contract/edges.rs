//! Grazing, head-on and extreme inputs: everything stays finite and on its side.
use crate::models::cases;
use glam::{Vec2, Vec3};
use sunfleck::{
    bsdf::{BsdfSample, Scatter, Transport},
    math::Local,
};

/// Head-on, grazing and in the plane, on both sides.
fn extreme_directions() -> Vec<Local> {
    let mut out = Vec::new();
    for z in [1.0f32, 0.7, 1e-3, 1e-6, 1e-12, 1e-30, f32::MIN_POSITIVE, 1e-42, 0.0] {
        for side in [z, -z] {
            let r = (1.0 - z * z).sqrt();
            out.push(Local(Vec3::new(r, 0.0, side)));
            out.push(Local(Vec3::new(-0.6 * r, 0.8 * r, side)));
        }
    }
    out
}

fn check(s: &BsdfSample, wo: Local, what: &str) {
    assert!(s.weight.is_finite() && !s.weight.is_black(), "{what}: weight {:?}", s.weight);
    assert!(s.pdf.is_finite() && s.pdf > 0.0, "{what}: pdf {}", s.pdf);
    assert!((s.wi.0.length() - 1.0).abs() < 1e-5, "{what}: wi {}", s.wi.0);
    assert!(s.wi.cos_theta() != 0.0 && wo.cos_theta() != 0.0, "{what}: in the plane");
    assert!(s.eta > 0.0 && s.eta.is_finite(), "{what}: eta {}", s.eta);
    if s.eta != 1.0 {
        assert!(!wo.same_side(s.wi), "{what}: refracted to the same side");
    }
}

#[test]
fn samples_are_finite_at_every_edge() {
    let ends = [0.0, 1e-7, 0.25, 0.5, 0.75, 1.0 - f32::EPSILON / 2.0];
    for c in cases() {
        for wo in extreme_directions() {
            for mode in [Transport::Radiance, Transport::Flux] {
                for i in 0..ends.len().pow(3) {
                    let [a, b, l] = [i % 6, i / 6 % 6, i / 36].map(|k| ends[k]);
                    if let Some(s) = c.bsdf.sample(wo, l, Vec2::new(a, b), mode) {
                        check(&s, wo, &format!("{} from {} with {l} {a} {b}", c.label, wo.0));
                        let crosses = (wo.0.z < 0.0) != (s.wi.0.z < 0.0);
                        assert!(c.transmits() || !crosses, "{} lets light through", c.label);
                    }
                }
            }
        }
    }
}

#[test]
fn values_are_finite_and_not_negative_at_every_edge() {
    for c in cases() {
        for wo in extreme_directions() {
            for wi in extreme_directions() {
                let what = || format!("{} between {} and {}", c.label, wo.0, wi.0);
                let pdf = c.bsdf.pdf(wo, wi);
                assert!(pdf.is_finite() && pdf >= 0.0, "{}: pdf {pdf}", what());
                for mode in [Transport::Radiance, Transport::Flux] {
                    let f = c.bsdf.eval(wo, wi, mode);
                    assert!(f.is_finite() && f.map(|v| -v).max() <= 0.0, "{}: {f:?}", what());
                }
            }
        }
    }
}

#[test]
fn light_stays_on_its_side_unless_the_model_transmits() {
    for c in cases().iter().filter(|c| !c.transmits()) {
        for (wo, wi) in
            extreme_directions().into_iter().flat_map(|a| extreme_directions().into_iter().map(move |b| (a, b)))
        {
            // Not by the product of the cosines, which underflows here.
            if wo.0.z.signum() != wi.0.z.signum() || wo.0.z == 0.0 || wi.0.z == 0.0 {
                assert!(c.bsdf.eval(wo, wi, Transport::Radiance).is_black(), "{}", c.label);
                assert_eq!(c.bsdf.pdf(wo, wi), 0.0, "{}", c.label);
            }
        }
    }
}
