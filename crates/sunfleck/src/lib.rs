//! sunfleck: a renderer of the photon-mapping family.
//!
//! The rooms, ground floor first: [`math`], [`spectrum`], [`sampler`]; then [`texture`], [`bsdf`], [`shape`], [`light`] and
//! [`camera`], one model a file; [`scene`] holds them in flat tables; [`walk`] is the one random
//! walk; [`photon`] is what light walks leave behind; [`integrator`] turns walks into pictures, pass by pass; [`film`]
//! adds passes up; [`render`] runs them.
#![forbid(unsafe_code)]

pub mod bsdf;
pub mod camera;
pub mod film;
pub mod integrator;
pub mod light;
pub mod math;
pub mod medium;
pub mod photon;
pub mod render;
pub mod sampler;
pub mod scene;
pub mod shape;
pub mod spectrum;
pub mod texture;
pub mod walk;
