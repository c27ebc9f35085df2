//! Eigenvalues so close that their eigenvectors are a matter of rounding: any basis of the space
//! they span is as good, and the sample decides which.

use super::jacobi::rotation;
use super::rows::{rotate, two_rows};
use super::Spectrum;
use crate::memory::Memory;
use core::ops::Range;
use forgetting_kernels::kernel::functions::{add_scaled, dot};
use forgetting_kernels::Kernels;
use forgetting_kernels::Real;

const SWEEPS: usize = 40;

impl<M: Memory> Spectrum<M> {
    /// The eigenvalues from `start` on that are equal but for the square root of the precision,
    /// each with the one before.
    pub fn cluster(&self, start: usize) -> Range<usize> {
        let values = self.information.as_ref();
        let tolerance = M::Real::EPSILON.sqrt();
        let mut end = start + 1;
        while end < values.len() && values[end] - values[end - 1] <= tolerance * values[end] {
            end += 1;
        }
        start..end
    }

    /// Turns the basis of a cluster until its first vectors are the right singular vectors of
    /// φ on it with a singular value above `threshold`; returns their number.
    ///
    /// `components` holds φ V, p rows of n numbers, of which it uses up those of the cluster.
    /// Where the eigenvalues differ, the vectors are no longer eigenvectors until
    /// [`Spectrum::settle`].
    pub fn align(
        &mut self,
        cluster: Range<usize>,
        components: &mut [M::Real],
        threshold: M::Real,
    ) -> usize {
        let n = self.memory.parameters();
        let mut found = 0;
        if cluster.len() == 1 {
            let column = components.iter().skip(cluster.start).step_by(n);
            let square = column.fold(M::Real::ZERO, |sum, &z| sum + z * z);
            return usize::from(square.sqrt() > threshold);
        }
        orthogonalize(components, n, cluster.clone());
        let uneven = self.is_uneven(cluster.clone());
        for k in 0..components.len() / n {
            let (row, later) = components[k * n..].split_at_mut(n);
            let length = dot(&row[cluster.clone()], &row[cluster.clone()]).sqrt();
            if !(length > threshold) || found == cluster.len() {
                continue;
            }
            if found == 0 && uneven {
                self.note_covariance(cluster.clone());
            }
            let first = cluster.start + found;
            self.reflect(&mut row[first..cluster.end], length, later, first, uneven, &cluster);
            found += 1;
        }
        found
    }

    /// Whether the eigenvalues of a cluster differ by more than rounding.
    pub fn is_uneven(&self, cluster: Range<usize>) -> bool {
        let values = &self.information.as_ref()[cluster];
        values[values.len() - 1] - values[0] > M::Real::EPSILON * M::Real::from_f64(4.0) * values[0]
    }

    /// vᵀPv for vector i of an uneven cluster, between [`Spectrum::align`] and
    /// [`Spectrum::settle`].
    pub fn variance(&self, cluster: Range<usize>, i: usize) -> M::Real {
        self.product.as_ref()[(i - cluster.start) * (cluster.len() + 1)]
    }

    /// The eigenvectors of an uneven cluster, after P became P + (`growth` − 1) Σ (vᵀPv) v vᵀ
    /// over its first `found` vectors.
    pub fn settle(&mut self, cluster: Range<usize>, found: usize, growth: M::Real) {
        let (n, c) = (self.memory.parameters(), cluster.len());
        let block = &mut self.product.as_mut()[..c * c];
        for i in 0..found {
            block[i * (c + 1)] *= growth;
        }
        let vectors = &mut self.vectors.as_mut()[cluster.start * n..cluster.end * n];
        diagonalize(block, vectors, c, n);
        for i in 0..c {
            let variance = self.product.as_ref()[i * (c + 1)];
            self.set_information(cluster.start + i, M::Real::ONE / variance);
        }
    }

    /// The block of P on the cluster, in `product`.
    fn note_covariance(&mut self, cluster: Range<usize>) {
        let c = cluster.len();
        let block = &mut self.product.as_mut()[..c * c];
        block.fill(M::Real::ZERO);
        let values = &self.information.as_ref()[cluster];
        for (x, &value) in block.iter_mut().step_by(c + 1).zip(values) {
            *x = M::Real::ONE / value;
        }
    }

