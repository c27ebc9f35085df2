//! A bank of estimators, of any type.

pub(crate) mod make;
pub(crate) mod outputs;
pub(crate) mod record;
mod update;

pub use make::{BankSettings, Member};
pub use outputs::BANK_OUTPUTS;
pub use update::BankUpdate;

use crate::choice::{Choice, Description};
use crate::error::Error;
use crate::estimator::{units, GoOn, Run, RunOptions};
use crate::missing::Missing;
use crate::number::{each, make, ByType, Family, Number};
use crate::number::{Array, NumberType, View};
use crate::update::UpdateOptions;
use forgetting::bank;
use forgetting::saved::bank_number_type;
use forgetting::{Memory, Real};

/// Banks, with the number type left open.
pub(crate) struct Banks;

impl Family for Banks {
    type Of<T: Number> = bank::Bank<T>;
}

/// Several estimators on the same samples, mixed by what they have predicted: nothing need be chosen
/// beforehand.
#[derive(Clone)]
pub struct Bank {
    pub(crate) typed: ByType<Banks>,
}

impl Bank {
    /// The bank that `settings` say.
    ///
    /// # Errors
    /// [`Error`] names the parameter, its value and what is allowed.
    pub fn new(settings: &BankSettings<'_>) -> Result<Self, Error> {
        Ok(Self { typed: make!(settings.common.number_type, T => make::bank::<T>(settings)?) })
    }

    /// The bank that [`Bank::to_bytes`] saved, bit for bit.
    ///
    /// # Errors
    /// [`Error::Core`] says what is wrong with the bytes.
    pub fn from_bytes(state: &[u8]) -> Result<Self, Error> {
        Ok(Self { typed: make!(saved_type(state)?, T => bank::Bank::<T>::from_bytes(state)?) })
    }

    /// The bank, configuration and state, as bytes: portable, versioned and checked.
    ///
    /// # Errors
    /// [`Error::Core`] when a part of it is a function of the user's.
    pub fn to_bytes(&self) -> Result<Vec<u8>, Error> {
        Ok(each!(&self.typed, bank => bank.to_bytes())?)
    }

    /// Back to the start, as if there had been no sample.
    pub fn reset(&mut self) {
        each!(&mut self.typed, bank => bank.reset());
    }

    /// Takes one sample: `phi` (n,) or (p, n), `y` (), (p,), (m,) or (p, m), and Γ as one number or
    /// (p, p); 1 if not given.
    ///
    /// # Errors
    /// [`Error`] names what was wrong; nothing has changed.
    pub fn update(
        &mut self,
        phi: View<'_>,
        y: View<'_>,
        gamma: Option<View<'_>>,
    ) -> Result<BankUpdate, Error> {
        self.update_with((phi, y, gamma), UpdateOptions::default())
    }

