//! Indices of refraction by name.

use super::document::Found;
use super::props::Props;

/// Measured between 0 and 20 °C near 589 nm, as Mitsuba's documentation lists them for `dielectric`.
const INDICES: [(&str, f64); 23] = [
    ("vacuum", 1.0),
    ("helium", 1.000_036),
    ("hydrogen", 1.000_132),
    ("air", 1.000_277),
    ("carbon dioxide", 1.000_45),
    ("water", 1.333),
    ("acetone", 1.36),
    ("ethanol", 1.361),
    ("carbon tetrachloride", 1.461),
    ("glycerol", 1.4729),
    ("benzene", 1.501),
    ("silicone oil", 1.520_45),
    ("bromine", 1.661),
    ("water ice", 1.31),
    ("fused quartz", 1.458),
    ("pyrex", 1.47),
    ("acrylic glass", 1.49),
    ("polypropylene", 1.49),
    ("bk7", 1.5046),
    ("sodium chloride", 1.544),
    ("amber", 1.55),
    ("pet", 1.575),
    ("diamond", 2.419),
];

/// The index of the inside over that of the outside.
pub(super) fn relative(props: &Props, inside: &'static str) -> Found<f32> {
    let eta = index(props, "int_ior", inside)? / index(props, "ext_ior", "air")?;
    if eta > 0.0 { Ok(eta as f32) } else { Err(props.bad("an index of refraction must be greater than 0")) }
}

/// An index by number or by name.
pub(super) fn index(props: &Props, name: &'static str, default: &str) -> Found<f64> {
    let find = |wanted: &str| {
        let wanted = wanted.trim().to_ascii_lowercase();
        INDICES.iter().find(|(name, _)| *name == wanted).map(|(_, eta)| *eta)
    };
    let Some((_, element)) = props.get(name) else { return Ok(find(default).unwrap_or(1.5)) };
    if element.tag != "string" {
        return props.float(name, 1.5);
    }
    let value = element.required("value")?;
    find(&value.value).ok_or_else(|| value.at.unknown("medium", &value.value, INDICES.iter().map(|(name, _)| *name)))
}
