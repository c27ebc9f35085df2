//! Estimators of any rule, rate, weighting and gate, by name.

use super::{Float, Model, Saves};
use crate::code::Why;
use crate::number::Number;
use crate::report::{Health, Report};
use crate::settings::{Choice, Settings};
use forgetting::choice::{About, Defaults, Kind, Value, Values};
use forgetting::compact::Given;
use forgetting::defaults::{PROCESS_NOISE, RULE, RULE_OF_DATA};
use forgetting::gates::AnyGate;
use forgetting::rates::AnyRate;
use forgetting::rules::Rule;
use forgetting::weightings::AnyWeighting;
use forgetting::{Error, Estimator, Memory, Named, Noise, Packed, Prior, Size, UpTo, DIFFUSE};

/// Samples that a rate can look back over.
const WINDOW: usize = 256;

type In<T, const N: usize> = UpTo<T, N, WINDOW>;

/// A general estimator of up to N parameters.
pub struct General<T: Float, const N: usize>(Named<In<T, N>>)
where
    Size<N>: Packed<T>;

/// The default where nothing is said.
struct Walk;

impl Values for Walk {
    fn get(&self, name: &str) -> Option<Value<'_>> {
        match name {
            "process_noise" => Some(Value::Real(PROCESS_NOISE)),
            "bound" => Some(Value::Real(DIFFUSE)),
            _ => None,
        }
    }
}

/// One number by its name.
struct One(&'static str, f64);

impl Values for One {
    fn get(&self, name: &str) -> Option<Value<'_>> {
        (name == self.0).then_some(Value::Real(self.1))
    }
}

/// What `make` makes of a choice, or of the default `name`.
fn chosen<C>(
    choice: &Choice,
    name: &'static str,
    entry: fn(&str) -> Option<&'static About>,
    make: impl Fn(&str, &dyn Values) -> Result<C, Error>,
) -> Result<C, Error> {
    match choice.name() {
        None => make(name, &Defaults),
        Some(name) => {
            choice.check(entry(name))?;
            make(name, &choice.values())
        }
    }
}

impl Settings {
    fn rule<M: Memory>(&self, memory: M) -> Result<Rule<M>, Error> {
        let nothing = self.initial_covariance == 0.0
            && self.forgetting_factor == 0.0
            && self.rate.name.is_null();
        match self.rule.name() {
            None if nothing => Rule::named(RULE_OF_DATA, &Walk, memory),
            _ => chosen(&self.rule, RULE, Rule::<M>::entry, |name, values| {
                Rule::named(name, values, memory)
            }),
        }
    }

    fn rate<M: Memory>(&self, rule: &str, memory: M) -> Result<AnyRate<M>, Error> {
        let about = Rule::<M>::entry(rule);
        let uses = about.is_some_and(|about| about.forgetting_factor);
        // a rule within it may use a factor where it does not
        let holds =
            about.is_some_and(|about| about.parameters.iter().any(|p| p.kind == Kind::Rule));
        let lambda = self.forgetting_factor(uses || (holds && self.forgetting_factor != 0.0))?;
        match self.rate.name() {
            None => AnyRate::named("constant", &One("forgetting_factor", lambda), memory),
            Some(_) if !uses && !holds => {
                Err(Error::Unsupported { reason: "a rate is given, but the rule uses none" })
            }
            Some(_) => chosen(&self.rate, "constant", AnyRate::<M>::entry, |name, values| {
                AnyRate::named(name, values, memory)
            }),
        }
    }

    fn prior<M: Memory>(&self, memory: M) -> Result<Prior<M>, Error> {
        let real = <M::Real as forgetting::Real>::from_f64;
        let prior = match self.initial_covariance {
            0.0 => Prior::of_data(memory),
            given => Prior::scalar(memory, real(given))?,
        };
        let Some(given) = self.initial_theta() else { return Ok(prior) };
        let mut theta = memory.vector();
        for (theta, &given) in theta.as_mut().iter_mut().zip(given) {
            *theta = real(given);
        }
        prior.with_theta(theta.as_ref())
    }
}

impl<T: Float, const N: usize> Model for General<T, N>
where
    Size<N>: Packed<T>,
{
    type Real = T;
    const NUMBER: Number = T::NUMBER;
    const PARAMETERS: (usize, usize) = (1, N);

    fn make(settings: &Settings) -> Result<Self, Why> {
        let memory = In::<T, N>::new(settings.parameters)?;
        let rule = settings.rule(memory)?;
        let rate = settings.rate(rule.called(), memory)?;
        let weighting = chosen(
            &settings.weighting,
            "equal",
            AnyWeighting::<In<T, N>>::entry,
            |name, values| AnyWeighting::named(name, values, memory),
        )?;
        let gate = chosen(&settings.gate, "open", AnyGate::<In<T, N>>::entry, |name, values| {
            AnyGate::named(name, values, memory)
        })?;
        let prior = settings.prior(memory)?;
        let mut estimator = Estimator::new(rule, rate, weighting, prior).with_gate(gate);
        if settings.monitor != 0 {
            estimator.enable_monitor();
        }
        Ok(Self(estimator))
    }

    fn parameters(&self) -> usize {
        self.0.prior().memory().parameters()
    }

    fn reset(&mut self) {
        self.0.reset();
    }

    fn samples(&self) -> u64 {
        self.0.samples()
    }

    fn health(&self) -> Option<Health> {
        self.0.health().map(Health::from)
    }

    fn update(&mut self, phi: &[T], y: T, _: Option<&Given<T>>) -> Result<Report<T>, Why> {
        Ok(self.0.update(phi, &[y])?.into())
    }

    fn predict(&self, phi: &[T]) -> T {
        let mut prediction = [T::ZERO];
        // the lengths fit
        let _ = self.0.predict(phi, &mut prediction);
        prediction[0]
    }

    fn theta(&self) -> &[T] {
        self.0.theta()
    }

    fn set_theta(&mut self, theta: &[T]) -> Result<(), Why> {
        Ok(self.0.set_theta(theta)?)
    }

    fn covariance(&mut self, covariance: &mut [T]) {
        self.0.express(self.0.factor()).reconstruct(covariance);
    }
}

impl<T: Float, const N: usize> Saves for General<T, N>
where
    Size<N>: Packed<T>,
{
    fn update_after(
        &mut self,
        elapsed: T,
        phi: &[T],
        y: T,
        gamma: Option<T>,
    ) -> Result<Report<T>, Why> {
        let noise = gamma.map_or(Noise::Unit, Noise::Scalar);
        Ok(self.0.update_after(elapsed, phi, &[y], noise)?.into())
    }

    fn load(bytes: &[u8]) -> Result<Self, Why> {
        Ok(Self(Named::from_bytes(bytes)?))
    }

    fn save(&mut self, put: &mut dyn FnMut(&[u8])) -> Result<(), Why> {
        self.0.save(put)?;
        Ok(())
    }
}
