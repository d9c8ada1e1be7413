//! What light subpaths leave behind: photons for gathers, vertices for connections.
use super::mis::Sums;
use crate::{
    scene::{Interaction, Record, World},
    spectrum::{PackedSpectrum, Spectrum},
    walk::Arrival,
};
use glam::Vec3;

/// Flux on its way, kept for gathers. Its position is kept by the index that finds it.
#[derive(Clone, Copy, Debug)]
pub(super) struct Photon {
    /// Flux (W) that arrives, over the number of paths.
    pub(super) flux: Spectrum,
    /// Unit direction back to where it came from.
    pub(super) wi: Vec3,
    /// Scatterings since the light.
    pub(super) scatterings: u16,
    /// Some boundary on its way parted the wavelengths.
    pub(super) dispersed: bool,
    /// It came from a mirror or through glass last.
    pub(super) caustic: bool,
    pub(super) sums: LightSums,
}

/// What joints with a light subpath need of [`Sums`].
#[derive(Clone, Copy, Debug)]
pub(super) struct LightSums {
    pub(super) vcm: f32,
    pub(super) vc: f32,
    pub(super) vm: f32,
    pub(super) geometry: f32,
}

impl From<&Sums> for LightSums {
    fn from(s: &Sums) -> Self {
        Self { vcm: s.vcm, vc: s.vc, vm: s.vm(), geometry: s.geometry }
    }
}

/// A vertex kept for connections.
#[derive(Clone, Copy, Debug)]
pub(super) struct LightVertex {
    pub(super) place: Record,
    pub(super) sums: LightSums,
    /// Flux (W) that arrives, as of one path; its tag holds the bits below.
    flux: PackedSpectrum,
    scatterings: u16,
    /// Number of the whole hit, where `place` does not say all; else [`RECALLED`].
    whole: u32,
}

/// See [`LightVertex::whole`].
const RECALLED: u32 = u32::MAX;

/// Some boundary on the way parted the wavelengths.
const DISPERSED: u8 = 1;
/// [`super::mis::Rule::merges`] of it is 1.
const MERGES: u8 = 2;

impl LightVertex {
    #[inline]
    pub(super) fn flux(&self) -> Spectrum {
        self.flux.get()
    }
    #[inline]
    pub(super) fn scatterings(&self) -> u32 {
        u32::from(self.scatterings)
    }
    #[inline]
    pub(super) fn dispersed(&self) -> bool {
        self.flux.tag & DISPERSED != 0
    }
    #[inline]
    pub(super) fn merges(&self) -> f32 {
        if self.flux.tag & MERGES != 0 { 1.0 } else { 0.0 }
    }
}

/// A light vertex at the end of a connection.
pub(super) struct LightEnd<'v> {
    pub(super) at: Interaction,
    pub(super) sums: &'v LightSums,
    pub(super) merges: f32,
}

/// The light subpaths of one task, in the order of their numbers.
#[derive(Default)]
pub(super) struct Vertices {
    all: Vec<LightVertex>,
    /// Hits that records do not say all about.
    whole: Vec<Interaction>,
    /// End of each path's vertices.
    ends: Vec<u32>,
}

impl Vertices {
    /// Adds a vertex to the path under way. `merges`: [`super::mis::Rule::merges`] of it.
    #[inline]
    pub(super) fn push(&mut self, world: &World, a: &Arrival, sums: &Sums, merges: f32) {
        let whole = if world.can_recall(a.at) { RECALLED } else { self.whole.len() as u32 };
        if whole != RECALLED {
            self.whole.push(*a.at);
        }
        let tag = if a.dispersed { DISPERSED } else { 0 } | if merges > 0.0 { MERGES } else { 0 };
        self.all.push(LightVertex {
            place: Record::new(a.at),
            sums: sums.into(),
            flux: PackedSpectrum::new(a.beta, tag),
            // Limits are far below.
            scatterings: a.scatterings as u16,
            whole,
        });
    }
    /// `v`, one of these, as the end of a connection.
    #[inline]
    pub(super) fn end<'v>(&self, world: &World, v: &'v LightVertex) -> LightEnd<'v> {
        let at = if v.whole == RECALLED { world.recall(&v.place) } else { self.whole[v.whole as usize] };
        LightEnd { at, sums: &v.sums, merges: v.merges() }
    }
    /// Ends the path under way.
    #[inline]
    pub(super) fn end_path(&mut self) {
        self.ends.push(self.all.len() as u32);
    }
    /// The vertices of path `i`.
    #[inline]
    pub(super) fn path(&self, i: usize) -> &[LightVertex] {
        let from = if i == 0 { 0 } else { self.ends[i - 1] };
        &self.all[from as usize..self.ends[i] as usize]
    }
    pub(super) fn len(&self) -> usize {
        self.all.len()
    }
    /// Memory (bytes) that they take, with room to spare.
    pub(super) fn bytes(&self) -> usize {
        self.all.capacity() * size_of::<LightVertex>()
            + self.whole.capacity() * size_of::<Interaction>()
            + self.ends.capacity() * size_of::<u32>()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn light_vertices_are_small() {
        assert!(size_of::<LightVertex>() <= 96, "{}", size_of::<LightVertex>());
        assert!(size_of::<Photon>() <= 48, "{}", size_of::<Photon>());
    }
}
