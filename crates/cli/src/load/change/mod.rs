//! What the command line changes in a scene: materials, lights, the kind of camera.
//!
//! Many files in the wild carry no light, or no glass. `--material` and `--add-light` give them some. Both are told as
//! `KIND[:PRESET][:KEY=VALUE]...`; [`spec`] reads that, [`material`] and [`light`] make things of it.
mod light;
mod material;
mod spec;

use crate::failure::Failure;
use formats::diagnostic::Diagnostic;
use formats::load::Loaded;
use spec::Spec;
use sunfleck::scene::MaterialId;

pub(crate) use spec::{projection, replacement};

/// Changes all that was asked for.
pub(super) fn apply(read: &mut Loaded, materials: &[(String, String)], lights: &[String]) -> Result<(), Failure> {
    for (name, what) in materials {
        let spec = Spec::read("--material", what)?;
        let ids = found(read, name)?;
        for id in ids {
            let model = material::make(&spec, &mut read.builder)?;
            read.builder.replace_material(id, model);
            if let Some(interior) = material::interior(&spec, &read.builder, id)? {
                let interior = read.builder.interior(interior);
                read.builder.fill(id, interior);
            }
        }
        spec.tell_unknown()?;
    }
    for what in lights {
        let spec = Spec::read("--add-light", what)?;
        read.surfaces += usize::from(light::add(&spec, &mut read.builder)?);
        read.lights += 1;
        spec.tell_unknown()?;
    }
    Ok(())
}

/// The materials of a name: `*` for all, `#N` for number N of `sunfleck info`.
fn found(read: &Loaded, name: &str) -> Result<Vec<MaterialId>, Failure> {
    let count = read.builder.parts().materials.len() as u32;
    if name == "*" {
        return Ok((0..count).map(MaterialId).collect());
    }
    if let Some(number) = name.strip_prefix('#').and_then(|n| n.parse().ok()).filter(|n| *n < count) {
        return Ok(vec![MaterialId(number)]);
    }
    let ids: Vec<MaterialId> = read.materials.iter().filter(|(n, _)| n == name).map(|(_, id)| *id).collect();
    if !ids.is_empty() {
        return Ok(ids);
    }
    let message = format!("no material `{name}` in this scene");
    let error = Diagnostic::error("material::unknown", message);
    let known = read.materials.iter().map(|(n, _)| n.as_str()).chain(["*"]);
    let error = error.one_of(name, known).help("`sunfleck info` names all materials; `#N` is the one of number N");
    Err(formats::Error::from(error).into())
}
