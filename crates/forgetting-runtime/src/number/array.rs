//! Numbers as an interface passes and receives them.

use super::NumberType;
use crate::error::Error;
use std::borrow::Cow;

/// Numbers of an interface, of either type. Those of another type than the estimator's are
/// converted, which takes a copy.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Numbers<'a> {
    /// of 64 bits
    F64(&'a [f64]),
    /// of 32 bits
    F32(&'a [f32]),
}

impl<'a> Numbers<'a> {
    /// How many there are.
    #[must_use]
    pub fn len(&self) -> usize {
        match self {
            Self::F64(numbers) => numbers.len(),
            Self::F32(numbers) => numbers.len(),
        }
    }

    /// Whether there is none.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// In 64 bits.
    #[must_use]
    pub fn to_f64(self) -> Cow<'a, [f64]> {
        match self {
            Self::F64(numbers) => Cow::Borrowed(numbers),
            Self::F32(numbers) => numbers.iter().map(|&x| f64::from(x)).collect(),
        }
    }

    /// Their type.
    #[must_use]
    pub fn number_type(&self) -> NumberType {
        match self {
            Self::F64(_) => NumberType::F64,
            Self::F32(_) => NumberType::F32,
        }
    }
}

impl<'a> From<&'a [f64]> for Numbers<'a> {
    #[inline]
    fn from(numbers: &'a [f64]) -> Self {
        Self::F64(numbers)
    }
}

impl<'a> From<&'a [f32]> for Numbers<'a> {
    #[inline]
    fn from(numbers: &'a [f32]) -> Self {
        Self::F32(numbers)
    }
}

/// Numbers in the shape of an array, the last dimension next to each other (C order).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct View<'a> {
    numbers: Numbers<'a>,
    shape: Shape<'a>,
}

#[derive(Clone, Copy, Debug, PartialEq)]
enum Shape<'a> {
    Given(&'a [usize]),
    Vector([usize; 1]),
}

impl<'a> View<'a> {
    /// `numbers`, the value of `parameter`, in this shape; `[]` is a single number.
    ///
    /// # Errors
    /// [`Error::Core`] names the parameter unless there are as many numbers as the shape has
    /// places.
    pub fn new(
        parameter: &'static str,
        numbers: impl Into<Numbers<'a>>,
        shape: &'a [usize],
    ) -> Result<Self, Error> {
        let numbers = numbers.into();
        let places = shape.iter().fold(1, |places: usize, &size| places.saturating_mul(size));
        forgetting::Error::check_length(parameter, numbers.len(), places)?;
        Ok(Self { numbers, shape: Shape::Given(shape) })
    }

    /// The numbers.
    #[inline]
    #[must_use]
    pub fn numbers(&self) -> Numbers<'a> {
        self.numbers
    }

    /// The shape.
    #[must_use]
    #[inline]
    pub fn shape(&self) -> &[usize] {
        match &self.shape {
            Shape::Given(shape) => shape,
            Shape::Vector(length) => length,
        }
    }
}

/// A vector: numbers in one dimension.
impl<'a, N: Into<Numbers<'a>>> From<N> for View<'a> {
    #[inline]
    fn from(numbers: N) -> Self {
        let numbers = numbers.into();
        Self { numbers, shape: Shape::Vector([numbers.len()]) }
    }
}

/// An array that an estimator or a fleet returns.
#[derive(Clone, Debug, PartialEq)]
pub struct Array {
    /// the size of each dimension
    pub shape: Vec<usize>,
    /// the elements, the last dimension next to each other (C order)
    pub elements: Elements,
}

/// The elements of an array.
#[derive(Clone, Debug, PartialEq)]
pub enum Elements {
    /// numbers of 64 bits
    F64(Vec<f64>),
    /// numbers of 32 bits
    F32(Vec<f32>),
    /// counts
    I64(Vec<i64>),
    /// codes: of a reason ([`Skip`](crate::Skip)) or an answer ([`Answer`](crate::Answer))
    U8(Vec<u8>),
    /// yes or no
    Bool(Vec<bool>),
}

impl Elements {
    /// The elements as numbers of 64 bits; yes is 1, no is 0.
    #[must_use]
    pub fn to_f64(&self) -> Vec<f64> {
        match self {
            Self::F64(elements) => elements.clone(),
            Self::F32(elements) => elements.iter().map(|&x| f64::from(x)).collect(),
            Self::I64(elements) => elements.iter().map(|&x| x as f64).collect(),
            Self::U8(elements) => elements.iter().map(|&x| f64::from(x)).collect(),
            Self::Bool(elements) => elements.iter().map(|&x| f64::from(u8::from(x))).collect(),
        }
    }
}
