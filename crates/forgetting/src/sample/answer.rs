//! What a gate decides about a sample.

/// What is done with a sample. Each is a step of Theorem 1: to freeze is F = 0, to hold is F = 0
/// and φ = 0, and so neither is improper or moves P up.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Answer {
    /// forget and learn
    Update,
    /// learn, but forget nothing
    Freeze,
    /// neither forget nor learn: all stays as it is
    Hold,
}

impl Answer {
    /// Every answer; its position is its code in a record of results.
    pub const ALL: &'static [Self] = &[Self::Update, Self::Freeze, Self::Hold];

    /// The answer in a word.
    pub fn word(self) -> &'static str {
        match self {
            Self::Update => "update",
            Self::Freeze => "freeze",
            Self::Hold => "hold",
        }
    }

    /// The answer that this word is, if it is one.
    pub fn of_word(word: &str) -> Option<Self> {
        Self::ALL.iter().copied().find(|answer| answer.word() == word)
    }

    /// The code of this answer: 0 is `update`.
    pub fn code(self) -> u8 {
        self as u8
    }
}

#[cfg(test)]
mod tests {
    use super::Answer;

    #[test]
    fn words_and_codes_are_one_to_one() {
        for (position, &answer) in Answer::ALL.iter().enumerate() {
            assert_eq!(usize::from(answer.code()), position);
            assert_eq!(Answer::of_word(answer.word()), Some(answer));
        }
        assert_eq!(Answer::of_word("close"), None);
    }
}
