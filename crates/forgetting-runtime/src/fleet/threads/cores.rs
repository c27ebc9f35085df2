//! The cores of a machine with threads.

use rayon::prelude::*;
use std::sync::OnceLock;

/// How many there are.
pub fn count() -> usize {
    rayon::current_num_threads()
}

/// Whether this process has the threads: one that was forked from another has not.
pub fn are_there() -> bool {
    static PROCESS: OnceLock<u32> = OnceLock::new();
    *PROCESS.get_or_init(std::process::id) == std::process::id()
}

/// The sum of what `work` returns for each task, on all of them.
pub fn sum<P: Send>(tasks: Vec<P>, work: impl Fn(P) -> usize + Sync + Send) -> usize {
    tasks.into_par_iter().map(work).sum()
}
