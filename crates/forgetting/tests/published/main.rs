//! Rules against their published forms, computed with dense matrices.

mod constant_trace;
#[path = "../dense/mod.rs"]
mod dense;
mod efra;
mod forms;
mod matrix_forgetting;
mod multiple;
mod variable_direction;
