//! A scene in numbers.
use super::Loaded;
use crate::words::things;
use formats::diagnostic::{Diagnostic, Severity};
use serde::Serialize;

/// How much a scene holds.
#[derive(Clone, Debug, Serialize)]
pub(crate) struct SceneRecord {
    hash: String,
    surfaces: usize,
    triangles: usize,
    spheres: usize,
    instances: usize,
    /// Instances that move while the shutter is open.
    moving_instances: usize,
    moving_camera: bool,
    materials: usize,
    textures: usize,
    lights: usize,
    /// Memory of the ray index.
    index_bytes: usize,
}

/// A finding of the importer.
#[derive(Clone, Debug, Serialize)]
pub(crate) struct Warning {
    severity: &'static str,
    code: &'static str,
    message: String,
    file: Option<String>,
    line: Option<usize>,
    column: Option<usize>,
}

impl Warning {
    /// Whether a rule of the format is broken.
    pub(crate) fn is_error(&self) -> bool {
        self.severity == "error"
    }
}

impl From<&Diagnostic> for Warning {
    fn from(d: &Diagnostic) -> Self {
        let at = d.place.as_ref().and_then(|p| p.at.as_ref());
        Self {
            severity: if d.severity == Severity::Error { "error" } else { "warning" },
            code: d.code,
            message: d.message.clone(),
            file: d.place.as_ref().map(|p| p.file.clone()),
            line: at.map(|p| p.line),
            column: at.map(|p| p.column),
        }
    }
}

impl Loaded {
    /// Counts for programs.
    pub(crate) fn record(&self) -> SceneRecord {
        let c = self.scene.counts();
        SceneRecord {
            hash: self.hash.clone(),
            surfaces: c.surfaces,
            triangles: c.triangles,
            spheres: c.spheres,
            instances: c.instances,
            moving_instances: c.moving_instances,
            moving_camera: c.moving_camera,
            materials: c.materials,
            textures: c.textures,
            lights: c.lights,
            index_bytes: c.bvh_bytes,
        }
    }
    /// Counts for people; what there is none of goes unsaid.
    pub(crate) fn words(&self) -> String {
        let c = self.scene.counts();
        let all = [
            (c.triangles, "triangle", "triangles"),
            (c.spheres, "sphere", "spheres"),
            (c.instances, "instance", "instances"),
            (c.materials, "material", "materials"),
            (c.textures, "texture", "textures"),
            (c.lights, "light", "lights"),
        ];
        let words = |(n, one, many): (usize, &str, &str)| (n > 0).then(|| things(n as u64, one, many));
        let mut said: Vec<String> = all.into_iter().filter_map(words).collect();
        if c.moving_instances > 0 {
            said.push(format!("{} of the instances moving", c.moving_instances));
        }
        if c.moving_camera {
            said.push("a moving camera".to_owned());
        }
        said.join(", ")
    }
}
