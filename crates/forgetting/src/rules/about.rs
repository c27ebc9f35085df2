//! What the registry says of a rule.

use crate::parameter::Parameter;
use crate::Error;

/// Whether something is guaranteed.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Claim {
    /// for every input
    Always,
    /// under this condition
    If(&'static str),
    /// not in general
    No,
}

/// One line of the registry: what a rule is called, takes and guarantees.
#[derive(Clone, Copy, Debug)]
pub struct About {
    /// the registry name, which is also the name of the rule's file
    pub name: &'static str,
    /// the name of the rule's type
    pub type_name: &'static str,
    /// the text of the rule's file; its header (`//!`) is the rule's documentation
    pub source: &'static str,
    /// the rule's own parameters, beside the forgetting factor
    pub parameters: &'static [Parameter],
    /// whether the rule uses the forgetting factor
    pub forgetting_factor: bool,
    /// the largest number of rows p that the rule takes, if there is one
    pub largest_rows: Option<usize>,
    /// A1: F ≥ 0
    pub proper: Claim,
    /// A2: P̄ is bounded above, without any excitation
    pub bounded_above: Claim,
    /// A3: P is bounded below, for bounded regressors
    pub bounded_below: Claim,
    /// operations per sample
    pub cost: &'static str,
}

impl About {
    /// Refuses more rows than the rule takes.
    ///
    /// # Errors
    /// [`Error::Value`] names `rows`.
    pub fn check_rows(&self, rows: usize) -> Result<(), Error> {
        match self.largest_rows {
            Some(largest) if rows > largest => {
                Err(Error::value("rows", rows as f64, "1 with this rule; else `subspace`"))
            }
            _ => Ok(()),
        }
    }

    /// The lines of the header, without their comment marks.
    pub fn header(&self) -> impl Iterator<Item = &'static str> {
        self.source
            .lines()
            .take_while(|line| line.starts_with("//!"))
            .map(|line| line.trim_start_matches("//!").strip_prefix(' ').unwrap_or(""))
    }

    /// The first sentence of the header.
    pub fn summary(&self) -> &'static str {
        self.header().next().unwrap_or("")
    }
}
