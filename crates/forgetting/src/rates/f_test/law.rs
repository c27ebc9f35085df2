//! The F distribution: its distribution function through the incomplete beta function, and the
//! inverse of that by bisection.
//!
//! The continued fraction and the logarithm of the gamma function lose about (a + b) roundings:
//! the quantile has 12 digits for a + b up to 1000 and 10 up to 10⁵.

/// P(X ≤ x) for X with a and b degrees of freedom, x ≥ 0.
fn distribution(x: f64, a: f64, b: f64) -> f64 {
    let (below, above) = (a * x / (a * x + b), b / (a * x + b));
    let (a, b) = (a / 2.0, b / 2.0);
    if below <= (a + 1.0) / (a + b + 2.0) {
        incomplete_beta(below, above, a, b)
    } else {
        1.0 - incomplete_beta(above, below, b, a)
    }
}

/// The regularized I_x(a, b) with y = 1 − x: xᵃ yᵇ / (a B(a, b)) times a continued fraction, by
/// Lentz's method (Abramowitz and Stegun, 26.5.8). It converges fast for x ≤ (a + 1)/(a + b + 2).
fn incomplete_beta(x: f64, y: f64, a: f64, b: f64) -> f64 {
    const STEPS: u32 = 100_000;
    const TINY: f64 = 1e-300;
    if x <= 0.0 {
        return 0.0;
    }
    let logarithm = libm::lgamma(a + b) - libm::lgamma(a) - libm::lgamma(b)
        + a * libm::log(x)
        + b * libm::log(y);
    let away_from_zero = |v: f64| if libm::fabs(v) < TINY { TINY } else { v };
    let (mut c, mut d) = (1.0, 1.0 / away_from_zero(1.0 - (a + b) * x / (a + 1.0)));
    let mut fraction = d;
    for m in (1..STEPS).map(f64::from) {
        let even = m * (b - m) * x / ((a + 2.0 * m - 1.0) * (a + 2.0 * m));
        let odd = -(a + m) * (a + b + m) * x / ((a + 2.0 * m) * (a + 2.0 * m + 1.0));
        let before = fraction;
        for term in [even, odd] {
            d = 1.0 / away_from_zero(1.0 + term * d);
            c = away_from_zero(1.0 + term / c);
            fraction *= c * d;
        }
        if libm::fabs(fraction - before) <= f64::EPSILON * fraction {
            break;
        }
    }
    libm::exp(logarithm) * fraction / a
}

/// The x with P(X ≤ x) = `probability`, in (0, 1), for a and b degrees of freedom.
pub(super) fn quantile(probability: f64, a: f64, b: f64) -> f64 {
    let (mut low, mut high) = (0.0, 1.0);
    while distribution(high, a, b) < probability && high < 1e300 {
        low = high;
        high *= 2.0;
    }
    loop {
        let middle = low + (high - low) / 2.0;
        if middle <= low || middle >= high {
            return high;
        }
        if distribution(middle, a, b) < probability {
            low = middle;
        } else {
            high = middle;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::{distribution, quantile};

    fn close(x: f64, expected: f64, tolerance: f64) {
        assert!((x / expected - 1.0).abs() < tolerance, "{x} is not {expected}");
    }

    #[test]
    fn agrees_with_closed_forms() {
        // two degrees of freedom above: 1 - (1 + 2x/b)^(-b/2)
        for (x, b) in [(0.1, 3.0), (1.0, 7.0), (4.103, 10.0), (2.0, 400.0)] {
            let exact = 1.0 - libm::pow(1.0 + 2.0 * x / b, -b / 2.0);
            close(distribution(x, 2.0, b), exact, 1e-12);
            close(quantile(exact, 2.0, b), x, 1e-11);
        }
        // one and one: the square of a Cauchy variable
        close(distribution(3.0, 1.0, 1.0), 2.0 / 3.0, 1e-14);
        // the same number of degrees on both sides: the median is 1
        for n in [1.0, 8.0, 1000.0, 50_000.0] {
            close(quantile(0.5, n, n), 1.0, 1e-10);
        }
    }

    /// Upper 5 % and 1 % points as tables have them.
    #[test]
    fn agrees_with_printed_tables() {
        close(quantile(0.95, 5.0, 40.0), 2.449, 5e-4);
        close(quantile(0.95, 2.0, 10.0), 4.103, 5e-4);
        close(quantile(0.99, 10.0, 100.0), 2.503, 5e-4);
        close(quantile(0.99, 1.0, 1.0), 4052.0, 5e-4);
    }
}
