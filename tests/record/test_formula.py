"""Formulas: one sentence for whatever is wrong, quickly, and nothing that opens or executes."""

from __future__ import annotations

import random
import time

import pandas as pd
import pytest

from forgetting.record import RecordError, read
from forgetting.record.regression import regression

QUICK = 5.0
"""Seconds; each of these took minutes or for ever before it was refused."""


@pytest.fixture(scope="module")
def record():
    return read(
        pd.DataFrame(
            {
                "a": [1.0, 2, 3, 4, 5],
                "b": [2.0, 1, 5, 3, 2],
                "a b": [1.0, 2, 3, 4, 4],
                "y": [1.0, 3, 2, 5, 4],
                "g": ["u", "v", "u", "v", "u"],
            }
        )
    )


@pytest.mark.parametrize(
    "formula",
    [
        "y ~ {a/}", "y ~ {'s'}", "y ~ ( ] \\", "y ~ `a", "y ~ 'x'", "y ~ \"", "~", "~~",
        "y ~ a ~ b", "", "y ~ a | b", "y ~ .", "y ~ {np}", "y ~ \x00", "y ~ {1/0}", "y ~ lag()",
        "y ~ lag(a, 'x')", "y ~ {-'a'}", "y ~ {a[a > 2]}", "y ~ {float('inf')}", "y ~ {min([])}",
        "y ~ {1j * a}", "y ~ 0.5.abs(a)", "y ~ {18**246}",
    ],
)  # fmt: skip
def test_malformed(record, formula):
    with pytest.raises(RecordError) as caught:
        regression(record, formula)
    assert "\n" not in str(caught.value) and "<unknown>" not in str(caught.value)


@pytest.mark.parametrize(
    ("formula", "words"),
    [
        ("y ~ " + "(" * 5000 + "a" + ")" * 5000, "brackets deep"),
        ("y ~ {" + "-" * 5000 + "a}", "cannot be"),
        ("y ~ {" + "a+" * 5000 + "a}", "cannot be|too"),
        ("y ~ (a+b)**30", "more than 10000 terms"),
        ("y ~ 10**910**9100000", "more than 10000 terms"),
        ("y ~ (a+b+g)^3000000", "more than 10000 terms"),
        ("y ~ " + "*".join(f"lag(a, {k})" for k in range(30)), "more than 10000 terms"),
        ("y ~ I(a**10**10**10)", "power of numbers that is too large"),
        ("y ~ I(2**-10**10**10)", "power of numbers that is too large"),
        ("y ~ {pow(10, 10**10)}", "calls 'pow', an unknown function"),
        ("y ~ {round(a, 10**9)}", "too large"),
        ("y ~ poly(a, 100000000)", "too large"),
        ("y ~ bs(a, df=10**9)", "too large"),
        ("y ~ {'a' * 10**9}", "computes with text or lists"),
        ("y ~ {[0] * 10**9}", "computes with text or lists"),
        ("y ~ {sum(range(10**9))}", "calls 'range', an unknown function"),
    ],
)
def test_what_would_never_end_is_refused_quickly(record, formula, words):
    start = time.monotonic()
    with pytest.raises(RecordError, match=words) as caught:
        regression(record, formula)
    assert time.monotonic() - start < QUICK and len(str(caught.value)) < 600


@pytest.mark.parametrize(
    "formula",
    [
        "y ~ a:open('{path}', 'w')",
        "y ~ {{open('{path}', 'w')}}",
        "open('{path}', 'w') ~ a",
        "y ~ {{exec('1')}}",
        "y ~ {{eval('1')}}",
        "y ~ {{__import__('os').system('touch {path}')}}",
        "y ~ {{a.to_csv('{path}')}}",
        "y ~ {{a.pipe(print)}}",
        "y ~ np.save('{path}', a)",
        "y ~ np.load('{path}')",
        "y ~ {{a.__class__}}",
        "y ~ {{(lambda: 1)()}}",
        "y ~ {{[open for open in a]}}",
        "y ~ {{[open][0]('{path}', 'w')}}",
        "y ~ {{getattr(a, 'to_csv')('{path}')}}",
        "y ~ {{f'{{a}}'}}",
        "y ~ {{'{{0.__class__}}'.format(a)}}",
        "y ~ {{np.vectorize(print)(a)}}",
    ],
)
def test_nothing_opens_or_executes(record, formula, tmp_path):
    path = tmp_path / "made"
    with pytest.raises(RecordError):
        regression(record, formula.format(path=path))
    assert not path.exists()


@pytest.mark.parametrize(
    "formula",
    [
        "y ~ log(a) + np.sqrt(b) + abs(a - b)", "y ~ lag(`a b`) + np.log(`a b`)", "y ~ a*b - a:b",
        "y ~ poly(a, 2)", "y ~ bs(a, df=4)", "y ~ C(g, contr.sum)", "y ~ scale(a) + center(b)",
        "y ~ I(a**2) + I(2**a)", "y ~ {a > 2}", "y ~ (a + b + `a b`)**2", "log(y) ~ a.clip(0, 3)",
        "y ~ I(a.rolling(2).mean())", "y ~ np.where(a > 2, a, b)", "y ~ C(g, levels=['v', 'u'])",
        "y ~ {a if True else b}", "y ~ round(a, 2)", "y ~ I(a * 1e-3)",
    ],
)  # fmt: skip
def test_what_models_need(record, formula):
    assert regression(record, formula).phi.shape[0] == 5


def test_a_thousand_regressors_are_no_deep_formula():
    frame = pd.DataFrame({f"x{k}": [1.0 * k, 2, 3] for k in range(1000)}).assign(y=1.0)
    formula = "y ~ 0 + " + " + ".join(f"x{k}" for k in range(1000))
    assert regression(read(frame), formula).phi.shape == (3, 1000)


PIECES = (
    "a b y g ~ + - * / : ** ^ ( ) [ ] { } | 0 1 2 lag np.log C I Q poly , 's' \" \\ ` . $ %in% log "
    "a.b 1e3 == < = None lambda if else for in @ ! é _ __ ; # &"
)


def test_random_formulas_end_in_a_sentence_or_a_model(record):
    rng, pieces = random.Random(5), [*PIECES.split(), "`a b`", " ", "\n", "\t"]
    models = 0
    for _ in range(2000):
        start = "y ~ " if rng.random() < 0.7 else ""
        body = rng.choice(["", " "]).join(rng.choice(pieces) for _ in range(rng.randint(1, 9)))
        try:
            regression(record, start + body)
            models += 1
        except RecordError:
            pass
    assert models > 10