    /// [`Bank::update`] with all options.
    ///
    /// # Errors
    /// Those of [`Bank::update`], and [`Error`] names `elapsed` unless it is finite and not negative.
    pub fn update_with(
        &mut self,
        sample: (View<'_>, View<'_>, Option<View<'_>>),
        options: UpdateOptions,
    ) -> Result<BankUpdate, Error> {
        each!(&mut self.typed, bank => update::update(bank, sample, options))
    }

    /// Takes a whole record, as [`Estimator::run`](crate::Estimator::run) does; the outputs are those
    /// of [`BANK_OUTPUTS`].
    ///
    /// # Errors
    /// [`Error::Sample`] names the sample and what is wrong with it, others the argument that does
    /// not fit; the bank is as it was before the record.
    pub fn run(
        &mut self,
        record: (View<'_>, View<'_>, Option<View<'_>>),
        missing: Missing,
        outputs: Option<&[&str]>,
    ) -> Result<Run, Error> {
        self.run_while(record, &RunOptions::new(missing, outputs), &mut || Ok(()))
    }

    /// [`Bank::run`] with all options, asking a few times a second whether to go on.
    ///
    /// # Errors
    /// Those of [`Bank::run`], and [`Error::Sample`] with what `go_on` answers.
    pub fn run_while(
        &mut self,
        record: (View<'_>, View<'_>, Option<View<'_>>),
        options: &RunOptions<'_>,
        go_on: GoOn<'_>,
    ) -> Result<Run, Error> {
        each!(&mut self.typed, bank => record::run(bank, record, options, go_on))
    }

    /// φθ of one regressor or many: (..., n) gives (...) or (..., m).
    ///
    /// # Errors
    /// [`Error::Shape`] names `phi`.
    pub fn predict(&self, phi: View<'_>) -> Result<Array, Error> {
        each!(&self.typed, bank => predict(bank, phi))
    }

    /// n
    #[must_use]
    pub fn parameters(&self) -> usize {
        each!(&self.typed, bank => bank.memory().parameters())
    }

    /// p
    #[must_use]
    pub fn rows(&self) -> usize {
        each!(&self.typed, bank => bank.memory().rows())
    }

    /// m
    #[must_use]
    pub fn targets(&self) -> usize {
        each!(&self.typed, bank => bank.memory().targets())
    }

    /// The type of its numbers.
    #[must_use]
    pub fn number_type(&self) -> NumberType {
        self.typed.number_type()
    }

    /// Samples used since the start.
    #[must_use]
    pub fn samples(&self) -> u64 {
        each!(&self.typed, bank => bank.samples())
    }

    /// θ, (n,) or (n, m).
    #[must_use]
    pub fn theta(&self) -> Array {
        each!(&self.typed, bank => {
            let (n, m) = (bank.memory().parameters(), bank.memory().targets());
            let mut theta = Vec::new();
            by_parameter(bank, &mut theta);
            let shape = if m == 1 { vec![n] } else { vec![n, m] };
            Number::array(theta, &shape)
        })
    }

    /// P, (n, n), in units of 1/φ², with what the members disagree about: times the noise variance,
    /// it is the covariance of θ.
    #[must_use]
    pub fn covariance(&self) -> Array {
        each!(&self.typed, bank => {
            let n = bank.memory().parameters();
            let mut dense = vec![Real::ZERO; n * n];
            bank.covariance(&mut dense);
            Number::array(dense, &[n, n])
        })
    }

    /// w of each member for the next sample, (K,).
    #[must_use]
    pub fn weights(&self) -> Array {
        each!(&self.typed, bank => Number::array(bank.weights().to_vec(), &[bank.weights().len()]))
    }

    /// Over how many samples the bank remembers.
    #[must_use]
    pub fn memory(&self) -> f64 {
        each!(&self.typed, bank => bank.memory_in_samples().to_f64())
    }

    /// The variance of the whitened noise, over up to the last thousand samples.
    #[must_use]
    pub fn noise_variance(&self) -> f64 {
        each!(&self.typed, bank => bank.noise_variance().to_f64())
    }

    /// The units s (n,) in which regressors are measured, where the bank follows the data.
    #[must_use]
    pub fn units(&self) -> Option<Array> {
        each!(&self.typed, bank => bank.reciprocal_units().map(units))
    }

    /// Rule, rate, weighting and gate of each member.
    #[must_use]
    pub fn members(&self) -> Vec<Description> {
        each!(&self.typed, bank => bank.members().iter().map(Description::of).collect())
    }

    /// What mixes them.
    #[must_use]
    pub fn mixer(&self) -> Choice {
        each!(&self.typed, bank => Choice::mixer(bank.mixer()))
    }
}

/// The number type of a saved bank.
pub(crate) fn saved_type(state: &[u8]) -> Result<NumberType, Error> {
    Ok(match bank_number_type(state)? {
        8 => NumberType::F64,
        _ => NumberType::F32,
    })
}

/// θ, the m numbers of the first parameter first.
fn by_parameter<T: Number>(bank: &bank::Bank<T>, numbers: &mut Vec<T>) {
    let (n, m) = (bank.memory().parameters(), bank.memory().targets());
    let theta = bank.theta();
    numbers.extend((0..n).flat_map(|i| (0..m).map(move |t| theta[t * n + i])));
}

fn predict<T: Number>(bank: &bank::Bank<T>, phi: View<'_>) -> Result<Array, Error> {
    let (n, m) = (bank.memory().parameters(), bank.memory().targets());
    let Some((_, regressors)) = phi.shape().split_last().filter(|(last, _)| **last == n) else {
        return Err(Error::shape("phi", phi.shape(), format!("(..., {n})")));
    };
    let phi = T::read(phi.numbers());
    let mut prediction = vec![T::ZERO; phi.len() / n * m];
    bank.predict(&phi, &mut prediction)?;
    let mut shape = regressors.to_vec();
    if m > 1 {
        shape.push(m);
    }
    Ok(T::array(prediction, &shape))
}
