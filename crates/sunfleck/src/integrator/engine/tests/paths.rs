//! Whole paths from the lens to a light.
use crate::{
    bsdf::Transport,
    camera::{CameraRay, Project, Spread},
    light::{Emitter, LightEnd, LightId},
    math::warp::square_to_sphere,
    sampler::Sampler,
    scene::{Interaction, World},
};
use glam::{Vec2, Vec3};

/// Surfaces on a path, at most.
const LONGEST: usize = 7;

/// A surface on a path.
pub(super) struct Vertex {
    /// As the camera's subpath comes to it.
    pub(super) at: Interaction,
    /// Unit direction on, toward the light.
    pub(super) wi: Vec3,
    pub(super) delta: bool,
}

pub(super) enum End {
    /// As the camera's subpath comes to it.
    Surface(Interaction),
    Point(LightId, Vec3),
    Infinite(LightId),
}

pub(super) struct Path {
    pub(super) raster: Vec2,
    pub(super) u_lens: Vec2,
    pub(super) camera: CameraRay,
    /// From the camera on, at least one.
    pub(super) vertices: Vec<Vertex>,
    pub(super) end: End,
}

impl Path {
    /// A path, if the numbers lead to one.
    pub(super) fn draw(world: &World, s: &mut Sampler) -> Option<Self> {
        let (raster, u_lens) = (s.next_2d(), s.next_2d());
        let camera = world.camera().ray(raster, u_lens);
        let (mut ray, mut vertices) = (camera.ray, Vec::new());
        let end = loop {
            let Some(at) = world.intersect(&ray) else {
                let from = ray.o;
                break End::Infinite(world.escaped(from, ray.d).find(|sky| !sky.le.is_black())?.light);
            };
            if !world.emitted(&at).is_black() {
                break End::Surface(at);
            }
            if vertices.len() == LONGEST {
                return None;
            }
            let (wi, delta, end) = go_on(world, &at, s)?;
            vertices.push(Vertex { at, wi, delta });
            if let Some(end) = end {
                break end;
            }
            ray = at.spawn(wi);
        };
        let mut path = Self { raster, u_lens, camera, vertices, end };
        path.straighten();
        (!path.vertices.is_empty()).then_some(path)
    }
    /// Rays start off their surfaces; here legs go from vertex to vertex. Parallel rays of the camera go where they go.
    fn straighten(&mut self) {
        let mut from = self.camera.ray.o;
        for i in 0..self.vertices.len() {
            let to = self.vertices[i].at.p - from;
            let at = &mut self.vertices[i].at;
            (at.distance, at.wo) = (to.length(), -to.normalize());
            if i == 0 && matches!(self.camera.spread, Spread::Area(_)) {
                at.wo = -self.camera.ray.d;
            }
            from = at.p;
            if i > 0 {
                self.vertices[i - 1].wi = to.normalize();
            }
        }
        let Some(last) = self.vertices.last_mut() else { return };
        match &mut self.end {
            End::Surface(at) => {
                let to = at.p - from;
                (at.distance, at.wo, last.wi) = (to.length(), -to.normalize(), to.normalize());
            }
            End::Point(_, p) => last.wi = (*p - from).normalize(),
            End::Infinite(_) => {}
        }
    }
    /// Length of the leg from vertex `i` toward the light.
    pub(super) fn leg_after(&self, i: usize) -> f32 {
        match (self.vertices.get(i + 1), &self.end) {
            (Some(next), _) => next.at.distance,
            (None, End::Surface(at)) => at.distance,
            (None, End::Point(_, p)) => p.distance(self.vertices[i].at.p),
            // Some way from outside.
            (None, End::Infinite(_)) => 7.0,
        }
    }
    pub(super) fn light(&self) -> LightId {
        match &self.end {
            End::Surface(at) => at.light.expect("an emitter"),
            End::Point(light, _) | End::Infinite(light) => *light,
        }
    }
    /// The path by Heckbert's letters, camera first.
    pub(super) fn letters(&self) -> String {
        let middle: String = self.vertices.iter().map(|v| if v.delta { 'S' } else { 'D' }).collect();
        let end = match self.end {
            End::Surface(_) => "surface",
            End::Point(..) => "point",
            End::Infinite(_) => "infinite",
        };
        format!("E{middle}L ({end})")
    }
}

/// A direction on, whether from a delta lobe, and the end of the path if it is there.
fn go_on(world: &World, at: &Interaction, s: &mut Sampler) -> Option<(Vec3, bool, Option<End>)> {
    let (choice, u_lobe, u) = (s.next_1d(), s.next_1d(), s.next_2d());
    if !at.is_connectible() {
        let s = at.sample(u_lobe, u, Transport::Radiance)?;
        return Some((s.wi, true, None));
    }
    let (wi, end) = if choice < 0.3 {
        let d = world.sample_direct(at.p, u_lobe, u)?;
        let end = match d.li.end {
            LightEnd::Point(p) => Some(End::Point(d.light, p)),
            LightEnd::Infinite if world.light(d.light).is_delta() => Some(End::Infinite(d.light)),
            _ => None,
        };
        if end.is_some() && world.occluded(&at.spawn_toward(d.li.wi, &d.li.end)) {
            return None;
        }
        (d.li.wi, end)
    } else if choice < 0.7 {
        (at.sample(u_lobe, u, Transport::Radiance)?.wi, None)
    } else {
        (square_to_sphere(u), None)
    };
    (!at.f_cos(wi, Transport::Radiance).is_black()).then_some((wi, false, end))
}
