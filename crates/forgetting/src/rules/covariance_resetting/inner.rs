//! The rule for the time between the resets: any rule, made by its name or with its parameters.

use super::super::{Forgetting, Forgotten, Step};
use crate::choice::{Defaults, Parameter, Value, Values};
use crate::error::Error;
use crate::memory::Memory;
use core::marker::PhantomData;

/// The rule that is the value of `parameter`.
pub(super) fn configure<M: Memory, F: Forgetting<M>>(
    parameter: &Parameter,
    values: &dyn Values,
    memory: M,
) -> Result<F, Error> {
    match parameter.look_up(values)? {
        Value::Word(name) => F::called(name, &Defaults, memory),
        Value::Choice { name, values } => F::called(name, values, memory),
        _ => Err(Error::value(parameter.name, f64::NAN, "the name of a rule")),
    }
}

/// Names `rule` with its parameters, as the value of the parameter `name`.
pub(super) fn describe<M: Memory, F: Forgetting<M>>(
    name: &'static str,
    rule: &F,
    each: &mut dyn FnMut(&'static str, Value<'_>),
) {
    let values = &Described(rule, PhantomData);
    each(name, Value::Choice { name: rule.name(), values });
}

/// The parameters of a rule, to be shown.
struct Described<'a, M, F>(&'a F, PhantomData<M>);

impl<M: Memory, F: Forgetting<M>> Values for Described<'_, M, F> {
    fn get(&self, _: &str) -> Option<Value<'_>> {
        None
    }

    fn each(&self, show: &mut dyn FnMut(&str, Value<'_>)) {
        self.0.describe(&mut |name, value| show(name, value));
    }
}

/// Lets `rule` forget, or start anew from a P that has just been put there. Not inlined: any rule may
/// be in here, beside any rule around it.
#[inline(never)]
pub(super) fn forget<M: Memory, F: Forgetting<M>>(
    rule: &F,
    state: &mut F::State,
    step: Step<'_, '_, M>,
    restart: bool,
) -> Result<Forgotten, Error> {
    if restart {
        rule.restart(state, step)
    } else {
        rule.forget(state, step)
    }
}
