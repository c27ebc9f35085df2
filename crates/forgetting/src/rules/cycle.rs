//! Rules that may act on one direction or block a sample, each in its turn, in the place of all.

use crate::choice::{Parameter, Value, Values};
use crate::error::Error;
use crate::memory::state::{State, Visitor};
use forgetting_kernels::Real;

const WORDS: [&str; 2] = ["every_sample", "cyclic"];

/// The parameter that says so.
pub const fn schedule(about: &'static str) -> Parameter {
    Parameter::word("schedule", &WORDS, about)
}

/// Whether the turns were asked for.
pub fn is_cyclic(schedule: &Parameter, values: &dyn Values) -> Result<bool, Error> {
    schedule.choice(values).map(|position| position == 1)
}

/// The word for it.
pub fn word(cyclic: bool) -> Value<'static> {
    Value::Word(WORDS[usize::from(cyclic)])
}

/// Whose turn it is.
#[derive(Clone, Copy, Debug, Default)]
pub struct Cycle {
    position: u64,
}

impl<T: Real> State<T> for Cycle {
    fn visit(&mut self, visitor: &mut dyn Visitor<T>) {
        visitor.whole(&mut self.position);
    }
}

impl Cycle {
    /// Which of `count` ≥ 1 it is.
    pub fn turn(self, count: usize) -> usize {
        // a position out of the cycle can only come from a saved state that was tampered with
        (self.position % count as u64) as usize
    }

    /// From here on it is the next one's turn.
    pub fn pass(&mut self, count: usize) {
        self.position = ((self.turn(count) + 1) % count) as u64;
    }
}

#[cfg(test)]
mod tests {
    use super::Cycle;

    #[test]
    fn everyone_has_a_turn_in_every_cycle() {
        let mut cycle = Cycle::default();
        let turns: [usize; 7] = core::array::from_fn(|_| {
            let turn = cycle.turn(3);
            cycle.pass(3);
            turn
        });
        assert_eq!(turns, [0, 1, 2, 0, 1, 2, 0]);
        assert_eq!(Cycle { position: u64::MAX }.turn(2), 1);
    }
}
