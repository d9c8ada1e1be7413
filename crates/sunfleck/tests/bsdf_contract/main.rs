//! What every scattering model promises, checked over the whole list of models.
//!
//! [`models`] is the list; [`sampling`], [`energy`], [`symmetry`] and [`edges`] are the promises of
//! [`sunfleck::bsdf::Scatter`]; [`boundaries`] and [`microfacets`] check the shared mathematics. [`sphere`] and
//! [`statistics`] are their instruments.
mod boundaries;
mod edges;
mod energy;
mod microfacets;
mod models;
mod sampling;
mod sphere;
mod statistics;
mod symmetry;