    /// Householder's reflection that takes the direction `row` (of this length) to vector
    /// `first`, applied to the basis, to the `later` rows and to the block of P.
    fn reflect(
        &mut self,
        row: &mut [M::Real],
        length: M::Real,
        later: &mut [M::Real],
        first: usize,
        uneven: bool,
        cluster: &Range<usize>,
    ) {
        let (n, c) = (self.memory.parameters(), cluster.len());
        row[0] += if row[0] < M::Real::ZERO { -length } else { length };
        let beta = M::Real::from_f64(2.0) / dot(row, row);
        if !beta.is_finite() || row.len() == 1 {
            return;
        }
        let sum = &mut self.roots.as_mut()[..n];
        sum.fill(M::Real::ZERO);
        let basis = &mut self.vectors.as_mut()[first * n..cluster.end * n];
        for (&x, v) in row.iter().zip(basis.chunks_exact(n)) {
            add_scaled(sum, x, v);
        }
        for (&x, v) in row.iter().zip(basis.chunks_exact_mut(n)) {
            add_scaled(v, -(beta * x), sum);
        }
        for other in later.chunks_exact_mut(n) {
            let other = &mut other[first..cluster.end];
            add_scaled(other, -(beta * dot(row, other)), row);
        }
        if uneven {
            let block = &mut self.product.as_mut()[..c * c];
            reflect_block(block, c, first - cluster.start, row, beta);
        }
    }
}

/// H A H of the c x c matrix `block`, with H = I − beta·x·xᵀ on the indices from `first` on.
fn reflect_block<T: Kernels>(block: &mut [T], c: usize, first: usize, x: &[T], beta: T) {
    for line in block.chunks_exact_mut(c) {
        let line = &mut line[first..];
        add_scaled(line, -(beta * dot(x, line)), x);
    }
    for column in 0..c {
        let at = |i: usize| (first + i) * c + column;
        let sum = x.iter().enumerate().fold(T::ZERO, |sum, (i, &x)| sum + x * block[at(i)]);
        for (i, &x) in x.iter().enumerate() {
            block[at(i)] -= beta * sum * x;
        }
    }
}

/// Rotates rows of n numbers until they are orthogonal over these columns.
fn orthogonalize<T: Kernels>(rows: &mut [T], n: usize, columns: Range<usize>) {
    let p = rows.len() / n;
    for _ in 0..SWEEPS {
        let mut rotated = false;
        for i in 0..p {
            for k in i + 1..p {
                let (x, y) = two_rows(rows, n, i, k);
                let (x, y) = (&mut x[columns.clone()], &mut y[columns.clone()]);
                let (a, b, c) = (dot(x, x), dot(y, y), dot(x, y));
                if c.abs() > T::EPSILON * (a * b).sqrt() {
                    let (cosine, sine) = rotation(a, b, c);
                    rotate(x, y, cosine, sine);
                    rotated = true;
                }
            }
        }
        if !rotated {
            break;
        }
    }
}

/// Rotates the symmetric c x c matrix `block` until it is diagonal, and `vectors` with it.
fn diagonalize<T: Kernels>(block: &mut [T], vectors: &mut [T], c: usize, n: usize) {
    for _ in 0..SWEEPS {
        let mut rotated = false;
        for i in 0..c {
            for k in i + 1..c {
                let (a, b, off) = (block[i * (c + 1)], block[k * (c + 1)], block[i * c + k]);
                if !(off.abs() > T::EPSILON * (a * b).sqrt()) {
                    continue;
                }
                let (cosine, sine) = rotation(a, b, off);
                let (x, y) = two_rows(block, c, i, k);
                rotate(x, y, cosine, sine);
                for line in block.chunks_exact_mut(c) {
                    let (x, y) = (line[i], line[k]);
                    line[i] = cosine * x - sine * y;
                    line[k] = sine * x + cosine * y;
                }
                let (v, w) = two_rows(vectors, n, i, k);
                rotate(v, w, cosine, sine);
                rotated = true;
            }
        }
        if !rotated {
            break;
        }
    }
}
