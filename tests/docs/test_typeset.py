"""Formulas of the heads become LaTeX, all of them, and KaTeX can set every one."""

from __future__ import annotations

import json
import re
import shutil
import subprocess

import pytest
from writing.header import parsed
from writing.typeset import block, formula, is_formula, prose
from writing.typeset.symbols import ABOVE, ACCENTS, BELOW, GREEK

from .conftest import ROOT
from .heads import heads

HEADS = heads()
MATHEMATICS = {*GREEK, *ABOVE, *BELOW, *ACCENTS, *"‖√∞≤≥←∝⌊∈"} - set("²³")
"""Signs that have no place outside a formula."""
INTERVAL = re.compile(r"[(\[][^()\[\]]*, ∞\)")


def shown(name: str) -> list[str]:
    """All Markdown that is made of a head."""
    text, names = HEADS[name]
    head = parsed(text)
    items = [*head.use, *head.not_use, *head.guarantees, *head.cost, *head.notes]
    sentences = [head.summary, *items, *head.paragraphs]
    symbols = [f"${formula(symbol)}$" for symbol in head.symbols.values() if symbol]
    return [block(head.equations, names), *symbols, *(prose(each, names) for each in sentences)]


def formulas(markdown: str) -> list[str]:
    """What stands between dollar signs."""
    return re.findall(r"\$([^$]*)\$", markdown)


@pytest.mark.parametrize("name", HEADS)
def test_no_formula_is_left_as_plain_text(name):
    for markdown in shown(name):
        outside = re.sub(r"\$[^$]*\$|`[^`]*`", "", markdown)
        outside = INTERVAL.sub("", outside)
        left = MATHEMATICS & set(outside)
        assert not left, f"{left} in {outside!r}"


@pytest.mark.parametrize("name", HEADS)
def test_what_is_typeset_is_ascii_but_for_words(name):
    for made in (each for markdown in shown(name) for each in formulas(markdown)):
        assert re.sub(r"\\text\{[^}]*\}", "", made).isascii(), made
        assert made.count("{") == made.count("}"), made


@pytest.mark.skipif(shutil.which("node") is None, reason="needs node, to run KaTeX")
def test_katex_sets_every_formula():
    every = [each for name in HEADS for markdown in shown(name) for each in formulas(markdown)]
    assert len(every) > 500
    script = (
        f"const katex = require({str(ROOT / 'docs/_static/katex/katex.min.js')!r});"
        "const all = JSON.parse(require('fs').readFileSync(0, 'utf8'));"
        "for (const each of all) katex.renderToString(each, {throwOnError: true, strict: 'error'});"
    )
    done = subprocess.run(
        ["node", "-e", script], input=json.dumps(every), capture_output=True, text=True, timeout=60
    )
    assert done.returncode == 0, done.stderr


@pytest.mark.parametrize(
    ("plain", "latex"),
    [
        ("θ₊ = θ", r"\theta_{+} = \theta"),
        ("λ_kʳ⁻¹⁻ʲ", r"\lambda_{k}^{r-1-j}"),
        ("D^(−1/2) U⁻¹", r"D^{-1/2} U^{-1}"),
        ("P_{k+1}⁻¹", r"P_{k+1}^{-1}"),
        ("P_k+1", r"P_{k+1}"),
        ("R_bb,k", r"R_{bb,k}"),
        ("ē", r"\bar{e}"),
        ("√λ x", r"\sqrt{\lambda} x"),
        ("‖φ̄‖²", r"\lVert \bar{\varphi}\rVert ^{2}"),
        ("Σ_i c_i²", r"\sum _{i} c_{i}^{2}"),
        ("Σ_n", r"\Sigma_{n}"),
        ("4bd", "4bd"),
        ("max(0, x)", r"\max(0, x)"),
        ("g > 0, else 1", r"g > 0, \text{ else } 1"),
    ],
)
def test_formula(plain, latex):
    assert formula(plain) == latex


@pytest.mark.parametrize("plain", ["x ☃ y", "√(1 − λ", "a_ b"])
def test_what_cannot_be_translated_is_an_error(plain):
    with pytest.raises(ValueError, match=r"translation|closed|below"):
        formula(plain)


def test_words_are_not_taken_for_formulas():
    text = "A sample (62) of a record, 10 at a time: see `P̄`, *θ* and A1."
    assert prose(text) == text
    assert not is_formula("update if r_k > width")


def test_a_note_goes_on_below_itself():
    lines = ["F = 0        the first words", "             go on here", "R̄ = R       other words"]
    made = block(lines)
    assert "the first words go on here" in made
    assert made.count("* - $") == 2
