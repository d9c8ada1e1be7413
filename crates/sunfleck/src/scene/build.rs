//! Putting a scene together, and checking it once so that passes need not.
use super::{
    Looks, MaterialId, ObjectId, Scene, Surface, TextureId,
    moment::{Moment, Placement, freeze, hierarchies},
    moving::{Emitters, Geometry, Moving, Place, Places},
    parts::{Instance, Parts},
};
use crate::{
    bsdf::{Material, cover::is_porous},
    camera::{Camera, Perspective, Project, View},
    light::{Light, Sides, Surroundings},
    math::Motion,
    medium::{Interior, InteriorId},
    shape::Shape,
    spectrum::{Colour, Illuminant, Wavelengths},
    texture::Texture,
};
use glam::{Affine3A, Vec3};
use std::sync::Arc;

/// A surface to add.
#[derive(Clone, Debug)]
pub struct SurfaceDef {
    /// Geometry, in the space of what it is added to.
    pub shape: Shape,
    /// Scattering.
    pub material: MaterialId,
    /// Emitted radiance W/(m²·sr) and the sides that emit.
    pub emission: Option<(Illuminant, Sides)>,
}

/// Why a scene cannot be built.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum SceneError {
    /// A handle that names nothing.
    #[error("{what} {id} does not exist: the scene has {count}")]
    Missing {
        /// Kind of handle.
        what: &'static str,
        /// Its number.
        id: u32,
        /// How many there are.
        count: usize,
    },
    /// An emitting sphere in an instance that stretches or shears it.
    #[error("object {object} holds an emitting sphere and is placed with uneven scaling, which has no exact light")]
    StretchedLight {
        /// Which object.
        object: u32,
    },
    /// A movement that would have to flatten the object on the way.
    #[error("object {object} cannot move: one of its two placements has no inverse, or is a mirror image of the other")]
    Motion {
        /// Which object.
        object: u32,
    },
    /// More interiors than handles.
    #[error("a scene can have 65535 interiors, and this one has {0}")]
    Interiors(usize),
    /// A movement of the camera that would have to turn it inside out on the way.
    #[error("the camera cannot move: its two views are of different kinds, or one is a mirror image of the other")]
    CameraMotion,
}

/// Collects a scene. Handles are given out in order and checked by [`SceneBuilder::build`].
#[derive(Clone, Debug, Default)]
pub struct SceneBuilder {
    textures: Vec<Texture>,
    materials: Vec<Material>,
    interiors: Vec<Interior>,
    /// What lies behind materials, by [`MaterialId`]; the rest have none.
    fillings: Vec<Option<InteriorId>>,
    surfaces: Vec<SurfaceDef>,
    objects: Vec<Vec<SurfaceDef>>,
    instances: Vec<Instance>,
    lights: Vec<Light>,
    camera: Option<Camera>,
    /// Where the camera goes, if it moves.
    camera_to: Option<Camera>,
    quality: Quality,
}

/// How much time the ray index may take to build.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Default)]
pub enum Quality {
    /// Quick to build.
    #[default]
    Default,
    /// Slower to build, faster to trace.
    High,
}

