//! A compact estimator as a member of a bank.

use super::{Compact, Saved};
use crate::bank::{Brought, Member};
use crate::covariance::{scale_each, Above};
use crate::error::Error;
use crate::memory::state::Visitor;
use crate::memory::{Fixed, Packed, Size};
use crate::rules::Forgetting;
use crate::sample::{Answer, Noise, Skip};
use forgetting_kernels::kernel::compact::triangle;
use forgetting_kernels::Kernels;

impl<F, T, const N: usize> Member<Fixed<T, N>> for Compact<F, T, N>
where
    F: Forgetting<Fixed<T, N>>,
    T: Kernels,
    Size<N>: Packed<T>,
{
    #[inline(always)]
    fn take(
        &mut self,
        elapsed: T,
        (phi, y): (&[T], &[T]),
        noise: Noise<'_, T>,
        errors: &mut [T],
    ) -> Result<Brought<T>, Error> {
        let (Some(phi), &[y], [error]) = (phi.first_chunk::<N>(), y, errors) else {
            return Err(Error::Length { parameter: "y", length: y.len(), expected: 1 });
        };
        let gamma = match noise {
            Noise::Unit => None,
            Noise::Scalar(gamma) => Some(gamma),
            Noise::Full(gamma) => gamma.first().copied(),
        };
        let (mut whitened, product) = ([T::ZERO; N], self.predict(phi));
        let given = if gamma.is_none() && elapsed == T::ONE {
            whitened = *phi;
            None
        } else {
            Some(self.pace().given(elapsed, (phi, y, product), gamma, &mut whitened)?)
        };
        let outcome = Compact::take(self, &whitened, y, given.as_ref())?;
        *error = y - product;
        Ok(Brought {
            leverage: outcome.leverage,
            forgetting_factor: given.map_or(self.forgetting_factor, |given| given.factor),
            skipped: (!outcome.used).then_some(Skip::DeadZone),
            gate: Answer::Update,
            windup: outcome.windup,
        })
    }

    fn reset(&mut self) {
        self.reset();
    }

    fn theta(&self) -> &[T] {
        &self.theta
    }

    fn covariance(&self, reciprocal: Option<&[T]>, dense: &mut [T]) {
        let (rows, _) = dense.as_chunks_mut::<N>();
        let Some(rows) = rows.first_chunk_mut::<N>() else { return };
        Self::covariance(&mut self.clone(), rows);
        let Some(reciprocal) = reciprocal else { return };
        for (row, &r) in rows.iter_mut().zip(reciprocal) {
            row.iter_mut().zip(reciprocal).for_each(|(element, &s)| *element *= r * s);
        }
    }

    fn trace(&self) -> T {
        self.clone().kernel().trace()
    }

    fn change_units(&mut self, ratios: &[T]) {
        let mut triangle = Triangle(self.triangle.as_mut());
        scale_each(&mut triangle, &mut self.diagonal, ratios);
        self.theta.iter_mut().zip(ratios).for_each(|(theta, &ratio)| *theta *= ratio);
        self.bound = self.kernel().trace();
    }

    fn is_sound(&self) -> bool {
        Saved::check_read(&mut self.clone())
    }

    fn visit(&mut self, visitor: &mut dyn Visitor<T>) {
        self.visit_state(visitor);
    }
}

/// U above its diagonal, column after column.
struct Triangle<'a, T>(&'a mut [T]);

impl<T> Above<T> for Triangle<'_, T> {
    #[inline(always)]
    fn above(&mut self, i: usize, j: usize) -> Option<&mut T> {
        self.0.get_mut(triangle(j) + i)
    }
}
