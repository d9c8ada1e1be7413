//! A closure seen from one direction, for asking about many others.
use super::{Bsdf, CoatedConductor, Scatter, Transport, principled};
use crate::{math::Local, spectrum::Spectrum};

/// What a closure knows of one direction before it is asked about others. Gathers ask of hundreds of photons at one place.
pub struct Outlook<'b> {
    bsdf: &'b Bsdf,
    wo: Local,
    principled: Option<principled::Outlook<'b>>,
}

impl Bsdf {
    /// Itself, seen from `wo`.
    #[inline]
    pub fn outlook(&self, wo: Local) -> Outlook<'_> {
        let principled = match self {
            Self::Principled(b) | Self::CoatedConductor(CoatedConductor(b)) => Some(b.outlook(wo)),
            _ => None,
        };
        Outlook { bsdf: self, wo, principled }
    }
}

impl Outlook<'_> {
    /// [`Scatter::eval`] of radiance.
    #[inline]
    pub fn eval(&self, wi: Local) -> Spectrum {
        match &self.principled {
            Some(p) => p.eval(wi),
            None => self.bsdf.eval(self.wo, wi, Transport::Radiance),
        }
    }
}
