//! Intervals, with the words that they are printed in.

/// The values that a parameter may take.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Range {
    low: f64,
    high: f64,
    low_included: bool,
    high_included: bool,
    /// the interval as it is printed
    pub words: &'static str,
}

impl Range {
    /// (0, ∞)
    pub const POSITIVE: Self = Self::open(0.0, f64::INFINITY, "(0, inf)");
    /// (0, 1]
    pub const FRACTION: Self = Self { high_included: true, ..Self::open(0.0, 1.0, "(0, 1]") };
    /// (0, 1)
    pub const INNER_FRACTION: Self = Self::open(0.0, 1.0, "(0, 1)");
    /// [0, 1)
    pub const BELOW_ONE: Self = Self { low_included: true, ..Self::open(0.0, 1.0, "[0, 1)") };
    /// [0, ∞)
    pub const NON_NEGATIVE: Self =
        Self { low_included: true, ..Self::open(0.0, f64::INFINITY, "[0, inf)") };
    /// [1, ∞)
    pub const AT_LEAST_ONE: Self =
        Self { low_included: true, ..Self::open(1.0, f64::INFINITY, "[1, inf)") };
    /// (−∞, ∞)
    pub const FINITE: Self = Self::open(f64::NEG_INFINITY, f64::INFINITY, "finite numbers");

    /// (low, high), printed as `words`.
    pub const fn open(low: f64, high: f64, words: &'static str) -> Self {
        Self { low, high, low_included: false, high_included: false, words }
    }

    /// [low, high], printed as `words`.
    pub const fn closed(low: f64, high: f64, words: &'static str) -> Self {
        Self { low, high, low_included: true, high_included: true, words }
    }

    /// Whether the range has `x`; never for NaN.
    pub fn contains(&self, x: f64) -> bool {
        let above = x > self.low || (self.low_included && x == self.low);
        let below = x < self.high || (self.high_included && x == self.high);
        above && below
    }
}
