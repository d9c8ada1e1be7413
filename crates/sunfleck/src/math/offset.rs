//! Where a ray that leaves a surface may start without hitting that surface again.
use glam::Vec3;

/// Moves `p` off its surface, to the side that `d` points to, by more than its error bound.
///
/// `p_error` bounds each coordinate's absolute error (world units); `ng` is the unit geometric normal. The bound is
/// projected on the normal, so a grazing point moves no further than needed (Pharr, Jakob & Humphreys 2023, "Physically
/// Based Rendering", section 6.8.6); two ulps of `p` pay for the rounding of the move itself.
#[inline]
pub fn offset_origin(p: Vec3, p_error: Vec3, ng: Vec3, d: Vec3) -> Vec3 {
    let distance = (p_error + 2.0 * f32::EPSILON * p.abs()).dot(ng.abs());
    p + distance.copysign(d.dot(ng)) * ng
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_origin_moves_to_the_side_of_the_direction() {
        let (p, e) = (Vec3::new(1.0, 2.0, 3.0), Vec3::splat(1e-5));
        assert!(offset_origin(p, e, Vec3::Z, Vec3::new(0.9, 0.0, 0.1)).z > p.z + 0.9e-5);
        assert!(offset_origin(p, e, Vec3::Z, Vec3::new(0.9, 0.0, -0.1)).z < p.z - 0.9e-5);
    }
}
