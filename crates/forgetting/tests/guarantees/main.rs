//! What the header of each rule claims, tested: F ≥ 0 (A1), P̄ bounded above without excitation
//! (A2), P bounded below for bounded regressors (A3); and a counterexample to each claim that is
//! not made for every input.

#[path = "../dense/mod.rs"]
mod dense;
#[path = "../conformance/record.rs"]
mod record;
#[path = "../conformance/subjects.rs"]
mod subjects;

mod attack;
mod bounds;
mod change;
mod claims;
mod inputs;
mod run;
