//! What a random walk is told.

use crate::choice::{Kind, Parameter, Range};
use crate::rules::cycle;

pub(crate) const PROCESS_NOISE: Parameter = Parameter::elements(
    "process_noise",
    Kind::Matrix,
    1e-4,
    Range::NON_NEGATIVE,
    "covariance of the parameters' steps: c for c*I, n numbers for a diagonal, or n x n",
);

pub(crate) const BOUND: Parameter = Parameter {
    name: "bound",
    about: "what no variance grows beyond without excitation; not bounded if not given",
    kind: Kind::Real,
    range: Range::POSITIVE,
    default: None,
    optional: true,
};

pub(crate) const SCHEDULE: Parameter = cycle::schedule(
    "when process_noise is added: all of it at each sample, or one direction a sample, in O(n^2)",
);
