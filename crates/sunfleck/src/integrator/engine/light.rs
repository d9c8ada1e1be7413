//! Light subpaths: what a pass knows of the light before the first camera ray.
use super::{
    camera::Only,
    chains::Chains,
    joins::Departed,
    mis::{Leg, Rule, Sums},
    techniques::{Merge, Technique},
    track::Track,
    vertex::{LightVertex, Photon, Vertices},
};
use crate::{
    bsdf::{Lobes, Transport},
    camera::{CameraSample, Project},
    film::{Counts, FilmSpec, PassImage, Splat, Splats},
    integrator::{
        Pass,
        eye_ray::{lens_point, seen_from_lens},
    },
    photon::{Emission, Radii, RadiusMap, Source, Span},
    sampler::{Domain, Sampler},
    scene::{Interaction, Scattered, World},
    walk::{Arrival, Limits, Step, Visit, walk},
};
use accel::concat;
use glam::{Vec2, Vec3};
use rayon::prelude::*;
use std::ops::Range;

/// Light subpaths to walk.
pub(super) struct Shower<'w> {
    pub(super) world: &'w World<'w>,
    pub(super) rule: Rule,
    /// Which photons are kept; `rule` says which of them are merged beside other samplers.
    pub(super) keep: Merge,
    pub(super) source: &'w Source,
    /// When whole paths end.
    pub(super) limits: Limits,
    pub(super) radii: &'w Radii,
    /// Radius of this pass over the first.
    pub(super) shrink: f32,
    pub(super) pass: &'w Pass,
    /// Numbers of the paths.
    pub(super) paths: Range<u64>,
    /// What splats are multiplied by.
    pub(super) share: f32,
    pub(super) spec: FilmSpec,
    /// Set to see one sampler alone.
    pub(super) only: Option<Only>,
    /// Set if each path is only the beginning of a chain.
    pub(super) chains: Option<&'w Chains>,
}

/// All light subpaths of a pass.
#[derive(Default)]
pub(super) struct Subpaths {
    pub(super) positions: Vec<Vec3>,
    pub(super) photons: Vec<Photon>,
    /// Those of [`CHUNK`] paths each.
    vertices: Vec<Vertices>,
}

impl Subpaths {
    /// Memory (bytes) that they take, the index of photons included.
    pub(super) fn bytes(&self) -> usize {
        self.photons.len() * PHOTON_BYTES + self.vertices.iter().map(Vertices::bytes).sum::<usize>()
    }
    /// The photons among them that `merge` gathers, without vertices for connections.
    pub(super) fn gathered_by(&self, merge: Merge) -> Self {
        let taken = |p: &Photon| merge.takes(u32::from(p.scatterings), p.caustic);
        let both = self.positions.iter().zip(&self.photons).filter(|(_, p)| taken(p));
        let (positions, photons) = both.map(|(at, p)| (*at, *p)).unzip();
        Self { positions, photons, vertices: Vec::new() }
    }
    /// Photons by place, for about so many gathers with the radii of `span`.
    pub(super) fn index(&self, span: Span, gathers: usize) -> RadiusMap<Photon> {
        RadiusMap::spanning(&self.positions, &self.photons, span.if_worth_it(self.photons.len(), gathers))
    }
    /// The vertices of path `i`, and what they are among.
    #[inline]
    pub(super) fn path(&self, i: usize) -> (&Vertices, &[LightVertex]) {
        let among = &self.vertices[i / CHUNK as usize];
        (among, among.path(i % CHUNK as usize))
    }
}

/// Memory (bytes) that a photon takes at the worst moment. Tasks leave lists with room to spare, these are joined, the index is built from
/// both and holds a copy; what tasks gave back is not all used again. As measured with ten million light paths.
const PHOTON_BYTES: usize = 205;

/// Light paths per task. Results are joined in path order, so any value gives the same.
const CHUNK: u64 = 1024;

