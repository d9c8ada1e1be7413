//! Light that goes one way could have gone the other: reciprocity, the η² of radiance, and adjoint pairs.
use crate::{
    models::{Case, cases, outgoing},
    statistics::Random,
};
use sunfleck::{
    bsdf::{Scatter, Transport},
    math::{Local, warp::square_to_sphere},
    spectrum::{Rgb, Wavelengths},
};

/// Calls `check` with directions of many pairs: some drawn by the model, which meet narrow lobes, some anyhow.
fn pairs(case: &Case, check: impl Fn(Local, Local)) {
    for wo in outgoing() {
        let mut random = Random(7);
        for _ in 0..200 {
            if let Some(s) = case.bsdf.sample(wo, random.unit(), random.unit2(), Transport::Radiance) {
                check(wo, s.wi);
            }
            check(wo, Local(square_to_sphere(random.unit2())));
        }
    }
}

fn f(case: &Case, wo: Local, wi: Local, mode: Transport) -> Rgb {
    case.bsdf.eval(wo, wi, mode).to_rgb(Wavelengths::Rgb)
}

fn assert_close(case: &Case, wo: Local, wi: Local, a: Rgb, b: Rgb) {
    let bound = case.tolerance() * a.max(b).max_element() + 1e-6;
    assert!((a - b).abs().max_element() <= bound, "{} between {} and {}: {a} but {b}", case.label, wo.0, wi.0);
}

/// η of the side that `w` is on.
fn eta_at(case: &Case, w: Local) -> Rgb {
    if w.cos_theta() > 0.0 { Rgb::ONE } else { case.eta }
}

#[test]
fn scattering_of_radiance_is_reciprocal_but_for_eta_squared() {
    // Veach 1997, eq. 5.14: f(wi → wo)/ηo² = f(wo → wi)/ηi².
    for c in cases().iter().filter(|c| c.is_physical()) {
        pairs(c, |wo, wi| {
            let there = f(c, wo, wi, Transport::Radiance) / eta_at(c, wo).powf(2.0);
            let back = f(c, wi, wo, Transport::Radiance) / eta_at(c, wi).powf(2.0);
            assert_close(c, wo, wi, there, back);
        });
    }
}

#[test]
fn flux_scatters_by_the_adjoint_of_radiance() {
    // Veach 1997, section 3.7.5; this holds for every model, reciprocal or not.
    for c in &cases() {
        pairs(c, |wo, wi| {
            assert_close(c, wo, wi, f(c, wo, wi, Transport::Radiance), f(c, wi, wo, Transport::Flux));
        });
    }
}

#[test]
fn refraction_scales_radiance_by_eta_squared_and_flux_not() {
    let mut refractions = 0;
    for c in &cases() {
        for wo in outgoing() {
            let mut random = Random(9);
            for _ in 0..100 {
                let (u_lobe, u) = (random.unit(), random.unit2());
                let radiance = c.bsdf.sample(wo, u_lobe, u, Transport::Radiance);
                let flux = c.bsdf.sample(wo, u_lobe, u, Transport::Flux);
                let (Some(radiance), Some(flux)) = (radiance, flux) else { continue };
                assert_eq!(radiance.wi, flux.wi, "{}", c.label);
                let eta = (eta_at(c, radiance.wi) / eta_at(c, wo)).x;
                assert!((radiance.eta - eta).abs() < 1e-6 * eta, "{}: eta {} but {eta}", c.label, radiance.eta);
                if wo.same_side(radiance.wi) {
                    assert_eq!(radiance.eta, 1.0);
                } else if radiance.weight.hero() > 0.0 {
                    refractions += 1;
                    let ratio = flux.weight.hero() / radiance.weight.hero();
                    assert!((ratio - eta * eta).abs() < 1e-5 * ratio, "{}: {ratio} but {}", c.label, eta * eta);
                }
            }
        }
    }
    assert!(refractions > 5000, "{refractions}");
}

#[test]
fn surfaces_without_an_inside_look_the_same_from_both_sides() {
    for c in cases().iter().filter(|c| !c.transmits()) {
        pairs(c, |wo, wi| {
            let turn = |w: Local| Local(w.0.with_z(-w.0.z));
            let (a, b) = (f(c, wo, wi, Transport::Radiance), f(c, turn(wo), turn(wi), Transport::Radiance));
            assert_eq!(a, b, "{}", c.label);
            assert_eq!(c.bsdf.pdf(wo, wi), c.bsdf.pdf(turn(wo), turn(wi)), "{}", c.label);
        });
    }
}
