//! A point where a path meets a surface, and everything that can be asked there.
use super::{MaterialId, Surface, world::Even};
use crate::{
    bsdf::{Bsdf, BsdfSample, Lobes, Outlook, Scatter, Transport, cover::Covered},
    light::{EmitterHit, LightEnd, LightId},
    math::{Frame, Local, Ray, offset_origin},
    medium::Medium,
    shape::{Shape, SurfacePoint},
    spectrum::Spectrum,
};
use glam::{Vec2, Vec3};

/// A ray–surface hit in world space, with its scattering resolved.
#[derive(Clone, Copy, Debug)]
pub struct Interaction {
    /// Position.
    pub p: Vec3,
    /// Bound on each coordinate's absolute error.
    pub p_error: Vec3,
    /// Geometric normal, unit, on the outer side.
    pub ng: Vec3,
    /// Shading frame.
    pub frame: Frame,
    /// Unit direction back to where the path came from.
    pub wo: Vec3,
    /// Distance along the ray that came here.
    pub distance: f32,
    /// Texture coordinates, if the material looks at them.
    pub uv: Vec2,
    /// Scattering here.
    pub bsdf: Bsdf,
    /// What `bsdf` was made of.
    pub material: MaterialId,
    /// The widest lobes of the material, which say whether photons are kept here. Where materials are mixed, those of all
    /// of them, even if this path met another.
    pub widest: Lobes,
    /// Its surface is a ball's, or its normals make it look bent.
    pub curved: bool,
    /// The light on this surface.
    pub light: Option<LightId>,
    /// What lies on the side of `wo`, and on the other.
    pub near: Medium,
    /// See `near`.
    pub far: Medium,
}

/// A direction to go on in, in world space.
#[derive(Clone, Copy, Debug)]
pub struct Scattered {
    /// Sampled direction, away from the surface.
    pub wi: Vec3,
    /// What the throughput is multiplied by.
    pub weight: Spectrum,
    /// Density (1/sr), or the lobe's discrete probability if `delta`.
    pub pdf: f32,
    /// From a delta lobe.
    pub delta: bool,
    /// η of the new side over η of the old one.
    pub eta: f32,
    /// It goes on behind the surface.
    pub crosses: bool,
    /// Right for the hero alone: see [`crate::spectrum`].
    pub disperses: bool,
}

/// One side of a surface, for asking about many directions.
#[derive(Clone, Copy, Debug)]
pub struct NearSide {
    n: Vec3,
    ng: Vec3,
    is_flat: bool,
}

impl NearSide {
    /// The shading cosine of `wi`, and that over the true cosine; `None` if `wi` is on the other side by one of the normals.
    #[inline]
    pub fn cos_and_ratio(&self, wi: Vec3) -> Option<(f32, f32)> {
        let cos = self.n.dot(wi);
        if self.is_flat {
            return (cos > 0.0).then_some((cos, 1.0));
        }
        let true_cos = self.ng.dot(wi);
        (cos > 0.0 && true_cos > 0.0).then(|| (cos, cos / true_cos))
    }
}

/// Scattering toward the eye.
pub struct TowardEye<'i> {
    at: &'i Interaction,
    /// Unless the eye sees the surface from behind by one of the normals.
    outlook: Option<Outlook<'i>>,
}

impl TowardEye<'_> {
    /// See [`Interaction::f_photon`].
    #[inline]
    pub fn f_photon(&self, wi: Vec3) -> Spectrum {
        let li = self.at.local(wi);
        match &self.outlook {
            Some(outlook) if self.at.sides_agree(wi, li) => outlook.eval(li) * self.at.cos_ratio(wi),
            _ => Spectrum::BLACK,
        }
    }
}

