//! sunfleck: a renderer of the photon-mapping family.
#![forbid(unsafe_code)]
