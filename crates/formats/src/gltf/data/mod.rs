//! The bytes behind the JSON: buffers, the views into them, and accessors, which are lists of numbers.

mod accessor;
mod buffers;
mod component;
mod meshopt;
mod uri;

pub(super) use accessor::Accessor;
pub(super) use buffers::{Buffers, reason};
pub(super) use component::{Component, element_bytes, width_of};
pub(super) use uri::{Reference, reference};
