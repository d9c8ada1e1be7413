//! Numbers and parameters as text. Numbers are as short as they can be to be read back as they were.

use glam::{Affine3A, Vec3};
use sunfleck::spectrum::{Colour, Curve, Illuminant, Ior, NAMED};

/// Wavelengths (nm) at which curves are told.
const NM: std::ops::RangeInclusive<u32> = 360..=830;

/// Numbers with blanks between.
pub(super) fn numbers(all: impl IntoIterator<Item = f32>) -> String {
    all.into_iter().map(|x| x.to_string()).collect::<Vec<_>>().join(" ")
}

/// `"kind name" [ values ]`, with a blank before.
pub(super) fn param(kind: &str, name: &str, values: &str) -> String {
    format!(" \"{kind} {name}\" [ {values} ]")
}

/// A single number.
pub(super) fn float(name: &str, x: f32) -> String {
    param("float", name, &x.to_string())
}

/// A string; quotes and backslashes in it are escaped.
pub(super) fn string(name: &str, value: &str) -> String {
    param("string", name, &quoted(value))
}

/// In quotes.
pub(super) fn quoted(value: &str) -> String {
    format!("\"{}\"", value.replace('\\', "\\\\").replace('"', "\\\""))
}

/// What only we read: the rest of the line is a comment to pbrt.
pub(super) fn ours(params: &str) -> String {
    if params.is_empty() { String::new() } else { format!("\n    #sunfleck{params}\n   ") }
}

/// A colour of matter.
pub(super) fn colour(name: &str, c: &Colour) -> String {
    match c.curve() {
        Some(curve) => param("spectrum", name, &pairs(curve)),
        None => param("rgb", name, &numbers(c.rgb().to_array())),
    }
}

/// A colour of light: what is not RGB is given its brightness by `scale`.
pub(super) fn light(name: &str, l: &Illuminant) -> String {
    match l.curve() {
        Some((curve, by)) => param("spectrum", name, &pairs(curve)) + &float("scale", curve.luminance() * by),
        None => param("rgb", name, &numbers(l.rgb().to_array())),
    }
}

/// Glasses that pbrt knows by the same names.
const GLASSES: [&str; 7] =
    ["glass-BK7", "glass-BAF10", "glass-FK51A", "glass-LASF9", "glass-F5", "glass-F10", "glass-F11"];

/// An index of refraction, by wavelength where it depends on it; by name where it has one.
pub(super) fn index(name: &str, eta: &Ior) -> String {
    if let Ior::Constant(eta) = eta {
        return float(name, *eta);
    }
    let known = NAMED.iter().find(|n| n.ior() == Some(*eta)).map(|n| param("spectrum", name, &quoted(n.name)));
    let pbrts = NAMED.iter().any(|n| n.ior() == Some(*eta) && GLASSES.contains(&n.name));
    let curve = || param("spectrum", name, &pairs(&Curve::new(|nm| eta.at_nm(nm))));
    match known {
        Some(known) if pbrts => known,
        Some(known) => curve() + &ours(&known),
        None => curve(),
    }
}

/// An index of refraction, without names.
pub(super) fn plain_index(name: &str, eta: &Ior) -> String {
    if let Ior::Constant(eta) = eta { float(name, *eta) } else { curve(name, &Curve::new(|nm| eta.at_nm(nm))) }
}

/// A curve over wavelength.
pub(super) fn curve(name: &str, c: &Curve) -> String {
    param("spectrum", name, &pairs(c))
}

/// Pairs of wavelength and value: those that a straight line between others does not tell.
fn pairs(curve: &Curve) -> String {
    let all: Vec<(f32, f32)> = NM.map(|nm| (nm as f32, curve.at(nm as f32))).collect();
    let mut kept = vec![all[0]];
    let mut first = 0;
    for end in 2..all.len() {
        let ((x0, y0), (x1, y1)) = (all[first], all[end]);
        let straight = all[first + 1..end].iter().all(|(x, y)| {
            let on_line = y0 + (y1 - y0) * (x - x0) / (x1 - x0);
            (on_line - y).abs() <= 1e-6 * y.abs().max(1e-6)
        });
        if !straight {
            first = end - 1;
            kept.push(all[first]);
        }
    }
    kept.push(all[all.len() - 1]);
    numbers(kept.into_iter().flat_map(|(nm, v)| [nm, v]))
}

/// Three numbers.
pub(super) fn point(name: &str, p: Vec3) -> String {
    param("point3", name, &numbers(p.to_array()))
}

/// The numbers of `Transform`.
pub(super) fn matrix(m: &Affine3A) -> String {
    let column = |c: Vec3, w: f32| format!("{} {w}", numbers(c.to_array()));
    let [x, y, z] = [m.matrix3.x_axis, m.matrix3.y_axis, m.matrix3.z_axis].map(|c| column(c.into(), 0.0));
    format!("[ {x}  {y}  {z}  {} ]", column(m.translation.into(), 1.0))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn straight_parts_of_a_curve_take_two_pairs() {
        assert_eq!(pairs(&Curve::new(|_| 0.5)), "360 0.5 830 0.5");
        let bent = pairs(&Curve::new(|nm| (nm - 500.0).abs()));
        assert_eq!(bent, "360 140 500 0 830 330");
    }
}
