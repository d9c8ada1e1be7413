//! The ray hierarchy: right answers, no leaks, every kind of input.

mod answers;
mod shapes;
mod support;
mod watertight;

use accel::SimdLevel;

/// Levels that the processor lacks fall back to the best one it has.
const LEVELS: [SimdLevel; 3] = [SimdLevel::Portable, SimdLevel::Avx2, SimdLevel::Avx512];