impl Shower<'_> {
    /// Walks all paths; splats connections to the lens into `image`.
    pub(super) fn walk(&self, image: &mut PassImage) -> Subpaths {
        let Range { start, end } = self.paths;
        let chunks: Vec<Chunk> = (0..(end - start).div_ceil(CHUNK))
            .into_par_iter()
            .map(|c| {
                let mut chunk = Chunk::default();
                for path in start + c * CHUNK..(start + (c + 1) * CHUNK).min(end) {
                    self.trace(path, &mut chunk);
                }
                chunk.sorted = Splats::new(&self.spec, &std::mem::take(&mut chunk.splats));
                chunk
            })
            .collect();
        join(chunks, image)
    }

    fn trace(&self, path: u64, out: &mut Chunk) {
        let sampler = Sampler::new(self.pass.seed, Domain::Light, self.pass.index, path);
        if let Some(chains) = self.chains {
            let mut random = Sampler::new(self.pass.seed, Domain::Chain, self.pass.index, path);
            chains.walk(&sampler, &mut random, out, |sampler, out| self.follow(sampler, out));
        } else {
            self.follow(&sampler, out);
        }
        out.vertices.end_path();
    }

    /// What one path leaves behind.
    pub(super) fn path(&self, path: u64) -> Chunk {
        let mut chunk = Chunk::default();
        self.follow(&Sampler::new(self.pass.seed, Domain::Light, self.pass.index, path), &mut chunk);
        chunk
    }

    /// Walks the path of these numbers.
    ///
    /// By reference: rustc 1.95 may hand out its caller's own value where a copy is passed on and changed.
    fn follow(&self, sampler: &Sampler, out: &mut Chunk) {
        let mut sampler = *sampler;
        out.counts.emitted += 1;
        if let Some(emission) = self.source.emit(self.world, &mut sampler) {
            // The last scattering belongs to the camera's side.
            let scatterings = self.limits.scatterings.saturating_sub(1);
            let limits = Limits { scatterings, ..self.limits };
            let start = emission.start;
            let mut shine = Shine { shower: self, emission, track: Track::new(), merges: 0.0, out };
            let rays = walk(self.world, &start, &limits, &mut sampler, &mut shine);
            out.counts.rays += rays;
            out.counts.light_rays += rays;
        }
    }
}

/// What some paths leave behind.
#[derive(Default)]
pub(super) struct Chunk {
    pub(super) positions: Vec<Vec3>,
    pub(super) photons: Vec<Photon>,
    vertices: Vertices,
    splats: Vec<Splat>,
    /// The same, when all are there.
    sorted: Splats,
    pub(super) counts: Counts,
}

impl Chunk {
    /// Forgets the photons and the counts; only such chunks are used again that have nothing else.
    pub(super) fn clear(&mut self) {
        self.positions.clear();
        self.photons.clear();
        self.counts = Counts::default();
    }
    /// Adds the photons of another, each worth `factor` times as much.
    pub(super) fn take(&mut self, other: &Self, factor: f32) {
        self.positions.extend_from_slice(&other.positions);
        self.photons.extend(other.photons.iter().map(|p| Photon { flux: p.flux * factor, ..*p }));
        self.counts += other.counts;
    }
}

fn join(mut chunks: Vec<Chunk>, image: &mut PassImage) -> Subpaths {
    for c in &chunks {
        image.counts += c.counts;
        image.counts.stored += (c.photons.len() + c.vertices.len()) as u64;
    }
    image.splat(&chunks.iter().map(|c| &c.sorted).collect::<Vec<_>>());
    let vertices = chunks.iter_mut().map(|c| std::mem::take(&mut c.vertices)).collect();
    let positions: Vec<&[Vec3]> = chunks.iter().map(|c| c.positions.as_slice()).collect();
    let photons: Vec<&[Photon]> = chunks.iter().map(|c| c.photons.as_slice()).collect();
    let all = Subpaths { positions: concat(&positions), photons: concat(&photons), vertices };
    chunks.into_par_iter().for_each(drop);
    all
}

