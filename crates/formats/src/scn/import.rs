//! From the tree of an `.scn` file to surfaces and lights of a scene.

use super::appearance::appearance;
use super::{LightKind, Plane, ScnFile, ScnLight, ScnModel, ScnOptions, ScnShape, ShapeKind, Triangle, parse};
use crate::diagnostic::{Diagnostic, Error, SourceFile, Span};
use crate::load::{LoadOptions, SceneFormat, Target};
use glam::Vec3;
use std::collections::BTreeMap;
use std::path::Path;
use sunfleck::bsdf::BlackMaterial;
use sunfleck::light::{DirectionalLight, PointLight, SpotLight};
use sunfleck::scene::MaterialId;
use sunfleck::shape::{Mesh, Parallelogram, Shape, Sphere};

/// The entry in the list of scene formats.
pub(crate) const FORMAT: SceneFormat = SceneFormat {
    name: "NRenderer scene",
    extensions: &["scn"],
    about: "NRenderer's text scenes: materials, spheres, triangles, planes, lights",
    is_mesh: false,
    load,
};

fn load(path: &Path, options: &LoadOptions, target: &mut Target) -> Result<(), Error> {
    let source = SourceFile::read(path)?;
    target.input(source.bytes());
    let tree = parse(&source, options.scn.comma(), &mut target.sink);
    target.sink.finish(())?;
    import(&tree, &source, options.scn, target);
    Ok(())
}

/// Adds what `tree` holds to a scene; `tree` must come from [`parse`] without errors. Problems go to the target's sink.
pub(crate) fn import(tree: &ScnFile, source: &SourceFile, options: ScnOptions, target: &mut Target) {
    let materials = tree.materials.iter().map(|m| appearance(m, source, options, target)).collect();
    let mut import = Import { source, options, target, materials };
    for model in &tree.models {
        import.model(model);
    }
    for light in &tree.lights {
        import.light(light);
    }
}

struct Import<'a> {
    source: &'a SourceFile,
    options: ScnOptions,
    target: &'a mut Target,
    materials: Vec<MaterialId>,
}

