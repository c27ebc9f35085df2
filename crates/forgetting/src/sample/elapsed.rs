//! Forgetting by the clock: what a forgetting factor of one unit of time becomes in another time.

use crate::error::Error;
use forgetting_kernels::Real;

/// However long a gap, this much is kept of what is known: it forgets ten half-lives at most.
const LEAST: f64 = 1.0 / 1024.0;

/// λ^Δt for the factor λ of one unit of time, at least 1/1024 or λ.
///
/// Two gaps without a sample between them are one gap: λ^a λ^b = λ^(a + b).
#[inline]
pub fn factor_after<T: Real>(lambda: T, elapsed: T) -> T {
    if elapsed == T::ONE || lambda == T::ONE {
        return lambda;
    }
    let factor = T::from_f64(libm::pow(lambda.to_f64(), elapsed.to_f64()));
    factor.max(T::from_f64(LEAST).min(lambda)).min(T::ONE)
}

/// Refuses a time that does not pass forwards.
///
/// # Errors
/// [`Error::Value`] names `elapsed`.
#[inline]
pub fn check_elapsed<T: Real>(elapsed: T) -> Result<(), Error> {
    if elapsed >= T::ZERO && elapsed <= T::CEILING {
        return Ok(());
    }
    Err(Error::value("elapsed", elapsed.to_f64(), "finite and not negative"))
}

#[cfg(test)]
mod tests {
    use super::factor_after;

    #[test]
    fn gaps_add_up() {
        let whole: f64 = factor_after(0.9, 7.5);
        let parts = factor_after(0.9, 3.0) * factor_after(0.9, 4.5);
        assert!((whole / parts - 1.0).abs() < 1e-15);
        assert_eq!(factor_after(0.9, 0.0), 1.0);
        assert_eq!(factor_after(1.0, 1e300), 1.0);
    }

    #[test]
    fn a_gap_forgets_ten_half_lives_at_most() {
        assert_eq!(factor_after(0.9, 1e6), 1.0 / 1024.0);
        assert_eq!(factor_after(1e-6, 2.0), 1e-6);
        assert_eq!(factor_after(0.5_f32, 10.0), 1.0 / 1024.0);
    }
}
