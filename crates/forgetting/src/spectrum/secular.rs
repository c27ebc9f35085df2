//! The secular equation 1 + Σ_i z_i²/(d_i − x) = 0 with d ascending, all z_i ≠ 0: the eigenvalues
//! x_j of diag(d) + z zᵀ, one in each interval (d_j, d_j+1) and one above the last.

use crate::Real;

/// More steps than any root needs; halving the interval is what the last of them do.
const STEPS: usize = 100;

/// The roots x_j, written to `roots`; row j of the m x m numbers `gaps` becomes d_i − x_j, each
/// to full relative precision.
#[inline(always)]
pub fn roots<T: Real>(poles: &[T], z: &[T], gaps: &mut [T], roots: &mut [T]) {
    let m = poles.len();
    let total = z.iter().fold(T::ZERO, |sum, &z| sum + z * z);
    for (j, (row, root)) in gaps.chunks_exact_mut(m).zip(roots).enumerate() {
        let interval = if j + 1 < m {
            Interval::between(poles, z, j)
        } else {
            Interval::last(poles, z, total)
        };
        let origin = poles[interval.origin];
        for (gap, &pole) in row.iter_mut().zip(poles) {
            *gap = pole - origin;
        }
        let offset = solve(row, z, j, interval);
        row.iter_mut().for_each(|gap| *gap -= offset);
        *root = origin + offset;
    }
}

/// Where to look for a root, as distances from the pole `origin`, and a first guess.
#[derive(Clone, Copy)]
struct Interval<T> {
    origin: usize,
    low: T,
    high: T,
    guess: T,
}

impl<T: Real> Interval<T> {
    /// Between poles j and j + 1, in the half that has the root. The guess solves the equation
    /// with the two poles exact and the rest as it is in the middle.
    #[inline(always)]
    fn between(poles: &[T], z: &[T], j: usize) -> Self {
        let gap = poles[j + 1] - poles[j];
        let half = gap * T::from_f64(0.5);
        let middle = |d: T| (d - poles[j]) - half;
        let mut rest = T::ONE;
        for (range, d) in [(0..j, &poles[..j]), (j + 2..poles.len(), &poles[j + 2..])] {
            rest += z[range].iter().zip(d).fold(T::ZERO, |sum, (&z, &d)| sum + z * (z / middle(d)));
        }
        let (left, right) = (z[j] * z[j], z[j + 1] * z[j + 1]);
        if rest + (right - left) / half >= T::ZERO {
            let a = rest * gap + left + right;
            let guess = small_root(a, left * gap, rest);
            Self { origin: j, low: T::ZERO, high: half, guess }
        } else {
            // the same, mirrored: rest > 0 there is rest < 0 here
            let a = left + right - rest * gap;
            let guess = -small_root(a, right * gap, -rest);
            Self { origin: j + 1, low: -half, high: T::ZERO, guess }
        }
    }

