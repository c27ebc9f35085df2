"""A formula of plain text as LaTeX."""

from __future__ import annotations

import re
import unicodedata

from .reader import Reader
from .symbols import ACCENTS, FUNCTIONS, RELATIONS


def formula(text: str) -> str:
    """The LaTeX of a formula.

    Raises
    ------
    ValueError
        For a sign without a translation, or a bracket that is not closed.

    Examples
    --------
    >>> print(formula("P̄ = P / λ"))
    \\bar{P} = P / \\lambda
    >>> print(formula("F_k = (1 − λ_k) R φ̄ᵀ (φ̄ R φ̄ᵀ)⁻¹"))
    F_{k} = (1 - \\lambda_{k}) R \\bar{\\varphi}^{\\mathsf{T}} (\\bar{\\varphi} R \\bar{\\varphi}^{\\mathsf{T}})^{-1}
    >>> print(formula("√(1 − λ) r, κ^(r/2)"))
    \\sqrt{1 - \\lambda} r, \\kappa^{r/2}
    """  # noqa: E501
    return Reader(_decomposed(text)).all()


def is_formula(text: str) -> bool:
    """Whether a text is a formula: a relation, with no words before it.

    Examples
    --------
    >>> is_formula("λ_k = 1 if g_k > 0, else 1"), is_formula("update if r_k > width")
    (True, False)
    """
    first = re.split(f"[{RELATIONS}]", text, maxsplit=1)
    if len(first) == 1:
        return False
    words = re.findall(r"[A-Za-z]{3,}", re.sub(r"_\w+", "", first[0]))
    return all(word in FUNCTIONS for word in words)


def _decomposed(text: str) -> str:
    """Letters with their accents as signs of their own; nothing else is taken apart."""
    parts = ((each, unicodedata.normalize("NFD", each)) for each in text)
    return "".join(apart if apart[1:] and apart[1] in ACCENTS else each for each, apart in parts)
