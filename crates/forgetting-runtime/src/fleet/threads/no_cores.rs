//! The same where there are no threads: WebAssembly.

/// One.
pub fn count() -> usize {
    1
}

/// None but the one that runs.
pub fn are_there() -> bool {
    false
}

/// The sum of what `work` returns for each task, one after the other.
pub fn sum<P: Send>(tasks: Vec<P>, work: impl Fn(P) -> usize + Sync + Send) -> usize {
    tasks.into_iter().map(work).sum()
}
