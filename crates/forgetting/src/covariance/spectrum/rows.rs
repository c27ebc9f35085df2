//! Operations on the rows of a matrix that is kept row by row.

use forgetting_kernels::Real;

/// Rows i and i + 1 of rows of n numbers change places.
pub(super) fn swap_rows<T: Real>(rows: &mut [T], n: usize, i: usize) {
    let (above, below) = rows[i * n..].split_at_mut(n);
    above.swap_with_slice(&mut below[..n]);
}

/// Rows i < k of rows of n numbers.
pub(super) fn two_rows<T: Real>(
    rows: &mut [T],
    n: usize,
    i: usize,
    k: usize,
) -> (&mut [T], &mut [T]) {
    let (above, below) = rows.split_at_mut(k * n);
    (&mut above[i * n..(i + 1) * n], &mut below[..n])
}

/// (x, y) ← (cosine·x − sine·y, sine·x + cosine·y)
pub(super) fn rotate<T: Real>(x: &mut [T], y: &mut [T], cosine: T, sine: T) {
    for (x, y) in x.iter_mut().zip(y) {
        let (before_x, before_y) = (*x, *y);
        *x = cosine * before_x - sine * before_y;
        *y = sine * before_x + cosine * before_y;
    }
}
