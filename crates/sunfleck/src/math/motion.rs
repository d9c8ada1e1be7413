//! From one placement to another: moved, turned and stretched evenly.
use accel::Aabb;
use glam::{Affine3A, DMat3, DQuat, DVec3, Vec3};

/// A movement between two affine maps.
///
/// Each map is taken apart as `M = T·R·S`: a shift, a turn, and a symmetric stretch that holds scaling and shear (the
/// polar decomposition of Shoemake & Duff 1992, "Matrix animation and polar decomposition"). Shift and stretch change
/// linearly, the turn at constant speed about one axis, the shorter way round (Shoemake 1985, `slerp`). So a rigid map
/// stays rigid on the way, points of a map that is only shifted move along straight lines, and a turn of half a
/// revolution or more needs more than two maps.
#[derive(Clone, Copy, Debug)]
pub struct Motion {
    from: Parts,
    to: Parts,
}

/// A map taken apart; `stretch` is positive definite, or negative definite for a map that mirrors.
#[derive(Clone, Copy, Debug)]
struct Parts {
    shift: DVec3,
    turn: DQuat,
    stretch: DMat3,
}

impl Motion {
    /// The movement between two maps. `None` if one of them has no inverse, or is a mirror image of the other: there is
    /// no way between those that does not flatten things.
    pub fn new(from: &Affine3A, to: &Affine3A) -> Option<Self> {
        let (from, to) = (Parts::of(from)?, Parts::of(to)?);
        (from.stretch.determinant() * to.stretch.determinant() > 0.0).then_some(Self { from, to })
    }

    /// The map at `time` in [0, 1].
    pub fn at(&self, time: f32) -> Affine3A {
        let (a, b, t) = (&self.from, &self.to, f64::from(time));
        // A mixture of two positive definite matrices is one too, so the map never flattens anything.
        let stretch = a.stretch * (1.0 - t) + b.stretch * t;
        let matrix = DMat3::from_quat(a.turn.slerp(b.turn, t)) * stretch;
        Affine3A::from_mat3_translation(matrix.as_mat3(), a.shift.lerp(b.shift, t).as_vec3())
    }

    /// A box around everything that points of `local` pass through; little larger than the smallest.
    pub fn bounds(&self, local: &Aabb) -> Aabb {
        if local.is_empty() {
            return Aabb::EMPTY;
        }
        let boxes = (0..=STEPS).map(|i| local.transformed(&self.at(i as f32 / STEPS as f32)));
        let seen = boxes.fold(Aabb::EMPTY, |all, one| all.union(&one));
        let slack = self.deviation() as f32 * local.min.abs().max(local.max.abs()).length();
        Aabb { min: seen.min - slack, max: seen.max + slack }
    }

    /// How far a point at distance 1 from the origin strays from the straight line between two of the `STEPS`: h²/8 times
    /// its acceleration, that of `R(t)·S(t)·p` with turns of angle ω being at most `ω²·‖S‖ + 2ω·‖S′‖`.
    fn deviation(&self) -> f64 {
        let (a, b) = (&self.from, &self.to);
        let angle = 2.0 * a.turn.dot(b.turn).abs().min(1.0).acos();
        let norm = |m: &DMat3| m.to_cols_array().iter().map(|x| x * x).sum::<f64>().sqrt();
        let acceleration =
            angle * angle * norm(&a.stretch).max(norm(&b.stretch)) + 2.0 * angle * norm(&(b.stretch - a.stretch));
        acceleration / (8.0 * f64::from(STEPS * STEPS))
    }
}

/// Pieces in which [`Motion::bounds`] looks at a movement.
const STEPS: u32 = 32;

/// Newton steps that take the flattest map to a rotation.
const NEWTON_STEPS: usize = 100;

