//! Dense matrices, written for the tests alone: what the factored forms are compared to.
#![allow(dead_code, reason = "each test uses some of it")]

use std::ops::{Add, Mul, Sub};
use std::vec;
use std::vec::Vec;

/// A matrix of `rows` x `columns` numbers, row by row.
#[derive(Clone, Debug, PartialEq)]
pub struct Dense {
    pub rows: usize,
    pub columns: usize,
    pub elements: Vec<f64>,
}

impl Dense {
    pub fn new(rows: usize, elements: &[f64]) -> Self {
        Self { rows, columns: elements.len() / rows, elements: elements.to_vec() }
    }

    pub fn zero(rows: usize, columns: usize) -> Self {
        Self { rows, columns, elements: vec![0.0; rows * columns] }
    }

    pub fn diagonal(elements: &[f64]) -> Self {
        let n = elements.len();
        let mut matrix = Self::zero(n, n);
        (0..n).for_each(|i| matrix.elements[i * n + i] = elements[i]);
        matrix
    }

    pub fn identity(n: usize) -> Self {
        Self::scaled_identity(n, 1.0)
    }

    pub fn scaled_identity(n: usize, c: f64) -> Self {
        Self::diagonal(&vec![c; n])
    }

    pub fn at(&self, i: usize, j: usize) -> f64 {
        self.elements[i * self.columns + j]
    }

    pub fn transpose(&self) -> Self {
        let (rows, columns) = (self.columns, self.rows);
        let elements = (0..rows * columns).map(|k| self.at(k % columns, k / columns)).collect();
        Self { rows, columns, elements }
    }

    pub fn trace(&self) -> f64 {
        (0..self.rows).map(|i| self.at(i, i)).sum()
    }

    pub fn times(&self, other: &Self) -> Self {
        assert_eq!(self.columns, other.rows);
        let mut product = Self::zero(self.rows, other.columns);
        for i in 0..self.rows {
            for j in 0..other.columns {
                product.elements[i * other.columns + j] =
                    (0..self.columns).map(|k| self.at(i, k) * other.at(k, j)).sum();
            }
        }
        product
    }

    /// self + c·other
    pub fn plus(&self, c: f64, other: &Self) -> Self {
        assert_eq!((self.rows, self.columns), (other.rows, other.columns));
        let mut sum = self.clone();
        sum.elements.iter_mut().zip(&other.elements).for_each(|(x, y)| *x += c * y);
        sum
    }

    pub fn scaled(&self, c: f64) -> Self {
        c * self.clone()
    }

    /// The mean of it and its transpose.
    pub fn symmetric(&self) -> Self {
        self.plus(1.0, &self.transpose()).scaled(0.5)
    }

    /// The largest magnitude.
    pub fn size(&self) -> f64 {
        self.elements.iter().fold(0.0, |largest, x| largest.max(x.abs()))
    }

    /// By Gauss and Jordan with pivots.
    pub fn inverse(&self) -> Self {
        let n = self.rows;
        let (mut a, mut b) = (self.clone(), Self::identity(n));
        for j in 0..n {
            let pivot = (j..n).max_by(|&x, &y| a.at(x, j).abs().total_cmp(&a.at(y, j).abs()));
            let pivot = pivot.unwrap();
            for m in [&mut a, &mut b] {
                (0..n).for_each(|c| m.elements.swap(pivot * n + c, j * n + c));
            }
            let d = a.at(j, j);
            assert!(d != 0.0, "singular");
            for m in [&mut a, &mut b] {
                (0..n).for_each(|c| m.elements[j * n + c] /= d);
            }
            for i in (0..n).filter(|&i| i != j) {
                let factor = a.at(i, j);
                for m in [&mut a, &mut b] {
                    (0..n).for_each(|c| m.elements[i * n + c] -= factor * m.at(j, c));
                }
            }
        }
        b
    }

    /// L, lower triangular, with L Lᵀ = self.
    pub fn cholesky(&self) -> Self {
        let n = self.rows;
        let mut l = Self::zero(n, n);
        for (i, j) in (0..n).flat_map(|i| (0..=i).map(move |j| (i, j))) {
            let rest = self.at(i, j) - (0..j).map(|k| l.at(i, k) * l.at(j, k)).sum::<f64>();
            l.elements[i * n + j] = if i == j { rest.sqrt() } else { rest / l.at(j, j) };
        }
        l
    }

    /// The eigenvalues of a symmetric matrix in ascending order.
    pub fn eigenvalues(&self) -> Vec<f64> {
        self.eigen().0
    }

    /// They, and the eigenvectors as columns, by Jacobi's rotations.
    pub fn eigen(&self) -> (Vec<f64>, Self) {
        let (n, mut a, mut v) = (self.rows, self.symmetric(), Self::identity(self.rows));
        let mut rotated = true;
        for _ in 0..60 {
            if !core::mem::take(&mut rotated) {
                break;
            }
            for (p, q) in (0..n).flat_map(|p| (p + 1..n).map(move |q| (p, q))) {
                let size = (a.at(p, p) * a.at(q, q)).abs().sqrt();
                if a.at(p, q).abs() > 1e-17 * size {
                    a.rotate(p, q, &mut v);
                    rotated = true;
                }
            }
        }
        let mut order: Vec<usize> = (0..n).collect();
        order.sort_by(|&i, &j| a.at(i, i).total_cmp(&a.at(j, j)));
        let vectors: Vec<f64> = (0..n * n).map(|k| v.at(k / n, order[k % n])).collect();
        (order.iter().map(|&i| a.at(i, i)).collect(), Self::new(n, &vectors))
    }

    /// Makes the element at p, q zero by a rotation of both rows and both columns, and turns the columns
    /// of `vectors` with them.
    fn rotate(&mut self, p: usize, q: usize, vectors: &mut Self) {
        let n = self.rows;
        let zeta = (self.at(q, q) - self.at(p, p)) / (2.0 * self.at(p, q));
        let t = zeta.signum() / (zeta.abs() + zeta.hypot(1.0));
        let (c, s) = (1.0 / t.hypot(1.0), t / t.hypot(1.0));
        let turn = |m: &mut Self, x: usize, y: usize| {
            let (a, b) = (m.elements[x], m.elements[y]);
            (m.elements[x], m.elements[y]) = (c * a - s * b, s * a + c * b);
        };
        (0..n).for_each(|k| turn(self, p * n + k, q * n + k));
        (0..n).for_each(|k| turn(self, k * n + p, k * n + q));
        (0..n).for_each(|k| turn(vectors, k * n + p, k * n + q));
        (self.elements[p * n + q], self.elements[q * n + p]) = (0.0, 0.0);
    }

    /// How far apart two matrices are, relative to the second.
    pub fn distance(&self, other: &Self) -> f64 {
        self.plus(-1.0, other).size() / other.size().max(f64::MIN_POSITIVE)
    }
}

impl Mul for Dense {
    type Output = Self;
    fn mul(self, other: Self) -> Self {
        self.times(&other)
    }
}

impl Mul<Dense> for f64 {
    type Output = Dense;
    fn mul(self, mut matrix: Dense) -> Dense {
        matrix.elements.iter_mut().for_each(|x| *x *= self);
        matrix
    }
}

impl Add for Dense {
    type Output = Self;
    fn add(self, other: Self) -> Self {
        self.plus(1.0, &other)
    }
}

impl Sub for Dense {
    type Output = Self;
    fn sub(self, other: Self) -> Self {
        self.plus(-1.0, &other)
    }
}
