//! Where a ray that leaves a surface may start without hitting that surface again.
use glam::Vec3;

/// Moves `p` off its surface, to the side that `d` points to, by more than its error bound.
///
/// `p_error` bounds each coordinate's absolute error (world units); `ng` is the unit geometric normal. The bound is
/// projected on the normal, so a grazing point moves no further than needed, and the result is rounded outward by one
/// ulp (Pharr, Jakob & Humphreys 2023, "Physically Based Rendering", section 6.8.6).
#[inline]
pub fn offset_origin(p: Vec3, p_error: Vec3, ng: Vec3, d: Vec3) -> Vec3 {
    let distance = p_error.dot(ng.abs());
    let offset = if d.dot(ng) < 0.0 { -distance * ng } else { distance * ng };
    let moved = p + offset;
    Vec3::new(round_along(moved.x, offset.x), round_along(moved.y, offset.y), round_along(moved.z, offset.z))
}

/// The neighbouring float in the direction of `sign`, or `x` itself for a zero sign.
#[inline]
fn round_along(x: f32, sign: f32) -> f32 {
    if sign > 0.0 {
        x.next_up()
    } else if sign < 0.0 {
        x.next_down()
    } else {
        x
    }
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
