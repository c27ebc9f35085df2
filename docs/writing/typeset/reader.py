"""Reads a formula of plain text from left to right and writes it as LaTeX."""

from __future__ import annotations

import re

from .symbols import (
    ABOVE,
    ACCENTS,
    BELOW,
    DIFFERENTIALS,
    FENCES,
    FUNCTIONS,
    GREEK,
    SIGNS,
)

SHORT = [name for name in FUNCTIONS if len(name) == 2]
WORD = r"(?:[A-Za-z]{3,}|(?:if|or|of|is|at|to|in|by|no|on|as|it|be)(?![A-Za-z]))"
PHRASE = re.compile(rf"{WORD}(?:[_ -](?:[a-z] )?{WORD})*|{'|'.join((*SHORT, *DIFFERENTIALS))}")
"""Words between symbols: "mean of", "forgetting_matrix", "all errors of a sample"."""
SUBSCRIPT = re.compile(r"[A-Za-z]{2,}|[^\W\d_]|\d+|∞")
BEHIND = re.compile(r"[^\s;=<>≤≥+−/(] $")
"""Where a word stands behind something that gives it no space by itself."""
SUM = re.compile(r"(?:_[bijk])?[^_]")
"""What stands behind a Σ that is a sum; Σ_n and Σ_d are matrices."""
POWER = re.compile(r"\d+(?:\.\d+)?e[+-]\d+")
FOLLOWING = re.compile(r",[A-Za-z](?![A-Za-z])|[+−]1(?!\d)")
"""What belongs to a subscript behind its first part: R_bb,k and P_k+1."""


class Reader:
    """Reads a formula from left to right."""

    def __init__(self, text: str) -> None:
        self.text, self.at = text, 0
        self.open = dict.fromkeys(FENCES, False)

    @property
    def next(self) -> str:
        """The sign that is read next; nothing at the end."""
        return self.text[self.at : self.at + 1]

    def take(self, pattern: re.Pattern[str]) -> str:
        """What matches here, read; nothing if it does not."""
        found = pattern.match(self.text, self.at)
        self.at = found.end() if found else self.at
        return found.group() if found else ""

    def all(self) -> str:
        """All of the formula."""
        made = []
        while self.next:
            made.append(self.piece())
        return "".join(made).strip()

    def piece(self) -> str:
        """The next piece, with what stands below and above it."""
        if self.next == " ":
            return self.space()
        number = self.take(POWER)
        if number:
            digits, _, power = number.partition("e")
            return rf"{digits}\cdot 10^{{{int(power)}}}"
        phrase = PHRASE.match(self.text, self.at)
        made = self.words(phrase.group()) if phrase else self.atom()
        return made + self.scripts()

    def space(self) -> str:
        """One space means nothing, several a new formula."""
        start = self.at
        while self.next == " ":
            self.at += 1
        return " " if self.at == start + 1 else r"\quad "

    def words(self, phrase: str) -> str:
        """Functions and differentials as such, other words as text with the spaces around them."""
        first = re.match(r"[A-Za-z]+", phrase).group()  # type: ignore[union-attr]
        known = FUNCTIONS.get(first) or DIFFERENTIALS.get(first)
        if known:
            self.at += len(first)
            return known + ("" if known.endswith("}") or self.next == "(" else " ")
        before = " " if BEHIND.search(self.text[: self.at]) else ""
        self.at += len(phrase)
        after = " " if self.next == " " else ""
        return rf"\text{{{before}{phrase}{after}}}".replace("_", r"\_")

    def atom(self) -> str:
        """One sign with its accents, a number, a root, a norm."""
        sign = self.next
        self.at += 1
        if sign == "√":
            return rf"\sqrt{{{self.group() or self.piece()}}}"
        if sign in FENCES:
            self.open[sign] = not self.open[sign]
            return FENCES[sign][0 if self.open[sign] else 1]
        if sign == "Σ" and SUM.match(self.text, self.at):
            return r"\sum "
        made = sign if sign.isascii() and sign.isalnum() else GREEK.get(sign) or SIGNS.get(sign)
        if sign in ABOVE or sign in BELOW:  # scripts without anything below them
            self.at -= 1
            return "{}"
        if made is None:
            raise ValueError(f"{sign!r} in {self.text!r} has no translation")
        while self.next in ACCENTS and self.next:
            made = rf"{ACCENTS[self.next]}{{{made}}}"
            self.at += 1
        followed = made[0] == "\\" and made[-1].isalpha() and self.next.isalpha()
        return made + " " if followed and self.next.isascii() else made

    def group(self, opening: str = "(", closing: str = ")") -> str:
        """The translated inside of the brackets that open here; nothing if none do."""
        if self.next != opening:
            return ""
        depth, end = 0, self.at
        for end in range(self.at, len(self.text)):
            depth += (self.text[end] == opening) - (self.text[end] == closing)
            if not depth:
                break
        if depth:
            raise ValueError(f"{opening!r} is not closed in {self.text!r}")
        inside = self.text[self.at + 1 : end]
        self.at = end + 1
        return Reader(inside).all()

    def scripts(self) -> str:
        """What stands below and above."""
        below, above, primes = [], [], ""
        while self.next and (self.next in "_^′" or self.next in ABOVE or self.next in BELOW):
            sign = self.next
            self.at += 1
            if sign == "_":
                below.append(self.group("{", "}") or self.group() or self.below())
            elif sign == "^":
                above.append(self.group("{", "}") or self.group() or self.above())
            elif sign == "′":
                primes += "'"
            else:
                (above if sign in ABOVE else below).append({**ABOVE, **BELOW}[sign])
        scripts = "".join(
            f"{mark}{{{''.join(part)}}}" for mark, part in (("_", below), ("^", above)) if part
        )
        return primes + scripts

    def below(self) -> str:
        """A subscript without brackets."""
        first = self.take(SUBSCRIPT)
        if not first:
            raise ValueError(f"nothing below '_' in {self.text!r}")
        made = Reader(first).all() if first in FUNCTIONS or len(first) == 1 else _upright(first)
        more = self.take(FOLLOWING)
        return made + (Reader(more).all() if more else "")

    def above(self) -> str:
        """An exponent without brackets."""
        return Reader(self.take(re.compile(r"[^\W_]+"))).all()


def _upright(letters: str) -> str:
    """Two letters are two indices, more are a word."""
    return letters if len(letters) < 3 or letters.isdigit() else rf"\text{{{letters}}}"
