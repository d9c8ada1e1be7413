//! `sunfleck info`: what a scene holds, without rendering it.
use crate::{
    args::InfoArgs,
    console,
    failure::Failure,
    load::{self, Eye, Inventory, Loaded, SceneRecord, Warning},
    table::aligned,
    words::{count, things},
};
use serde::Serialize;
use std::collections::BTreeMap;
use sunfleck::{light::Emitter, scene::MID_SHUTTER, spectrum::Wavelengths};

/// Materials that are told of one by one; of more, how many there are of each model.
const MATERIALS_SHOWN: usize = 20;
/// Lights that are told of one by one; of more, only the number is.
const LIGHTS_SHOWN: usize = 20;

/// What is said at the end of a file that can be read.
const BREAKS_RULES: &str = "the scene can be rendered, but its file breaks rules of its format";

/// Fails, with all told, if a file breaks rules of its format.
pub(crate) fn run(args: &InfoArgs) -> Result<(), Failure> {
    let loaded = load::scene(&args.scene, &args.camera, args.compat, false)?;
    loaded.say_warnings();
    let info = Info::new(args, &loaded);
    let told = if args.json { console::print_json(&info) } else { console::print(&info.text(&loaded)) };
    told?;
    let broken = loaded.warnings().filter(Warning::is_error).count();
    if broken == 0 { Ok(()) } else { Err(Failure::Work(anyhow::Error::msg(BREAKS_RULES))) }
}

#[derive(Serialize)]
struct Info {
    files: Vec<String>,
    scene: SceneRecord,
    camera: Eye,
    /// Whether some material parts colours, so that it is rendered by wavelength unless `--color` says otherwise.
    dispersive: bool,
    /// How many materials there are of each model.
    materials: BTreeMap<&'static str, usize>,
    lights: Vec<LightInfo>,
    /// Materials and textures one by one, with how often they are used, and memory.
    inventory: Inventory,
    /// Files that are missing.
    missing: Vec<String>,
    /// A sphere around all geometry.
    bounds: Bounds,
    warnings: Vec<Warning>,
}

#[derive(Serialize)]
struct LightInfo {
    kind: &'static str,
    /// Emitted flux by channel, W; of surroundings, what falls on the scene.
    power: [f32; 3],
}

#[derive(Serialize)]
struct Bounds {
    centre: [f32; 3],
    radius: f32,
}

impl Info {
    fn new(args: &InfoArgs, loaded: &Loaded) -> Self {
        let scene = &loaded.scene;
        let around = scene.surroundings(Wavelengths::Rgb);
        let mut materials = BTreeMap::new();
        scene.materials().iter().for_each(|m| *materials.entry(m.name()).or_default() += 1);
        let light = |l: &sunfleck::light::Light| LightInfo { kind: l.name(), power: l.power(&around).to_array() };
        Self {
            files: args.scene.files.iter().map(|f| f.display().to_string()).collect(),
            scene: loaded.record(),
            camera: loaded.eye,
            dispersive: scene.is_dispersive(),
            materials,
            lights: scene.world(Wavelengths::Rgb, MID_SHUTTER).lights().map(light).collect(),
            inventory: loaded.inventory.clone(),
            missing: loaded.missing().map(str::to_owned).collect(),
            bounds: Bounds { centre: around.centre.to_array(), radius: around.radius },
            warnings: loaded.warnings().collect(),
        }
    }

    fn text(&self, loaded: &Loaded) -> String {
        let list = |v: [f32; 3]| v.map(|x| x.to_string()).join(", ");
        let bytes = loaded.scene.counts().bvh_bytes;
        let mut rows = vec![
            ("files", self.files.join(", ")),
            ("holds", loaded.words()),
            ("bounds", format!("a sphere of radius {} around ({})", self.bounds.radius, list(self.bounds.centre))),
            ("camera", self.camera.words()),
            ("memory", self.memory(bytes)),
            ("hash", loaded.hash.clone()),
        ];
        if self.dispersive {
            rows.push(("color", "spectral: some material parts wavelengths".to_owned()));
        }
        rows.extend(self.material_rows().map(|row| ("material", row)));
        rows.extend(self.texture_row().map(|row| ("textures", row)));
        let light = |l: &LightInfo| ("light", format!("{}, {} W", l.kind, list(l.power)));
        rows.extend(self.lights.iter().take(LIGHTS_SHOWN).map(light));
        if let more @ 1.. = self.lights.len().saturating_sub(LIGHTS_SHOWN) {
            rows.push(("", format!("and {}", things(more as u64, "light more", "lights more"))));
        }
        rows.extend(self.unused_row().map(|row| ("unused", row)));
        rows.extend(self.missing.iter().map(|m| ("missing", m.clone())));
        let rows: Vec<[String; 2]> = rows.into_iter().map(|(name, value)| [name.to_owned(), value]).collect();
        aligned(&rows)
    }

    fn memory(&self, index: usize) -> String {
        let all = [
            (self.inventory.geometry_bytes, "geometry"),
            (self.inventory.texture_bytes, "textures"),
            (index, "ray index"),
        ];
        all.map(|(bytes, what)| format!("{}B of {what}", count(bytes as f64))).join(", ")
    }

    fn material_rows(&self) -> Box<dyn Iterator<Item = String> + '_> {
        let all = &self.inventory.materials;
        if all.len() > MATERIALS_SHOWN {
            return Box::new(self.materials.iter().map(|(model, n)| format!("{n} × {model}")));
        }
        Box::new(all.iter().enumerate().map(|(i, m)| {
            let name = m.name.as_ref().map(|n| format!(" `{n}`")).unwrap_or_default();
            format!("#{i}{name}: {}, used {}", m.model, things(m.uses as u64, "time", "times"))
        }))
    }

    /// Pictures and patterns; `None` if there are only plain colours.
    fn texture_row(&self) -> Option<String> {
        let textures = &self.inventory.textures;
        let pixels: usize = textures.iter().filter_map(|t| t.size).map(|[w, h]| w * h).sum();
        let mut kinds: BTreeMap<&str, usize> = BTreeMap::new();
        textures.iter().for_each(|t| *kinds.entry(t.kind).or_default() += 1);
        let kinds: Vec<String> = kinds.iter().map(|(kind, n)| format!("{n} × {kind}")).collect();
        (!kinds.is_empty()).then(|| format!("{}, {} pixels", kinds.join(", "), count(pixels as f64)))
    }

    /// What nothing refers to; `None` if everything is used.
    fn unused_row(&self) -> Option<String> {
        let Inventory { materials, textures, unused_objects, .. } = &self.inventory;
        let counts = [
            (materials.iter().filter(|m| m.uses == 0).count(), "material", "materials"),
            (textures.iter().filter(|t| t.uses == 0).count(), "texture", "textures"),
            (*unused_objects, "object", "objects"),
        ];
        let said = counts.into_iter().filter(|(n, ..)| *n > 0).map(|(n, one, many)| things(n as u64, one, many));
        let said: Vec<String> = said.collect();
        (!said.is_empty()).then(|| said.join(", "))
    }
}
