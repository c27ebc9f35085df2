//! The samples of a block: numbers of one stream after the other, as vectors with a stream in
//! each lane.

use super::{Line, Real, Samples, StreamVector};
use core::ops::Range;

/// The regressors of the streams from `lane` on as columns; zeros in the lanes that are over.
#[inline(always)]
pub fn columns<T: Real, A: StreamVector<T>, const N: usize>(
    rows: &[[T; N]],
    lane: usize,
) -> [A; N] {
    if let Some(rows) = rows.get(lane..lane + A::COUNT) {
        return A::columns(rows);
    }
    let mut columns = [A::splat(T::ZERO); N];
    for i in 0..N {
        columns[i] = A::at(|k| rows.get(lane + k).map_or(T::ZERO, |row| row[i]));
    }
    columns
}

/// The y of these streams; NaN where one has no sample, and in the lanes that are over.
#[inline(always)]
pub fn outputs<T: Real>(samples: &Samples<'_, T>, streams: Range<usize>) -> Line<T> {
    let y = &samples.y[streams.clone()];
    if let (None, [chunk, ..]) = (samples.mask, T::chunks(y).0) {
        return Line(*chunk);
    }
    let mut line = Line::splat(T::from_f64(f64::NAN));
    for (lane, &y) in y.iter().enumerate() {
        if samples.mask.is_none_or(|mask| mask[streams.start + lane]) {
            line.set(lane, y);
        }
    }
    line
}