impl SceneBuilder {
    /// An empty scene.
    pub fn new() -> Self {
        Self::default()
    }
    /// What was added so far.
    pub fn parts(&self) -> Parts<'_> {
        let Self { textures, materials, interiors, fillings, surfaces, objects, instances, lights, .. } = self;
        Parts { textures, materials, interiors, fillings, surfaces, objects, instances, lights }
    }
    /// Puts another material in the place of `id`, wherever that is used. False if there is no such material.
    pub fn replace_material(&mut self, id: MaterialId, m: impl Into<Material>) -> bool {
        self.materials.get_mut(id.0 as usize).map(|old| *old = m.into()).is_some()
    }
    /// Gives all surfaces of the material `old` the material `new`.
    pub fn exchange_material(&mut self, old: MaterialId, new: MaterialId) {
        let all = self.surfaces.iter_mut().chain(self.objects.iter_mut().flatten());
        all.filter(|s| s.material == old).for_each(|s| s.material = new);
    }
    /// Adds a texture.
    pub fn texture(&mut self, t: Texture) -> TextureId {
        self.textures.push(t);
        TextureId(self.textures.len() as u32 - 1)
    }
    /// Adds a texture of one colour.
    pub fn constant(&mut self, c: impl Into<Colour>) -> TextureId {
        self.texture(Texture::Constant(c.into()))
    }
    /// Adds a material.
    pub fn material(&mut self, m: impl Into<Material>) -> MaterialId {
        self.materials.push(m.into());
        MaterialId(self.materials.len() as u32 - 1)
    }
    /// Adds an interior.
    pub fn interior(&mut self, i: Interior) -> InteriorId {
        self.interiors.push(i);
        InteriorId(u16::try_from(self.interiors.len() - 1).unwrap_or(u16::MAX))
    }
    /// Puts `interior` behind all surfaces of the material `id`, on the side that normals point away from. What lies behind
    /// the parts of a covering does not count.
    pub fn fill(&mut self, id: MaterialId, interior: InteriorId) {
        let at = id.0 as usize;
        self.fillings.resize(self.fillings.len().max(at + 1), None);
        self.fillings[at] = Some(interior);
    }
    /// Adds a material like `id`, with `interior` behind it. A handle that names nothing stays one.
    pub fn filled(&mut self, id: MaterialId, interior: InteriorId) -> MaterialId {
        let Some(same) = self.materials.get(id.0 as usize).cloned() else { return id };
        let filled = self.material(same);
        self.fill(filled, interior);
        filled
    }
    /// Adds a surface in world space.
    pub fn surface(&mut self, s: SurfaceDef) {
        self.surfaces.push(s);
    }
    /// Adds a surface that does not emit.
    pub fn add(&mut self, shape: Shape, material: MaterialId) {
        self.surface(SurfaceDef { shape, material, emission: None });
    }
    /// Adds an object, seen only where [`SceneBuilder::place`] puts it.
    pub fn object(&mut self, surfaces: Vec<SurfaceDef>) -> ObjectId {
        self.objects.push(surfaces);
        ObjectId(self.objects.len() as u32 - 1)
    }
    /// Places an object in the world.
    pub fn place(&mut self, object: ObjectId, world_from_object: Affine3A) {
        self.instances.push(Instance { object, from: world_from_object, to: None });
    }
    /// Places an object that moves while the shutter is open, as [`Motion`] does between the two maps; emitting surfaces
    /// move with it. Take apart what moves for longer than the shutter is open, or turns further, with [`Motion::at`].
    pub fn place_moving(&mut self, object: ObjectId, from: Affine3A, to: Affine3A) {
        self.instances.push(Instance { object, from, to: (from != to).then_some(to) });
    }
    /// Adds a light that is not a surface.
    pub fn light(&mut self, l: impl Into<Light>) {
        self.lights.push(l.into());
    }
    /// Sets the eye.
    pub fn camera(&mut self, c: impl Into<Camera>) {
        (self.camera, self.camera_to) = (Some(c.into()), None);
    }
    /// Sets an eye that moves while the shutter is open, from one view to another of the same kind.
    pub fn camera_moving(&mut self, from: impl Into<Camera>, to: impl Into<Camera>) {
        (self.camera, self.camera_to) = (Some(from.into()), Some(to.into()));
    }
    /// Sets the effort for the ray index.
    pub fn quality(&mut self, q: Quality) {
        self.quality = q;
    }

    /// Checks all handles, turns emission into lights, and builds the ray index. Without a camera, one at
    /// (0, 0, −3) looks at the origin under 40 degrees, as NRenderer's does.
    ///
    /// # Errors
    /// A handle that names nothing, or a light that cannot be placed.
    pub fn build(mut self) -> Result<Scene, SceneError> {
        self.check()?;
        let (places, emitters) = self.arrange()?;
        let camera = self.camera.take().unwrap_or_else(default_camera);
        if self.camera_to.as_ref().is_some_and(|to| camera.between(to, 0.5).is_none()) {
            return Err(SceneError::CameraMotion);
        }
        let mut lights = std::mem::take(&mut self.lights);
        let mut group = |g: Vec<SurfaceDef>| g.into_iter().map(|s| freeze(s, 0, &mut lights)).collect::<Vec<Surface>>();
        let surfaces = group(std::mem::take(&mut self.surfaces));
        let dark = |o: Vec<SurfaceDef>| o.into_iter().filter(|s| s.emission.is_none()).collect();
        let mut objects: Vec<Vec<Surface>> =
            std::mem::take(&mut self.objects).into_iter().map(|o| group(dark(o))).collect();
        let moves = !emitters.is_empty() || places.iter().any(|(_, place)| matches!(place, Place::Moving(_)));
        let quality = self.quality.into();
        let (geometry, around) = if moves {
            let moving = Moving::new(surfaces, &mut objects, places, emitters, quality);
            let around = surroundings(&moving.swept());
            (Geometry::Moving(moving), around)
        } else {
            let placements = places.iter().map(|(o, place)| Placement::new(*o, place.at(0.0))).collect();
            let moment = Moment::new(&hierarchies(&objects, quality), surfaces, placements, quality);
            let around = surroundings(&moment.bvh.bounds());
            (Geometry::Still(Arc::new(moment.with_lights(&lights, Vec::new(), &around))), around)
        };
        let Self { textures, materials, interiors, fillings, camera_to, .. } = self;
        let porous = porous(&materials, &fillings);
        let mut looks = looks(&materials, &textures);
        for (look, filling) in looks.iter_mut().zip(&fillings) {
            look.interior = *filling;
            // What lies on the other side is not looked up again.
            look.has_means &= filling.is_none();
            // Its scattering depends on what is before it.
            look.at_place_alone &= filling.is_none_or(|id| interiors[usize::from(id.0)].priority == 0);
        }
        let has_means = looks.iter().any(|l| l.has_means);
        let crowded = false.into();
        Ok(Scene {
            textures,
            materials,
            porous,
            looks,
            has_means,
            interiors,
            crowded,
            objects,
            lights,
            geometry,
            camera,
            camera_to,
            around,
        })
    }

    fn check(&self) -> Result<(), SceneError> {
        let check = |what, id: u32, count: usize| {
            if (id as usize) < count { Ok(()) } else { Err(SceneError::Missing { what, id, count }) }
        };
        for s in self.surfaces.iter().chain(self.objects.iter().flatten()) {
            check("material", s.material.0, self.materials.len())?;
        }
        for t in self.materials.iter().flat_map(Material::textures) {
            check("texture", t.0, self.textures.len())?;
        }
        if self.interiors.len() > usize::from(u16::MAX) {
            return Err(SceneError::Interiors(self.interiors.len()));
        }
        for filling in self.fillings.iter().flatten() {
            check("interior", u32::from(filling.0), self.interiors.len())?;
        }
        if let Some(last) = self.fillings.len().checked_sub(1) {
            check("material", last as u32, self.materials.len())?;
        }
        // A material is laid over earlier ones, so that finding what is met comes to an end.
        for (count, m) in self.materials.iter().enumerate() {
            m.parts().iter().try_for_each(|part| check("material", part.0, count))?;
        }
        // A texture is made of earlier ones, so that looking one up comes to an end.
        for (count, t) in self.textures.iter().enumerate() {
            t.parts().iter().try_for_each(|part| check("texture", part.0, count))?;
        }
        self.instances.iter().try_for_each(|i| check("object", i.object.0, self.objects.len()))
    }

    /// Where objects are, and the emitting surfaces that move. Emitting surfaces of objects that stand still are copied
    /// into the world at each placement, so that every light has one place.
    fn arrange(&mut self) -> Result<(Places, Emitters), SceneError> {
        let (mut places, mut emitters) = (Vec::new(), Vec::new());
        for &Instance { object, from, to } in &self.instances {
            let place = match to {
                None => Place::Still(from),
                Some(to) => Place::Moving(Motion::new(&from, &to).ok_or(SceneError::Motion { object: object.0 })?),
            };
            let (emitting, dark): (Vec<_>, Vec<_>) =
                self.objects[object.0 as usize].iter().partition(|s| s.emission.is_some());
            for s in emitting {
                let stretched = || SceneError::StretchedLight { object: object.0 };
                let shape = s.shape.transformed(&from).ok_or_else(stretched)?;
                match place {
                    Place::Still(_) => self.surfaces.push(SurfaceDef { shape, ..s.clone() }),
                    Place::Moving(motion) => {
                        s.shape.transformed(&motion.at(1.0)).ok_or_else(stretched)?;
                        emitters.push((s.clone(), motion));
                    }
                }
            }
            // An object with nothing left needs no placing; one that moves is kept to be counted.
            if !dark.is_empty() || to.is_some() {
                places.push((object, place));
            }
        }
        Ok((places, emitters))
    }
}

