//! `sunfleck info`: what a scene holds, without rendering it.
use crate::{
    args::InfoArgs,
    console,
    failure::Failure,
    load::{self, Eye, Loaded, SceneRecord, Warning},
    table::aligned,
    words::{count, things},
};
use serde::Serialize;
use std::collections::BTreeMap;
use sunfleck::{light::Emitter, scene::MID_SHUTTER, spectrum::Wavelengths};

/// Lights that are told of one by one; of more, only the number is.
const LIGHTS_SHOWN: usize = 20;

pub(crate) fn run(args: &InfoArgs) -> Result<(), Failure> {
    let loaded = load::scene(&args.scene, &args.camera, args.compat, false)?;
    loaded.say_warnings();
    let info = Info::new(args, &loaded);
    if args.json { console::print_json(&info) } else { console::print(&info.text(&loaded)) }
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
            ("memory", format!("{}B of ray index", count(bytes as f64))),
            ("hash", loaded.hash.clone()),
        ];
        if self.dispersive {
            rows.push(("color", "spectral: some material parts wavelengths".to_owned()));
        }
        rows.extend(self.materials.iter().map(|(model, n)| ("material", format!("{n} × {model}"))));
        let light = |l: &LightInfo| ("light", format!("{}, {} W", l.kind, list(l.power)));
        rows.extend(self.lights.iter().take(LIGHTS_SHOWN).map(light));
        if let more @ 1.. = self.lights.len().saturating_sub(LIGHTS_SHOWN) {
            rows.push(("", format!("and {}", things(more as u64, "light more", "lights more"))));
        }
        let rows: Vec<[String; 2]> = rows.into_iter().map(|(name, value)| [name.to_owned(), value]).collect();
        aligned(&rows)
    }
}
