//! The secular equation 1 + Σ_i w_i/(d_i − x) = 0, w_i = z_i² > 0, with d ascending.
//!
//! Its roots are the eigenvalues x_j of diag(d) + z zᵀ, one in each interval (d_j, d_j+1) and one
//! above the last. Several are sought at a time, each in its own lane of a vector.

use crate::number::Real;

/// More steps than any root needs; halving the interval is what the last of them do.
const STEPS: usize = 100;
const LANES: usize = 4;

/// A number for each root that is sought.
type Lanes<T> = [T; LANES];

/// The roots x_j, written to `roots`; row j of the m x m numbers `gaps` becomes d_i − x_j, each
/// to full relative precision.
#[inline(always)]
pub fn roots<T: Real>(poles: &[T], w: &[T], gaps: &mut [T], roots: &mut [T]) {
    let m = poles.len();
    let total = w.iter().fold(T::ZERO, |sum, &w| sum + w);
    let mut first = 0;
    while first < m {
        let (origin, x) = solve(poles, w, total, first);
        for lane in 0..LANES.min(m - first) {
            let (origin, x) = (origin[lane], x[lane]);
            let row = &mut gaps[(first + lane) * m..][..m];
            for i in 0..m {
                row[i] = (poles[i] - origin) - x;
            }
            roots[first + lane] = origin + x;
        }
        first += LANES;
    }
}

/// Roots `first` and the following as distances x from the pole `origin` that is nearest, by
/// rational interpolation within an interval that is known to have the root.
#[inline(always)]
fn solve<T: Real>(poles: &[T], w: &[T], total: T, first: usize) -> (Lanes<T>, Lanes<T>) {
    let last = poles.len() - 1;
    let half = T::from_f64(0.5);
    let mut searches = [Search::new(); LANES];
    let (mut origin, mut x) = ([T::ZERO; LANES], [T::ZERO; LANES]);
    for (lane, search) in searches.iter_mut().enumerate() {
        search.j = last.min(first + lane);
        origin[lane] = poles[search.j];
        x[lane] = if search.j < last { (poles[search.j + 1] - origin[lane]) * half } else { total };
    }
    let sums = evaluate(poles, w, &origin, &x);
    for (lane, search) in searches.iter_mut().enumerate() {
        (origin[lane], x[lane]) = search.start(poles, w, x[lane], sums.value[lane]);
    }
    for _ in 0..STEPS {
        let sums = evaluate(poles, w, &origin, &x);
        let mut done = true;
        for (lane, search) in searches.iter_mut().enumerate() {
            if !search.done {
                x[lane] = search.advance(poles, w, origin[lane], x[lane], sums.of(lane));
                done &= search.done;
            }
        }
        if done {
            break;
        }
    }
    (origin, x)
}

/// The interval, as distances from the origin, that has root j.
#[derive(Clone, Copy)]
struct Search<T> {
    j: usize,
    low: T,
    high: T,
    done: bool,
}

impl<T: Real> Search<T> {
    #[inline(always)]
    fn new() -> Self {
        Self { j: 0, low: T::ZERO, high: T::ZERO, done: false }
    }

    /// The origin and a first guess, from the sum of the terms in the middle of the interval (for
    /// the last root, at its end): it solves the equation with the poles on both sides exact and
    /// the rest as it is there.
    #[inline(always)]
    fn start(&mut self, poles: &[T], w: &[T], at: T, sum: T) -> (T, T) {
        let (j, f) = (self.j, T::ONE + sum);
        let (pole, left) = (poles[j], w[j]);
        if j + 1 == poles.len() {
            (self.low, self.high) = (T::ZERO, at);
            return (pole, self.inside(left / (f + left / at)));
        }
        let (gap, right) = (poles[j + 1] - pole, w[j + 1]);
        let rest = f - (right - left) / at;
        if f >= T::ZERO {
            (self.low, self.high) = (T::ZERO, at);
            (pole, self.inside(small_root(rest * gap + left + right, left * gap, rest)))
        } else {
            (self.low, self.high) = (-at, T::ZERO);
            let guess = -small_root(left + right - rest * gap, right * gap, -rest);
            (poles[j + 1], self.inside(guess))
        }
    }

    /// `x`, or the middle if that is not within the interval.
    #[inline(always)]
    fn inside(&self, x: T) -> T {
        if x > self.low && x < self.high {
            x
        } else {
            (self.low + self.high) * T::from_f64(0.5)
        }
    }

    /// The next guess, after the sums at `x`.
    #[inline(always)]
    fn advance(&mut self, poles: &[T], w: &[T], origin: T, x: T, sums: [T; 4]) -> T {
        let [value, size, slope, signed] = sums;
        let f = T::ONE + value;
        if f.abs() <= T::EPSILON * T::from_f64(4.0) * (T::ONE + size) {
            self.done = true;
            return x;
        }
        if f < T::ZERO {
            self.low = x;
        } else {
            self.high = x;
        }
        let gap = |i: usize| (poles[i] - origin) - x;
        let half = T::from_f64(0.5);
        let (step, near) = if self.j + 1 == poles.len() {
            let far = gap(self.j - 1);
            (beyond(f, gap(self.j), far, w[self.j], slope), gap(self.j).abs())
        } else {
            let (left, right) = (gap(self.j), gap(self.j + 1));
            let (below, above) = ((slope - signed) * half, (slope + signed) * half);
            (between(f, left, below, right, above), left.abs().min(right.abs()))
        };
        let next = self.inside(x + step);
        // the error is squared by every step: what is left of a small one is below the precision
        let settled = T::EPSILON.sqrt() * T::from_f64(0.05);
        self.done = (next - x).abs() <= settled * near || !(next > self.low && next < self.high);
        next
    }
}

