//! Weights of multiple importance sampling over all samplers that are on, in recursive form.
//!
//! After Georgiev 2012, "Implementing Vertex Connection and Merging" (technical report; equation numbers below are
//! its). A subpath carries what is needed to compare, at any later vertex, the sampler at hand with all that would have
//! made the same path with their joint at an earlier vertex:
//!
//! - `vcm`: 1 over the density of the last vertex (eqs. 31 and 34);
//! - `vc`: the sum over joints by connection, next-event estimation or a hit (eqs. 32 and 35);
//! - `vm`: the sum over joints by merging, *per unit of* `η = n·π·r²`. The report folds η into one more number, which needs one
//!   radius for the whole scene; kept apart, each pixel may have its own.
//!
//! Samplers that are off contribute nothing to a sum, so that the weights of those that are on sum to one.
//! Densities are those of walks without Russian roulette, which changes how often a sampler is used, not what it finds.
//!
//! **Correlation.** The photons of one gather share the camera's part of the path; what that part does badly, more photons
//! do not mend. Grittmann et al. 2021, "Correlation-Aware Multiple Importance Sampling for Bidirectional Rendering
//! Algorithms", therefore multiply the number of photons by a factor that falls with the probability `C` that two camera
//! paths share the part up to the gather (their section 4: the product over its vertices of min(1, pdf · area), with the area of
//! a disk seen under one degree). Their factor `C / (C + L − C·L)` also has the probability `L` of the light's part, and
//! no recursive form; ours is the square root of `C`, a product, which does.
use super::techniques::{Heuristic, Merge, Techniques};
use crate::{bsdf::Lobes, scene::Interaction};

/// Probability of sharing a place below which camera paths go on alone: past a matt surface, photons are not merged
/// again, which would cost much and add little to those of the first merging.
const APART: f32 = 0.02;

/// What is the same for all weights of a pass.
#[derive(Clone, Copy, Debug)]
pub(super) struct Rule {
    pub(super) on: Techniques,
    pub(super) heuristic: Heuristic,
    /// The least lobes at which photons are left and gathered: [`crate::walk::Limits::gathers`].
    pub(super) least: Lobes,
    /// Light paths of the pass.
    pub(super) paths: f32,
    /// Area (world units²) within which camera vertices count as the same place.
    pub(super) same_place: f32,
}

/// The sums of one subpath; see the module's text.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Sums {
    /// Of the last vertex; masked by whether the sampler with its joint there is on.
    pub(super) vcm: f32,
    /// Connections, light samples and hits.
    pub(super) vc: f32,
    /// As `vcm`, of the connection to the lens, where the last vertex is a camera path's first.
    pub(super) image: f32,
    /// What `image` of the vertex before the last is at the last.
    pub(super) vc_image: f32,
    /// Merging at the vertex before the last, over η.
    pub(super) vm_last: f32,
    /// Merging farther back, over η.
    pub(super) vm_rest: f32,
    /// Cosine at the vertex before the last over squared distance: turns a density (1/sr) back there into one per area.
    pub(super) geometry: f32,
    /// Correlation factor of merging at the last vertex (camera subpaths).
    pub(super) shared: f32,
}

impl Sums {
    /// Those of a camera subpath that no light subpath is weighed with: see [`Rule::needs_sums`].
    pub(super) const ALONE: Self =
        Self { vcm: 0.0, vc: 0.0, image: 0.0, vc_image: 0.0, vm_last: 0.0, vm_rest: 0.0, geometry: 0.0, shared: 1.0 };
    /// Connections of every kind at all earlier vertices.
    #[inline]
    pub(super) fn vc(&self) -> f32 {
        self.vc + self.vc_image
    }
    /// Merging at all earlier vertices, over η.
    #[inline]
    pub(super) fn vm(&self) -> f32 {
        self.vm_last + self.vm_rest
    }
}

/// Densities of the scattering at a vertex.
#[derive(Clone, Copy, Debug)]
pub(super) struct Turn {
    /// Density (1/sr) with which the walk took its direction.
    pub(super) forward: f32,
    /// Density (1/sr) with which it would have been taken the other way.
    pub(super) back: f32,
    /// True cosine of the direction taken.
    pub(super) cos: f32,
}

impl Rule {
    /// Whether weights depend on how subpaths came about. They do not where light paths are met in the first gather alone,
    /// which finds what no other sampler does; there, sums stay [`Sums::ALONE`].
    #[inline]
    pub(super) fn needs_sums(&self) -> bool {
        let Techniques { light_image, connect, merge, .. } = self.on;
        light_image || connect || (merge.is_on() && !merge.at_first_only())
    }
    /// `η = n·π·r²`, compared as the heuristic has it.
    #[inline]
    pub(super) fn eta(&self, radius: f32) -> f32 {
        self.heuristic.of(self.paths * std::f32::consts::PI * radius * radius)
    }
    /// Correlation factor of going on to a vertex drawn with density `pdf_area` (1/m²).
    #[inline]
    pub(super) fn sharing(&self, pdf_area: f32) -> f32 {
        let same = pdf_area * self.same_place;
        // Caustics are found badly by all else, so paths gather them at every vertex, and at their full number.
        if same >= 1.0 || self.on.merge == Merge::Caustic {
            1.0
        } else if same > APART {
            self.heuristic.of(same.sqrt())
        } else {
            0.0
        }
    }

