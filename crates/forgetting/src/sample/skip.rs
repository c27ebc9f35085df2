//! Why a sample was left out.

/// Why a sample was left out.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Skip {
    /// the regressor is too small to count as information
    DeadZone,
    /// a value of the sample is missing
    Missing,
    /// the innovation is within what is known already
    WithinBound,
    /// the gate holds it back
    Gate,
}

impl Skip {
    /// Every reason; its position plus one is its code in a record of results (0: not skipped).
    pub const ALL: &'static [Self] =
        &[Self::DeadZone, Self::Missing, Self::WithinBound, Self::Gate];

    /// The reason in a word.
    pub fn word(self) -> &'static str {
        match self {
            Self::DeadZone => "dead_zone",
            Self::Missing => "missing",
            Self::WithinBound => "within_bound",
            Self::Gate => "gate",
        }
    }

    /// The reason that this word is, if it is one.
    pub fn of_word(word: &str) -> Option<Self> {
        Self::ALL.iter().copied().find(|reason| reason.word() == word)
    }

    /// The code of this reason: 1 and up.
    pub fn code(self) -> u8 {
        self as u8 + 1
    }
}
