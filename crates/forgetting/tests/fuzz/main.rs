//! Fuzzing: random input of any size, for a few cases in a test run, for hours with `make fuzz`.

#[path = "../conformance/subjects.rs"]
mod subjects;
mod target;

mod bytes;
mod states;
