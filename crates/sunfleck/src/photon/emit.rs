//! The start of a light path: a light in proportion to its power, a ray in proportion to what it emits.
use crate::{bsdf::Transport, light::Emitter, sampler::Sampler, scene::World, spectrum::Spectrum, walk::Start};

/// Starts one light path. `beta` is the flux (W) that it stands for if it is the only one; divide by the number of paths
/// *emitted*, those that came to nothing included.
///
/// `None` if the scene has no light, or if the light emits nothing there; such a path counts as emitted. Draws one
/// number and two pairs.
#[inline]
pub fn emit(world: &World, sampler: &mut Sampler) -> Option<Start> {
    let (id, prob, _) = world.choose_light(sampler.next_1d())?;
    let (u_area, u_dir) = (sampler.next_2d(), sampler.next_2d());
    let le = world.light(id).sample_le(u_area, u_dir, world.around())?;
    let beta: Spectrum = le.flux() / prob;
    (beta.is_finite() && !beta.is_black()).then_some(Start { ray: le.ray, beta, mode: Transport::Flux })
}
