//! One sample through a bank.

use crate::error::Error;
use crate::missing::{is_missing, Missing};
use crate::number::{Number, View};
use crate::update::{check_shapes, noise_of, Innovation, UpdateOptions};
use forgetting::bank::Bank;
use forgetting::{Dynamic, Memory, Skip};

/// What a bank reports of one sample.
#[derive(Clone, Debug, PartialEq)]
pub struct BankUpdate {
    /// y − φθ with the θ of before, in units of y
    pub error: Innovation,
    /// the variance of the prediction in units of the noise variance, without what members
    /// disagree about
    pub leverage: f64,
    /// the forgetting factor of the members, mixed
    pub forgetting_factor: f64,
    /// why the sample was left out, if all members left it out
    pub skipped: Option<Skip>,
    /// whether P of every member that is believed has wound up
    pub windup: bool,
    /// members that could not take the sample
    pub asleep: usize,
}

impl BankUpdate {
    /// Of a sample that is missing.
    fn of_missing<T: Number>(memory: Dynamic<T>) -> Self {
        let (p, m) = (memory.rows(), memory.targets());
        Self {
            error: Innovation::new(&vec![f64::NAN; p * m], m),
            leverage: f64::NAN,
            forgetting_factor: 1.0,
            skipped: Some(Skip::Missing),
            windup: false,
            asleep: 0,
        }
    }
}

/// Updates `bank` with one sample: φ (p, n), y (p, m) and Γ, 1, () or (p, p).
pub(super) fn update<T: Number>(
    bank: &mut Bank<T>,
    (phi, y, gamma): (View<'_>, View<'_>, Option<View<'_>>),
    options: UpdateOptions,
) -> Result<BankUpdate, Error> {
    let m = bank.memory().targets();
    check_shapes(bank.memory(), &phi, &y, gamma.as_ref())?;
    let gamma = gamma.map(|gamma| T::read(gamma.numbers()));
    let noise = noise_of(gamma.as_deref());
    let (phi, y) = (T::read(phi.numbers()), T::read(y.numbers()));
    if options.missing == Missing::Skip && is_missing(&phi, &y) {
        return Ok(BankUpdate::of_missing(bank.memory()));
    }
    let update = bank.update_after(T::from_f64(options.elapsed), &phi, &y, noise)?;
    Ok(BankUpdate {
        error: Innovation::new(update.error, m),
        leverage: update.leverage.to_f64(),
        forgetting_factor: update.forgetting_factor.to_f64(),
        skipped: update.skipped,
        windup: update.windup,
        asleep: update.asleep,
    })
}
