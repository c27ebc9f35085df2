//! The units of the streams that follow the data, as lines beside their states.

use super::size::reserve;
use super::starts::Starts;
use super::Line;
use crate::error::Error;
use alloc::vec::Vec;
use forgetting_kernels::kernel::lanes::streams::Units as StreamUnits;
use forgetting_kernels::Kernels;

/// What [`units`](crate::units) keeps, for each stream.
#[derive(Clone, Debug)]
pub(super) struct Units<T: Kernels> {
    n: usize,
    /// how many streams follow the data
    pub following: usize,
    /// 1/s, Σ x² and how many x there were other than 0: n lines each a block
    lines: Vec<Line<T>>,
    /// samples offered that a stream has not measured
    unmeasured: Vec<u64>,
    /// of how many samples the units of a stream were last looked at
    renewed: Vec<u64>,
    /// whether every regressor of every stream of a block has been other than 0
    settled: Vec<bool>,
    /// how many samples a block is to be offered before one of its streams renews its units
    due: Vec<u64>,
}

impl<T: Kernels> Units<T> {
    /// Of no streams yet, of n parameters.
    pub fn new(n: usize) -> Self {
        Self {
            n,
            following: 0,
            lines: Vec::new(),
            unmeasured: Vec::new(),
            renewed: Vec::new(),
            settled: Vec::new(),
            due: Vec::new(),
        }
    }

    /// Room for as many.
    ///
    /// # Errors
    /// [`Error::Memory`] when there is none.
    pub fn reserve(&mut self, blocks: usize, streams: usize) -> Result<(), Error> {
        let lines = blocks.checked_mul(3 * self.n).ok_or(Error::Memory)?;
        reserve(&mut self.lines, lines)?;
        reserve(&mut self.unmeasured, streams)?;
        reserve(&mut self.renewed, streams)?;
        reserve(&mut self.settled, blocks)?;
        reserve(&mut self.due, blocks)
    }

    /// Whether so many blocks fit where the lines are.
    pub fn has_room(&self, blocks: usize) -> bool {
        blocks <= self.lines.capacity() / (3 * self.n)
    }

    /// The first ones alone.
    pub fn truncate(&mut self, blocks: usize, streams: usize) {
        self.lines.truncate(blocks * 3 * self.n);
        self.unmeasured.truncate(streams);
        self.renewed.truncate(streams);
        self.settled.truncate(blocks);
        self.due.truncate(blocks);
    }

    /// Makes a lane of the last block that of a new stream.
    pub fn clear(&mut self, lane: usize) {
        let (first, n) = (self.lines.len() - 3 * self.n, self.n);
        for (i, line) in self.lines[first..].iter_mut().enumerate() {
            line.set(lane, if i < n { T::ONE } else { T::ZERO });
        }
    }

    /// New streams, up to `streams` in blocks that were offered so many samples.
    pub fn grow(&mut self, offered: &[u64], streams: usize) {
        for stream in self.unmeasured.len()..streams {
            let block = stream / Line::<T>::LANES;
            self.unmeasured.push(offered[block]);
            self.renewed.push(0);
            // a new stream in an old block
            if let (Some(settled), Some(due)) =
                (self.settled.get_mut(block), self.due.get_mut(block))
            {
                (*settled, *due) = (false, 0);
            }
        }
        self.settled.resize(offered.len(), false);
        self.due.resize(offered.len(), 0);
        let old = self.lines.len() / (3 * self.n);
        for _ in old..offered.len() {
            for i in 0..3 * self.n {
                self.lines.push(Line::splat(if i < self.n { T::ONE } else { T::ZERO }));
            }
        }
    }

    /// The numbers of a stream, in the order in which an estimator shows them.
    pub fn numbers(&self, stream: usize) -> impl Iterator<Item = T> + '_ {
        let (block, lane) = (stream / Line::<T>::LANES, stream % Line::<T>::LANES);
        self.block(block).iter().map(move |line| line.get(lane))
    }

    /// The lines of a block.
    pub fn block(&self, block: usize) -> &[Line<T>] {
        &self.lines[block * 3 * self.n..(block + 1) * 3 * self.n]
    }

    /// How many samples a stream has measured.
    pub fn measured(&self, stream: usize, offered: &[u64]) -> u64 {
        offered[stream / Line::<T>::LANES].wrapping_sub(self.unmeasured[stream])
    }

    /// All of them, to be changed as samples come.
    pub fn all<'a>(&'a mut self, starts: Starts<'a, T>) -> (StreamUnits<'a, T>, Following<'a, T>) {
        let Self { lines, unmeasured, renewed, settled, due, .. } = self;
        (StreamUnits { lines, unmeasured }, Following { starts, first: 0, renewed, settled, due })
    }
}

/// What is known of when streams will be on their own; see [`Units`].
#[derive(Debug)]
pub(super) struct Following<'a, T: Kernels> {
    pub starts: Starts<'a, T>,
    /// the first stream
    pub first: usize,
    pub renewed: &'a mut [u64],
    pub settled: &'a mut [bool],
    pub due: &'a mut [u64],
}

impl<T: Kernels> Following<'_, T> {
    /// Whether the prior of a stream follows the data.
    pub fn follows(&self, stream: usize) -> bool {
        self.starts.priors.get(self.first + stream).is_of_data()
    }
}
