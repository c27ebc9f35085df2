//! What several threads may use: one after the other, those that wait do not hold the interpreter.

use pyo3::exceptions::PyRuntimeError;
use pyo3::prelude::*;
use pyo3::sync::MutexExt;
use std::ops::{Deref, DerefMut};
use std::sync::atomic::{AtomicUsize, Ordering};
use std::sync::{Mutex, MutexGuard, PoisonError};

/// A value that one thread uses at a time.
pub struct Shared<T> {
    value: Mutex<T>,
    /// which thread uses it; 0 for none
    user: AtomicUsize,
}

/// A value in use.
pub struct Held<'a, T> {
    value: MutexGuard<'a, T>,
    user: &'a AtomicUsize,
}

impl<T> Shared<T> {
    /// Used by nobody yet.
    pub fn new(value: T) -> Self {
        Self { value: Mutex::new(value), user: AtomicUsize::new(0) }
    }

    /// The value, once no other thread uses it; the interpreter is free in the meantime.
    ///
    /// # Errors
    /// `RuntimeError` where this thread is in the middle of using it: in a function that the value
    /// itself has called.
    #[inline]
    pub fn lock(&self, py: Python<'_>) -> PyResult<Held<'_, T>> {
        let this = this_thread();
        if self.user.load(Ordering::Relaxed) == this {
            return Err(PyRuntimeError::new_err(
                "it is in the middle of a sample: a function that it calls cannot use it",
            ));
        }
        let value = match self.value.try_lock() {
            Ok(value) => value,
            Err(_) => self.value.lock_py_attached(py).unwrap_or_else(PoisonError::into_inner),
        };
        self.user.store(this, Ordering::Relaxed);
        Ok(Held { value, user: &self.user })
    }
}

/// A number of this thread's own, never 0.
#[inline]
fn this_thread() -> usize {
    thread_local! {
        static PLACE: u8 = const { 0 };
    }
    PLACE.with(|place| std::ptr::from_ref(place) as usize)
}

impl<T> Drop for Held<'_, T> {
    fn drop(&mut self) {
        self.user.store(0, Ordering::Relaxed);
    }
}

impl<T> Deref for Held<'_, T> {
    type Target = T;
    #[inline]
    fn deref(&self) -> &T {
        &self.value
    }
}

impl<T> DerefMut for Held<'_, T> {
    #[inline]
    fn deref_mut(&mut self) -> &mut T {
        &mut self.value
    }
}
