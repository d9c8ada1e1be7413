//! No surface gives back more light than it gets.
use crate::{
    models::{cases, outgoing},
    sampling::surveys,
    statistics::Random,
};
use glam::{Vec2, Vec3};
use sunfleck::{
    bsdf::{Bsdf, BsdfSample, Scatter, Transport},
    math::Local,
    spectrum::Wavelengths,
};

#[test]
fn no_rough_surface_gives_back_more_than_it_gets() {
    let bad: Vec<_> = surveys()
        .iter()
        .filter(|s| s.physical && s.albedo.max_element() > 1.0 + 1e-3)
        .map(|s| format!("{}: {}", s.label, s.albedo))
        .collect();
    assert!(bad.is_empty(), "{} views:\n{}", bad.len(), bad.join("\n"));
}

/// All lobes of a delta model, each with its probability.
fn lobes(bsdf: &Bsdf, wo: Local, mode: Transport) -> Vec<BsdfSample> {
    let mut lobes: Vec<BsdfSample> = Vec::new();
    for u in [0.0, 1.0 - f32::EPSILON / 2.0] {
        if let Some(s) = bsdf.sample(wo, u, Vec2::splat(0.5), mode)
            && lobes.iter().all(|l| l.wi != s.wi)
        {
            lobes.push(s);
        }
    }
    lobes
}

#[test]
fn no_smooth_surface_gives_back_more_than_it_gets() {
    for c in cases().iter().filter(|c| !c.bsdf.is_connectible()) {
        for wo in outgoing() {
            let sum: Vec3 =
                lobes(&c.bsdf, wo, Transport::Flux).iter().map(|s| s.weight.to_rgb(Wavelengths::Rgb) * s.pdf).sum();
            assert!(sum.max_element() <= 1.0 + 1e-5, "{} from {}: {sum}", c.label, wo.0);
        }
    }
}

#[test]
fn a_smooth_white_dielectric_loses_nothing() {
    for c in
        cases().iter().filter(|c| c.label.starts_with("dielectric eta") || c.label.starts_with("thindielectric eta"))
    {
        for wo in outgoing() {
            let mut probability = 0.0;
            for s in lobes(&c.bsdf, wo, Transport::Flux) {
                probability += s.pdf;
                let weight = s.weight.to_rgb(Wavelengths::Rgb);
                assert!((weight - 1.0).abs().max_element() < 1e-5, "{} from {}: {weight}", c.label, wo.0);
            }
            assert!((probability - 1.0).abs() < 1e-6, "{} from {}: {probability}", c.label, wo.0);
        }
    }
}

#[test]
fn slightly_rough_surfaces_lose_next_to_nothing() {
    // Masking only takes what a second bounce would have given back, which is little on gentle slopes.
    let ideal = ["roughconductor ideal alpha 0.02", "roughdielectric eta 1.50 alpha 0.05"];
    for name in ideal {
        let label = format!("{name} seen from {}", Vec3::Z);
        let s = surveys().iter().find(|s| s.label == label).expect("in the list");
        assert!(s.albedo.min_element() > 0.995, "{}: {}", s.label, s.albedo);
    }
}

#[test]
fn white_layers_and_white_rough_metal_lose_nothing() {
    // What facets keep from each other comes back, and what a gloss does not reflect reaches the base.
    for s in surveys() {
        let white = ["paint", "metal"].iter().any(|w| s.label.starts_with(&format!("principled {w}")));
        if white || s.label.starts_with("plastic white") && !s.label.contains(" at 0 seen") {
            assert!((s.albedo - 1.0).abs().max_element() < 0.02, "{}: {}", s.label, s.albedo);
        }
    }
    for c in cases().iter().filter(|c| c.label.starts_with("plastic white") && c.label.ends_with(" at 0")) {
        for wo in outgoing() {
            let s = c.bsdf.sample(wo, 0.0, Vec2::splat(0.5), Transport::Flux).expect("a mirror reflection");
            let label = format!("{} seen from {}", c.label, wo.0);
            let matt = surveys().iter().find(|s| s.label == label).map(|s| s.albedo.x);
            let all = f64::from(s.pdf * s.weight.max()) + matt.unwrap_or(f64::from(1.0 - s.pdf));
            assert!((all - 1.0).abs() < 4e-3, "{label}: {all}");
        }
    }
}

#[test]
fn light_between_base_and_boundary_leaves_darker() {
    // Of 1.5 the boundary sends back 60 % of diffuse light from below (Egan & Hilgeman 1973 tabulate 0.596).
    let albedo = |name: &str| {
        let label = format!("plastic tinted nonlinear {name} at 0 seen from {}", Vec3::Z);
        surveys().iter().find(|s| s.label == label).expect("in the list").albedo
    };
    let (pure, bounced, rho) = (albedo("false"), albedo("true"), 0.7);
    let want = (1.0 - 0.596) / (1.0 - rho * 0.596);
    assert!((bounced.x / pure.x - want).abs() < 2e-3, "{} {want}", bounced.x / pure.x);
}

#[test]
fn a_phong_brighter_than_white_is_scaled_to_white() {
    let all = cases();
    let c = all.iter().find(|c| c.label == "phong too bright").expect("in the list");
    let mut random = Random(5);
    let wo = Local(Vec3::Z);
    let mean: f32 = (0..20_000)
        .filter_map(|_| c.bsdf.sample(wo, random.unit(), random.unit2(), Transport::Radiance))
        .map(|s| s.weight.max() / 20_000.0)
        .sum();
    // kd = ks = 1/2 after scaling; along the normal ∫ (n+2)/2π cosⁿ⁺¹ = 1.
    assert!((mean - 1.0).abs() < 0.01, "{mean}");
}
