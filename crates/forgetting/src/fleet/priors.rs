//! What each stream starts from: the same for all, or a prior of its own.

use super::size::reserve;
use crate::covariance::Prior;
use crate::error::Error;
use crate::memory::state::Visitor;
use crate::memory::Dynamic;
use alloc::vec::Vec;
use forgetting_kernels::Kernels;

/// The priors of the streams.
#[derive(Clone, Debug)]
pub struct Priors<T: Kernels> {
    /// that of a new stream, then those of streams with one of their own
    different: Vec<Prior<Dynamic<T>>>,
    /// which one each stream has; empty while all have the first
    of: Vec<usize>,
}

impl<T: Kernels> Priors<T> {
    /// The same for all.
    pub fn of(common: Prior<Dynamic<T>>) -> Self {
        Self { different: Vec::from([common]), of: Vec::new() }
    }

    pub fn get(&self, stream: usize) -> &Prior<Dynamic<T>> {
        &self.different[self.of.get(stream).copied().unwrap_or(0)]
    }

    /// Whether the stream starts as a new one does.
    pub fn is_common(&self, stream: usize) -> bool {
        self.of.get(stream).is_none_or(|&which| which == 0)
    }

    /// Room for as many streams.
    pub fn reserve(&mut self, streams: usize) -> Result<(), Error> {
        match self.of.as_slice() {
            [] => Ok(()),
            _ => reserve(&mut self.of, streams),
        }
    }

    /// `count` more streams that start as a new one does.
    pub fn grow(&mut self, count: usize) {
        if !self.of.is_empty() {
            self.of.resize(self.of.len() + count, 0);
        }
    }

    /// The first `count` alone.
    pub fn truncate(&mut self, count: usize) {
        self.of.truncate(count);
        let used = self.of.iter().max().map_or(1, |&last| last + 1);
        self.different.truncate(used);
    }

    /// Whether new streams start as those of `others`, bit for bit.
    pub fn are_common(&self, others: &Self) -> bool {
        same(&self.different[0], &others.different[0])
    }

    /// Gives a stream, one of `count`, this prior.
    ///
    /// # Errors
    /// [`Error::Memory`] when there is none; nothing has changed.
    pub fn put(
        &mut self,
        stream: usize,
        prior: &Prior<Dynamic<T>>,
        count: usize,
    ) -> Result<(), Error> {
        let common = same(&self.different[0], prior);
        if common && self.of.is_empty() {
            return Ok(());
        }
        reserve(&mut self.of, count)?;
        let another = self.different.len() + 1;
        reserve(&mut self.different, another)?;
        if self.of.is_empty() {
            self.of.resize(count, 0);
        }
        match (self.of[stream], common) {
            (0, true) => {}
            (0, false) => {
                self.of[stream] = self.different.len();
                self.different.push(prior.clone());
            }
            // its own place is kept for it
            (own, _) => self.different[own] = prior.clone(),
        }
        Ok(())
    }
}

/// Whether two priors are the same, bit for bit.
fn same<T: Kernels>(a: &Prior<Dynamic<T>>, b: &Prior<Dynamic<T>>) -> bool {
    a.form() == b.form() && written(a) == written(b)
}

fn written<T: Kernels>(prior: &Prior<Dynamic<T>>) -> Vec<u64> {
    struct Bits(Vec<u64>);
    impl<T: Kernels> Visitor<T> for Bits {
        fn reals(&mut self, values: &mut [T]) {
            self.0.extend(values.iter().map(|x| x.to_f64().to_bits()));
        }
        fn whole(&mut self, value: &mut u64) {
            self.0.push(*value);
        }
    }
    let mut bits = Bits(Vec::new());
    prior.clone().visit(&mut bits);
    bits.0
}
