//! Streams that start again.

use super::pieces::each_piece;
use super::streams::Streams;
use super::threads::is_long;
use crate::configure::check_copies;
use crate::estimator::GoOn;
use crate::number::Number;
use forgetting::Error;

/// How much more than a sample it costs a stream to start again.
const EFFORT: usize = 8;

impl<T: Number> Streams<T> {
    /// Starts again the streams that `mask` names, or all. Where that may take long, and there is memory
    /// for it, it is done with a copy.
    ///
    /// # Errors
    /// That of `go_on`; nothing has changed.
    pub fn reset(&mut self, mask: Option<&[bool]>, go_on: GoOn<'_>) -> Result<(), Error> {
        let (count, n) = (self.count(), self.parameters());
        let is_long = is_long(count * n * (n + 3) * EFFORT);
        if !is_long || check_copies(self.fresh(), count).is_err() {
            return self.start_again(mask, &mut || Ok(()));
        }
        let mut copy = self.copy(go_on)?;
        copy.start_again(mask, go_on)?;
        *self = copy;
        Ok(())
    }

    fn start_again(&mut self, mask: Option<&[bool]>, go_on: GoOn<'_>) -> Result<(), Error> {
        each_piece(self.count(), self.parameters(), go_on, |streams| {
            let named = streams.filter(|&stream| mask.is_none_or(|mask| mask[stream]));
            match self {
                Self::Blocks(fleet) => fleet.reset(named),
                Self::Estimators { each, .. } => named.for_each(|stream| each[stream].reset()),
            }
            Ok(())
        })
    }
}