impl Parts {
    /// Takes a map apart by Newton's iteration for the polar factor, `Q ← (Q + Q⁻ᵀ) / 2` (Higham 1986). `None` without
    /// inverse.
    fn of(map: &Affine3A) -> Option<Self> {
        let m = DMat3::from_cols_array(&glam::Mat3::from(map.matrix3).to_cols_array().map(f64::from));
        let det = m.determinant();
        if !map.is_finite() || det == 0.0 {
            return None;
        }
        let mut q = m * det.abs().cbrt().recip();
        for _ in 0..NEWTON_STEPS {
            let next = (q + q.inverse().transpose()) * 0.5;
            let done = next.abs_diff_eq(q, 1e-14);
            q = next;
            if done {
                break;
            }
        }
        // What mirrors goes into the stretch, as −1.
        let turn = q * det.signum();
        let stretch = turn.transpose() * m;
        let turn = DQuat::from_mat3(&turn).normalize();
        (stretch.is_finite() && turn.is_finite()).then_some(Self {
            shift: Vec3::from(map.translation).as_dvec3(),
            turn,
            stretch,
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{
        math::warp::square_to_sphere,
        sampler::{Domain, Sampler},
    };
    use glam::{Mat3, Quat};
    use std::f32::consts::{FRAC_PI_2, PI};

    fn sampler(i: u64) -> Sampler<'static> {
        Sampler::new(3, Domain::Prepare, 0, i)
    }

    /// Any map of the given hand.
    fn map(s: &mut Sampler, mirrored: bool) -> Affine3A {
        let turn =
            |s: &mut Sampler| Mat3::from_quat(Quat::from_axis_angle(square_to_sphere(s.next_2d()), 6.0 * s.next_1d()));
        let size = Vec3::new(0.05 + s.next_1d(), 0.05 + 3.0 * s.next_1d(), 0.05 + s.next_1d());
        let sign = if mirrored { -1.0 } else { 1.0 };
        let m = turn(s) * Mat3::from_diagonal(size * Vec3::new(sign, 1.0, 1.0)) * turn(s);
        Affine3A::from_mat3_translation(m, 4.0 * square_to_sphere(s.next_2d()))
    }

    #[test]
    fn a_motion_begins_and_ends_with_its_maps_and_never_flattens() {
        for i in 0..500 {
            let s = &mut sampler(i);
            let (a, b) = (map(s, i % 2 == 0), map(s, i % 2 == 0));
            let motion = Motion::new(&a, &b).unwrap();
            assert!(motion.at(0.0).abs_diff_eq(a, 2e-6) && motion.at(1.0).abs_diff_eq(b, 2e-6), "{a} {b}");
            let least = a.matrix3.determinant().abs().min(b.matrix3.determinant().abs());
            for t in [0.1, 0.5, 0.8] {
                let det = motion.at(t).matrix3.determinant();
                assert!(det * a.matrix3.determinant() > 0.0 && det.abs() > 0.999 * least, "{a} {b}: {det} at {t}");
            }
        }
    }

    #[test]
    fn turns_are_even_and_keep_the_shape_and_shifts_are_straight() {
        let a = Affine3A::from_rotation_translation(Quat::from_rotation_y(0.3), Vec3::X);
        let b = Affine3A::from_rotation_translation(Quat::from_rotation_y(0.3 + FRAC_PI_2), Vec3::new(5.0, 2.0, 0.0));
        let motion = Motion::new(&a, &b).unwrap();
        for t in [0.0, 0.25, 0.7] {
            let expected = Affine3A::from_rotation_translation(
                Quat::from_rotation_y(0.3 + t * FRAC_PI_2),
                Vec3::X + t * Vec3::new(4.0, 2.0, 0.0),
            );
            assert!(motion.at(t).abs_diff_eq(expected, 1e-6), "{t}");
        }
        // Mixing the matrices themselves would shrink a half turn about two axes to nothing on the way.
        let half = Affine3A::from_rotation_z(PI * 0.999);
        assert!((Motion::new(&Affine3A::IDENTITY, &half).unwrap().at(0.5).matrix3.determinant() - 1.0).abs() < 1e-5);
        let grown = Motion::new(&Affine3A::IDENTITY, &Affine3A::from_scale(Vec3::new(3.0, 1.0, 1.0))).unwrap();
        assert!(grown.at(0.5).abs_diff_eq(Affine3A::from_scale(Vec3::new(2.0, 1.0, 1.0)), 1e-6));
    }

    #[test]
    fn what_cannot_be_undone_or_would_turn_inside_out_does_not_move() {
        let flat = Affine3A::from_scale(Vec3::new(1.0, 0.0, 1.0));
        let mirror = Affine3A::from_scale(Vec3::new(-1.0, 1.0, 1.0));
        for (a, b) in [
            (Affine3A::IDENTITY, flat),
            (flat, Affine3A::IDENTITY),
            (Affine3A::IDENTITY, mirror),
            (Affine3A::from_translation(Vec3::NAN), Affine3A::IDENTITY),
        ] {
            assert!(Motion::new(&a, &b).is_none(), "{a} {b}");
        }
        assert!(Motion::new(&mirror, &mirror).is_some());
    }

    #[test]
    fn bounds_hold_the_whole_way_and_little_more() {
        let local = Aabb { min: Vec3::new(-1.0, 0.5, -0.2), max: Vec3::new(0.5, 2.0, 0.4) };
        for i in 0..200 {
            let s = &mut sampler(i);
            let (a, b) = (map(s, false), map(s, false));
            let motion = Motion::new(&a, &b).unwrap();
            let bounds = motion.bounds(&local);
            let mut seen = Aabb::EMPTY;
            for step in 0..2000 {
                let map = motion.at(step as f32 / 1999.0);
                let corner = glam::BVec3::new(step & 1 != 0, step & 2 != 0, step & 4 != 0);
                let p = map.transform_point3(Vec3::select(corner, local.max, local.min));
                assert!(bounds.contains(p), "{bounds:?} {p}");
                seen = seen.with_point(p);
            }
            let (size, seen) = ((bounds.max - bounds.min).length(), (seen.max - seen.min).length());
            assert!(size < 1.05 * seen, "{size} {seen}");
        }
    }
}
