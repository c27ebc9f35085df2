//! Every kernel beside the same operation on dense matrices, in plain loops.

#![allow(clippy::needless_range_loop, reason = "indices as in the equations")]

use forgetting::Kernels;
use forgetting_kernels::kernel::symmetric::stride;
use forgetting_kernels::kernel::{functions, layout};

/// The sizes: every one around the blocks of eight columns, and some larger.
pub fn sizes() -> impl Iterator<Item = usize> {
    (1..=40).chain([64, 100, 128, 129])
}

/// Numbers between −1 and 1, the same ones for the same seed.
struct Numbers(u64);

impl Numbers {
    fn next(&mut self) -> f64 {
        self.0 = self.0.wrapping_mul(6364136223846793005).wrapping_add(1442695040888963407);
        (self.0 >> 11) as f64 / (1u64 << 52) as f64 - 1.0
    }
    fn vector<T: Kernels>(&mut self, n: usize) -> Vec<T> {
        (0..n).map(|_| T::from_f64(self.next())).collect()
    }
}

struct Case<T> {
    n: usize,
    columns: Vec<T>,
    diagonal: Vec<T>,
    x: Vec<T>,
}

impl<T: Kernels> Case<T> {
    fn new(n: usize, seed: u64) -> Self {
        let mut numbers = Numbers(seed.wrapping_add(n as u64));
        let mut columns = vec![T::ZERO; layout::length::<T>(n)];
        layout::set_identity(&mut columns, n);
        let small = T::from_f64(1.0 / (n as f64).sqrt());
        for j in 0..n {
            let column: Vec<T> = (0..j).map(|_| small * T::from_f64(numbers.next())).collect();
            layout::put_column(&mut columns, j, &column);
        }
        let diagonal = (0..n).map(|_| T::from_f64(1.5 + numbers.next())).collect();
        Self { n, columns, diagonal, x: numbers.vector(n) }
    }

    fn u(&self) -> Vec<Vec<f64>> {
        let n = self.n;
        let mut u = vec![vec![0.0; n]; n];
        for j in 0..n {
            u[j][j] = 1.0;
            let mut column = vec![T::ZERO; j];
            layout::get_column(&self.columns, j, &mut column);
            for (i, x) in column.iter().enumerate() {
                u[i][j] = x.to_f64();
            }
        }
        u
    }

    fn p(&self) -> Vec<Vec<f64>> {
        let (u, n) = (self.u(), self.n);
        let d = doubles(&self.diagonal);
        let element = |i: usize, j: usize| (i.max(j)..n).map(|k| u[i][k] * d[k] * u[j][k]).sum();
        (0..n).map(|i| (0..n).map(|j| element(i, j)).collect()).collect()
    }

    /// Whether what the kernels keep beside U is as it should be.
    fn check_padding(&self) {
        let mut rest = self.columns.clone();
        for j in 0..self.n {
            let diagonal = &mut rest[layout::place::<T>(j, j)];
            assert!(*diagonal == T::ONE, "the diagonal of column {j} of {}", self.n);
            *diagonal = T::ZERO;
            for i in 0..j {
                rest[layout::place::<T>(i, j)] = T::ZERO;
            }
        }
        assert!(rest.iter().all(|&x| x == T::ZERO), "beside U of {}", self.n);
    }
}

fn doubles<T: Kernels>(x: &[T]) -> Vec<f64> {
    x.iter().map(|x| x.to_f64()).collect()
}

fn times(a: &[Vec<f64>], x: &[f64]) -> Vec<f64> {
    a.iter().map(|row| row.iter().zip(x).map(|(a, x)| a * x).sum()).collect()
}

fn inner(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}

/// Rounding grows at most with the length of the sums: 40 n ε leaves a factor of ten.
fn close<T: Kernels>(what: &str, n: usize, a: &[f64], b: &[f64]) {
    let tolerance = 40.0 * n as f64 * T::EPSILON.to_f64();
    let scale = b.iter().fold(1.0f64, |scale, x| scale.max(x.abs()));
    for (i, (x, y)) in a.iter().zip(b).enumerate() {
        assert!((x - y).abs() <= tolerance * scale, "{what}, n = {n}, {i}: {x} beside {y}");
    }
}

/// Compares every kernel at size n; returns all numbers that came out, for bits to be compared.
pub fn check<T: Kernels>(n: usize, seed: u64) -> Vec<f64> {
    let mut out = Vec::new();
    products::<T>(n, seed, &mut out);
    measurement::<T>(n, seed, &mut out);
    dyad::<T>(n, seed, &mut out);
    symmetric::<T>(n, seed, &mut out);
    out
}

