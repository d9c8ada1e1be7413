//! Photons: where does the light that arrives at surfaces come from, and how dense is it?
//!
//! The way of a photon, one room after the other, never back:
//!
//! ```text
//!  light ─source─▶ walk ──deposit──▶ map ──gather──▶ integrator
//!                    │                 ▲      ▲
//!                    └── the camera's  │      └── kernel: what a photon at a distance counts
//!                        own walk ─ survey ─ radius: how far a gather reaches
//! ```
//!
//! - [`source`]: chooses a light and starts a path of known flux and density; [`aim`]: learns where to send it;
//! - [`deposit`]: which arrivals of a path are kept, and a [`Shower`] of many paths, the same for any number of threads;
//! - [`map`]: photons beside an index of their positions, by radius or by number;
//! - [`kernel`], [`gather`]: the density estimate;
//! - [`ledger`]: what becomes of the light of each lamp, and how much of it any gather reaches;
//! - [`mod@survey`], [`radii`], [`radius`]: what the camera sees of the scene, and from it the first radius and how it
//!   shrinks;
//! - [`uniformity`]: radii fitted to how evenly photons lie; [`bandwidth`]: radii fitted to the error they leave.
pub mod aim;
pub mod bandwidth;
pub mod deposit;
pub mod gather;
pub mod kernel;
pub mod ledger;
pub mod map;
pub mod radii;
pub mod radius;
mod sight;
pub mod source;
pub mod survey;
pub mod uniformity;

pub use aim::Training;
pub use bandwidth::{After, Bandwidth, Fitted, GatherError};
pub use deposit::{Catch, Keep, Photon, Shower};
pub use gather::{CameraEnd, Disc, Gathered, NearestQuery, gather_counted, gather_nearest, gather_within};
pub use kernel::Kernel;
pub use ledger::{Account, Amount, Audit, Ledger};
pub use map::{NearestMap, RadiusMap, Span};
pub use radii::Radii;
pub use radius::{Reach, Schedule};
pub(crate) use sight::Sight;
pub use source::{Emission, Source};
pub use survey::{Sighting, survey};
pub use uniformity::Evenness;
