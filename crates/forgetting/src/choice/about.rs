//! What a registry says of its entries: the tests, every face and the documentation read it.

use super::guarantee::Guarantees;
use super::Parameter;
use crate::error::Error;
use forgetting_kernels::kernel::layout::COMPACT;

/// One line of a registry: what a choice is called, takes and guarantees.
#[derive(Clone, Copy, Debug)]
pub struct About {
    /// the registry name, which is also the name of the file
    pub name: &'static str,
    /// the name of the type
    pub type_name: &'static str,
    /// the header of the file with its comment marks (`//!`): the documentation
    pub source: &'static str,
    /// its own parameters
    pub parameters: &'static [Parameter],
    /// whether a forgetting factor, or a rate in its place, goes before them
    pub forgetting_factor: bool,
    /// the largest number of rows p that it takes, if there is one
    pub largest_rows: Option<usize>,
    /// operations per sample of a rule; empty where only the header says them
    pub cost: &'static str,
    /// how many n x n numbers it keeps, another rule's that it is around not counted
    pub squares: usize,
    /// what a rule guarantees; nothing where the choice does not forget
    pub guarantees: Option<Guarantees>,
}

impl About {
    /// A choice with these parameters and nothing else to say of it. The registry adds the
    /// names and the text, which are those of the file.
    pub const fn new(parameters: &'static [Parameter]) -> Self {
        Self {
            name: "",
            type_name: "",
            source: "",
            parameters,
            forgetting_factor: false,
            largest_rows: None,
            cost: "",
            squares: 0,
            guarantees: None,
        }
    }

    /// Refuses more rows than the choice takes.
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
        header(self.source)
    }

    /// The first sentence of the header.
    pub fn summary(&self) -> &'static str {
        self.header().next().unwrap_or("")
    }
}

/// A question that every estimator answers with one entry of a registry.
#[derive(Clone, Copy, Debug)]
pub struct Axis {
    /// what one entry is called, as in "a rule"
    pub name: &'static str,
    /// what several are called, which is also the name of the folder
    pub plural: &'static str,
    /// the header of the folder's `mod.rs`, which says what the axis is
    pub source: &'static str,
    /// the registry
    pub entries: &'static [About],
}

impl Axis {
    /// The lines of the header's first paragraph, which says what the axis is.
    pub fn summary(&self) -> impl Iterator<Item = &'static str> {
        header(self.source).take_while(|line| !line.is_empty())
    }

    /// The entry of this name.
    pub fn find(&self, name: &str) -> Option<&'static About> {
        self.entries.iter().find(|about| about.name == name)
    }
}

/// How long the comment (`//!`) is that a file begins with; where programs are to be small, its first
/// paragraph.
pub(crate) const fn header_length(file: &str) -> usize {
    let (text, mut end) = (file.as_bytes(), 0);
    while end + 3 <= text.len()
        && text[end] == b'/'
        && text[end + 1] == b'/'
        && text[end + 2] == b'!'
    {
        let start = end;
        while end < text.len() && text[end] != b'\n' {
            end += 1;
        }
        if COMPACT && end == start + 3 {
            return start;
        }
        if end < text.len() {
            end += 1;
        }
    }
    end
}

/// The first `LENGTH` bytes of a file.
pub(crate) const fn copy_of<const LENGTH: usize>(file: &str) -> [u8; LENGTH] {
    let (mut copy, mut at) = ([0; LENGTH], 0);
    while at < LENGTH {
        copy[at] = file.as_bytes()[at];
        at += 1;
    }
    copy
}

/// The text that these bytes are.
pub(crate) const fn text_of(bytes: &'static [u8]) -> &'static str {
    match core::str::from_utf8(bytes) {
        Ok(text) => text,
        Err(_) => "",
    }
}

/// The lines of a header, without their comment marks.
fn header(source: &'static str) -> impl Iterator<Item = &'static str> {
    source.lines().map(|line| line.trim_start_matches("//!").strip_prefix(' ').unwrap_or(""))
}

#[cfg(test)]
mod tests {
    use super::{copy_of, header_length};

    #[test]
    fn a_header_ends_where_the_comment_does() {
        let file = "//! One.\n//!\n//! Two: φ.\n\nuse x;\n//! no";
        assert_eq!(&file[..header_length(file)], "//! One.\n//!\n//! Two: φ.\n");
        assert_eq!(header_length("//! All"), 7);
        assert_eq!(header_length("// none"), 0);
        assert_eq!(header_length(""), 0);
        assert_eq!(copy_of::<4>(file), *b"//! ");
    }
}
