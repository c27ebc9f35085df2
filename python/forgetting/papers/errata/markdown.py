"""The errata as a page of the documentation."""

from __future__ import annotations

from . import gf, opd, vdf
from .erratum import Erratum

PAPERS = (
    (
        "Tutorial on variable-direction forgetting",
        "A. Goel, A. L. Bruce, D. S. Bernstein, *IEEE Control Systems Magazine* 40(4), 2020, "
        "arXiv 2003.03523.",
        vdf.ERRATA,
    ),
    (
        "Generalized forgetting recursive least squares",
        "B. Lai, D. S. Bernstein, arXiv 2308.04259.",
        gf.ERRATA,
    ),
    (
        "Variable-direction forgetting via oblique projection decomposition",
        "K. Zhu, C. Yu, Y. Wan, *IEEE/CAA Journal of Automatica Sinica* 9(3), 2022.",
        opd.ERRATA,
    ),
)
HEAD = """# Errata of the papers

Every entry was found by checking the papers against the code, and the line "Measured" was computed
when this page was built: it shows the printed form failing and the corrected one holding. Each is
also a test. *Error*: the statement is false. *Gap*: the proof does not prove it. *Slip*: a
misprint.

The printed forms are those of a transcription of the papers. Slips that a transcription could have
made by itself (a lost transpose, bar or tilde) are left out, as is the missing π in the arguments
of the parameters a₃ and b₃ of Zhu et al., which may be meant.
"""
WORDS = {"error": "Error", "gap": "Gap", "typo": "Slip"}


def page() -> str:
    """The whole page, measured now."""
    parts = [HEAD]
    for title, reference, errata in PAPERS:
        parts += [f"## {title}\n", f"{reference}\n", *(entry(each) for each in errata)]
    return "\n".join(parts)


def entry(each: Erratum) -> str:
    """One erratum."""
    words, confirmed = each()
    if not confirmed:
        raise ArithmeticError(f"{each.name} is not confirmed: {words}")
    lines = [
        f"### {each.name}: {each.where}\n",
        f"*{WORDS[each.kind]}.* {each.why}\n",
        f"- **Printed:** {escaped(each.printed)}",
        f"- **Corrected:** {escaped(each.corrected)}",
    ]
    if each.measure is not None:
        lines.append(f"- **Measured:** {escaped(words)}")
    return "\n".join(lines) + "\n"


def escaped(text: str) -> str:
    """Text that Markdown leaves as it is."""
    for mark in ("\\", "*", "_", "[", "]", "<", "|", "^"):
        text = text.replace(mark, f"\\{mark}")
    return text