/// Leaves photons, vertices and splats behind.
struct Shine<'w, 'o> {
    shower: &'w Shower<'w>,
    emission: Emission,
    track: Track,
    /// [`Rule::merges`] at the last vertex.
    merges: f32,
    out: &'o mut Chunk,
}

impl Visit for Shine<'_, '_> {
    #[inline]
    fn surface(&mut self, a: &Arrival, sampler: &mut Sampler) -> Step {
        let rule = &self.shower.rule;
        let sums = if a.scatterings == 0 { self.leave(a.at) } else { self.track.after(rule, Leg::to(a.at)) };
        self.track.sums = sums;
        self.merges = rule.merges(a.at, a.scatterings, a.caustic);
        // At every vertex, so that what follows does not depend on the material.
        let u_lens = if rule.on.light_image { lens_point(self.shower.world, sampler) } else { Vec2::ZERO };
        if self.shower.limits.scatterings == 0 {
            return Step::On;
        }
        if a.at.widest >= rule.least && self.shower.keep.takes(a.scatterings, a.caustic) {
            self.deposit(a, &sums);
        }
        // What is black here may be seen as the mean over a pixel.
        if a.at.widest == Lobes::Delta {
            return Step::On;
        }
        if rule.on.connect && a.at.is_connectible() {
            self.out.vertices.push(self.shower.world, a, &sums, self.merges);
        }
        if rule.images(a.scatterings) {
            self.splat(a, &sums, u_lens);
        }
        Step::On
    }
    #[inline]
    fn scatter(&mut self, at: &Interaction, s: &Scattered) {
        self.track.depart_from_light(&self.shower.rule, at, s, self.merges);
    }
}

impl Shine<'_, '_> {
    fn deposit(&mut self, a: &Arrival, s: &Sums) {
        self.out.positions.push(a.at.p);
        self.out.photons.push(Photon {
            flux: a.beta / self.shower.rule.paths,
            wi: a.at.wo,
            // Limits are far below.
            scatterings: a.scatterings as u16,
            dispersed: a.dispersed,
            caustic: a.caustic,
            sums: s.into(),
        });
    }

    /// The sums at the first vertex.
    fn leave(&self, at: &Interaction) -> Sums {
        let Emission { light, le, pdf, .. } = &self.emission;
        let from = Departed { light: *light, origin: &le.origin, cos: le.cos, pdf: *pdf };
        self.shower.rule.reach(self.shower.world, from, at)
    }

    /// Connects the vertex to the lens.
    fn splat(&mut self, a: &Arrival, s: &Sums, u_lens: Vec2) {
        let shower = self.shower;
        let Some(c) = shower.world.camera().sample_wi(a.at.p, u_lens) else { return };
        // The camera's samplers see the same there, so that the weights of a path sum to one.
        let seen;
        let at = if shower.limits.filter && shower.world.has_means() {
            seen = seen_from_lens(shower.world, a, &c, shower.spec, shower.pass.index);
            &seen
        } else {
            a.at
        };
        let value = a.beta * at.f_cos(c.wi, Transport::Flux) * (c.importance * shower.share / shower.rule.paths);
        if value.is_black() || shower.only.is_some_and(|o| o.technique != Technique::LightImage) {
            return;
        }
        self.out.counts.rays += 1;
        let Some(passed) = shower.world.passed(at, &at.spawn_to(c.wi, c.p)) else { return };
        let weight = if shower.only.is_some_and(|o| !o.weighted) { 1.0 } else { self.light_image_weight(a, at, s, &c) };
        self.out
            .splats
            .push(Splat { raster: c.raster, value: (value * passed * weight).to_rgb(shower.world.lambda()) });
    }
    fn light_image_weight(&self, a: &Arrival, at: &Interaction, s: &Sums, c: &CameraSample) -> f32 {
        let shower = self.shower;
        let eta = shower.rule.eta(shower.shrink * shower.radii.at(c.raster));
        let merges = shower.rule.merges(at, a.scatterings, a.caustic);
        shower.rule.lens(&s.into(), at, c, shower.spec.pixels(), merges, eta)
    }
}
