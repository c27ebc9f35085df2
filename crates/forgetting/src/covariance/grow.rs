//! Adding covariance: P ← c·P and P ← P + c·x·xᵀ. P can only grow, and is watched for overflow.

use super::Factor;
use crate::error::Error;
use crate::memory::Memory;
use forgetting_kernels::kernel::{functions, layout};
use forgetting_kernels::Real;

impl<M: Memory> Factor<M> {
    /// P ← `growth`·P with `growth` ≥ 1. O(n).
    ///
    /// # Errors
    /// [`Error::Range`] when P would leave the range of the number type; P is as it was.
    #[inline]
    pub fn scale(&mut self, growth: M::Real) -> Result<(), Error> {
        self.reserve(growth, M::Real::ZERO)?;
        for d in self.diagonal.as_mut() {
            *d *= growth;
        }
        self.deferred.scale(growth);
        Ok(())
    }

    /// P ← P·`trace`/tr(P), for a trace below [`Real::CEILING`]. O(n²).
    ///
    /// Elements of D that would fall below [`Real::FLOOR`] stay there.
    pub fn hold_trace(&mut self, trace: M::Real) {
        let before = self.trace();
        for j in 0..self.parameters() {
            self.put_diagonal(j, self.diagonal.as_ref()[j] / before * trace);
        }
        self.deferred.scale(trace / before);
        self.tighten();
    }

    /// P ← `share`·P with `share` in (0, 1]. O(n). Elements of D that would fall below [`Real::FLOOR`]
    /// stay there.
    pub fn shrink(&mut self, share: M::Real) {
        for j in 0..self.parameters() {
            self.put_diagonal(j, self.diagonal.as_ref()[j] * share);
        }
        self.deferred.scale(share);
    }

    /// P ← S·P·S with S = I but for `scale` in (0, 1] at parameter `i`. O(n). Its D stays at
    /// [`Real::FLOOR`] where it would fall below.
    pub fn shrink_one(&mut self, i: usize, scale: M::Real) {
        let columns = self.columns.as_mut();
        for k in 0..i {
            columns[layout::place::<M::Real>(k, i)] /= scale;
        }
        for k in i + 1..self.memory.parameters() {
            columns[layout::place::<M::Real>(i, k)] *= scale;
        }
        self.put_diagonal(i, self.diagonal.as_ref()[i] * scale * scale);
    }

    /// P ← P + c·x·xᵀ with c ≥ 0 for n numbers `x`, which it uses up. O(m²), m the place of the
    /// last number that is not 0: columns of U after it stay as they are.
    ///
    /// Call [`Factor::reserve`] first, for all that one sample adds.
    #[inline]
    pub fn add_covariance(&mut self, x: &mut [M::Real], c: M::Real) {
        if let Some(last) = x.iter().rposition(|&x| x != M::Real::ZERO) {
            let (d, x) = (&mut self.diagonal.as_mut()[..=last], &mut x[..=last]);
            functions::agee_turner(self.columns.as_mut(), d, x, c);
        }
    }

    /// P ← P + diag(`variances`), each ≥ 0. O(n³/3): one dyad per element that is not 0.
    ///
    /// Call [`Factor::reserve`] first.
    pub fn add_diagonal(&mut self, variances: &[M::Real], work: &mut [M::Real]) {
        for (i, &variance) in variances.iter().enumerate() {
            if variance > M::Real::ZERO {
                work.fill(M::Real::ZERO);
                work[i] = M::Real::ONE;
                self.add_covariance(work, variance);
            }
        }
    }

    /// Makes room for P to become at most `growth`·P plus a matrix of trace `added`.
    ///
    /// The bound on P's trace costs O(1) to keep; only when it nears the limit is the trace
    /// itself computed.
    ///
    /// # Errors
    /// [`Error::Range`] when the trace would exceed [`Real::CEILING`]; P is as it was.
    #[inline]
    pub fn reserve(&mut self, growth: M::Real, added: M::Real) -> Result<(), Error> {
        let before = self.trace_bound;
        let mut bound = before * growth + added;
        if !(bound < M::Real::CEILING) {
            self.tighten();
            bound = self.trace_bound * growth + added;
        }
        self.set_bound(bound).inspect_err(|_| self.trace_bound = before)
    }

    /// Makes room for a P of at most this trace, which is to take the place of P.
    ///
    /// # Errors
    /// [`Error::Range`] when it exceeds [`Real::CEILING`]; P is as it was.
    #[inline]
    pub(crate) fn set_bound(&mut self, trace: M::Real) -> Result<(), Error> {
        if trace < M::Real::CEILING {
            self.trace_bound = trace;
            return Ok(());
        }
        let (value, limit) = (trace.to_f64(), M::Real::CEILING.to_f64());
        Err(Error::Range { parameter: "covariance (its trace)", value, limit })
    }
}

#[cfg(test)]
mod tests {
    use super::Factor;
    use crate::memory::Dynamic;
    use alloc::vec;
    use forgetting_kernels::kernel::layout::place;
    use forgetting_kernels::Kernels;

    /// The trace of P grows by that of what is added, also where D of a long column grows to
    /// many times what it was.
    fn adds_what_it_is_given<T: Kernels>(n: usize, long: f64) {
        let memory = Dynamic::<T>::new(n, 1, 1).unwrap();
        let (one, long) = (T::ONE, T::from_f64(long));
        for j in 0..n {
            let mut factor = Factor::scalar(memory, one).unwrap();
            // column j is `long`, and D_j so small that it weighs as much as any other
            factor.diagonal.as_mut()[j] = one / (long * long);
            for i in 0..j {
                let sign = if i % 2 == 0 { one } else { -one };
                factor.columns.as_mut()[place::<T>(i, j)] = sign * long;
            }
            let before = factor.trace();
            let step = T::from_f64(1e-3);
            factor.add_diagonal(&vec![step; n], &mut vec![T::ZERO; n]);
            let expected = before + step * T::from_f64(n as f64);
            let error = (factor.trace() / expected - one).abs();
            assert!(error < T::EPSILON * T::from_f64(100.0), "{n} {j}: {error:?}");
            assert!(factor.is_sound(), "{n} {j}: {factor:?}");
        }
    }

    #[test]
    fn a_long_column_adds_no_rounding() {
        for n in [2, 3, 8, 9, 12, 16, 17, 40] {
            adds_what_it_is_given::<f64>(n, 1e60);
            adds_what_it_is_given::<f64>(n, 1e3);
            adds_what_it_is_given::<f32>(n, 1e8);
        }
    }
}
