//! The weights of all samplers that find a path sum to one: whole paths are drawn, and for each place where subpaths could
//! be joined, both are built by the code that renders.
mod paths;
mod scenes;

use super::{
    Engine, Heuristic, Merge, Techniques,
    joins::{Departed, Joins, LastLeg},
    mis::{Leg, Rule, Sums},
    track::Track,
    vertex::{LightEnd as KeptEnd, LightVertex, Vertices},
    weights::Between,
};
use crate::{
    bsdf::Lobes,
    camera::Project,
    film::{FilmSpec, Filter},
    integrator::{bdpt, unified, vcm},
    light::{LeOrigin, LiSample, LightEnd},
    medium::Inside,
    photon::{Radii, Source},
    sampler::{Domain, Sampler},
    scene::{DirectSample, Interaction, MID_SHUTTER, Scattered, World},
    shape::AreaSample,
    spectrum::{Spectrum, Wavelengths},
    walk::{Arrival, Limits},
};
use glam::Vec3;
use paths::{End, Path, Vertex};

const SPEC: FilmSpec = FilmSpec { width: 24, height: 16, filter: Filter::Box };

/// How far a sum may be from one.
const TOLERANCE: f32 = 1e-4;

/// A pass.
struct Setting<'w> {
    world: &'w World<'w>,
    rule: Rule,
    radii: &'w Radii,
    source: &'w Source,
}

/// The light's subpath of a path: the vertex nearest to the camera first.
struct LightSide {
    among: Vertices,
    kept: Vec<LightVertex>,
}

/// A sampler and its weight.
type Weight = (String, f32);