impl Import<'_> {
    fn warn(&mut self, code: &'static str, span: Span, label: &str, message: impl FnOnce() -> String) {
        let source = self.source;
        self.target.sink.warn(code, || Diagnostic::warning(code, message()).at(source, span, label));
    }

    fn model(&mut self, model: &ScnModel) {
        if let Some(scale) = model.scale.as_ref().filter(|s| s.value != Vec3::ONE) {
            self.warn("scn::scale", scale.span, "ignored, as by NRenderer's renderers", || {
                "`Scale` only changes the preview of NRenderer".to_owned()
            });
        }
        // One mesh holds all triangles of a material.
        let mut triangles: BTreeMap<usize, Vec<Vec3>> = BTreeMap::new();
        for shape in &model.shapes {
            if let ShapeKind::Triangle(triangle) = &shape.kind {
                let corners = self.triangle(triangle, shape.name.span, model.translation);
                triangles.entry(shape.material).or_default().extend(corners.into_iter().flatten());
            } else if let Some(geometry) = self.geometry(shape, model.translation) {
                self.target.surface(geometry, self.materials[shape.material], None);
            }
        }
        for (material, positions) in triangles {
            let indices = (0..positions.len() as u32 / 3).map(|i| [3 * i, 3 * i + 1, 3 * i + 2]).collect::<Vec<_>>();
            if indices.is_empty() {
                continue;
            }
            let mesh = Mesh::new(positions, Vec::new(), Vec::new(), indices).expect("indices count the positions");
            self.target.surface(Shape::Mesh(mesh), self.materials[material], None);
        }
    }

    /// A sphere or plane in world space; `None` with a warning if there is nothing to see of it.
    fn geometry(&mut self, shape: &ScnShape, translation: Vec3) -> Option<Shape> {
        let span = shape.name.span;
        match &shape.kind {
            ShapeKind::Sphere(sphere) if sphere.radius > 0.0 => {
                Some(Shape::Sphere(Sphere { centre: sphere.centre + translation, radius: sphere.radius }))
            }
            ShapeKind::Sphere(sphere) => {
                self.warn("scn::empty-shape", span, "dropped", || format!("a sphere of radius {}", sphere.radius));
                None
            }
            ShapeKind::Plane(plane) => self.plane(plane, span, translation),
            ShapeKind::Triangle(_) => None,
        }
    }

    fn plane(&mut self, plane: &Plane, span: Span, translation: Vec3) -> Option<Shape> {
        let turned = self.orientation(plane.u, plane.v, plane.normal, "the edges `U` and `V`", span)?;
        let (u, v) = if turned { (plane.v, plane.u) } else { (plane.u, plane.v) };
        Some(Shape::Parallelogram(Parallelogram::new(plane.corner + translation, u, v)))
    }

    fn triangle(&mut self, triangle: &Triangle, span: Span, translation: Vec3) -> Option<[Vec3; 3]> {
        let [a, b, c] = triangle.vertices;
        let turned = self.orientation(b - a, c - a, triangle.normal, "the triangle", span)?;
        let order = if turned { [a, c, b] } else { [a, b, c] };
        Some(order.map(|p| p + translation))
    }

    /// Whether the edges must be swapped for the outer side to be that of the stored normal. `None`, with a warning, if
    /// they span nothing.
    fn orientation(&mut self, u: Vec3, v: Vec3, normal: Vec3, what: &str, span: Span) -> Option<bool> {
        let spanned = u.cross(v);
        // Below this the area is rounding error of the products.
        let flat = spanned.length() <= 1e-6 * u.length() * v.length();
        if flat || !spanned.is_finite() {
            self.warn("scn::empty-shape", span, "dropped", || "a shape without area".to_owned());
            return None;
        }
        let cosine = spanned.normalize().dot(normal.normalize_or_zero());
        if cosine.abs() < 0.999 {
            self.warn("scn::normal", span, "its edges decide", || {
                format!("the stored normal `N` is not perpendicular to {what}")
            });
        }
        Some(cosine < 0.0)
    }

    fn light(&mut self, light: &ScnLight) {
        let power = Vec3::from_array(light.irv);
        if power.min_element() < 0.0 {
            self.warn("scn::negative-light", light.name.span, "negative parts are taken as 0", || {
                format!("a light with `IRV` {} {} {}", power.x, power.y, power.z)
            });
        }
        let power = power.max(Vec3::ZERO);
        match light.kind {
            LightKind::Point => self.target.light(PointLight { p: light.position, intensity: power.into() }),
            LightKind::Area => self.area_light(light, power),
            LightKind::Spot => {
                let spot = SpotLight::new(light.position, light.direction, power, [light.hot_spot, light.fallout]);
                match spot {
                    Ok(spot) => self.target.light(spot),
                    Err(error) => self.bad_light(light, error.to_string()),
                }
            }
            LightKind::Directional => match DirectionalLight::new(light.direction, power) {
                Some(directional) => self.target.light(directional),
                None => self.bad_light(light, "a directional light needs a direction `D`".to_owned()),
            },
        }
    }

    fn bad_light(&mut self, light: &ScnLight, message: String) {
        let error = Diagnostic::error("scn::bad-light", message).at(self.source, light.name.span, "this light");
        self.target.sink.error(error);
    }

    /// Lights of NRenderer swallow what meets them, so their body is black.
    fn area_light(&mut self, light: &ScnLight, radiance: Vec3) {
        let area = light.u.cross(light.v);
        if !area.is_finite() || area.length() <= 1e-6 * light.u.length() * light.v.length() {
            return self.warn("scn::empty-shape", light.name.span, "dropped", || "a light without area".to_owned());
        }
        let shape = Shape::Parallelogram(Parallelogram::new(light.position, light.u, light.v));
        let black = self.target.builder().material(BlackMaterial);
        self.target.surface(shape, black, Some((radiance.into(), self.options.sides())));
    }
}
