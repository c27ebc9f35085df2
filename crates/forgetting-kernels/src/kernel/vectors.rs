//! Vectors of any length: products and sums.

use super::copies::copy;
use super::layout::{COMPACT, FEW};
use crate::kernel::dispatch::Kernel;
use crate::number::lane::Lane;
use crate::number::vector::Vector;
use crate::number::Real;

/// Σ aᵢ bᵢ over the shorter of the two.
pub struct Dot<'a, T> {
    /// the first
    pub a: &'a [T],
    /// the second
    pub b: &'a [T],
}

impl<T: Real> Kernel<T> for Dot<'_, T> {
    type Output = T;

    #[inline(always)]
    fn size(&self) -> usize {
        self.a.len()
    }

    #[inline(always)]
    fn run<V: Vector<T>, const GROUP: usize>(self) -> T {
        let length = self.a.len().min(self.b.len());
        dot_of::<T, V>(&self.a[..length], &self.b[..length])
    }
}

/// Σ aᵢ bᵢ of two that are equally long, inside another kernel.
#[inline(always)]
pub fn dot_of<T: Real, V: Vector<T>>(a: &[T], b: &[T]) -> T {
    let ((a, a_rest), (b, b_rest)) = (T::chunks(a), T::chunks(b));
    let mut sum = T::ZERO;
    if !a.is_empty() {
        let mut lanes = V::splat(T::ZERO);
        for i in 0..a.len().min(b.len()) {
            lanes = V::load(&a[i]).mul_add(V::load(&b[i]), lanes);
        }
        sum = lanes.sum();
    }
    for i in 0..a_rest.len().min(b_rest.len()) {
        sum = a_rest[i].mul_add(b_rest[i], sum);
    }
    sum
}

/// `y` += c·`x`
pub struct AddScaled<'a, T> {
    /// one number a sample
    pub y: &'a mut [T],
    /// the factor
    pub c: T,
    /// the vector
    pub x: &'a [T],
}

impl<T: Real> Kernel<T> for AddScaled<'_, T> {
    type Output = ();

    #[inline(always)]
    fn size(&self) -> usize {
        self.x.len()
    }

    #[inline(always)]
    fn run<V: Vector<T>, const GROUP: usize>(self) {
        add_scaled_by::<T, V>(self.y, self.c, self.x);
    }
}

/// `y` += c·`x`, inside another kernel.
#[inline(always)]
pub fn add_scaled_by<T: Real, V: Vector<T>>(y: &mut [T], c: T, x: &[T]) {
    let length = y.len().min(x.len());
    let (y, y_rest) = T::chunks_mut(&mut y[..length]);
    let (x, x_rest) = T::chunks(&x[..length]);
    let lanes = V::splat(c);
    for i in 0..y.len().min(x.len()) {
        lanes.mul_add(V::load(&x[i]), V::load(&y[i])).store(&mut y[i]);
    }
    for i in 0..y_rest.len().min(x_rest.len()) {
        y_rest[i] = c.mul_add(x_rest[i], y_rest[i]);
    }
}

/// φ·θ and φ·φ, with φ copied on the way: what the arrival of a sample needs.
pub struct Arrive<'a, T> {
    /// the regressors
    pub phi: &'a [T],
    /// θ
    pub theta: &'a [T],
    /// becomes φ
    pub copy: &'a mut [T],
}

impl<T: Real> Kernel<T> for Arrive<'_, T> {
    type Output = (T, T);

    #[inline(always)]
    fn size(&self) -> usize {
        self.phi.len()
    }

    #[inline(always)]
    fn run<V: Vector<T>, const GROUP: usize>(self) -> (T, T) {
        copy::<T, V>(self.phi, self.copy);
        // wide vectors are for many: without this they would be compiled for few, too
        if GROUP < 8 && self.phi.len() <= FEW {
            if COMPACT {
                return some(self.phi, self.theta);
            }
            with_few!(self.phi.len(), few::<T>(self.phi, self.theta))
        } else {
            products::<T, V>(self.phi, self.theta)
        }
    }
}

/// φ·θ and φ·φ of many parameters, inside another kernel.
#[inline(always)]
pub fn products<T: Real, V: Vector<T>>(phi: &[T], theta: &[T]) -> (T, T) {
    let (theta, theta_rest) = T::chunks(&theta[..phi.len()]);
    let (phi, phi_rest) = T::chunks(phi);
    let (mut product, mut square) = (T::ZERO, T::ZERO);
    if !phi.is_empty() {
        let (mut products, mut squares) = (V::splat(T::ZERO), V::splat(T::ZERO));
        for i in 0..phi.len().min(theta.len()) {
            let phi = V::load(&phi[i]);
            products = phi.mul_add(V::load(&theta[i]), products);
            squares = phi.mul_add(phi, squares);
        }
        (product, square) = (products.sum(), squares.sum());
    }
    for i in 0..phi_rest.len().min(theta_rest.len()) {
        let phi = phi_rest[i];
        product = phi.mul_add(theta_rest[i], product);
        square = phi.mul_add(phi, square);
    }
    (product, square)
}

/// φ·θ and φ·φ of N numbers, at most ten.
#[inline(always)]
fn few<T: Real, const N: usize>(phi: &[T], theta: &[T]) -> (T, T) {
    match (phi.first_chunk::<N>(), theta.first_chunk::<N>()) {
        (Some(phi), Some(theta)) => few_products(phi, theta),
        _ => (T::ZERO, T::ZERO),
    }
}

/// The same of any number of them, where programs are to be small.
fn some<T: Real>(phi: &[T], theta: &[T]) -> (T, T) {
    let (mut product, mut square) = (T::ZERO, T::ZERO);
    for (&phi, &theta) in phi.iter().zip(theta) {
        product = phi.mul_add(theta, product);
        square = phi.mul_add(phi, square);
    }
    (product, square)
}

/// φ·θ and φ·φ, of one stream or of one in each lane.
#[inline(always)]
pub fn few_products<T: Real, A: Lane<T>, const N: usize>(phi: &[A; N], theta: &[A; N]) -> (A, A) {
    let (mut product, mut square) = (A::splat(T::ZERO), A::splat(T::ZERO));
    for i in 0..N {
        product = phi[i].mul_add(theta[i], product);
        square = phi[i].mul_add(phi[i], square);
    }
    (product, square)
}
