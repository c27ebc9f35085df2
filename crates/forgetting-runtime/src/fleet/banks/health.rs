//! How far the estimates of streams that are banks can be trusted.

use super::Banks;
use crate::estimator::GoOn;
use crate::fleet::health::StreamHealth;
use crate::fleet::pieces::room;
use crate::number::{Array, Elements, Number};
use forgetting::Error;

impl<T: Number> Banks<T> {
    /// What the health of each stream is made of. P of a bank is a sum and has no D of its own: the
    /// elements of its diagonal bound its eigenvalues in the same way.
    ///
    /// # Errors
    /// That of `go_on`.
    pub fn health(&self, go_on: GoOn<'_>) -> Result<StreamHealth, Error> {
        let (n, count) = (self.parameters(), self.count);
        let (mut largest, mut smallest) = (room(count, 1)?, room(count, 1)?);
        let mut windup = room(count, 1)?;
        let mut variances = vec![T::ZERO; n];
        self.try_each(go_on, |_, bank| {
            bank.variances(&mut variances);
            largest.push(variances.iter().fold(variances[0], |most, &p| most.max(p)));
            smallest.push(variances.iter().fold(variances[0], |least, &p| least.min(p)));
            windup.push(bank.windup());
            Ok(())
        })?;
        Ok(StreamHealth {
            windup: Array { shape: vec![count], elements: Elements::Bool(windup) },
            samples: Array { shape: vec![count], elements: Elements::I64(self.samples(go_on)?) },
            largest: T::array(largest, &[count]),
            smallest: T::array(smallest, &[count]),
        })
    }
}
