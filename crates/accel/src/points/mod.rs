//! Which points lie near a point?
//!
//! Two indices, for the two questions a photon map asks:
//! - [`PointGrid`]: all points within a fixed radius. Cheap to rebuild for every pass.
//! - [`KdTree`]: the `k` nearest points, into a reusable [`Neighbours`].
//!
//! Both are built in parallel, and neither their layout nor the order in which they report points depends on the
//! number of threads. Points with a coordinate that is NaN or infinite are never reported, and a query at such a
//! place reports nothing. Squared distances are those of `glam::Vec3::distance_squared`, bit for bit, on every
//! machine: no path fuses multiplication and addition.

mod grid;
mod lanes;
mod nearest;

pub use grid::PointGrid;
pub use nearest::{KdTree, Neighbours};