    /// The sums of a light subpath at its first vertex (eqs. 31 to 33).
    #[inline]
    pub(super) fn leave_light(&self, light: &LightStart) -> Sums {
        let h = self.heuristic;
        let vcm = if self.on.nee { h.of(light.direct / (light.emitted * light.cos)) } else { 0.0 };
        let vc = if self.on.hit && light.hittable { h.of(light.cos_light / (light.emitted * light.cos)) } else { 0.0 };
        Sums { vcm, vc, ..Sums::default() }
    }
    /// The sums of a camera subpath at its first vertex: the sampler before it is the connection to the lens, made
    /// for each light path. `pixel`: area across the path that one camera path is meant for.
    #[inline]
    pub(super) fn leave_camera(&self, pixel: f32, cos: f32) -> Sums {
        let image = if self.on.light_image { self.heuristic.of(self.paths * pixel / cos) } else { 0.0 };
        Sums { image, shared: 1.0, ..Sums::default() }
    }
    /// Whether light vertices after so many scatterings are connected to the lens. Direct light is not where lights are
    /// chosen from camera vertices, which finds it with hardly any noise: that a pixel gets one or two light paths is noise
    /// alone, and balancing densities cannot tell.
    #[inline]
    pub(super) fn images(&self, scatterings: u32) -> bool {
        self.on.light_image && (scatterings > 0 || !self.on.nee)
    }
    /// 1 if photons at `at` that were scattered `scatterings` times, last as [`crate::walk::Arrival::caustic`] says, are merged
    /// beside other samplers; else 0.
    #[inline]
    pub(super) fn merges(&self, at: &Interaction, scatterings: u32, caustic: bool) -> f32 {
        let merge = self.on.merge;
        let on = merge.takes(scatterings, caustic) && !merge.at_first_only() && at.gathers(self.least);
        f32::from(u8::from(on))
    }
    /// Whether photons that came as caustics do, if `caustic`, are gathered.
    #[inline]
    pub(super) fn gathers(&self, caustic: bool) -> bool {
        caustic || self.on.merge != Merge::Caustic
    }
    /// The sums of a camera subpath at a vertex that goes on by a lobe with a density: merging before it would have
    /// taken a photon from there, which, if the vertex gathers, is no caustic.
    #[inline]
    pub(super) fn rough(&self, s: &Sums, at: &Interaction) -> Sums {
        let plain = self.on.merge == Merge::Caustic && at.gathers(self.least);
        let vm_last = if plain { 0.0 } else { s.vm_last };
        Sums { vm_last, ..*s }
    }
    /// `vcm` of a vertex past the first, drawn with density (1/sr) `pdf`, as the connection before it.
    #[inline]
    fn connection(&self, pdf_area: f32) -> f32 {
        if self.on.connect { self.heuristic.of(1.0 / pdf_area) } else { 0.0 }
    }

    /// Takes the sums of a subpath on to the next vertex, across a scattering with a density (eqs. 34 to 36). `merges`:
    /// [`Rule::merges`] of the vertex left behind, times its correlation factor on camera subpaths; `sharing`: how the
    /// correlation factor of merging one vertex back changes (light subpaths; 1 on camera subpaths).
    #[inline]
    pub(super) fn scatter(&self, s: &Sums, turn: &Turn, merges: f32, sharing: f32, to: Leg) -> Sums {
        let h = self.heuristic;
        let forward_area = turn.forward * to.cos / to.d2;
        let g = h.of(turn.cos / (turn.forward * to.cos));
        let back = h.of(turn.back);
        Sums {
            vcm: self.connection(forward_area),
            vc: g * (s.vcm + back * s.vc()),
            image: 0.0,
            vc_image: g * s.image,
            vm_last: g * merges,
            vm_rest: g * back * sharing * s.vm(),
            geometry: turn.cos / to.d2,
            shared: s.shared * self.sharing(forward_area),
        }
    }
    /// As [`Rule::scatter`] across a delta lobe: no sampler has its joint at either end of what follows (eqs. 37 to 39).
    #[inline]
    pub(super) fn pass_through(&self, s: &Sums, cos: f32, to: Leg) -> Sums {
        let g = self.heuristic.of(cos / to.cos);
        Sums { vc: g * s.vc(), vm_rest: g * s.vm(), geometry: cos / to.d2, shared: s.shared, ..Sums::default() }
    }
}

/// What is known when the first vertex of a light subpath is reached.
#[derive(Clone, Copy, Debug)]
pub(super) struct LightStart {
    /// Density with which next-event estimation from the vertex draws the light's point, times what turns it into the measure
    /// of the emission: for a surface density (1/sr) · cosine at the light, for a point probability · squared distance, at
    /// infinity density (1/sr) or probability alone.
    pub(super) direct: f32,
    /// Density of the emitted ray, choice of the light included.
    pub(super) emitted: f32,
    /// Cosine at the light; 1 where there is no surface.
    pub(super) cos_light: f32,
    /// Whether a ray can meet the light by chance.
    pub(super) hittable: bool,
    /// True cosine at the vertex.
    pub(super) cos: f32,
}

/// The segment to a new vertex.
#[derive(Clone, Copy, Debug)]
pub(super) struct Leg {
    /// Squared length.
    pub(super) d2: f32,
    /// True cosine at its end.
    pub(super) cos: f32,
}
