//! The parameter `otherwise` of a gate: what is done with a sample that does not pass.

use crate::choice::{Parameter, Value, Values};
use crate::error::Error;
use crate::sample::Answer;

/// The parameter.
pub(super) const OTHERWISE: Parameter = Parameter::word(
    "otherwise",
    &["hold", "freeze"],
    "what is done with a sample that does not pass: neither forget nor learn, or learn only",
);

/// The answer that `otherwise` names in `values`.
///
/// # Errors
/// [`Error`] names the parameter when it is no such word.
pub(super) fn read(values: &dyn Values) -> Result<Answer, Error> {
    OTHERWISE.choice(values).map(|position| [Answer::Hold, Answer::Freeze][position])
}

/// Names `answer` as the parameter `otherwise`.
pub(super) fn describe(answer: Answer, each: &mut dyn FnMut(&'static str, Value<'_>)) {
    each(OTHERWISE.name, Value::Word(answer.word()));
}
