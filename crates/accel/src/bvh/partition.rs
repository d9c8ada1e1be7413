//! Moving the references of both sides of a split apart.

use super::{
    binning::ObjectSplit,
    refs::{Bounds, Corners, Ref},
    simd::SimdLevel,
};

impl ObjectSplit {
    /// Moves the left side to the front; returns its length and the boxes around the doubled centres of both sides.
    pub(super) fn partition(&self, refs: &mut [Ref], level: SimdLevel) -> (usize, [Bounds; 2]) {
        match level {
            SimdLevel::Portable => self.partition_with(refs),
            #[cfg(target_arch = "x86_64")]
            // SAFETY: the builder takes the level from `SimdLevel::detect`.
            SimdLevel::Avx2 | SimdLevel::Avx512 => unsafe { self.partition_avx2(refs) },
            #[cfg(not(target_arch = "x86_64"))]
            _ => self.partition_with(refs),
        }
    }

    #[cfg(target_arch = "x86_64")]
    #[target_feature(enable = "avx2")]
    fn partition_avx2(&self, refs: &mut [Ref]) -> (usize, [Bounds; 2]) {
        self.partition_with(refs)
    }

    /// Without branches, as nothing foretells to which side a reference goes.
    #[inline(always)]
    fn partition_with(&self, refs: &mut [Ref]) -> (usize, [Bounds; 2]) {
        let (origin, scale, bin) = (self.grid.origin[self.axis], self.grid.scale[self.axis], self.bin as f32);
        let mut centres = [Corners::EMPTY; 2];
        let mut middle = 0;
        for i in 0..refs.len() {
            let reference = refs[i];
            let centre = reference.0[self.axis] - reference.0[self.axis + 4];
            let is_left = (centre - origin) * scale < bin;
            let centre = Corners::point(reference.centre2());
            centres[0].grow(&centre.plus([f32::INFINITY, 0.0][usize::from(is_left)]));
            centres[1].grow(&centre.plus([0.0, f32::INFINITY][usize::from(is_left)]));
            refs[i] = refs[middle];
            refs[middle] = reference;
            middle += usize::from(is_left);
        }
        (middle, [centres[0].bounds(), centres[1].bounds()])
    }
}
