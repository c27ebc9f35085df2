//! The information of the last samples.

use crate::error::Error;
use crate::number::{Array, Elements, Number, View};
use crate::settings::size;
use crate::shape;
use crate::update::{check_gamma, noise_of};
use forgetting::memory::zeros;

/// The sum of φᵀφ over the last samples, in O(n²) a sample.
#[derive(Clone, Debug)]
pub struct InformationWindow {
    window: forgetting::InformationWindow<f64>,
    parameters: usize,
    rows: usize,
}

impl InformationWindow {
    /// Of n = `parameters`, over `window` samples of `rows` rows.
    ///
    /// # Errors
    /// [`Error::Core`] names the size that is out of range.
    pub fn new(parameters: i64, window: i64, rows: i64) -> Result<Self, Error> {
        let parameters = size("parameters", parameters)?;
        let (window, rows) = (size("window", window)?, size("rows", rows)?);
        let window = forgetting::InformationWindow::new(parameters, rows, window)?;
        Ok(Self { window, parameters, rows })
    }

    /// Takes one sample: `phi` (rows, n) with rows of 1 left out or not, and `gamma` () or (rows,
    /// rows); 1 if not given.
    ///
    /// # Errors
    /// [`Error`] names what does not fit; nothing has changed.
    pub fn add(&mut self, phi: View<'_>, gamma: Option<View<'_>>) -> Result<(), Error> {
        shape::check("phi", phi.shape(), &[], &[self.rows, self.parameters])?;
        let phi = f64::read(phi.numbers());
        let Some(gamma) = gamma else { return Ok(self.window.add(&phi)?) };
        check_gamma(gamma.shape(), self.rows)?;
        let gamma = f64::read(gamma.numbers());
        Ok(self.window.add_with_noise(&phi, noise_of(Some(&gamma)))?)
    }

    /// The sum, (n, n), in units of φ².
    ///
    /// # Errors
    /// [`Error::Core`] when there is not enough memory.
    pub fn information(&self) -> Result<Array, Error> {
        let n = self.parameters;
        let mut information = zeros(n * n)?;
        let written = self.window.information(&mut information);
        debug_assert!(written.is_ok(), "there is room for n x n numbers");
        Ok(Array { shape: vec![n, n], elements: Elements::F64(information) })
    }

    /// The size below which an eigenvalue of the sum cannot be told from rounding.
    #[must_use]
    pub fn noise(&self) -> f64 {
        self.window.noise()
    }

    /// Samples taken so far.
    #[must_use]
    pub fn samples(&self) -> u64 {
        self.window.samples()
    }

    /// Samples in a full window.
    #[must_use]
    pub fn window(&self) -> usize {
        self.window.window()
    }
}
