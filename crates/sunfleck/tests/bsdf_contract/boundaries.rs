//! Fresnel's equations against closed forms and against complex arithmetic.
use crate::models::{cases, outgoing};
use glam::{DVec2, Vec2, Vec3};
use sunfleck::{
    bsdf::{Bsdf, Dielectric, Scatter, Transport, fresnel},
    math::Local,
    spectrum::Spectrum,
};

#[test]
fn a_clear_boundary_reflects_by_the_index_along_the_normal() {
    for eta in [1.5f32, 1.33, 2.4, 1.0 / 1.5, 1.0] {
        let want = ((eta - 1.0) / (eta + 1.0)).powi(2);
        assert!((fresnel::dielectric(1.0, eta).reflectance() - want).abs() < 1e-7, "{eta}");
    }
}

#[test]
fn parallel_light_is_not_reflected_at_brewsters_angle() {
    for eta in [1.5f32, 1.33, 0.75] {
        let r = fresnel::dielectric(eta.atan().cos(), eta);
        assert!(r.r_p < 1e-10 && r.r_s > 0.01, "{eta}: {r:?}");
        // There the reflected and the refracted ray are at a right angle.
        assert!((r.cos_t - eta.atan().sin()).abs() < 1e-6);
    }
}

#[test]
fn everything_is_reflected_beyond_the_critical_angle_and_only_there() {
    for eta in [1.0 / 1.5f32, 1.0 / 1.33] {
        let critical = eta.asin();
        let beyond = fresnel::dielectric((critical + 1e-3).cos(), eta);
        assert!(beyond.reflectance() == 1.0 && beyond.cos_t == 0.0);
        let before = fresnel::dielectric((critical - 1e-3).cos(), eta);
        assert!(before.reflectance() < 0.9 && before.cos_t > 0.0);
    }
    assert_eq!(fresnel::dielectric(1e-4, 1.0).reflectance(), 0.0, "equal indices make no boundary");
}

#[test]
fn a_boundary_reflects_alike_from_both_sides() {
    for eta in [1.5f32, 1.33, 2.4] {
        for cos in [1.0, 0.7, 0.3, 0.05] {
            let there = fresnel::dielectric(cos, eta);
            let back = fresnel::dielectric(there.cos_t, 1.0 / eta);
            assert!((there.reflectance() - back.reflectance()).abs() < 1e-5 && (back.cos_t - cos).abs() < 1e-5);
        }
    }
}

#[test]
fn light_bends_by_snells_law_and_away_from_glass() {
    for (eta, z) in [(1.5f32, 0.6), (1.5, -0.9), (0.75, 0.8), (2.4, -0.95)] {
        let glass =
            Dielectric { eta: Spectrum::splat(eta), reflectance: Spectrum::BLACK, transmittance: Spectrum::ONE };
        let wo = Local(Vec3::new((1.0f32 - z * z).sqrt(), 0.0, z));
        let s = glass.sample(wo, 0.5, Vec2::ZERO, Transport::Flux).expect("below the critical angle");
        let (eta_o, eta_i) = if z > 0.0 { (1.0, eta) } else { (eta, 1.0) };
        assert!((eta_o * wo.0.x + eta_i * s.wi.0.x).abs() < 1e-6, "{eta} {z}: {}", s.wi.0);
        assert!(s.wi.0.z * z < 0.0 && s.wi.0.y == 0.0);
    }
}

#[test]
fn a_pane_reflects_what_its_two_sides_do_and_lets_the_rest_straight_through() {
    // Of 1.5 along the normal, each side reflects 4 %: 0.04 + 0.96² · 0.04 / (1 − 0.04²) = 2/26.
    for c in cases().iter().filter(|c| c.label == "thindielectric eta 1.50") {
        let reflected = c.bsdf.sample(Local(Vec3::Z), 0.0, Vec2::ZERO, Transport::Radiance).expect("a reflection");
        assert!((reflected.pdf - 2.0 / 26.0).abs() < 1e-6 && reflected.wi.0 == Vec3::Z, "{}", reflected.pdf);
        for wo in outgoing() {
            let passed = c.bsdf.sample(wo, 0.9999, Vec2::ZERO, Transport::Radiance).expect("a passage");
            assert!(passed.wi.0 == -wo.0 && passed.eta == 1.0, "{}", wo.0);
        }
    }
}

