"""Free runs, predictions and residuals beside the difference equations written out."""

import numpy as np
import pandas as pd
import pytest
from scipy.signal import lfilter

import forgetting as fg

from .systems import SYSTEMS, model, outputs, signals

ROUNDING = 1e-9
"""Of a few hundred samples; the filters and the loops sum in another order."""
names = pytest.mark.parametrize("name", SYSTEMS)


def u_of(found, u):
    return u if found.structure.inputs else None


@names
def test_free_run_is_the_difference_equation(name):
    found = model(name)
    u, _, _ = signals(found, 200)
    wanted = outputs(found, u, np.zeros(200))
    given = u if found.structure.inputs else 200
    np.testing.assert_allclose(found.simulate(given), wanted, atol=ROUNDING)


@names
def test_residuals_are_the_noise_that_was_put_in(name):
    found = model(name)
    u, e, y = signals(found, 600)
    # the first ones are shared out between the noise and the unknown initial state
    np.testing.assert_allclose(found.residuals(u_of(found, u), y)[200:], e[200:], atol=1e-7)


@names
@pytest.mark.parametrize("steps", [1, 2, 7])
def test_prediction_is_the_model_run_on_from_the_last_known_output(name, steps):
    found = model(name)
    u, _, y = signals(found, 400)
    predicted = found.predict(u_of(found, u), y, steps)
    for k in (250, 399):
        known = np.where(np.arange(400) <= k - steps, y, np.nan)
        run, _ = outputs(found, u, np.zeros(400), known)
        assert predicted[k] == pytest.approx(run[k], abs=1e-7)


@names
def test_the_model_stands_in_where_outputs_are_missing(name):
    found = model(name)
    u, _, y = signals(found, 600)
    known = y.copy()
    known[[5, 100, 101, 102, 300, 599]] = np.nan
    run, errors = outputs(found, u, np.zeros(600), known)
    residuals = found.residuals(u_of(found, u), known)
    np.testing.assert_array_equal(np.isnan(residuals), np.isnan(known))
    there = ~np.isnan(known)
    there[:250] = False
    np.testing.assert_allclose(residuals[there], errors[there], atol=1e-7)
    predicted = found.predict(u_of(found, u), known)
    assert predicted[599] == pytest.approx(run[599], abs=1e-7)


@names
def test_the_initial_state_is_found(name):
    found = model(name)
    u, _, y = signals(found, 500, noise=0.0)
    later, after = u[300:], y[300:]
    np.testing.assert_allclose(found.predict(u_of(found, later), after), after, atol=1e-8)
    if name in ("ARMA", "static"):
        return
    np.testing.assert_allclose(found.simulate(later, after[:20]), after, atol=1e-8)
    assert found.fit_percent(later, after) == pytest.approx(100, abs=1e-6)


def test_longer_horizons_explain_less():
    found = model("ARMAX")
    u, _, y = signals(found, 3000, noise=1.0)
    fits = [found.fit_percent(u, y, steps) for steps in (1, 2, 5, 20, None)]
    assert fits == sorted(fits, reverse=True) and fits[-2] == pytest.approx(fits[-1], abs=0.1)


def test_errors_of_a_horizon_have_the_variance_of_the_theory():
    found = model("ARMA")
    y = lfilter(found.C, found.A, np.random.default_rng(0).normal(size=50_000))
    shocks = outputs(found, np.zeros((3, 0)), np.eye(1, 3)[0])
    for steps in (1, 2, 3):
        error = (y - found.predict(None, y, steps))[100:]
        assert np.var(error) == pytest.approx((shocks[:steps] ** 2).sum(), rel=0.03)


def test_fit_is_that_of_the_mean_and_of_nothing():
    found = fg.PolynomialModel(B=[0.0], delay=0, offset=2.0)
    y = np.array([1.0, 3.0, 1.0, 3.0])
    assert found.fit_percent(np.zeros(4), y, 1) == pytest.approx(0.0)
    assert np.isnan(found.fit_percent(np.zeros(4), np.full(4, 5.0), 1))
    assert np.isnan(found.fit_percent(np.zeros(4), np.full(4, np.nan), 1))


