"""Mathematics of plain text as LaTeX.

The heads of the Rust files write formulas in Unicode (P̄ = P / λ), which a terminal shows and a
reader of the file understands. These pages show them typeset: `formula` translates one, `prose`
finds those in a sentence, `block` reads a block of formulas with their notes, `page` goes over a
page. A letter that has no translation is an error, so that nothing is shown half translated.
"""

from .block import block
from .formula import formula, is_formula
from .page import page
from .prose import prose

__all__ = ["block", "formula", "is_formula", "page", "prose"]