fn symmetric<T: Kernels>(n: usize, seed: u64, out: &mut Vec<f64>) {
    let (p, x) = (Case::<T>::new(n, seed).p(), Case::<T>::new(n, seed).x);
    let stride = stride::<T>(n);
    let mut matrix = vec![T::ZERO; n * stride];
    for (i, j) in (0..n * n).map(|k| (k / n, k % n)) {
        matrix[i * stride + j] = T::from_f64(p[i.min(j)][i.max(j)]);
    }
    let read = |matrix: &[T]| -> Vec<Vec<f64>> {
        matrix.chunks(stride).map(|row| doubles(&row[..n])).collect()
    };
    let (before, mut product) = (read(&matrix), vec![T::ZERO; n]);
    functions::symmetric_multiply(&matrix, &x, &mut product);
    close::<T>("A x", n, &doubles(&product), &times(&before, &doubles(&x)));
    functions::symmetric_subtract(&mut matrix, T::from_f64(0.75), &x);
    let (after, x) = (read(&matrix), doubles(&x));
    for i in 0..n {
        let expected: Vec<f64> = (0..n).map(|j| 0.75 * before[i][j] - x[i] * x[j]).collect();
        close::<T>("0.75 A − x xᵀ", n, &after[i], &expected);
        assert!((0..n).all(|j| after[i][j] == after[j][i]), "{n}");
    }
    assert!(matrix.chunks(stride).all(|row| row[n..].iter().all(|&x| x == T::ZERO)), "{n}");
    out.extend(doubles(&product));
    out.extend(after.concat());
}

fn products<T: Kernels>(n: usize, seed: u64, out: &mut Vec<f64>) {
    let case = Case::<T>::new(n, seed);
    let (u, x) = (case.u(), doubles(&case.x));
    let transposed: Vec<Vec<f64>> = (0..n).map(|j| (0..n).map(|i| u[i][j]).collect()).collect();
    let mut product = case.x.clone();
    functions::multiply(&case.columns, &mut product);
    close::<T>("U x", n, &doubles(&product), &times(&u, &x));
    out.extend(doubles(&product));
    functions::solve(&case.columns, &mut product);
    close::<T>("U⁻¹ U x", n, &doubles(&product), &x);
    out.extend(doubles(&product));
    let mut product = case.x.clone();
    functions::multiply_transposed(&case.columns, &mut product);
    close::<T>("Uᵀ x", n, &doubles(&product), &times(&transposed, &x));
    out.extend(doubles(&product));
    let leverage = functions::leverage(&case.columns, &case.diagonal, &case.x).to_f64();
    close::<T>("x P x", n, &[leverage], &[inner(&x, &times(&case.p(), &x))]);
    let dot = functions::dot(&case.x, &case.diagonal).to_f64();
    close::<T>("x d", n, &[dot], &[inner(&x, &doubles(&case.diagonal))]);
    out.extend([leverage, dot]);
}

fn measurement<T: Kernels>(n: usize, seed: u64, out: &mut Vec<f64>) {
    let mut case = Case::<T>::new(n, seed);
    let (p, x) = (case.p(), doubles(&case.x));
    let gain_before = times(&p, &x);
    let a = 1.0 + inner(&x, &gain_before);
    let mut gain = vec![T::ZERO; n];
    let measured = functions::bierman(&mut case.columns, &mut case.diagonal, &case.x, &mut gain);
    close::<T>("a", n, &[measured.variance.to_f64()], &[a]);
    close::<T>("s", n, &[measured.leverage.to_f64()], &[a - 1.0]);
    close::<T>("P x", n, &doubles(&gain), &gain_before);
    for (i, row) in case.p().iter().enumerate() {
        let wanted: Vec<f64> =
            (0..n).map(|j| p[i][j] - gain_before[i] * gain_before[j] / a).collect();
        close::<T>("P₊", n, row, &wanted);
    }
    case.check_padding();
    out.extend(doubles(&case.columns));
    out.extend(doubles(&case.diagonal));
    out.extend(doubles(&gain));
}

fn dyad<T: Kernels>(n: usize, seed: u64, out: &mut Vec<f64>) {
    for c in [0.0, 1e-3, 2.5] {
        let mut case = Case::<T>::new(n, seed);
        let (p, x, mut used) = (case.p(), doubles(&case.x), case.x.clone());
        let d = doubles(&case.diagonal);
        let given = T::from_f64(c);
        functions::agee_turner(&mut case.columns, &mut case.diagonal, &mut used, given);
        for (i, row) in case.p().iter().enumerate() {
            let wanted: Vec<f64> =
                (0..n).map(|j| given.to_f64().mul_add(x[i] * x[j], p[i][j])).collect();
            close::<T>("P + c x xᵀ", n, row, &wanted);
        }
        assert!(doubles(&case.diagonal).iter().zip(&d).all(|(now, d)| now >= d), "D grows");
        case.check_padding();
        out.extend(doubles(&case.columns));
        out.extend(doubles(&case.diagonal));
    }
}
