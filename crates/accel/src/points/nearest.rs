//! The `k` nearest points.

use glam::Vec3;

/// An index over points that finds the nearest ones. Immutable once built.
pub struct KdTree {
    points: Vec<(Vec3, u32)>,
}

impl KdTree {
    /// Indexes `points`. Points that are not finite are left out.
    ///
    /// # Panics
    /// If there are more than `u32::MAX` points.
    pub fn build(points: &[Vec3]) -> Self {
        assert!(u32::try_from(points.len()).is_ok(), "at most u32::MAX points");
        Self { points: points.iter().copied().zip(0..).filter(|(q, _)| q.is_finite()).collect() }
    }

    /// Fills `out` with the up to `k` points nearest to `p` among those with squared distance `d2 <= r_max * r_max`,
    /// nearest first, equal distances by index. A negative or NaN `r_max`, or a `p` that is not finite, finds nothing.
    pub fn nearest(&self, p: Vec3, k: usize, r_max: f32, out: &mut Neighbours) {
        out.keys.clear();
        if !p.is_finite() || r_max.is_nan() || r_max < 0.0 {
            return;
        }
        for &(q, i) in &self.points {
            let d2 = p.distance_squared(q);
            if d2 <= r_max * r_max {
                out.keys.push(u64::from(d2.to_bits()) << 32 | u64::from(i));
            }
        }
        if k < out.keys.len() {
            out.keys.select_nth_unstable(k);
            out.keys.truncate(k);
        }
        out.keys.sort_unstable();
    }

    /// The number of points kept, which is the number of finite ones.
    pub fn len(&self) -> usize {
        self.points.len()
    }

    /// Whether no point was kept.
    pub fn is_empty(&self) -> bool {
        self.points.is_empty()
    }
}

/// The answer of [`KdTree::nearest`]: point indices and squared distances, nearest first. Reuse one for many queries:
/// it keeps its memory.
#[derive(Clone, Debug, Default)]
pub struct Neighbours {
    /// Bits of the squared distance above the index: integer order is the order by distance, then by index.
    keys: Vec<u64>,
}

impl Neighbours {
    /// Empty, and without memory until its first use.
    pub fn new() -> Self {
        Self::default()
    }

    /// The number of points found.
    pub fn len(&self) -> usize {
        self.keys.len()
    }

    /// Whether no point was found.
    pub fn is_empty(&self) -> bool {
        self.keys.is_empty()
    }

    /// The `i`-th nearest as (index, squared distance), or `None` beyond the last.
    pub fn get(&self, i: usize) -> Option<(u32, f32)> {
        self.keys.get(i).map(|&key| unpack(key))
    }

    /// The farthest of the points found as (index, squared distance).
    pub fn farthest(&self) -> Option<(u32, f32)> {
        self.keys.last().map(|&key| unpack(key))
    }

    /// All as (index, squared distance), nearest first.
    pub fn iter(&self) -> impl ExactSizeIterator<Item = (u32, f32)> + DoubleEndedIterator + '_ {
        self.keys.iter().map(|&key| unpack(key))
    }
}

fn unpack(key: u64) -> (u32, f32) {
    (key as u32, f32::from_bits((key >> 32) as u32))
}
