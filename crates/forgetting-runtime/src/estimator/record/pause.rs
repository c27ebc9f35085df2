//! Long records ask now and then whether to go on.

use forgetting::Error;
use std::time::{Duration, Instant};

/// Whether a long calculation goes on; an error ends it, with everything as it was before.
pub type GoOn<'a> = &'a mut dyn FnMut() -> Result<(), Error>;

/// Time between two questions.
const INTERVAL: Duration = Duration::from_millis(50);
/// Numbers of P that samples pass over between two looks at the clock.
const NUMBERS: usize = 1 << 18;

/// When to ask.
pub(crate) struct Pause<'a> {
    go_on: GoOn<'a>,
    /// when it was asked last, where there is a clock
    last: Option<Instant>,
    /// samples between two looks at the clock, and until the next
    every: usize,
    left: usize,
}

impl<'a> Pause<'a> {
    /// For samples of so many rows and parameters.
    pub fn new(go_on: GoOn<'a>, rows: usize, parameters: usize) -> Self {
        let every = (NUMBERS / (rows * parameters * parameters).max(1)).max(1);
        Self { go_on, last: now(), every, left: every }
    }

    /// After so many samples.
    ///
    /// # Errors
    /// That with which the question is answered.
    #[inline]
    pub fn after(&mut self, samples: usize) -> Result<(), Error> {
        self.left = self.left.saturating_sub(samples);
        if self.left > 0 {
            return Ok(());
        }
        self.left = self.every;
        if self.last.is_some_and(|last| last.elapsed() < INTERVAL) {
            return Ok(());
        }
        self.last = now();
        (self.go_on)()
    }
}

/// None on WebAssembly, which has no clock.
fn now() -> Option<Instant> {
    (!cfg!(target_arch = "wasm32")).then(Instant::now)
}
