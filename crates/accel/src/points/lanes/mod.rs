//! The three inner loops of the point indices, sixteen at a time, in the widest instructions of this processor.
//!
//! A query is a [`Task`]; [`Isa::run`] compiles it once per instruction set and picks at run time. All sets give the
//! same bits: they add in the same order and fuse nothing.

mod portable;
#[cfg(test)]
mod tests;
#[cfg(target_arch = "x86_64")]
mod x86;

use glam::Vec3;

use portable::Portable;

/// How many points or boxes one step handles.
pub(super) const LANES: usize = 16;

/// One value for each lane.
pub(super) type Row = [f32; LANES];

/// One coordinate per row.
pub(super) type Rows<'a> = [&'a Row; 3];

/// Where numbers and squared distances of points go.
pub(super) struct Near<'a> {
    pub(super) numbers: &'a mut [u32; LANES],
    pub(super) d2: &'a mut Row,
}

/// An instruction set. A value of a type that implements this proves that the processor has it.
pub(super) trait Lanes: Copy {
    /// Squared distances from `p` to sixteen points; bit `i` of the result tells `d2[i] <= bound`.
    fn points(self, at: Rows, p: Vec3, bound: f32, d2: &mut Row) -> u32;

    /// Of sixteen points whose bit in `valid` is set, those with a squared distance from `p` of at most `bound`, in order: their
    /// numbers, counted from `first`, and their squared distances. Returns how many; what is behind them means nothing.
    fn near(self, at: Rows, p: Vec3, bound: f32, valid: u32, first: u32, out: Near) -> usize;

    /// Brings the memory at `p` closer, if that can be.
    fn prefetch(self, p: *const f32);

    /// Squared distances from `p` to sixteen boxes, 0 inside; bit `i` of the result tells `d2[i] <= bound`.
    /// Never above what [`Self::points`] gives for a point of the box.
    fn boxes(self, lo: Rows, hi: Rows, p: Vec3, bound: f32, d2: &mut Row) -> u32;

    /// Which cells of a 4x4x4 brick have `d2[0][x] + d2[1][y] + d2[2][z] <= bound`: bit `x + 4 y + 16 z`.
    fn cells(self, d2: &[[f32; 4]; 3], bound: f32) -> u64;
}

/// Work that wants the widest lanes. Implement `run` and all that it calls with `#[inline(always)]`.
pub(super) trait Task {
    /// Does the work once.
    fn run<L: Lanes>(self, lanes: L);
}

/// The instruction sets that tasks are compiled for.
#[derive(Clone, Copy)]
pub(super) enum Isa {
    /// What every processor of the target has.
    Portable(Portable),
    /// Eight lanes, twice.
    #[cfg(target_arch = "x86_64")]
    Avx2(x86::Avx2),
    /// Sixteen lanes.
    #[cfg(target_arch = "x86_64")]
    Avx512(x86::Avx512),
}

impl Isa {
    /// The best that this processor has.
    pub(super) fn detect() -> Self {
        #[cfg(target_arch = "x86_64")]
        {
            if let Some(lanes) = x86::Avx512::detect() {
                return Self::Avx512(lanes);
            }
            if let Some(lanes) = x86::Avx2::detect() {
                return Self::Avx2(lanes);
            }
        }
        Self::Portable(Portable)
    }

    /// Runs `task` with these lanes.
    #[inline]
    pub(super) fn run(self, task: impl Task) {
        match self {
            Self::Portable(lanes) => task.run(lanes),
            #[cfg(target_arch = "x86_64")]
            Self::Avx2(lanes) => lanes.run(task),
            #[cfg(target_arch = "x86_64")]
            Self::Avx512(lanes) => lanes.run(task),
        }
    }
}
