//! How rough a surface is, and whether that depends on the direction.
use super::{Facets, Landscape, Lookup, Scalar, TextureId, ggx::Ggx};

/// Roughness along the two tangents: where the texture coordinate u grows, and across. Brushed metal has two different ones.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Roughness {
    /// Along.
    pub u: Scalar,
    /// Across.
    pub v: Scalar,
    /// The kind of landscape; models with layers over GGX do not look at it.
    pub facets: Facets,
}

impl From<f32> for Roughness {
    fn from(alpha: f32) -> Self {
        Scalar::Constant(alpha).into()
    }
}

impl From<TextureId> for Roughness {
    fn from(alpha: TextureId) -> Self {
        Scalar::Texture(alpha).into()
    }
}

impl From<Scalar> for Roughness {
    fn from(alpha: Scalar) -> Self {
        Self::aligned(alpha, alpha)
    }
}

impl Roughness {
    /// Of GGX, `u` along and `v` across.
    pub fn aligned(u: Scalar, v: Scalar) -> Self {
        Self { u, v, facets: Facets::Ggx }
    }
    /// The same of another kind of landscape.
    pub fn with(self, facets: Facets) -> Self {
        Self { facets, ..self }
    }
    /// Whether it depends on the direction.
    pub(super) fn is_aligned(&self) -> bool {
        self.u != self.v
    }
    pub(super) fn textures(&self) -> impl Iterator<Item = TextureId> {
        [self.u, self.v].into_iter().filter_map(Scalar::texture)
    }
    /// Both roughnesses here.
    #[inline]
    pub(super) fn at(&self, at: &Lookup) -> [f32; 2] {
        let u = at.scalar(self.u);
        [u, if self.is_aligned() { at.scalar(self.v) } else { u }]
    }
    /// The landscape here; `None` where both roughnesses are below [`Ggx::MIN_ALPHA`], and the surface is smooth.
    #[inline]
    pub(super) fn landscape(&self, at: &Lookup) -> Option<Landscape> {
        let [u, v] = self.at(at);
        (u.max(v) >= Ggx::MIN_ALPHA).then(|| Landscape::new(self.facets, u, v))
    }
    /// As [`Roughness::landscape`], of GGX.
    #[inline]
    pub(super) fn ggx(&self, at: &Lookup) -> Option<Ggx> {
        let [u, v] = self.at(at);
        (u.max(v) >= Ggx::MIN_ALPHA).then(|| Ggx::aligned(u, v))
    }
}
