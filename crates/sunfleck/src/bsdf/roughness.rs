//! How rough a surface is, and whether that depends on the direction.
use super::{Lookup, Scalar, TextureId, ggx::Ggx};

/// GGX roughness along the two tangents: where the texture coordinate u grows, and across. Brushed metal has two different
/// ones.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Roughness {
    /// Along.
    pub u: Scalar,
    /// Across.
    pub v: Scalar,
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
        Self { u: alpha, v: alpha }
    }
}

impl Roughness {
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
    pub(super) fn ggx(&self, at: &Lookup) -> Option<Ggx> {
        let [u, v] = self.at(at);
        (u.max(v) >= Ggx::MIN_ALPHA).then(|| Ggx::aligned(u, v))
    }
}
