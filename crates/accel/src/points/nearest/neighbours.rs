//! The best `k` so far, then the answer.

/// The answer of [`KdTree::nearest`](super::KdTree::nearest): point indices and squared distances, nearest first; or of
/// [`KdTree::nearest_unordered`](super::KdTree::nearest_unordered), where only the last is known to be the farthest.
/// Reuse one for many queries: it keeps its memory.
#[derive(Clone, Debug, Default)]
pub struct Neighbours {
    /// Keys of what was found; a heap with the worst on top once there are `k`, sorted when the query ends if the caller wants it.
    keys: Vec<u64>,
    k: usize,
    /// Only keys below this one are wanted.
    worst: u64,
}

/// A squared distance above an index: the order of keys is the order by distance, then by index, since the bits of
/// floats that are not negative are in the order of their values.
#[inline(always)]
pub(super) fn key(d2: f32, index: u32) -> u64 {
    u64::from(d2.to_bits()) << 32 | u64::from(index)
}

/// The squared distance of a key.
#[inline(always)]
pub(super) fn d2_of(key: u64) -> f32 {
    f32::from_bits((key >> 32) as u32)
}

/// The index of a key.
#[inline(always)]
pub(super) fn index_of(key: u64) -> u32 {
    key as u32
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

    /// The `i`-th of the answer as (index, squared distance), or `None` beyond the last.
    pub fn get(&self, i: usize) -> Option<(u32, f32)> {
        self.keys.get(i).map(|&key| (index_of(key), d2_of(key)))
    }

    /// The farthest of the points found as (index, squared distance).
    pub fn farthest(&self) -> Option<(u32, f32)> {
        self.keys.last().map(|&key| (index_of(key), d2_of(key)))
    }

    /// All as (index, squared distance), in the order of the answer.
    pub fn iter(&self) -> impl DoubleEndedIterator<Item = (u32, f32)> + ExactSizeIterator + '_ {
        self.keys.iter().map(|&key| (index_of(key), d2_of(key)))
    }

    /// Forgets what was found and will take up to `k` with `d2 <= bound`.
    #[inline]
    pub(super) fn begin(&mut self, k: usize, bound: f32) {
        self.keys.clear();
        self.k = k;
        // No point has the index `u32::MAX`, so all at this distance are below.
        self.worst = key(bound, u32::MAX);
    }

    /// The key that others must be below to be wanted.
    #[inline(always)]
    pub(super) fn worst(&self) -> u64 {
        self.worst
    }

    /// Takes a point if it is one of the best so far.
    #[inline(always)]
    pub(super) fn offer(&mut self, key: u64) {
        if key >= self.worst {
            return;
        }
        if self.keys.len() < self.k {
            self.keys.push(key);
            if self.keys.len() == self.k {
                (0..self.k / 2).rev().for_each(|i| sift_down(&mut self.keys, i));
                self.worst = self.keys[0];
            }
        } else {
            self.keys[0] = key;
            sift_down(&mut self.keys, 0);
            self.worst = self.keys[0];
        }
    }

    /// Puts the nearest first.
    #[inline]
    pub(super) fn sort(&mut self) {
        self.keys.sort_unstable();
    }

    /// Puts the farthest last and leaves the others as they are.
    #[inline]
    pub(super) fn put_farthest_last(&mut self) {
        // With `k` found they are a heap.
        let top = if self.keys.len() == self.k { Some(0) } else { (0..self.keys.len()).max_by_key(|&i| self.keys[i]) };
        if let (Some(top), Some(last)) = (top, self.keys.len().checked_sub(1)) {
            self.keys.swap(top, last);
        }
    }
}

/// Moves `heap[i]` down until no child is larger.
#[inline(always)]
fn sift_down(heap: &mut [u64], mut i: usize) {
    let moved = heap[i];
    loop {
        let mut child = 2 * i + 1;
        if child >= heap.len() {
            break;
        }
        if child + 1 < heap.len() {
            child += usize::from(heap[child + 1] > heap[child]);
        }
        if heap[child] <= moved {
            break;
        }
        heap[i] = heap[child];
        i = child;
    }
    heap[i] = moved;
}
