"""Formulas within a sentence.

A sentence is read word by word. A word with a sign that only mathematics has (a Greek letter, an
overbar, a script, a root) is part of a formula, and so is what hangs on it: operators, single
letters, numbers, and all up to a bracket that it leaves open. Code and emphasis stay as they are.
"""

from __future__ import annotations

import re
import unicodedata

from .formula import formula
from .symbols import ABOVE, ACCENTS, BELOW, FUNCTIONS, GREEK, RELATIONS

PROTECTED = re.compile(r"(`[^`]*`|\*\*?[^*\s][^*]*\*\*?|\[[^\]]*\]\([^)]*\)|\$[^$]*\$)")
STRONG = {*GREEK, *ABOVE, *BELOW, *ACCENTS, *"‖√∞½⌊"}
OPERATORS = {*RELATIONS, *"+−/·×|", "mod"}
INITIAL = re.compile(r"[A-Z]\. [A-Z]")
LABEL = re.compile(r"[a-z],?\)")
"""The initial of a name before the next, and the b) of a figure."""
LONE = re.compile(r"[b-zB-Z]|…|\d+(?:\.\d+)?(?:e[+-]?\d+)?|\d+[a-zA-Z]{1,2}|\d+/\w+|[a-zA-Z]/\d+")
"""What may be an operand without a sign of mathematics: a letter, a number, 2n, 1/k."""
APPLIED = ("tr", "ln")
"""Functions written without brackets."""
CALL = re.compile(rf"(?:{'|'.join(FUNCTIONS)}|O|f)\(")
SUBSCRIPTED = re.compile(r"[A-Za-z]_(?:\w|\{)")
SIZES = re.compile(r"(?<=\b[npm]) x (?=[npm]\b)")
ENDS = ".,;:"


def prose(text: str, names: tuple[str, ...] = ()) -> str:
    """The sentence with its formulas between dollar signs.

    Parameters
    ----------
    text : str
        Sentences in Markdown.
    names : tuple of str
        Names of parameters, which belong to a formula if an operator stands beside them.

    Examples
    --------
    >>> print(prose("P̄ is at least (1 − λ) P_∞, as ever; see `P_∞`."))
    $\\bar{P}$ is at least $(1 - \\lambda) P_{\\infty}$, as ever; see `P_∞`.
    >>> print(prose("by min(1/(β + 1/floor), 1) if n is small."))
    by $\\min(1/(\\beta + 1/\\text{floor}), 1)$ if $n$ is small.
    """
    parts = PROTECTED.split(SIZES.sub(" × ", text))
    return "".join(
        part if number % 2 else _sentence(part, names) for number, part in enumerate(parts)
    )


def _sentence(text: str, names: tuple[str, ...]) -> str:
    """One stretch of text without code."""
    out: list[str] = []
    run: list[str] = []
    parts = re.split(r"(\s+)", text)
    for at, word in enumerate(parts):
        if not word or word.isspace():
            (run if run else out).append(word)
        elif _belongs(word, run, names, "".join(parts[at + 2 : at + 3])):
            run.append(word)
            if word[-1] in ENDS and not _open(run):
                out += _finished(run)
                run = []
        else:
            out += [*_finished(run), word]
            run = []
    return "".join(out + _finished(run))


def _belongs(word: str, run: list[str], names: tuple[str, ...], following: str) -> bool:
    """Whether a word is part of the formula that is being read, or begins one."""
    if INITIAL.fullmatch(f"{word} {following[:1]}") or (LABEL.fullmatch(word) and not _open(run)):
        return False
    bare = word.strip(ENDS).lstrip("([{").rstrip(")]}") or word.strip(ENDS)
    if _open(run) or _strong(word) or bare in OPERATORS or CALL.match(word.lstrip("([")):
        return True
    operands = re.split(r"[+−/·×|=<>≤≥]", bare)
    if len(operands) > 1:
        return all(part in names or not re.search(r"[A-Za-z]{3}", part) for part in operands)
    if bare in (*names, "a", "A"):
        last = next((part for part in reversed(run) if not part.isspace()), "")
        return last in OPERATORS or (following in OPERATORS and word[-1] not in ENDS)
    return bare in APPLIED or bool(LONE.fullmatch(bare))


def _strong(word: str) -> bool:
    """Whether a word has a sign that only mathematics has."""
    return bool(SUBSCRIPTED.match(word.lstrip("([1/−"))) or any(
        sign in STRONG for sign in unicodedata.normalize("NFD", word)
    )


def _open(run: list[str]) -> bool:
    """Whether brackets of a formula are still open; one before it may be the sentence's."""
    text = "".join(run).strip().lstrip("(")
    opened, closed = (sum(map(text.count, brackets)) for brackets in ("([{", ")]}"))
    return opened > closed


def _finished(run: list[str]) -> list[str]:
    """The formula of a run, and around it what belongs to the sentence."""
    text = "".join(run)
    core = " ".join(text.split())
    if not core:
        return [text]
    before, core, after = _without_punctuation(core)
    space = text[len(text.rstrip()) :]
    if not _means(core):
        return [text]
    return [f"{before}${formula(core)}${after}{space}"]


def _without_punctuation(text: str) -> tuple[str, str, str]:
    """What stands before a formula, the formula, and what stands behind it."""
    before, after = "", ""
    while (
        text and text[-1] in ENDS + ")" and (text[-1] != ")" or text.count("(") < text.count(")"))
    ):
        text, after = text[:-1], text[-1] + after
    while text.startswith("(") and text.count("(") > text.count(")"):
        text, before = text[1:], before + "("
    return before, text, after


def _means(text: str) -> bool:
    """Whether a run is a formula: not a number, and not the "(62)" of an equation."""
    return bool(re.search(r"[^\W\d_]", text) or any(sign in RELATIONS for sign in text)) and (
        _strong(text) or bool(re.search(r"[A-Za-z]", text))
    )