impl Setting<'_> {
    fn joins(&self, path: &Path) -> Joins<'_> {
        let eta = self.rule.eta(self.radii.at(path.raster));
        // Only walks that end after their first gather choose whether to go on to a light.
        let hit_share = if self.rule.on.merge.at_first_only() { 0.3 } else { 1.0 };
        Joins { world: self.world, source: self.source, rule: &self.rule, eta, hit_share }
    }

    /// The sums of the camera's subpath on arrival at each vertex, and on arrival at the light.
    fn camera_sums(&self, path: &Path) -> (Vec<Sums>, Sums) {
        let pixel = path.camera.spread.of_pixel(SPEC.pixels());
        let mut track = Track::new();
        let sums = path.vertices.iter().enumerate().map(|(i, v)| {
            let sums = track.arrive_from_camera(&self.rule, pixel, i as u32, &v.at);
            track.sums = sums;
            track.depart_from_camera(&self.rule, &v.at, &scattered(&v.at, v.wi, v.delta));
            sums
        });
        let sums = sums.collect();
        let last = match &path.end {
            End::Surface(at) => track.arrive_from_camera(&self.rule, pixel, path.vertices.len() as u32, at),
            End::Point(..) | End::Infinite(..) => track.after(&self.rule, Leg::AWAY),
        };
        (sums, last)
    }

    /// The light's subpath: its vertices as they would be kept, that nearest to the camera first.
    fn light_side(&self, path: &Path) -> LightSide {
        let mut track = Track::new();
        let mut caustic = false;
        let mut among = Vertices::default();
        for (i, v) in path.vertices.iter().enumerate().rev() {
            let at = Interaction { wo: v.wi, distance: path.leg_after(i), ..v.at };
            let scatterings = (path.vertices.len() - 1 - i) as u32;
            let sums = if scatterings == 0 { self.reach(path, &at) } else { track.after(&self.rule, Leg::to(&at)) };
            track.sums = sums;
            let merges = self.rule.merges(&at, scatterings, caustic);
            track.depart_from_light(&self.rule, &at, &scattered(&at, v.at.wo, v.delta), merges);
            caustic = v.delta || !at.gathers(self.rule.least);
            let (beta, pdf, delta, all_delta, dispersed, travelled) = (Spectrum::ONE, 1.0, v.delta, false, false, 0.0);
            let (departed, inside) = (beta, &Inside::NOTHING);
            let ray = &crate::math::Ray::new(at.p + at.wo, -at.wo);
            let arrival = Arrival {
                at: &at,
                ray,
                beta,
                departed,
                scatterings,
                pdf,
                delta,
                caustic,
                all_delta,
                dispersed,
                travelled,
                inside,
            };
            among.push(self.world, &arrival, &sums, merges);
        }
        among.end_path();
        let kept = among.path(0).iter().rev().copied().collect();
        LightSide { among, kept }
    }
    fn reach(&self, path: &Path, at: &Interaction) -> Sums {
        let hit = if let End::Surface(q) = &path.end { Some(q.emitter_hit()) } else { None };
        let (cos, origin) = match (&path.end, hit) {
            (End::Surface(q), Some(hit)) => (q.true_cos(q.wo), LeOrigin::Surface(hit)),
            (End::Infinite(..), _) => (1.0, LeOrigin::Infinite),
            _ => (1.0, LeOrigin::Point),
        };
        let light = path.light();
        let pdf = self.source.pdf(self.world, light, hit.as_ref(), at.p, -at.wo);
        self.rule.reach(self.world, Departed { light, origin: &origin, cos, pdf }, at)
    }

    /// Whether camera paths come as far as vertex `i`: those that gather at their first vertex alone end there.
    fn comes_to(&self, path: &Path, i: usize) -> bool {
        !self.rule.on.merge.at_first_only() || path.vertices[..i].iter().all(|v| self.is_passed(v))
    }
    /// Whether nothing is gathered at a vertex.
    fn is_passed(&self, v: &Vertex) -> bool {
        v.delta || !v.at.gathers(self.rule.least)
    }

    /// Every sampler that finds the path, with its weight.
    fn weights(&self, path: &Path) -> Vec<Weight> {
        let (camera, at_light) = self.camera_sums(path);
        let light = self.light_side(path);
        let mut all = self.of_lights(path, &camera, &at_light);
        all.extend(self.of_lens(path, &light));
        all.extend(self.of_connections(path, &camera, &light));
        all.extend(self.of_merging(path, &camera, &light.kept));
        all
    }
    fn of_lights(&self, path: &Path, camera: &[Sums], at_light: &Sums) -> Vec<Weight> {
        let (on, joins) = (&self.rule.on, self.joins(path));
        let last = path.vertices.len() - 1;
        let v = &path.vertices[last];
        let mut all = Vec::new();
        if !self.comes_to(path, last) {
            return all;
        }
        if on.hit && (self.is_passed(v) || on.nee || !on.merge.at_first_only()) {
            let leg = LastLeg::new(v.at.p, v.at.pdf(v.wi), v.delta);
            match &path.end {
                End::Surface(at) => all.push(("hit".to_owned(), joins.hit(at_light, leg, at))),
                End::Infinite(..) => {
                    for sky in self.world.escaped(v.at.p, v.wi).filter(|sky| sky.light == path.light()) {
                        all.push(("hit".to_owned(), joins.sky(at_light, leg, v.wi, &sky)));
                    }
                }
                End::Point(..) => {}
            }
        }
        if on.nee && !v.delta {
            let d = self.direct(path, &v.at, v.wi);
            all.push(("nee".to_owned(), joins.nee(&self.rule.rough(&camera[last], &v.at), &v.at, &d)));
        }
        all
    }
    /// The light's point as next-event estimation draws it.
    fn direct(&self, path: &Path, at: &Interaction, wi: Vec3) -> DirectSample {
        let light = path.light();
        let (pdf, end) = match &path.end {
            End::Surface(q) => {
                let point = AreaSample { p: q.p, p_error: q.p_error, ng: q.ng };
                (self.world.pdf_direct(at.p, wi, q), LightEnd::Surface(point))
            }
            End::Point(_, p) => (self.world.light_prob(light), LightEnd::Point(*p)),
            End::Infinite(_) => {
                let seen = self.world.escaped(at.p, wi).find(|sky| sky.light == light);
                (seen.map_or(self.world.light_prob(light), |sky| sky.pdf_direct), LightEnd::Infinite)
            }
        };
        DirectSample { li: LiSample { wi, li: Spectrum::ONE, pdf, delta: false, end }, light }
    }
    fn of_lens(&self, path: &Path, light: &LightSide) -> Option<Weight> {
        let v = &light.kept[0];
        if !self.rule.images(v.scatterings()) || path.vertices[0].delta {
            return None;
        }
        let KeptEnd { at, sums, merges } = light.among.end(self.world, v);
        let c = self.world.camera().sample_wi(at.p, path.u_lens).expect("a vertex that the camera sees");
        let eta = self.rule.eta(self.radii.at(c.raster));
        Some(("light image".to_owned(), self.rule.lens(sums, &at, &c, SPEC.pixels(), merges, eta)))
    }
    fn of_connections(&self, path: &Path, camera: &[Sums], light: &LightSide) -> Vec<Weight> {
        let joins = self.joins(path);
        let connect = |i: usize| {
            let (v, next) = (&path.vertices[i], &path.vertices[i + 1]);
            (self.rule.on.connect && !v.delta && !next.delta).then(|| {
                let d2 = path.leg_after(i).powi(2);
                let sums = self.rule.rough(&camera[i], &v.at);
                let end = light.among.end(self.world, &light.kept[i + 1]);
                (format!("connection {i}"), joins.connect(&sums, &v.at, &end, v.wi, d2))
            })
        };
        (0..path.vertices.len() - 1).filter_map(connect).collect()
    }
    fn of_merging(&self, path: &Path, camera: &[Sums], light: &[LightVertex]) -> Vec<Weight> {
        let (rule, joins) = (&self.rule, self.joins(path));
        let merge = |i: usize| {
            let (v, photon) = (&path.vertices[i], &light[i]);
            let caustic = path.vertices.get(i + 1).is_some_and(|v| self.is_passed(v));
            let kept = rule.on.merge.takes(photon.scatterings(), caustic) && rule.gathers(caustic);
            (kept && !self.is_passed(v) && camera[i].shared > 0.0 && self.comes_to(path, i)).then(|| {
                let at = Between { forward: v.at.pdf(v.wi), back: v.at.pdf_back(v.wi) };
                let weight = if rule.on.merge.at_first_only() {
                    1.0
                } else {
                    rule.merge_weight(&rule.rough(&camera[i], &v.at), &photon.sums, photon.scatterings(), at, joins.eta)
                };
                (format!("merging {i}"), weight)
            })
        };
        (0..path.vertices.len()).filter_map(merge).collect()
    }
}

