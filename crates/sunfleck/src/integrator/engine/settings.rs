//! What users can set, by name.
use super::{Engine, Fit, Heuristic};
use crate::{
    integrator::{ParamError, ParamInfo, Params},
    photon::{Kernel, Schedule},
    walk::Limits,
};

/// What every algorithm on the engine can be told.
pub(in crate::integrator) const PARAMS: [ParamInfo; 10] = [
    ParamInfo { name: "photons", about: "light paths a pass, 1 to 1e9 (default: by the size of the picture)" },
    ParamInfo { name: "radius", about: "first radius, world units > 0 (default: from what pixels cover)" },
    ParamInfo { name: "radius-scale", about: "first radius over that, 1e-6 to 1e6 (default 1)" },
    ParamInfo {
        name: "fit",
        about: "fit the first radius to the light: off, even or error (default error for unified, off if radius is set)",
    },
    ParamInfo { name: "alpha", about: "how the radius shrinks, 0.01 to 1 (default 2/3; 1 keeps it)" },
    ParamInfo { name: "kernel", about: "constant, cone or epanechnikov (default epanechnikov)" },
    ParamInfo {
        name: "memory",
        about: "bytes that light vertices may take, 1e6 to 1e15; a pass of more is split (default 2e9)",
    },
    ParamInfo {
        name: "aim",
        about: "send light to where the camera needs it: on or off (default on where photons are gathered)",
    },
    ParamInfo {
        name: "chains",
        about: "look for light paths near those that gathers reach, by Markov chains: on or off (default off; ppm and unified)",
    },
    ParamInfo { name: "heuristic", about: "what weights compare: balance or power (default balance)" },
];

impl Engine {
    /// With named settings, [`PARAMS`] and those common to all algorithms; what is not named stays.
    pub(in crate::integrator) fn with_params(self, p: &mut Params) -> Result<Self, ParamError> {
        let d = self;
        let paths = p.count("photons", 0, 1..=1_000_000_000)?;
        let radius = p.number("radius", 0.0, f64::from(f32::MIN_POSITIVE)..=1e30)? as f32;
        // Whoever names a radius means it.
        let fit = if radius > 0.0 { Fit::Off } else { d.fit };
        let chains = p.switch("chains", d.chains)?;
        if chains && !d.on.lights_serve_gathers_alone() {
            let expected = "off, which it must be where light paths do more than gathers".into();
            return Err(ParamError::Value { name: "chains", value: "on".into(), expected });
        }
        Ok(Self {
            limits: Limits { gathers: d.limits.gathers, ..p.limits()? },
            paths: (paths > 0).then_some(paths),
            radius: (radius > 0.0).then_some(radius),
            radius_scale: p.number("radius-scale", 1.0, 1e-6..=1e6)? as f32,
            fit: Fit::ALL[p.word("fit", fit as usize, &Fit::WORDS)?],
            schedule: Schedule { alpha: p.number("alpha", d.schedule.alpha, 0.01..=1.0)? },
            kernel: Kernel::ALL[p.word("kernel", d.kernel as usize, &Kernel::WORDS)?],
            memory: p.count("memory", d.memory, 1_000_000..=1_000_000_000_000_000)?,
            aim: p.switch("aim", d.aim)?,
            chains,
            heuristic: Heuristic::ALL[p.word("heuristic", d.heuristic as usize, &Heuristic::WORDS)?],
            ..d
        })
    }
}
