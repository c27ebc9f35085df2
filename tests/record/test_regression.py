"""Formula models: values, lags, gaps, categories and errors."""

from __future__ import annotations

import numpy as np
import pandas as pd
import pytest

import forgetting as fg
from forgetting.record import RecordError, identify, read
from forgetting.record.regression import regression

WEAK = 1e8
"""An initial covariance so large that the prior does not show at 1e-6."""


def samples(frame, formula):
    return regression(read(frame), formula)


def test_equals_batch_least_squares():
    rng = np.random.default_rng(1)
    frame = pd.DataFrame({"a": rng.normal(size=300), "b": rng.normal(size=300)})
    frame["y"] = 2.0 + 3.0 * frame.a - 0.5 * frame.a * frame.b + 0.1 * rng.normal(size=300)
    found = identify(frame, formula="y ~ a + a:b", rule="none", initial_covariance=WEAK)
    x = np.column_stack([np.ones(300), frame.a, frame.a * frame.b])
    expected = np.linalg.lstsq(x, frame.y.to_numpy(), rcond=None)[0]
    assert found.parameters["parameter"].tolist() == ["Intercept", "a", "a:b"]
    np.testing.assert_allclose(found.parameters["value"], expected, rtol=1e-6)


def test_lags():
    frame = pd.DataFrame({"x": [1.0, 2.0, 4.0, 8.0], "y": [0.0, 1.0, 2.0, 3.0]})
    built = samples(frame, "y ~ 0 + x + lag(x) + lag(y, 2)")
    nan = np.nan
    expected = [[1, nan, nan], [2, 1, nan], [4, 2, 0], [8, 4, 1]]
    np.testing.assert_array_equal(built.phi, expected)
    assert built.complete.tolist() == [False, False, True, True]


def test_a_lag_does_not_cross_a_gap_in_time():
    frame = pd.DataFrame({"time": [0.0, 1.0, 2.0, 9.0, 10.0], "x": [1.0, 2.0, 3.0, 4.0, 5.0]})
    built = samples(frame.assign(y=0.0), "y ~ 0 + lag(x)")
    np.testing.assert_array_equal(built.phi[:, 0], [np.nan, 1, 2, np.nan, 4])


def test_missing_cells_are_skipped_and_counted():
    frame = pd.DataFrame({"x": np.arange(20.0), "y": 2 * np.arange(20.0)})
    frame.loc[4, "x"] = np.nan
    frame.loc[9, "y"] = np.nan
    found = identify(frame, formula="y ~ 0 + x + lag(x)", rule="none")
    # Row 0 has no lag; row 4 misses x, row 5 its lag; row 9 misses y.
    assert (found.used, found.missing, found.dead_zone) == (16, 4, 0)
    assert np.isnan(found.trace.error[[0, 4, 5, 9], 0]).all()
    assert np.array_equal(found.theta[4], found.theta[3])


def test_several_outputs_share_the_regressor():
    rng = np.random.default_rng(2)
    frame = pd.DataFrame({"x": rng.normal(size=100)})
    frame["p"], frame["q"] = 2 * frame.x, -3 * frame.x
    both = identify(frame, formula="p + q ~ 0 + x")
    for name in ("p", "q"):
        alone = identify(frame, formula=f"{name} ~ 0 + x")
        column = both.samples.outputs.index(name)
        np.testing.assert_allclose(both.theta[:, :, column], alone.theta[:, :, 0], rtol=1e-12)


def test_categories_only_when_asked():
    frame = pd.DataFrame({"g": ["a", "b", "a", None], "y": [1.0, 2.0, 1.0, 5.0]})
    with pytest.raises(RecordError, match="column 'g' of record must hold numbers"):
        samples(frame, "y ~ g")
    built = samples(frame, "y ~ C(g)")
    assert built.complete.tolist() == [True, True, True, False]
    np.testing.assert_array_equal(built.phi[:3, 1], [0, 1, 0])


def test_methods_of_columns():
    frame = pd.DataFrame({"x": [-1.0, 2.0, 3.0], "y": [2.0, 4.0, 6.0]})
    np.testing.assert_array_equal(samples(frame, "y ~ 0 + x.clip(0)").phi[:, 0], [0, 2, 3])


