//! Every rate and every weighting of the registries, whatever they are.

mod bits;
mod limits;
mod outliers;
mod parameters;
mod subjects;
