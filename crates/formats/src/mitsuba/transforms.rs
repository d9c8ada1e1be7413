//! `transform`: each step is applied to what the steps before it gave.

use super::document::{Document, Element, Found};
use super::props::{numbers, triple};
use glam::{Affine2, DAffine3, DMat2, DMat3, DMat4, DQuat, DVec3};

/// The map of a `transform` element.
pub(super) fn transform(document: &Document, element: usize) -> Found<DAffine3> {
    let mut map = DAffine3::IDENTITY;
    for step in document.children(element) {
        map = single(step)? * map;
    }
    if !map.is_finite() {
        return Err(document.elements[element].at.bad("mitsuba::transform", "this transformation is not finite"));
    }
    Ok(map)
}

/// What a transformation does to texture coordinates.
pub(super) fn flat(map: &DAffine3) -> Affine2 {
    let m = map.matrix3;
    let linear = DMat2::from_cols(m.x_axis.truncate(), m.y_axis.truncate());
    Affine2::from_mat2_translation(linear.as_mat2(), map.translation.truncate().as_vec2())
}

fn single(step: &Element) -> Found<DAffine3> {
    match step.tag.as_str() {
        "translate" => Ok(DAffine3::from_translation(xyz(step, 0.0)?)),
        "scale" => Ok(DAffine3::from_scale(xyz(step, 1.0)?)),
        "rotate" => rotate(step),
        "lookat" => look_at(step),
        "matrix" => matrix(step),
        _ => {
            let steps = ["lookat", "matrix", "rotate", "scale", "translate"];
            Err(step.at.unknown("step of a transformation", &step.tag, steps))
        }
    }
}

/// Three numbers by `x`, `y` and `z`, or by `value`, where one stands for all.
pub(super) fn xyz(element: &Element, default: f64) -> Found<DVec3> {
    if let Some(value) = element.attribute("value") {
        let list = numbers(value)?;
        return match list[..] {
            [v] => Ok(DVec3::splat(v)),
            [x, y, z] => Ok(DVec3::new(x, y, z)),
            [x, y] => Ok(DVec3::new(x, y, default)),
            _ => Err(value.at.bad("mitsuba::value", "one number or three are needed")),
        };
    }
    let axis = |name| match element.attribute(name) {
        Some(value) => numbers(value).and_then(|list| match list[..] {
            [v] => Ok(v),
            _ => Err(value.at.bad("mitsuba::value", "a number is needed")),
        }),
        None => Ok(default),
    };
    Ok(DVec3::new(axis("x")?, axis("y")?, axis("z")?))
}

fn rotate(step: &Element) -> Found<DAffine3> {
    let angle = step.required("angle")?;
    let axis = xyz(step, 0.0)?.try_normalize();
    let axis = axis.ok_or_else(|| step.at.bad("mitsuba::transform", "a rotation needs an axis"))?;
    let [degrees] = numbers(angle)?[..] else {
        return Err(angle.at.bad("mitsuba::value", "an angle in degrees is needed"));
    };
    Ok(DAffine3::from_quat(DQuat::from_axis_angle(axis, degrees.to_radians())))
}

/// Looks along z with x to the left and y up.
fn look_at(step: &Element) -> Found<DAffine3> {
    let (origin, target) = (triple(step.required("origin")?)?, triple(step.required("target")?)?);
    let up = step.attribute("up").map(triple).transpose()?.unwrap_or(DVec3::ZERO);
    let forward = (target - origin).try_normalize();
    let forward =
        forward.ok_or_else(|| step.at.bad("mitsuba::transform", "`lookat` needs a `target` away from `origin`"))?;
    let left = up.cross(forward).try_normalize().unwrap_or_else(|| forward.any_orthonormal_vector());
    Ok(DAffine3::from_mat3_translation(DMat3::from_cols(left, forward.cross(left), forward), origin))
}

/// 16 numbers row by row, or 9 without shift.
fn matrix(step: &Element) -> Found<DAffine3> {
    let value = step.required("value")?;
    let list = numbers(value)?;
    if let Ok(nine) = <&[f64; 9]>::try_from(&list[..]) {
        return Ok(DAffine3::from_mat3(DMat3::from_cols_array(nine).transpose()));
    }
    let Ok(sixteen) = <&[f64; 16]>::try_from(&list[..]) else {
        let message = format!("a matrix has 9 or 16 numbers, not {}", list.len());
        return Err(value.at.bad("mitsuba::value", message));
    };
    let m = DMat4::from_cols_array(sixteen).transpose();
    let last = m.row(3);
    if last.truncate().abs().max_element() > 1e-6 * last.w.abs() || last.w == 0.0 {
        return Err(value.at.bad("mitsuba::transform", "the last row of a matrix must be 0 0 0 1"));
    }
    Ok(DAffine3::from_mat4(m * (1.0 / last.w)))
}