    /// Above the last pole, at most Σ z² above it.
    #[inline(always)]
    fn last(poles: &[T], z: &[T], total: T) -> Self {
        let origin = poles.len() - 1;
        let rest = z[..origin]
            .iter()
            .zip(poles)
            .fold(T::ONE, |rest, (&z, &d)| rest - z * (z / (total + (poles[origin] - d))));
        let guess = z[origin] * z[origin] / rest;
        Self { origin, low: T::ZERO, high: total, guess }
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

/// The distance from the origin to root j, by rational interpolation within the interval.
#[inline(always)]
fn solve<T: Real>(poles: &[T], z: &[T], j: usize, interval: Interval<T>) -> T {
    let Interval { mut low, mut high, guess, .. } = interval;
    let halve = |low: T, high: T| (low + high) * T::from_f64(0.5);
    let inside = |x: T, low: T, high: T| x > low && x < high;
    let mut x = if inside(guess, low, high) { guess } else { halve(low, high) };
    let tolerance = T::EPSILON * T::from_f64(4.0);
    let settled = T::EPSILON.sqrt() * T::from_f64(0.05);
    for _ in 0..STEPS {
        let (below, below_slope) = evaluate(&poles[..=j], &z[..=j], x);
        let (above, above_slope) = evaluate(&poles[j + 1..], &z[j + 1..], x);
        let f = T::ONE + below + above;
        if f.abs() <= tolerance * (T::ONE - below + above) {
            break;
        }
        if f < T::ZERO {
            low = x;
        } else {
            high = x;
        }
        let last = j + 1 == poles.len();
        let step = if last {
            beyond(f, poles, z, below_slope, x)
        } else {
            between(f, poles[j] - x, below_slope, poles[j + 1] - x, above_slope)
        };
        let next = x + step;
        if !inside(next, low, high) {
            let middle = halve(low, high);
            if !inside(middle, low, high) {
                break;
            }
            x = middle;
            continue;
        }
        x = next;
        // the error is squared by every step: what is left of this one is below the precision
        let near = if last {
            (poles[j] - x).abs()
        } else {
            (poles[j] - x).abs().min((poles[j + 1] - x).abs())
        };
        if step.abs() <= settled * near {
            break;
        }
    }
    x
}

/// The step to the root of the function with these two poles that agrees at this point, each
/// side of the sum with its slope.
#[inline(always)]
fn between<T: Real>(f: T, left: T, left_slope: T, right: T, right_slope: T) -> T {
    let c = f - left * left_slope - right * right_slope;
    let a = (left + right) * f - left * right * (left_slope + right_slope);
    let b = left * right * f;
    let discriminant = (a * a - T::from_f64(4.0) * b * c).abs().sqrt();
    if a <= T::ZERO {
        (a - discriminant) / (c + c)
    } else {
        (b + b) / (a + discriminant)
    }
}

/// The same above the last pole, whose own term is exact; the others act as if at the one
/// before.
#[inline(always)]
fn beyond<T: Real>(f: T, poles: &[T], z: &[T], slope: T, x: T) -> T {
    let m = poles.len();
    let (near, far) = (poles[m - 1] - x, poles[m - 2] - x);
    let own = z[m - 1] / near;
    let rest = (slope - own * own).max(T::ZERO);
    let c = f - far * rest - z[m - 1] * own;
    let a = (near + far) * f - near * far * (rest + own * own);
    let b = near * far * f;
    let discriminant = (a * a - T::from_f64(4.0) * b * c).abs().sqrt();
    if a >= T::ZERO {
        (a + discriminant) / (c + c)
    } else {
        (b + b) / (a - discriminant)
    }
}

/// Σ z²/(d − x) and Σ z²/(d − x)², in partial sums.
#[inline(always)]
fn evaluate<T: Real>(poles: &[T], z: &[T], x: T) -> (T, T) {
    const LANES: usize = 4;
    let (mut sums, mut slopes) = ([T::ZERO; LANES], [T::ZERO; LANES]);
    let (mut d, mut w) = (poles.chunks_exact(LANES), z.chunks_exact(LANES));
    for (d, z) in d.by_ref().zip(w.by_ref()) {
        for lane in 0..LANES {
            let t = z[lane] / (d[lane] - x);
            sums[lane] = z[lane].mul_add(t, sums[lane]);
            slopes[lane] = t.mul_add(t, slopes[lane]);
        }
    }
    let mut sum = (sums[0] + sums[2]) + (sums[1] + sums[3]);
    let mut slope = (slopes[0] + slopes[2]) + (slopes[1] + slopes[3]);
    for (&d, &z) in d.remainder().iter().zip(w.remainder()) {
        let t = z / (d - x);
        sum = z.mul_add(t, sum);
        slope = t.mul_add(t, slope);
    }
    (sum, slope)
}

/// Row j of `gaps` (d_i − x_j) becomes eigenvector j; false if one is out of range.
///
/// They are those of diag(d) + ẑẑᵀ, whose eigenvalues are exactly the computed x_j:
/// ẑ_i² = Π_j (x_j − d_i) / Π_j≠i (d_j − d_i).
#[inline(always)]
pub fn vectors<T: Real>(poles: &[T], z: &[T], gaps: &mut [T], squares: &mut [T]) -> bool {
    let m = poles.len();
    squares.fill(T::ONE);
    for (j, row) in gaps.chunks_exact(m).enumerate() {
        let d = poles[j];
        let ratio = |square: &mut T, gap: T, pole: T| *square *= gap / (pole - d);
        for i in 0..j {
            ratio(&mut squares[i], row[i], poles[i]);
        }
        squares[j] *= -row[j];
        for i in j + 1..m {
            ratio(&mut squares[i], row[i], poles[i]);
        }
    }
    for (square, &z) in squares.iter_mut().zip(z) {
        let magnitude = square.sqrt();
        *square = if z < T::ZERO { -magnitude } else { magnitude };
    }
    let mut sound = true;
    for row in gaps.chunks_exact_mut(m) {
        for (gap, &z) in row.iter_mut().zip(squares.iter()) {
            *gap = z / *gap;
        }
        let square = crate::factor::kernel::dot(row, row);
        let scale = T::ONE / square.sqrt();
        sound &= scale.is_finite() && scale > T::ZERO;
        row.iter_mut().for_each(|x| *x *= scale);
    }
    sound
}