@pytest.mark.parametrize("term", ["I((x + z).clip(0))", "I(np.where(z > 0, x + z, 0).clip(0))"])
def test_methods_of_expressions(term):
    frame = pd.DataFrame({"x": [-1.0, 2.0, 3.0], "z": [-4.0, 1.0, 2.0], "y": [2.0, 4.0, 6.0]})
    np.testing.assert_array_equal(samples(frame, f"y ~ 0 + {term}").phi[:, 0], [0, 3, 5])


def test_functions_of_columns_that_formulaic_provides():
    frame = pd.DataFrame({"x": [-1.0, 2.0, 5.0], "y": [2.0, 4.0, 6.0], "text": ["a", "b", "c"]})
    np.testing.assert_allclose(samples(frame, "y ~ 0 + center(x)").phi[:, 0], [-3, 0, 3])
    with pytest.raises(RecordError, match="column 'text' of record must hold numbers"):
        samples(frame, "y ~ 0 + center(text)")


def test_names_with_a_dot():
    frame = pd.DataFrame({"cell.1": [1.0, 2.0, 3.0], "y": [2.0, 4.0, 6.0]})
    lagged = samples(frame, "y ~ 0 + lag(`cell.1`)")
    np.testing.assert_array_equal(lagged.phi[:, 0], [np.nan, 1, 2])


def test_odd_names():
    frame = pd.DataFrame({"current [A]": [1.0, 2.0, 3.0], "y": [2.0, 4.0, 6.0]})
    np.testing.assert_array_equal(samples(frame, "y ~ 0 + `current [A]`").phi[:, 0], [1, 2, 3])
    lagged = samples(frame, "y ~ 0 + lag(`current [A]`) + np.log(`current [A]`)")
    np.testing.assert_array_equal(lagged.phi[:, 0], [np.nan, 1, 2])
    np.testing.assert_array_equal(lagged.phi[:, 1], np.log([1, 2, 3]))


def test_columns_named_like_functions():
    """Current is I everywhere; formulaic has functions I, C and Q."""
    frame = pd.DataFrame({"I": [1.0, 2.0, 3.0], "C": [2.0, 2.0, 4.0], "V": [2.0, 4.0, 6.0]})
    built = samples(frame, "V ~ 0 + I + lag(I) + I:C")
    np.testing.assert_array_equal(built.phi, [[1, np.nan, 2], [2, 1, 4], [3, 2, 12]])
    np.testing.assert_array_equal(samples(frame, "V ~ 0 + I(C**2)").phi[:, 0], [4, 4, 16])


@pytest.mark.parametrize(
    ("formula", "words"),
    [
        ("y", "must read: output ~ regressors"),
        ("~ x", "must read: output ~ regressors"),
        ("y ~", "must read: output ~ regressors|cannot be read"),
        ("y ~ 0", "must read: output ~ regressors"),
        ("y ~ (x", "cannot be read"),
        ("y ~ np.abs(x).clip(0)", "cannot be read"),
        ("y ~ wibble(x)", "calls 'wibble', an unknown function"),
        ("y ~ lag(z)", "no column 'z'"),
        ("y ~ x.nothing", "no column .x.nothing."),
        ("y ~ log(x)", r"regressor 'log\(x\)' is infinite in row 1"),
        ("log(x) ~ y", r"output 'log\(x\)' is infinite in row 1"),
        ("y ~ 0 + lag(x, 9)", "has no complete sample"),
    ],
)
def test_formulas_that_are_wrong(formula, words):
    frame = pd.DataFrame({"x": [0.0, 1.0, 2.0], "y": [1.0, 2.0, 3.0]})
    if formula == "y ~":
        found = identify(frame, formula=formula)
        assert found.samples.regressors == ("Intercept",)
        return
    with pytest.raises(RecordError, match=words):
        identify(frame, formula=formula)


def test_float32_is_float32():
    frame = pd.DataFrame({"x": np.linspace(1, 2, 50)})
    frame["y"] = 3 * frame.x
    settings = {"rule": "subspace", "dtype": "float32", "initial_covariance": 100.0}
    found = identify(frame, formula="y ~ 0 + x", **settings)
    estimator = fg.RLS(1, **settings)
    column = frame["x"].to_numpy(dtype=np.float32)[:, None]
    run = estimator.run(column, frame["y"].to_numpy(dtype=np.float32))
    assert np.array_equal(found.theta[:, :, 0].astype(np.float32), run.theta)
