//! Values that are kept of every sample, where they were asked for.

use crate::error::Error;
use crate::number::{Array, Elements};

/// Room for the elements of the output `name`, of this shape, if it is among `names`.
pub(crate) fn room<X>(
    names: &[&str],
    name: &str,
    shape: &[usize],
) -> Result<Option<Vec<X>>, Error> {
    if !names.contains(&name) {
        return Ok(None);
    }
    let length = shape.iter().try_fold(1usize, |length, &size| length.checked_mul(size));
    let mut elements = Vec::new();
    let reserved = length.map(|length| elements.try_reserve_exact(length));
    reserved.and_then(Result::ok).ok_or(forgetting::Error::Memory)?;
    Ok(Some(elements))
}

/// Appends a value, if it is kept.
#[inline(always)]
pub(crate) fn push<T>(values: &mut Option<Vec<T>>, value: T) {
    if let Some(values) = values {
        values.push(value);
    }
}

/// The outputs that were kept, each with its name and in its shape.
pub(crate) fn arrays<const N: usize>(
    outputs: [(&'static str, Option<Elements>, Vec<usize>); N],
) -> Vec<(&'static str, Array)> {
    let kept = outputs.into_iter().filter_map(|(name, elements, shape)| {
        elements.map(|elements| (name, Array { shape, elements }))
    });
    kept.collect()
}