#[test]
fn mirrors_reflect_about_the_normal() {
    for wo in outgoing() {
        for c in cases().iter().filter(|c| matches!(c.bsdf, Bsdf::Mirror(_) | Bsdf::Conductor(_))) {
            let s = c.bsdf.sample(wo, 0.5, Vec2::ZERO, Transport::Radiance).expect("not in the plane");
            assert!((wo.0 + s.wi.0).cross(Vec3::Z).length() < 1e-6 && s.wi.0.z == wo.0.z, "{}: {}", c.label, s.wi.0);
        }
    }
}

fn conductor(cos: f32, eta: f32, k: f32) -> f32 {
    fresnel::conductor(cos, Spectrum::splat(eta), Spectrum::splat(k)).max()
}

#[test]
fn gold_and_aluminium_reflect_as_measured() {
    // Johnson & Christy 1972, gold at 2.26 eV (549 nm): 0.43 + 2.455i. Rakić 1995, aluminium near 550 nm: 0.96 + 6.69i.
    for (eta, k, percent) in [(0.43f32, 2.455f32, 78.7), (0.96, 6.69, 92.1)] {
        let want = ((eta - 1.0).powi(2) + k * k) / ((eta + 1.0).powi(2) + k * k);
        let got = conductor(1.0, eta, k);
        assert!((got - want).abs() < 1e-6 && (100.0 * got - percent).abs() < 0.1, "{got} {want}");
    }
}

fn mul(a: DVec2, b: DVec2) -> DVec2 {
    DVec2::new(a.x * b.x - a.y * b.y, a.x * b.y + a.y * b.x)
}

fn sqrt(a: DVec2) -> DVec2 {
    let half = 0.5 * a.y.atan2(a.x);
    DVec2::new(half.cos(), half.sin()) * a.length().sqrt()
}

#[test]
fn metals_reflect_as_complex_arithmetic_says() {
    for (eta, k) in [(0.43, 2.455), (0.96, 6.69), (1.38, 1.92), (0.05, 4.0), (3.0, 0.1)] {
        for cos in [1.0, 0.9, 0.5, 0.2, 0.01] {
            let index = DVec2::new(eta, k);
            let n2 = mul(index, index);
            let c = DVec2::new(cos, 0.0);
            let root = sqrt(n2 - DVec2::new(1.0 - cos * cos, 0.0));
            let s = (c - root).length_squared() / (c + root).length_squared();
            let p = (mul(n2, c) - root).length_squared() / (mul(n2, c) + root).length_squared();
            let got = f64::from(conductor(cos as f32, eta as f32, k as f32));
            assert!((got - 0.5 * (s + p)).abs() < 2e-5, "{eta}+{k}i at {cos}: {got} but {}", 0.5 * (s + p));
        }
    }
}

#[test]
fn a_metal_that_does_not_absorb_is_glass() {
    for cos in [1.0, 0.8, 0.4, 0.1] {
        let glass = fresnel::dielectric(cos, 1.5).reflectance();
        assert!((conductor(cos, 1.5, 0.0) - glass).abs() < 1e-5);
    }
}

#[test]
fn schlick_is_near_fresnel_for_glass_and_exact_at_both_ends() {
    let f0 = Spectrum::splat(0.04);
    assert_eq!(fresnel::schlick(f0, 1.0).max(), 0.04);
    assert_eq!(fresnel::schlick(f0, 0.0).max(), 1.0);
    for cos in [0.9, 0.6, 0.3] {
        let exact = fresnel::dielectric(cos, 1.5).reflectance();
        assert!((fresnel::schlick(f0, cos).max() - exact).abs() < 0.05, "{cos}");
    }
}