def test_frames_keep_their_index():
    found = model("ARX")
    days = pd.date_range("2024-01-01", periods=50)
    u, _, y = signals(found, 50)
    series = pd.Series(y, index=days, name="y")
    predicted = found.predict(pd.DataFrame(u, index=days), series)
    assert predicted.index.equals(days) and predicted.name == "y"
    np.testing.assert_array_equal(predicted.to_numpy(), found.predict(u, y))
    assert found.simulate(pd.Series(u[:, 0], index=days)).index.equals(days)


@pytest.mark.parametrize("polynomial", [{"C": [1, -1.2]}, {"F": [1, -1.0], "B": [1.0]}])
def test_an_unstable_predictor_is_refused(polynomial):
    found = fg.PolynomialModel(**{"B": [1.0], **polynomial})
    with pytest.raises(fg.InvalidInput, match="root of modulus 1"):
        found.predict(np.zeros(9), np.zeros(9))


@pytest.mark.parametrize(
    ("u", "y", "words"),
    [
        (np.zeros((5, 2)), np.zeros(5), "2 channels, allowed: 1"),
        (None, np.zeros(5), "0 channels, allowed: 1"),
        (np.zeros(5), np.zeros((5, 2)), "y has 2 columns"),
        (np.zeros(5), np.zeros(4), "u has 5 rows and y has 4"),
        ([0, np.nan], [0, 0], "u is missing in row 1"),
        ([0, 1], [0, np.inf], "y is infinite in row 1"),
        ([], [], "y has no rows"),
    ],
)
def test_data_that_do_not_fit_are_refused(u, y, words):
    with pytest.raises(fg.InvalidInput, match=words):
        model("ARX").predict(u, y)


@pytest.mark.parametrize("steps", [0, -1, 1.5])
def test_steps_out_of_range_are_refused(steps):
    with pytest.raises(fg.InvalidInput, match="steps"):
        model("ARX").predict(np.zeros(5), np.zeros(5), steps)


def test_short_and_unknown_records_give_an_answer():
    found = model("all")
    assert found.predict(np.zeros((1, 2)), [1.0]) == pytest.approx([1.0])
    nothing = found.predict(np.ones((30, 2)), np.full(30, np.nan))
    assert np.isfinite(nothing).all()


def test_an_unstable_system_is_predicted_all_the_same():
    found = fg.PolynomialModel([1, -1.05], [1.0])
    u, e, y = signals(found, 200)
    np.testing.assert_allclose(found.residuals(u, y)[1:], e[1:], atol=1e-6)


def test_a_free_run_of_an_unstable_model_grows_and_says_so():
    found = fg.PolynomialModel([1, -1.5], [1.0])
    u = np.random.default_rng(0).normal(size=(4000, 1))
    grown = found.simulate(u)
    assert not np.isfinite(grown[-1])
    assert found.fit_percent(u, u[:, 0]) == -np.inf
    few = outputs(found, u[:30], np.zeros(30))
    np.testing.assert_allclose(found.simulate(u[:30], few[:5]), few, rtol=1e-9)


def test_a_free_run_without_a_level_of_rest_starts_at_zero():
    counter = fg.PolynomialModel([1, -1.0], [1.0], offset=0.5)
    np.testing.assert_allclose(counter.simulate(np.zeros(4)), [0.5, 1.0, 1.5, 2.0])


@pytest.mark.parametrize("u", [5, -5, [], "x", [1.0, np.nan], [[1.0, 2.0]]])
def test_a_free_run_of_what_are_no_inputs_is_refused(u):
    with pytest.raises(fg.InvalidInput, match=r"^u "):
        model("ARX").simulate(u)
