"""Formulas: whatever they say, they are evaluated or refused with one line."""

from __future__ import annotations

import numpy as np
import pandas as pd
from hypothesis import strategies as st

from forgetting.record import read
from forgetting.record.formula import COUNTED, METHODS, NUMPY
from forgetting.record.regression import regression

from .target import fuzz

COLUMNS = ("a", "b", "y", "g", "I", "`a b`", "time", "np", "nothing")
SIGNS = (
    "+", "-", "*", "/", ":", "**", "^", "~", "|", "(", ")", "{", "}", "[", "]", ",", ".", "%in%",
    "`", "'", '"', " ", "\n", "\x00", "\\", "==", "<", "if", "else", "lambda", "for", "%", "@",
    "0", "1", "2", "-1", "1e400", "10**9", "100000", "1j", "None", "True", "=", "#", "é", "∞",
)  # fmt: skip
CALLS = ("lag", "C", "I", "Q", "log", "exp", "center", "scale", "round", "min", "sum", *COUNTED)


def terms() -> st.SearchStrategy[str]:
    """Terms that mostly mean something, built upon each other."""
    leaf = st.one_of(st.sampled_from(COLUMNS), st.integers(-3, 2000).map(str), st.floats().map(str))
    functions = st.one_of(
        st.sampled_from(CALLS), st.sampled_from(sorted(NUMPY)).map(lambda name: f"np.{name}")
    )

    def larger(inner: st.SearchStrategy[str]) -> st.SearchStrategy[str]:
        return st.one_of(
            st.tuples(inner, st.sampled_from(SIGNS[:7]), inner).map(" ".join),
            st.tuples(functions, inner).map(lambda part: f"{part[0]}({part[1]})"),
            st.tuples(functions, inner, inner).map(lambda part: "{}({}, {})".format(*part)),
            st.tuples(inner, st.sampled_from(sorted(METHODS)), inner).map(
                lambda part: "{}.{}({})".format(*part)
            ),
            inner.map(lambda part: f"({part})"),
            inner.map(lambda part: "{" + part + "}"),
            st.tuples(inner, inner).map(lambda part: "{}[{}]".format(*part)),
        )

    return st.recursive(leaf, larger, max_leaves=8)


def formulas() -> st.SearchStrategy[str]:
    """Formulas that mean something, tokens in any order, and text."""
    tokens = st.sampled_from((*SIGNS, *COLUMNS, *CALLS))
    heap = st.lists(tokens, max_size=12).map("".join)
    right = st.one_of(terms(), terms(), heap, st.text(max_size=20))
    return st.one_of(right.map(lambda right: f"y ~ {right}"), st.tuples(right, right).map("~".join))


def test_formula() -> None:
    frame = pd.DataFrame(
        {
            "time": np.arange(6.0),
            "a": [1.0, 2, 3, 4, 5, np.nan],
            "b": [2.0, 1, 5, 3, 2, 0],
            "a b": [1.0, 2, 3, 4, 4, 4],
            "y": [1.0, 3, 2, 5, 4, 4],
            "I": [0.0, 0, 0, 0, 0, 0],
            "g": ["u", "v", "u", "v", "u", "w"],
        }
    )
    record = read(frame)

    def check(formula: str) -> None:
        samples = regression(record, formula)
        assert len(samples.phi) == len(samples.y) == len(frame)
        assert not np.isinf(samples.phi).any() and not np.isinf(samples.y).any()

    fuzz("formula", 150, formulas(), check)
