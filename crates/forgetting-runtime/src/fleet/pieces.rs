//! Work on all streams that may take long: piece by piece; at the start and between them it asks whether
//! to go on.

use crate::estimator::record::{GoOn, Pause};
use crate::number::Number;
use forgetting::fleet::Fleet;
use forgetting::Error;
use std::ops::Range;

/// Numbers of the state in a piece.
const NUMBERS: usize = 1 << 18;
/// A piece is so many streams, or a multiple: whole blocks of lanes, whatever their number type.
const BLOCK: usize = 64;

/// Does `work` on each piece of the streams from the first to `count`, each of n parameters.
///
/// # Errors
/// That of `work`, and that of `go_on`.
pub fn each_piece(
    count: usize,
    n: usize,
    go_on: GoOn<'_>,
    mut work: impl FnMut(Range<usize>) -> Result<(), Error>,
) -> Result<(), Error> {
    let piece = (NUMBERS / (n * n)).next_multiple_of(BLOCK).max(BLOCK);
    go_on()?;
    let mut pause = Pause::new(go_on, 1, n);
    for first in (0..count).step_by(piece) {
        let streams = first..count.min(first + piece);
        pause.after(streams.len())?;
        work(streams)?;
    }
    Ok(())
}

/// The same for each stream.
///
/// # Errors
/// Those of [`each_piece`].
pub fn each_stream(
    count: usize,
    n: usize,
    go_on: GoOn<'_>,
    mut work: impl FnMut(usize) -> Result<(), Error>,
) -> Result<(), Error> {
    go_on()?;
    let mut pause = Pause::new(go_on, 1, n);
    (0..count).try_for_each(|stream| {
        pause.after(1)?;
        work(stream)
    })
}

/// Room for `count` numbers of n each.
///
/// # Errors
/// [`Error::Memory`] when there is none.
pub fn room<X>(count: usize, n: usize) -> Result<Vec<X>, Error> {
    let mut numbers = Vec::new();
    let all = count.checked_mul(n).ok_or(Error::Memory)?;
    numbers.try_reserve_exact(all).map_err(|_| Error::Memory)?;
    Ok(numbers)
}

/// `count` times 0.
///
/// # Errors
/// [`Error::Memory`] when there is none.
pub fn zeros<X: Clone + Default>(count: usize) -> Result<Vec<X>, Error> {
    let mut numbers = room(count, 1)?;
    numbers.resize(count, X::default());
    Ok(numbers)
}

/// Adds streams to `fleet`: copies of those of `others`, where given, then so many new ones.
///
/// # Errors
/// Those of [`Fleet::append`] and of [`each_piece`]; nothing has changed.
pub fn extend<T: Number>(
    fleet: &mut Fleet<T>,
    others: Option<&Fleet<T>>,
    new: usize,
    go_on: GoOn<'_>,
) -> Result<(), Error> {
    let (before, n) = (fleet.count(), fleet.parameters());
    let copies = others.map_or(0, Fleet::count);
    fleet.reserve(copies.checked_add(new).ok_or(Error::Memory)?)?;
    let copied = others.map_or(Ok(()), |others| {
        each_piece(copies, n, go_on, |streams| fleet.append(others, streams))
    });
    let extended =
        copied.and_then(|()| each_piece(new, n, go_on, |streams| fleet.grow(streams.len())));
    if extended.is_err() {
        fleet.truncate(before);
    }
    extended
}