impl Interaction {
    #[inline(always)]
    pub(super) fn new(s: &SurfacePoint, wo: Vec3, distance: f32, even: &Even, surface: &Surface) -> Self {
        // Not by way of `covered`: each copy of a closure is dear.
        Self {
            p: s.p,
            p_error: s.p_error,
            ng: s.ng,
            frame: Frame::from_normal(s.n),
            wo,
            distance,
            uv: s.uv,
            bsdf: even.bsdf,
            material: surface.material,
            widest: even.widest,
            curved: matches!(surface.shape, Shape::Sphere(_)) || s.n != s.ng,
            light: surface.light,
            near: Medium::VACUUM,
            far: Medium::VACUUM,
        }
    }
    #[inline]
    pub(super) fn covered(s: &SurfacePoint, wo: Vec3, distance: f32, by: &Covered, surface: &Surface) -> Self {
        let Covered { bsdf, frame, widest } = *by;
        let curved = matches!(surface.shape, Shape::Sphere(_)) || frame.n != s.ng;
        Self { frame, curved, ..Self::new(s, wo, distance, &Even { bsdf, widest }, surface) }
    }
    /// Takes a surface that is black at this very point for one that is not: the camera may see colours around it, too.
    #[inline]
    pub(super) fn as_if_coloured(&mut self) {
        use Bsdf::{Diffuse, DiffuseTransmission, NRendererPhong, Phong, Plastic, RoughPlastic};
        let matt = matches!(
            self.bsdf,
            Diffuse(_) | DiffuseTransmission(_) | NRendererPhong(_) | Phong(_) | Plastic(_) | RoughPlastic(_)
        );
        if matt {
            self.widest = Lobes::Wide;
        }
    }
    /// The emitting surface that was met.
    #[inline]
    pub fn emitter_hit(&self) -> EmitterHit {
        EmitterHit { p: self.p, ng: self.ng }
    }
    /// Whether lights and paths may be connected and photons be gathered here.
    #[inline]
    pub fn is_connectible(&self) -> bool {
        self.bsdf.is_connectible()
    }
    /// Whether a camera path gathers photons here.
    #[inline]
    pub fn gathers(&self, least: Lobes) -> bool {
        self.bsdf.lobes() >= least
    }

