//! Shapes of arguments, as a user of any language sees them: the one place that says which fit.
//!
//! An argument has a full shape, such as (rows, n) for φ; dimensions of 1 may be left out, but no
//! other shape of as many numbers will do: a transposed matrix is not the matrix.

use crate::error::{tuple, Error};

/// Refuses a shape other than `leading` followed by `full`, of which dimensions of 1 may be left out.
///
/// # Errors
/// [`Error::Shape`] names the parameter, its shape and the shapes allowed.
#[inline]
pub(crate) fn check(
    parameter: &str,
    shape: &[usize],
    leading: &[usize],
    full: &[usize],
) -> Result<(), Error> {
    let rest = shape.strip_prefix(leading);
    if rest.is_some_and(|rest| fits(rest, full)) {
        return Ok(());
    }
    Err(Error::shape(parameter, shape, forms(leading, full)))
}

/// Whether `shape` is `full` with dimensions of 1 left out, or not.
#[inline]
pub(crate) fn fits(shape: &[usize], full: &[usize]) -> bool {
    let mut rest = shape;
    for &size in full {
        match rest.split_first() {
            Some((&first, after)) if first == size => rest = after,
            _ if size == 1 => {}
            _ => return false,
        }
    }
    rest.is_empty()
}

/// The shapes that fit, in words: "(3,) or (1, 3)".
#[cold]
pub(crate) fn forms(leading: &[usize], full: &[usize]) -> String {
    let mut forms = vec![leading.to_vec()];
    for &size in full {
        let with: Vec<_> = forms.iter().map(|form| [form.as_slice(), &[size]].concat()).collect();
        if size == 1 {
            forms.extend(with);
        } else {
            forms = with;
        }
    }
    forms.sort_by_key(Vec::len);
    forms.dedup();
    either(&forms)
}

/// Several shapes: "(), (3,) or (3, 3)".
#[cold]
pub(crate) fn either<S: AsRef<[usize]>>(shapes: &[S]) -> String {
    let mut words: Vec<_> = shapes.iter().map(|shape| tuple(shape.as_ref())).collect();
    match words.pop() {
        Some(last) if !words.is_empty() => format!("{} or {last}", words.join(", ")),
        last => last.unwrap_or_default(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn dimensions_of_one_may_be_left_out_and_nothing_else() {
        for shape in [&[3][..], &[1, 3]] {
            assert!(fits(shape, &[1, 3]));
        }
        for shape in [&[3, 1][..], &[1, 1, 3], &[], &[2], &[3, 3]] {
            assert!(!fits(shape, &[1, 3]), "{shape:?}");
        }
        for shape in [&[][..], &[1], &[1, 1]] {
            assert!(fits(shape, &[1, 1]));
        }
        assert!(!fits(&[1, 1, 1], &[1, 1]) && !fits(&[3, 2], &[2, 3]));
    }

    #[test]
    fn the_shapes_allowed_are_told() {
        assert_eq!(forms(&[], &[1, 3]), "(3,) or (1, 3)");
        assert_eq!(forms(&[7], &[1, 1]), "(7,), (7, 1) or (7, 1, 1)");
        assert_eq!(forms(&[], &[2, 3]), "(2, 3)");
    }
}
