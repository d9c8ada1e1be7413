//! `--filter KIND[:KEY=VALUE]...`.
use sunfleck::film::{Curve, Filter, MAX_FILTER_RADIUS};

/// Kinds of filters by name, with the settings that each has and what they are by default.
const KINDS: [(&str, &[(&str, f32)]); 7] = [
    ("box", &[("radius", 0.5)]),
    ("triangle", &[("radius", 1.0)]),
    ("gaussian", &[("radius", 1.5), ("sigma", 0.5)]),
    ("mitchell", &[("radius", 2.0), ("b", 1.0 / 3.0), ("c", 1.0 / 3.0)]),
    ("catmull-rom", &[("radius", 2.0)]),
    ("lanczos", &[("radius", 3.0), ("tau", 3.0)]),
    ("nrenderer", &[]),
];

/// A pixel filter.
pub(crate) fn filter(text: &str) -> Result<Filter, String> {
    let mut words = text.split(':');
    let kind = words.next().unwrap_or_default();
    let Some((name, settings)) = KINDS.iter().find(|(name, _)| *name == kind) else {
        let names: Vec<&str> = KINDS.iter().map(|(name, _)| *name).collect();
        return Err(format!("expected one of {}", names.join(", ")));
    };
    let mut values: Vec<(&str, f32)> = settings.to_vec();
    for word in words {
        let (key, value) = word.split_once('=').ok_or_else(|| format!("`{word}` is no `key=value`"))?;
        let known = || settings.iter().map(|(key, _)| *key).collect::<Vec<_>>().join(", ");
        let slot = values.iter_mut().find(|(k, _)| *k == key);
        let slot = slot.ok_or_else(|| format!("`{name}` has no setting `{key}`, but: {}", known()))?;
        slot.1 = value.trim().parse().map_err(|_| format!("`{value}` is no number"))?;
    }
    let get = |key| values.iter().find(|(k, _)| *k == key).map_or(0.0, |(_, v)| *v);
    let curve = match *name {
        "box" => Curve::Box,
        "triangle" => Curve::Tent,
        "gaussian" => Curve::Gaussian { sigma: get("sigma") },
        "mitchell" => Curve::Cubic { b: get("b"), c: get("c") },
        "catmull-rom" => Curve::Cubic { b: 0.0, c: 0.5 },
        "lanczos" => Curve::Lanczos { tau: get("tau") },
        _ => return Ok(Filter::NRenderer),
    };
    Filter::shaped(curve, glam::Vec2::splat(get("radius"))).ok_or_else(|| {
        format!("expected a radius of more than 0 and at most {MAX_FILTER_RADIUS} pixels, and a curve that is positive")
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_kind_is_read_with_its_defaults_and_its_settings() {
        for (name, settings) in KINDS {
            let plain = filter(name).unwrap();
            let mut words = vec![name.to_owned()];
            words.extend(settings.iter().map(|(key, value)| format!("{key}={value}")));
            assert_eq!(filter(&words.join(":")).unwrap(), plain);
        }
        assert_eq!(filter("box").unwrap(), Filter::Box);
        assert_eq!(
            filter("gaussian:radius=2:sigma=0.7").unwrap().shape().unwrap(),
            (Curve::Gaussian { sigma: 0.7 }, glam::Vec2::splat(2.0))
        );
    }

    #[test]
    fn mistakes_name_what_is_known() {
        assert!(filter("blur").unwrap_err().contains("mitchell"));
        assert!(filter("gaussian:width=2").unwrap_err().contains("radius, sigma"));
        assert!(filter("gaussian:radius").unwrap_err().contains("key=value"));
        for bad in ["box:radius=0", "triangle:radius=nan", "gaussian:sigma=-1", "lanczos:radius=99", "box:radius=x"] {
            assert!(filter(bad).is_err(), "{bad}");
        }
    }
}
