//! Rows as columns: the numbers of one stream after those of the other become registers with a
//! stream in each lane.
//!
//! As everywhere in this folder: only what has checked the machine names these types, so that
//! every intrinsic here has its instructions.

use super::{at, Wide};
use crate::fused::Fused;
use core::arch::x86_64::*;
use forgetting_kernels::number::vector::StreamVector;

/// So many numbers of a row are read at once.
const WINDOW: usize = 8;

/// The columns of sixteen rows: the first eight side by side, others one by one. For eight streams of
/// `f64` that takes as long as one by one, and so it does for less than four columns.
#[inline(always)]
pub fn of_sixteen<const N: usize>(rows: &[[Fused<f32>; N]; 16]) -> [Wide<__m512>; N] {
    let window = Wide::window(rows);
    let mut columns = [window[0]; N];
    for i in 0..N {
        columns[i] = if N >= 4 && i < WINDOW { window[i] } else { Wide::at(|lane| rows[lane][i]) };
    }
    columns
}

/// Ones for the numbers of a row.
const fn mask(n: usize) -> u8 {
    if n < WINDOW {
        (1 << n) - 1
    } else {
        u8::MAX
    }
}

impl Wide<__m512> {
    /// The first eight columns; zeros where there are fewer.
    #[inline(always)]
    fn window<const N: usize>(rows: &[[Fused<f32>; N]; 16]) -> [Self; WINDOW] {
        let (x, y) = (Self::halves_of_columns(rows, 0), Self::halves_of_columns(rows, 8));
        let mut columns = [x[0]; WINDOW];
        for c in 0..4 {
            let (x, y) = (x[c].0, y[c].0);
            columns[c] = Self(unsafe { _mm512_shuffle_f32x4::<0x88>(x, y) });
            columns[c + 4] = Self(unsafe { _mm512_shuffle_f32x4::<0xDD>(x, y) });
        }
        columns
    }

    /// Of eight rows from `first` on: the first four numbers of column c, those of column c + 4, then
    /// the other four of both, for c = 0 … 3.
    #[inline(always)]
    fn halves_of_columns<const N: usize>(rows: &[[Fused<f32>; N]; 16], first: usize) -> [Self; 4] {
        let mut r = [Self(unsafe { _mm512_setzero_ps() }); 4];
        for k in 0..4 {
            let (row, later) = (&rows[first + k], &rows[first + k + 4]);
            r[k] = Self(unsafe {
                // where the mask is 0 nothing is read
                let low = _mm256_maskz_loadu_ps(mask(N), at!(row, f32, 0));
                let high = _mm256_maskz_loadu_ps(mask(N), at!(later, f32, 0));
                _mm512_insertf32x8::<1>(_mm512_castps256_ps512(low), high)
            });
        }
        let [a, b, c, d] = r;
        unsafe {
            let (ab, cd) = (_mm512_unpacklo_ps(a.0, b.0), _mm512_unpacklo_ps(c.0, d.0));
            let (high_ab, high_cd) = (_mm512_unpackhi_ps(a.0, b.0), _mm512_unpackhi_ps(c.0, d.0));
            let pairs = [(ab, cd), (high_ab, high_cd)];
            let mut columns = [a; 4];
            for k in 0..2 {
                let (x, y) = (_mm512_castps_pd(pairs[k].0), _mm512_castps_pd(pairs[k].1));
                columns[2 * k] = Self(_mm512_castpd_ps(_mm512_unpacklo_pd(x, y)));
                columns[2 * k + 1] = Self(_mm512_castpd_ps(_mm512_unpackhi_pd(x, y)));
            }
            columns
        }
    }
}
