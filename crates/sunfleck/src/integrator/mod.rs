//! Algorithms: from a scene to an estimate of its picture.
//!
//! To add one: write `integrator/<name>.rs` with its settings, an `ENTRY` and the two traits below, and add its `mod` line
//! and its entry to [`REGISTRY`]; command line and help run over that list.
mod bdpt;
mod engine;
mod eye_ray;
mod light;
mod params;
mod path;
mod photonmap;
mod ppm;
mod raycast;
mod sppm;
mod unified;
mod vcm;

pub use engine::{Engine, Fit, Heuristic, Merge, Technique, Techniques};
pub use light::LightTracer;
pub use params::{ParamError, ParamInfo, Params};
pub use path::PathTracer;
pub use photonmap::PhotonMapper;
pub use raycast::RayCast;

use crate::{
    film::PassImage,
    photon::Audit,
    sampler::{Domain, Sampler},
    scene::Scene,
    spectrum::{ColorMode, Wavelengths},
};

/// All that differs between passes.
#[derive(Clone, Copy, Debug)]
pub struct Pass {
    /// 0, 1, 2, …
    pub index: u64,
    /// The user's seed.
    pub seed: u64,
    /// What the lanes of a spectrum mean in this pass.
    pub lambda: Wavelengths,
    /// When the shutter is open for this pass: 0 as it opens, 1 as it closes.
    pub time: f32,
}

impl Pass {
    /// Pass `index` of a render with `seed`. Times of successive passes are spread evenly over the shutter: each aligned
    /// block of 2^k passes has one in each of 2^k equal intervals.
    pub fn new(seed: u64, index: u64) -> Self {
        let mut sampler = Sampler::new(seed, Domain::Pass, 0, index);
        Self { index, seed, lambda: Wavelengths::Rgb, time: sampler.next_1d() }
    }
    /// Pass `index` of the same render.
    #[must_use]
    pub fn at_index(&self, index: u64) -> Self {
        Self::new(self.seed, index).colored(self.lambda.mode())
    }
    /// The same pass with what `color` carries in it.
    #[must_use]
    pub fn colored(self, color: ColorMode) -> Self {
        Self { lambda: color.wavelengths(self.seed, self.index), ..self }
    }
}

/// An algorithm with its settings.
pub trait Integrator: Send + Sync {
    /// Gets ready for `scene`; may measure or train, deterministically in (scene, spec, seed).
    fn prepare<'s>(&'s self, scene: &'s Scene, spec: crate::film::FilmSpec, seed: u64) -> Box<dyn PassRenderer + 's>;
}

/// One estimate of the whole picture per pass.
pub trait PassRenderer: Sync {
    /// Adds an estimate to the black `image`: a pure function of what was prepared and of the pass. The mean over
    /// passes is the picture.
    fn render_pass(&self, pass: &Pass, image: &mut PassImage);
    /// The samplers whose sum the picture is, if the algorithm can show each alone.
    fn techniques(&self) -> Vec<Technique> {
        Vec::new()
    }
    /// Adds what one of [`PassRenderer::techniques`] alone finds in the pass: as it counts in the picture if `weighted`, else
    /// as if it were the only sampler, which is the whole of the light that it can find.
    fn render_technique(&self, _pass: &Pass, _technique: Technique, _weighted: bool, _image: &mut PassImage) {}
    /// How it sends and keeps photons, so that books can be kept of `paths` of them; `None` if it sends none, or does not say.
    fn audit(&self, _seed: u64, _paths: u64) -> Option<Audit> {
        None
    }
}

/// Name, purpose and maker of an algorithm.
pub struct Entry {
    /// Word on the command line.
    pub name: &'static str,
    /// One line for help and manual.
    pub about: &'static str,
    /// Settings it takes.
    pub params: &'static [ParamInfo],
    /// Whether films of separate sets of passes may be merged.
    pub mergeable: bool,
    /// Builds it from named settings.
    pub make: fn(&mut Params) -> Result<Box<dyn Integrator>, ParamError>,
}

/// Every algorithm.
pub const REGISTRY: &[Entry] = &[
    raycast::ENTRY,
    path::ENTRY,
    light::ENTRY,
    bdpt::ENTRY,
    photonmap::ENTRY,
    ppm::ENTRY,
    sppm::ENTRY,
    vcm::ENTRY,
    unified::ENTRY,
];

/// The entry called `name`.
pub fn find(name: &str) -> Option<&'static Entry> {
    REGISTRY.iter().find(|e| e.name == name)
}

impl Entry {
    /// Builds the algorithm.
    ///
    /// # Errors
    /// A setting it does not know, or a value out of range.
    pub fn build(&self, mut params: Params) -> Result<Box<dyn Integrator>, ParamError> {
        let made = (self.make)(&mut params)?;
        params.finish(self)?;
        Ok(made)
    }
}

#[cfg(test)]
mod tests {
    use super::Pass;

    #[test]
    fn the_times_of_passes_fill_the_shutter_evenly() {
        for (seed, first) in [(1, 0), (9, 64), (2, 1 << 20)] {
            let mut seen = [0; 64];
            (first..first + 64).for_each(|index| seen[(64.0 * Pass::new(seed, index).time) as usize] += 1);
            assert_eq!(seen, [1; 64], "seed {seed}, from pass {first}");
        }
        assert_ne!(Pass::new(1, 5).time, Pass::new(2, 5).time);
    }
}
