//! The weight of each sampler beside all others, from the sums of the two subpaths that it joins.
//!
//! In each, `eta` is [`Rule::eta`] with the radius of the pixel, and a weight is `1 / (1 + what the light's side has + what
//! the camera's side has)` (Georgiev 2012, eqs. 38 to 48).
use super::{
    mis::{Rule, Sums},
    vertex::LightSums,
};
use crate::scene::Interaction;

/// Densities (1/sr) of scattering at a vertex between its two neighbours.
#[derive(Clone, Copy, Debug)]
pub(super) struct Between {
    /// From the own subpath's past to the other subpath.
    pub(super) forward: f32,
    /// From the other subpath to the own subpath's past.
    pub(super) back: f32,
}

#[inline]
fn weight(others: f32) -> f32 {
    share(1.0, others)
}

/// The part that `own` has beside `others`.
#[inline]
fn share(own: f32, others: f32) -> f32 {
    // Infinite sums are honest zeros; a product of 0 and ∞ is not a number, and no sampler finds such a path.
    if others.is_nan() { 0.0 } else { own / (own + others) }
}

impl Rule {
    /// A camera path that met a light past its first leg. `direct_over_pdf`: density of next-event estimation over the
    /// density of the last direction, 0 if that sampler could not; `emitted`: density of the light's emission the other way;
    /// `s`: sums at the light.
    #[inline]
    pub(super) fn hit_weight(&self, s: &Sums, direct_over_pdf: f32, emitted: f32, eta: f32) -> f32 {
        let h = self.heuristic;
        let nee = if self.on.nee { h.of(direct_over_pdf) } else { 0.0 };
        let vm = if self.on.merge.of_direct() { s.vm() } else { s.vm_rest };
        let vc = if self.images(0) { s.vc() } else { s.vc };
        weight(nee + h.of(emitted) * (vc + eta * vm))
    }

    /// A point of a light chosen from the camera vertex `at`. `hit_over_pdf`: density of meeting it by chance over that of the
    /// choice, 0 where none can; `emitted_over_pdf`: density (per area at the vertex) of the light's emission toward the
    /// vertex over that of the choice; `back`: density (1/sr) at the vertex from the light to the camera's side.
    #[inline]
    pub(super) fn nee_weight(
        &self,
        s: &Sums,
        at: &Interaction,
        hit_over_pdf: f32,
        emitted_over_pdf: f32,
        back: f32,
        eta: f32,
    ) -> f32 {
        let h = self.heuristic;
        let hit = if self.on.hit { h.of(hit_over_pdf) } else { 0.0 };
        let here = eta * s.shared * self.merges(at, 0, false);
        let image = if self.images(0) { s.image } else { 0.0 };
        weight(hit + h.of(emitted_over_pdf) * (here + s.vcm + image + h.of(back) * (s.vc() + eta * s.vm())))
    }

    /// A light vertex connected to the lens. `camera_area`: density (1/m²) of one camera path of the pixel at the vertex;
    /// `back`: density (1/sr) at the vertex from the lens to the light's side; `merges`: [`Rule::merges`] of the vertex.
    #[inline]
    pub(super) fn light_image_weight(&self, s: &LightSums, camera_area: f32, back: f32, merges: f32, eta: f32) -> f32 {
        let h = self.heuristic;
        let sharing = self.sharing(back * s.geometry);
        let others = eta * merges + s.vcm + h.of(back) * (s.vc + eta * sharing * s.vm);
        weight(h.of(camera_area / self.paths) * others)
    }

    /// A camera vertex connected to a light vertex. `to_light`, `to_camera`: density (1/m²) of the one subpath's last vertex
    /// as drawn from the other's.
    #[inline]
    pub(super) fn connect_weight(&self, camera: &Joint<Sums>, light: &Joint<LightSums>, eta: f32) -> f32 {
        let h = self.heuristic;
        let (c, l) = (camera.sums, light.sums);
        let light_shared = c.shared * self.sharing(light.area);
        let farther = light_shared * self.sharing(light.back * l.geometry);
        let on_light = h.of(light.area)
            * (eta * light.merges * light_shared + l.vcm + h.of(light.back) * (l.vc + eta * farther * l.vm));
        let on_camera = h.of(camera.area)
            * (eta * camera.merges * c.shared + c.vcm + c.image + h.of(camera.back) * (c.vc() + eta * c.vm()));
        weight(on_light + on_camera)
    }

    /// A photon gathered at a camera vertex, after so many scatterings. `at`: densities at the vertex, forward to where the photon came from.
    #[inline]
    pub(super) fn merge_weight(
        &self,
        camera: &Sums,
        photon: &LightSums,
        scatterings: u32,
        at: Between,
        eta: f32,
    ) -> f32 {
        let h = self.heuristic;
        let farther = camera.shared * self.sharing(at.forward * photon.geometry);
        let on_light = photon.vcm + h.of(at.forward) * (photon.vc + eta * farther * photon.vm);
        let image = if self.images(scatterings) { camera.image } else { 0.0 };
        let on_camera = camera.vcm + image + h.of(at.back) * (camera.vc() + eta * camera.vm());
        share(eta * camera.shared, on_light + on_camera)
    }
}

/// One end of a connection.
#[derive(Clone, Copy, Debug)]
pub(super) struct Joint<'s, S> {
    /// Sums of its subpath.
    pub(super) sums: &'s S,
    /// Density (1/m²) with which the other subpath would have drawn this vertex.
    pub(super) area: f32,
    /// Density (1/sr) from the other subpath to this one's past.
    pub(super) back: f32,
    /// [`Rule::merges`] of its vertex.
    pub(super) merges: f32,
}