/// Whether rays may pass each material; empty if they pass none. Holes in what has an interior are surfaces, which paths cross
/// unbent.
fn porous(materials: &[Material], fillings: &[Option<InteriorId>]) -> Vec<bool> {
    let mut porous = Vec::with_capacity(materials.len());
    for m in materials {
        porous.push(is_porous(m, &porous));
    }
    porous.iter_mut().zip(fillings).for_each(|(p, filling)| *p &= filling.is_none());
    if porous.contains(&true) { porous } else { Vec::new() }
}

/// What each material looks at.
fn looks(materials: &[Material], textures: &[Texture]) -> Vec<Looks> {
    // Textures are made of earlier ones.
    let made_of = |is: fn(&Texture) -> bool| {
        let mut all: Vec<bool> = Vec::with_capacity(textures.len());
        for t in textures {
            all.push(is(t) || t.parts().iter().any(|part| all[part.0 as usize]));
        }
        all
    };
    let (of_vertices, of_means) = (made_of(Texture::asks_vertices), made_of(Texture::has_means));
    // Coverings are made of earlier materials.
    let mut means: Vec<bool> = Vec::with_capacity(materials.len());
    for m in materials {
        let own = m.textures().iter().any(|t| of_means[t.0 as usize]);
        means.push(own || m.parts().iter().any(|part| means[part.0 as usize]));
    }
    let one = |(m, has_means): (&Material, bool)| {
        let own = m.textures();
        let even = own.iter().all(|t| matches!(textures[t.0 as usize], Texture::Constant(_)));
        let asks_vertices = own.iter().any(|t| of_vertices[t.0 as usize]);
        Looks {
            is_even: m.is_plain() && even,
            at_place_alone: m.is_plain() && !asks_vertices,
            has_means,
            interior: None,
        }
    };
    materials.iter().zip(means).map(one).collect()
}

impl From<Quality> for accel::Quality {
    fn from(q: Quality) -> Self {
        match q {
            Quality::Default => Self::Default,
            Quality::High => Self::High,
        }
    }
}

/// A sphere around all geometry; a unit one around the origin when there is none.
fn surroundings(b: &accel::Aabb) -> Surroundings {
    let radius = 0.5 * (b.max - b.min).length();
    let usable = radius.is_finite() && radius > 0.0 && !b.is_empty();
    let (centre, radius) = if usable { (b.centre(), radius) } else { (Vec3::ZERO, 1.0) };
    Surroundings { centre, radius, lambda: Wavelengths::Rgb }
}

fn default_camera() -> Camera {
    let view = View { position: Vec3::new(0.0, 0.0, -3.0), look_at: Vec3::ZERO, up: Vec3::Y };
    Perspective::new(&view, 40.0, 1.0).expect("constants are in range").into()
}
