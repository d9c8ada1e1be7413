//! Identities that make a landscape of microfacets a surface.
use glam::Vec3;
use std::f64::consts::TAU;
use sunfleck::{
    bsdf::{Facets, Landscape, ggx::reflect_up},
    math::Local,
};

/// `∫ f(m) dm` over the upper hemisphere, even in the logarithm of the slope, where a GGX lobe of any width is smooth.
fn over_normals(alpha: f32, f: impl Fn(Local) -> f64) -> f64 {
    let (from, to, steps, turns) = ((f64::from(alpha) * 1e-4).ln(), 1e5f64.ln(), 3000, 256);
    let ds = (to - from) / f64::from(steps);
    let mut sum = 0.0;
    for i in 0..steps {
        let slope = (from + (f64::from(i) + 0.5) * ds).exp();
        let cos = 1.0 / (1.0 + slope * slope).sqrt();
        let sin = slope * cos;
        // dω = sin θ dθ dφ and dθ = sin θ cos θ d(ln tan θ).
        let weight = sin * sin * cos * ds * TAU / f64::from(turns);
        for j in 0..turns {
            let (y, x) = (TAU * (f64::from(j) + 0.5) / f64::from(turns)).sin_cos();
            sum += weight * f(Local(Vec3::new((sin * x) as f32, (sin * y) as f32, cos as f32)));
        }
    }
    sum
}

const ALPHAS: [[f32; 2]; 6] = [[1e-3, 1e-3], [0.05, 0.05], [0.3, 0.3], [1.0, 1.0], [0.1, 0.5], [0.8, 0.2]];

/// Every kind of landscape at every roughness, with the least of its two roughnesses.
fn landscapes() -> impl Iterator<Item = (Landscape, f32)> {
    let kinds = [Facets::Ggx, Facets::GgxSeparate, Facets::Beckmann].into_iter();
    kinds.flat_map(|kind| ALPHAS.map(|[u, v]| (Landscape::new(kind, u, v), u.min(v))))
}

fn views() -> impl Iterator<Item = Local> {
    [1.0f32, 0.9, 0.5, 0.1].into_iter().map(|c| {
        let (sin, phi) = ((1.0 - c * c).sqrt(), 3.0 * c);
        Local(Vec3::new(sin * phi.cos(), sin * phi.sin(), c))
    })
}

#[test]
fn microfacets_cover_the_surface_once() {
    for (facets, narrow) in landscapes() {
        let area = over_normals(narrow, |m| f64::from(facets.d(m) * m.cos_theta()));
        assert!((area - 1.0).abs() < 1e-4, "{facets:?}: {area}");
    }
}

#[test]
fn masking_leaves_the_projected_area_of_the_surface() {
    // Heitz 2014, eq. 7 with Smith's hypothesis: G1(wo) ∫ D (wo·m)+ dm = cos θo, which D alone decides.
    for (facets, narrow) in landscapes() {
        for wo in views() {
            let seen = over_normals(narrow, |m| f64::from(facets.d(m) * wo.dot(m).max(0.0)));
            let g1 = f64::from(wo.cos_theta()) / seen;
            assert!((f64::from(facets.g1(wo)) - g1).abs() < 1e-3, "{facets:?} {}: {} {g1}", wo.0, facets.g1(wo));
            let total = over_normals(narrow, |m| f64::from(facets.pdf_visible(wo, m)));
            assert!((total - 1.0).abs() < 1e-3, "{facets:?} {}: {total}", wo.0);
        }
    }
}

#[test]
fn every_visible_normal_drawn_is_seen() {
    for (facets, _) in landscapes() {
        for wo in views() {
            for i in 0..1000u32 {
                let u = glam::Vec2::new((i as f32 * 0.618).fract(), i as f32 / 1000.0);
                let m = facets.sample_visible(wo, u);
                assert!(
                    facets.pdf_visible(wo, m) > 0.0 && (m.0.length() - 1.0).abs() < 1e-5,
                    "{facets:?} {} {}",
                    wo.0,
                    m.0
                );
            }
        }
    }
}

#[test]
fn shadowing_only_takes_light_away() {
    for (facets, _) in landscapes() {
        for (wo, wi) in views().flat_map(|a| views().map(move |b| (a, b))) {
            let s = facets.shadowing(wo, wi);
            assert!(s > 0.0 && s <= 1.0, "{facets:?}: {s}");
            // Height correlation hides less than independence, and no more is seen than by either alone.
            let g2 = s * facets.g1(wo);
            assert!(g2 >= facets.g1(wo) * facets.g1(wi) * 0.999 && g2 <= facets.g1(wi) * 1.001, "{facets:?}: {g2}");
        }
    }
}

#[test]
fn a_reflection_that_would_go_down_is_dropped() {
    let grazing = Local(Vec3::new(0.995, 0.0, 0.0999));
    assert!(reflect_up(grazing, Local(Vec3::new(-0.6, 0.0, 0.8))).is_none());
    assert!(reflect_up(grazing, Local(Vec3::Z)).is_some());
}