fn scattered(at: &Interaction, wi: Vec3, delta: bool) -> Scattered {
    let pdf = if delta { 1.0 } else { at.pdf(wi) };
    Scattered { wi, weight: Spectrum::ONE, pdf, delta, eta: 1.0, crosses: false, disperses: false }
}

/// The presets and what lies between them.
fn samplers() -> Vec<Techniques> {
    let paths = Techniques { merge: Merge::Off, ..unified::ON };
    let with = |on: Techniques, merge| Techniques { merge, ..on };
    vec![
        paths,
        bdpt::ON,
        vcm::ON,
        unified::ON,
        with(vcm::ON, Merge::Scattered),
        with(vcm::ON, Merge::Caustic),
        with(paths, Merge::Scattered),
        with(paths, Merge::All),
        with(paths, Merge::First),
        Techniques { nee: false, merge: Merge::FirstAll, ..paths },
        Techniques { nee: false, ..vcm::ON },
        Techniques { hit: false, ..vcm::ON },
        Techniques { connect: false, ..vcm::ON },
        Techniques { light_image: false, ..vcm::ON },
    ]
}

/// Paths in each scene.
const PATHS: u64 = 12_000;

fn check(name: &str, lights: scenes::Lights) {
    let scene = scenes::scene(lights);
    let world = scene.world(Wavelengths::Rgb, MID_SHUTTER);
    let radii = Radii::from_footprints(&scene, SPEC, &Limits::default(), 1, 4.0, 0.1);
    let paths: Vec<Path> =
        (0..PATHS).filter_map(|i| Path::draw(&world, &mut Sampler::new(5, Domain::Prepare, 0, i))).collect();
    assert!(paths.len() > 300, "{name}: {} paths", paths.len());
    let aimed = Engine::new(vcm::ON).source(&scene, SPEC, 1);
    // In the middle of a wide ground, light from outside is aimed.
    assert!(aimed.aim().is_some() || !lights.has_sky(), "{name}: not aimed");
    for source in [Source::plain(), aimed] {
        check_all(name, &world, &radii, &source, &paths);
    }
}

/// What weights compare, and the least lobes that gather.
const RULES: [(Heuristic, Lobes); 3] =
    [(Heuristic::Balance, Lobes::Narrow), (Heuristic::Balance, Lobes::Wide), (Heuristic::Power, Lobes::Wide)];

fn check_all(name: &str, world: &World, radii: &Radii, source: &Source, paths: &[Path]) {
    for on in samplers() {
        for (heuristic, least) in RULES {
            let rule = Rule { on, heuristic, least, paths: 700.0, same_place: 0.02 };
            let setting = Setting { world, rule, radii, source };
            let (mut shared, mut most) = (0, 0);
            for path in paths {
                let weights = setting.weights(path);
                let sum: f32 = weights.iter().map(|w| w.1).sum();
                let right = weights.is_empty() || (sum - 1.0).abs() < TOLERANCE;
                assert!(
                    right,
                    "{name}, aimed: {}, {rule:?}: {sum}, {weights:?}\n{}",
                    source.aim().is_some(),
                    path.letters()
                );
                shared += usize::from(weights.iter().filter(|w| w.1 > 0.01).count() > 1);
                most = most.max(weights.len());
            }
            if on == vcm::ON {
                assert!(shared > 100 && most > 8, "{name}: {shared} paths are shared, among {most} at most");
            }
        }
    }
}

macro_rules! sums_to_one {
    ($($test:ident: $lights:ident),* $(,)?) => {
        $(#[test]
        fn $test() {
            check(stringify!($test), scenes::Lights::$lights);
        })*
    };
}

sums_to_one![
    weights_sum_to_one_under_a_lamp: Lamp,
    weights_sum_to_one_under_a_lamp_of_two_sides: TwoSided,
    weights_sum_to_one_around_a_shining_ball: Ball,
    weights_sum_to_one_around_a_point: Point,
    weights_sum_to_one_in_a_spot: Spot,
    weights_sum_to_one_in_parallel_light: Directional,
    weights_sum_to_one_under_a_sky: Sky,
    weights_sum_to_one_under_all_lights_through_a_lens: AllThroughLens,
    weights_sum_to_one_under_all_lights_along_parallel_rays: AllAlongParallelRays,
];