/// The root of c·x² − a·x + b = 0 that goes to b/a for small b, without cancellation.
#[inline(always)]
fn small_root<T: Real>(a: T, b: T, c: T) -> T {
    let two = T::from_f64(2.0);
    let discriminant = (a * a - T::from_f64(4.0) * b * c).abs().sqrt();
    if a > T::ZERO {
        two * b / (a + discriminant)
    } else {
        (a - discriminant) / (two * c)
    }
}

/// The step to the root of the function with these two poles that agrees at this point, each
/// side of the sum with its slope.
#[inline(always)]
fn between<T: Real>(f: T, left: T, left_slope: T, right: T, right_slope: T) -> T {
    let c = f - left * left_slope - right * right_slope;
    let a = (left + right) * f - left * right * (left_slope + right_slope);
    small_root(a, left * right * f, c)
}

/// The same above the last pole, whose own term is exact; the others act as if at the one
/// before.
#[inline(always)]
fn beyond<T: Real>(f: T, near: T, far: T, weight: T, slope: T) -> T {
    let own = weight / near;
    let rest = (slope - own / near).max(T::ZERO);
    let c = f - far * rest - own;
    let a = (near + far) * f - near * far * (rest + own / near);
    let b = near * far * f;
    let discriminant = (a * a - T::from_f64(4.0) * b * c).abs().sqrt();
    if a >= T::ZERO {
        (a + discriminant) / (c + c)
    } else {
        (b + b) / (a - discriminant)
    }
}

/// Σ w/(d − x), the sum of its magnitudes, Σ w/(d − x)², and the same with the sign of d − x: the
/// slope above x less that below.
#[derive(Clone, Copy)]
struct Sums<T> {
    value: Lanes<T>,
    size: Lanes<T>,
    slope: Lanes<T>,
    signed: Lanes<T>,
}

impl<T: Real> Sums<T> {
    #[inline(always)]
    fn of(&self, lane: usize) -> [T; 4] {
        [self.value[lane], self.size[lane], self.slope[lane], self.signed[lane]]
    }
}

#[inline(always)]
fn evaluate<T: Real>(poles: &[T], w: &[T], origin: &Lanes<T>, x: &Lanes<T>) -> Sums<T> {
    let zero = [T::ZERO; LANES];
    let (mut value, mut size, mut slope, mut signed) = (zero, zero, zero, zero);
    for i in 0..poles.len().min(w.len()) {
        let (d, w) = (poles[i], w[i]);
        for lane in 0..LANES {
            let inverse = T::ONE / ((d - origin[lane]) - x[lane]);
            let term = w * inverse;
            value[lane] += term;
            size[lane] += term.abs();
            slope[lane] += term * inverse;
            signed[lane] += term * inverse.abs();
        }
    }
    Sums { value, size, slope, signed }
}

/// Row j of `gaps` (d_i − x_j) becomes eigenvector j; false if one is out of range.
///
/// They are those of diag(d) + ẑẑᵀ, whose eigenvalues are exactly the computed x_j:
/// ẑ_i² = Π_j (x_j − d_i) / Π_j≠i (d_j − d_i).
#[inline(always)]
pub fn vectors<T: Real>(poles: &[T], z: &[T], gaps: &mut [T], squares: &mut [T]) -> bool {
    let m = poles.len();
    // not `fill`: a call
    for i in 0..m {
        squares[i] = T::ONE;
    }
    for (j, row) in gaps.chunks_exact(m).enumerate() {
        let d = poles[j];
        let own = -(squares[j] * row[j]);
        for i in 0..m {
            squares[i] *= row[i] / (poles[i] - d);
        }
        squares[j] = own;
    }
    for i in 0..m {
        let magnitude = squares[i].sqrt();
        squares[i] = if z[i] < T::ZERO { -magnitude } else { magnitude };
    }
    let mut sound = true;
    for row in gaps.chunks_exact_mut(m) {
        for i in 0..m {
            row[i] = squares[i] / row[i];
        }
        let length = squared_length(row).sqrt();
        let scale = T::ONE / length;
        sound &= scale.is_finite() && scale > T::ZERO;
        row.iter_mut().for_each(|x| *x *= scale);
    }
    sound
}

/// Σ x², in partial sums.
#[inline(always)]
fn squared_length<T: Real>(row: &[T]) -> T {
    let mut partial = [T::ZERO; LANES];
    let mut blocks = row.chunks_exact(LANES);
    for block in blocks.by_ref() {
        for lane in 0..LANES {
            partial[lane] += block[lane] * block[lane];
        }
    }
    for (lane, &x) in blocks.remainder().iter().enumerate() {
        partial[lane] += x * x;
    }
    (partial[0] + partial[2]) + (partial[1] + partial[3])
}
