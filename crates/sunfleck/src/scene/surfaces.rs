//! What rays meet, and what covers it.
use super::{
    Interaction, Record, Surface, World,
    moment::{Moment, Placement},
    world::Even,
};
use crate::{
    bsdf::{
        Lookup, Scatter, ThinDielectric,
        cover::{Coin, Covered, Site, cover, opacity},
    },
    math::Ray,
    shape::{SurfacePoint, Tangents},
    texture::Footprint,
};
use accel::Hit;
use glam::{Mat3A, Vec3};

/// What the toss for a hole that is met as a surface is for.
const HOLE: u64 = 0x686f_6c65;

impl World<'_> {
    /// The first surface along `ray` (unit direction), materials resolved.
    #[inline(always)]
    pub fn intersect(&self, ray: &Ray) -> Option<Interaction> {
        self.intersect_seen(ray, |_| None)
    }
    /// As [`World::intersect`], colours being the mean over what is seen at once: `sight` tells, after the distance to the hit,
    /// in which direction the eye looks at it and how wide (world units) that is.
    #[inline(always)]
    pub fn intersect_seen(&self, ray: &Ray, sight: impl FnOnce(f32) -> Option<(Vec3, f32)>) -> Option<Interaction> {
        let bvh = &self.moment.bvh;
        let hit = if self.scene.porous.is_empty() { bvh.closest(ray) } else { self.closest_between_holes(ray) }?;
        let (surface, point) = self.locate(&hit, ray);
        let (wo, t) = (-ray.d, hit.t);
        if let Some(even) = &self.even[surface.material.0 as usize] {
            return Some(Interaction::new(&point, wo, t, even, surface));
        }
        let attributes = surface.shape.attributes(&hit);
        let has_means = self.scene.looks[surface.material.0 as usize].has_means;
        let seen = if has_means { sight(hit.t) } else { None };
        let at = Lookup {
            textures: &self.scene.textures,
            uv: point.uv,
            p: point.p,
            lambda: self.around.lambda,
            attributes,
            footprint: seen.map_or(Footprint::POINT, |(d, width)| self.footprint(&hit, ray, point.ng, d, width)),
        };
        let material = &self.scene.materials[surface.material.0 as usize];
        let covered = if material.is_plain() {
            Covered::plain(material.resolve(&at), point.n)
        } else {
            self.cover(&hit, ray, surface, &point, at)
        };
        let mut met = Interaction::covered(&point, wo, t, &covered, surface);
        if has_means {
            met.as_if_coloured();
        }
        Some(met)
    }
    /// Whether [`World::recall`] makes `at` again from a record of it.
    #[inline]
    pub fn can_recall(&self, at: &Interaction) -> bool {
        self.scene.looks[at.material.0 as usize].at_place_alone
    }
    /// The hit that `record` was made of, in a world of the same time and wavelengths.
    #[inline]
    pub fn recall(&self, record: &Record) -> Interaction {
        if let Some(even) = &self.even[record.material.0 as usize] {
            return record.with(even);
        }
        let at = Lookup::new(&self.scene.textures, record.uv, record.p, self.around.lambda);
        let bsdf = self.scene.materials[record.material.0 as usize].resolve(&at);
        record.with(&Even { bsdf, widest: bsdf.lobes() })
    }
    /// Whether some material looks at textures that are means over what is seen at once.
    #[inline]
    pub fn has_means(&self) -> bool {
        self.scene.has_means
    }
    /// What lies at `at`, which was found along `ray`, as the eye sees it that looks in direction `d` at `width` (world units) at
    /// once.
    pub fn seen(&self, at: &Interaction, ray: &Ray, d: Vec3, width: f32) -> Interaction {
        if !self.scene.looks[at.material.0 as usize].has_means {
            return *at;
        }
        // The same ray meets the same surface again, by the same tosses; past a hidden surface it would not.
        let again = self.intersect_seen(ray, |_| Some((d, width))).filter(|again| again.p == at.p);
        again.map_or(*at, |again| Interaction { bsdf: again.bsdf, frame: again.frame, ..*at })
    }
    /// What a cone of `width` in direction `d` covers at a hit.
    #[inline(never)]
    fn footprint(&self, hit: &Hit, ray: &Ray, ng: Vec3, d: Vec3, width: f32) -> Footprint {
        self.tangents(hit, ray).map_or(Footprint::POINT, |tangents| Footprint::new(width, d, ng, tangents))
    }
    /// Whether something lies within the reach of `ray`.
    #[inline]
    pub fn occluded(&self, ray: &Ray) -> bool {
        if self.scene.porous.is_empty() { self.moment.bvh.occluded(ray) } else { self.occluded_between_holes(ray) }
    }

    #[inline]
    pub(super) fn surface(&self, hit: &Hit) -> (&Surface, Option<&Placement>) {
        let Moment { surfaces, placements, .. } = &*self.moment;
        if hit.instance == Hit::NO_INSTANCE {
            return (&surfaces[hit.geometry as usize], None);
        }
        let placed = &placements[hit.instance as usize];
        (&self.scene.objects[placed.object.0 as usize][hit.geometry as usize], Some(placed))
    }
    /// The surface that was hit and the point on it, in world space.
    #[inline(always)]
    pub(super) fn locate(&self, hit: &Hit, ray: &Ray) -> (&Surface, SurfacePoint) {
        let at = ray.o + hit.t * ray.d;
        let (surface, placed) = self.surface(hit);
        let wants_uv = self.even[surface.material.0 as usize].is_none();
        let Some(placed) = placed else { return (surface, surface.shape.surface_point(hit, at, wants_uv)) };
        let local = surface.shape.surface_point(hit, placed.object_from_world.transform_point3(at), wants_uv);
        (surface, placed.to_world(&local))
    }
    /// What covers `surface` at `point`, where that is not a plain model.
    #[inline(never)]
    fn cover(&self, hit: &Hit, ray: &Ray, surface: &Surface, point: &SurfacePoint, at: Lookup) -> Covered {
        let site = Site {
            materials: &self.scene.materials,
            at,
            ng: point.ng,
            n: point.n,
            tangents: self.tangents(hit, ray),
            outside: ray.d.dot(point.ng) < 0.0,
            coin: Coin::new(ray),
        };
        let covered = cover(surface.material, site);
        let filled = self.scene.looks[surface.material.0 as usize].interior.is_some();
        // A hole in what has an interior leads into it.
        if filled && site.coin.toss(HOLE) >= opacity(surface.material, site.materials, &at) {
            return Covered { bsdf: ThinDielectric::NOTHING.into(), ..covered };
        }
        covered
    }
    /// How the point of a hit moves in the world with its texture coordinates.
    fn tangents(&self, hit: &Hit, ray: &Ray) -> Option<Tangents> {
        let at = ray.o + hit.t * ray.d;
        let (surface, placed) = self.surface(hit);
        let Some(placed) = placed else {
            return surface.shape.tangents(hit, &surface.shape.surface_point(hit, at, false));
        };
        let point = surface.shape.surface_point(hit, placed.object_from_world.transform_point3(at), false);
        let tangents = surface.shape.tangents(hit, &point)?;
        Some(tangents.map(|t| placed.world_from_object.transform_vector3(t)))
    }

    #[inline(never)]
    fn closest_between_holes(&self, ray: &Ray) -> Option<Hit> {
        let coin = Coin::new(ray);
        self.moment.bvh.closest_filtered(ray, |hit| self.meets(hit, ray, coin))
    }
    #[inline(never)]
    fn occluded_between_holes(&self, ray: &Ray) -> bool {
        let coin = Coin::new(ray);
        self.moment.bvh.occluded_filtered(ray, |hit| self.meets(hit, ray, coin))
    }
    /// Whether `ray` meets the surface of `hit`, or a hole in it.
    pub(super) fn meets(&self, hit: &Hit, ray: &Ray, coin: Coin) -> bool {
        let (surface, _) = self.surface(hit);
        if !self.scene.porous[surface.material.0 as usize] || surface.light.is_some() {
            return true;
        }
        let (surface, point) = self.locate(hit, ray);
        let at = Lookup {
            textures: &self.scene.textures,
            uv: point.uv,
            p: point.p,
            lambda: self.around.lambda,
            attributes: surface.shape.attributes(hit),
            footprint: Footprint::POINT,
        };
        let opacity = opacity(surface.material, &self.scene.materials, &at);
        // A ball may be met twice by the same ray, so the place is part of the toss.
        let place = [hit.instance, hit.geometry, hit.primitive, hit.t.to_bits()];
        let salt = place.iter().fold(0, |h, &v| crate::sampler::mix64(h ^ u64::from(v)));
        opacity >= 1.0 || coin.toss(salt) < opacity
    }
}

impl Placement {
    fn to_world(&self, s: &SurfacePoint) -> SurfacePoint {
        let m = &self.world_from_object;
        let abs = |m: &Mat3A| Mat3A::from_cols(m.x_axis.abs(), m.y_axis.abs(), m.z_axis.abs());
        let (forth, back) = (abs(&m.matrix3), abs(&self.object_from_world.matrix3));
        // Error of the moved point: the old error moved, plus the roundings of the transform itself, and of the inverse
        // transform that rays leaving this point go through.
        let p = m.transform_point3(s.p);
        let there = forth * s.p.abs() + Vec3::from(m.translation).abs();
        let back_again = forth * (back * p.abs() + Vec3::from(self.object_from_world.translation).abs());
        let rounding = crate::shape::gamma(4.0) * (there + back_again);
        let ng = (self.normal_from_object * s.ng).normalize_or(Vec3::Z);
        let n = (self.normal_from_object * s.n).normalize_or(ng);
        SurfacePoint { p, p_error: 1.01 * (forth * s.p_error) + rounding, ng, n, uv: s.uv }
    }
}
