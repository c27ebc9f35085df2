//! What every rule of the registry must do, whatever it forgets. A new line of the registry is
//! tested here without an edit.

mod bits;
mod fuzz;
mod gates;
mod headers;
mod innovation;
mod limits;
mod parameters;
mod record;
mod silence;
mod subjects;
mod tampering;
mod trace;