    /// The scattering function in 1/sr without any cosine; zero where the shading and the geometric normal disagree
    /// about the side of a direction (light would leak through the surface).
    #[inline]
    pub fn f(&self, wi: Vec3, mode: Transport) -> Spectrum {
        let (lo, li) = (self.local(self.wo), self.local(wi));
        if self.sides_agree(self.wo, lo) && self.sides_agree(wi, li) {
            self.bsdf.eval(lo, li, mode)
        } else {
            Spectrum::BLACK
        }
    }
    /// What a path that goes on toward `wi` is multiplied by, per unit of solid angle: `f` with its cosine, and for
    /// flux the adjoint factor of shading normals (Veach 1997, eq. 5.19).
    #[inline]
    pub fn f_cos(&self, wi: Vec3, mode: Transport) -> Spectrum {
        self.f(wi, mode) * self.cos_factor(wi, mode)
    }
    /// Radiance toward `wo` per unit of flux density of photons that came from `wi`: photons are counted per area of
    /// the true surface, while scattering weighs them by the shading cosine.
    #[inline]
    pub fn f_photon(&self, wi: Vec3) -> Spectrum {
        self.toward_eye().f_photon(wi)
    }
    /// For asking [`Interaction::f_photon`] of many photons.
    #[inline]
    pub fn toward_eye(&self) -> TowardEye<'_> {
        let lo = self.local(self.wo);
        let outlook = self.sides_agree(self.wo, lo).then(|| self.bsdf.outlook(lo));
        TowardEye { at: self, outlook }
    }
    /// Shading cosine over true cosine of `wi`; zero in the plane of the true surface.
    #[inline]
    pub fn cos_ratio(&self, wi: Vec3) -> f32 {
        let cos_g = self.ng.dot(wi);
        if cos_g == 0.0 { 0.0 } else { (self.frame.n.dot(wi) / cos_g).abs() }
    }
    /// Cosine (not negative) of `w` with the shading normal.
    #[inline]
    pub fn shading_cos(&self, w: Vec3) -> f32 {
        self.frame.n.dot(w).abs()
    }
    /// Cosine (not negative) of `w` with the true surface's normal.
    #[inline]
    pub fn true_cos(&self, w: Vec3) -> f32 {
        self.ng.dot(w).abs()
    }
    /// The eye's side of the surface.
    #[inline]
    pub fn near_side(&self) -> NearSide {
        let toward = |n: Vec3| n * 1f32.copysign(n.dot(self.wo));
        NearSide { n: toward(self.frame.n), ng: toward(self.ng), is_flat: self.is_flat() }
    }
    /// Density (1/sr) with which [`Interaction::sample`] draws `wi`.
    #[inline]
    pub fn pdf(&self, wi: Vec3) -> f32 {
        self.bsdf.pdf(self.local(self.wo), self.local(wi))
    }
    /// Density (1/sr) with which a path that comes from `wi` would be sent to `wo`: [`Interaction::pdf`] the other way.
    #[inline]
    pub fn pdf_back(&self, wi: Vec3) -> f32 {
        self.bsdf.pdf(self.local(wi), self.local(self.wo))
    }
    /// Draws a direction to go on in. `None` when nothing is carried on.
    #[inline]
    pub fn sample(&self, u_lobe: f32, u: Vec2, mode: Transport) -> Option<Scattered> {
        let lo = self.local(self.wo);
        if let Bsdf::Diffuse(matt) = &self.bsdf
            && self.is_flat()
        {
            // As below, where there is nothing for normals to disagree about.
            let BsdfSample { wi, weight, pdf, .. } = matt.sample(lo, u_lobe, u, mode)?;
            let wi = self.frame.to_world(wi);
            return Some(Scattered { wi, weight, pdf, delta: false, eta: 1.0, crosses: false, disperses: false });
        }
        let s = self.bsdf.sample(lo, u_lobe, u, mode)?;
        let wi = self.frame.to_world(s.wi);
        if !(self.sides_agree(self.wo, lo) && self.sides_agree(wi, s.wi)) || s.weight.is_black() {
            return None;
        }
        let adjoint = match mode {
            Transport::Flux if !self.is_flat() => self.cos_factor(wi, mode) / s.wi.abs_cos_theta(),
            _ => 1.0,
        };
        let weight = s.weight * adjoint;
        let BsdfSample { pdf, delta, eta, disperses, .. } = s;
        let crosses = lo.cos_theta() * s.wi.cos_theta() < 0.0;
        weight.is_finite().then_some(Scattered { wi, weight, pdf, delta, eta, crosses, disperses })
    }
    #[inline]
    fn cos_factor(&self, wi: Vec3, mode: Transport) -> f32 {
        let n = self.frame.n;
        match mode {
            Transport::Radiance => n.dot(wi).abs(),
            Transport::Flux => n.dot(self.wo).abs() * self.ng.dot(wi).abs() / self.ng.dot(self.wo).abs(),
        }
    }
    /// `w` in the shading frame, as far as the model looks at it: what is matt asks for its height alone.
    #[inline]
    fn local(&self, w: Vec3) -> Local {
        if let Bsdf::Diffuse(_) = self.bsdf { Local(w.dot(self.frame.n) * Vec3::Z) } else { self.frame.to_local(w) }
    }
    /// Whether shading and geometric normal are the same.
    #[inline]
    fn is_flat(&self) -> bool {
        self.frame.n == self.ng
    }
    /// Whether `w` lies on the same side for both normals.
    #[inline]
    fn sides_agree(&self, w: Vec3, local: Local) -> bool {
        self.ng.dot(w) * local.cos_theta() > 0.0
    }

    /// What a path goes on in that leaves in direction `d`.
    #[inline]
    pub fn medium_toward(&self, d: Vec3) -> Medium {
        if self.ng.dot(d) * self.ng.dot(self.wo) > 0.0 { self.near } else { self.far }
    }

    /// A ray from here in direction `d` that does not meet this surface again.
    #[inline]
    pub fn spawn(&self, d: Vec3) -> Ray {
        Ray { o: offset_origin(self.p, self.p_error, self.ng, d), d, tmin: 0.0, tmax: f32::INFINITY }
    }
    /// A shadow ray toward the far end of a connection in direction `wi`, which ends short of it.
    #[inline]
    pub fn spawn_toward(&self, wi: Vec3, end: &LightEnd) -> Ray {
        match end {
            LightEnd::Infinite => self.spawn(wi),
            LightEnd::Point(p) => self.spawn_to(wi, *p),
            LightEnd::Surface(q) => self.spawn_to(wi, offset_origin(q.p, q.p_error, q.ng, -wi)),
        }
    }
    /// A shadow ray toward another surface in direction `wi`, which ends short of it.
    #[inline]
    pub fn spawn_to_surface(&self, wi: Vec3, to: &Self) -> Ray {
        self.spawn_to(wi, offset_origin(to.p, to.p_error, to.ng, -wi))
    }
    /// A shadow ray toward the point `to` in direction `wi`, which ends short of it.
    #[inline]
    pub fn spawn_to(&self, wi: Vec3, to: Vec3) -> Ray {
        let o = offset_origin(self.p, self.p_error, self.ng, wi);
        // The far end is exact to a few ulps; a ten-thousandth of the way keeps clear of it.
        Ray { o, d: to - o, tmin: 0.0, tmax: 0.9999 }
    }
}
