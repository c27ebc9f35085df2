"""Tests of residuals: their formulas, how often they reject, and what they find."""

import numpy as np
import pytest
from scipy import stats
from scipy.signal import lfilter

import forgetting as fg
from forgetting.polynomials.residual_tests import across

from .systems import model, signals

RUNS = 300


def test_statistics_are_those_of_their_definitions():
    random = np.random.default_rng(0)
    u, e = random.normal(size=(2, 400))
    found = fg.PolynomialModel(B=[0.0], delay=0)
    tests = found.residual_tests(u, e, lags=6)
    r = [np.sum(e[lag:] * e[: 400 - lag]) / np.sum(e * e) for lag in range(7)]
    np.testing.assert_allclose(tests.autocorrelation, r[1:], atol=1e-12)
    q = np.cumsum([400 * 402 * r[lag] ** 2 / (400 - lag) for lag in range(1, 7)])
    np.testing.assert_allclose(tests.ljung_box, q, rtol=1e-9)
    np.testing.assert_allclose(tests.p_value, stats.chi2.sf(q, np.arange(1, 7)), rtol=1e-9)
    moved, size = u - u.mean(), np.sqrt(np.sum(e * e) * np.sum((u - u.mean()) ** 2))
    cross = [
        np.sum(e[max(lag, 0) : 400 + min(lag, 0)] * moved[max(-lag, 0) : 400 - max(lag, 0)])
        for lag in range(-6, 7)
    ]
    np.testing.assert_allclose(tests.cross_correlation[0], np.array(cross) / size, atol=1e-12)
    assert tests.cross_lags.tolist() == list(range(-6, 7))
    assert tests.band(0.95) == pytest.approx(1.96 / 20, rel=1e-3)


def test_parameters_that_were_fitted_take_degrees_of_freedom():
    found = model("ARX")
    u, _, y = signals(found, 500)
    fitted, fresh = (found.residual_tests(u, y, fitted=each) for each in (True, False))
    assert np.isnan(fitted.p_value[:2]).all() and np.isfinite(fresh.p_value).all()
    assert fitted.p_value[5] == pytest.approx(stats.chi2.sf(fitted.ljung_box[5], 4))


def test_right_models_are_rejected_as_often_as_they_should_be():
    """Least squares on records of the system itself."""
    rejected = []
    for seed in range(RUNS):
        random = np.random.default_rng(seed)
        u = random.normal(size=400)
        y = lfilter([0, 1, 0.5], [1, -1.5, 0.7], u) + lfilter(
            [1], [1, -1.5, 0.7], random.normal(size=400)
        )
        phi = np.column_stack([y[1:-1], y[:-2], u[1:-1], u[:-2]])
        a1, a2, *b = np.linalg.lstsq(phi, y[2:], rcond=None)[0]
        tests = fg.PolynomialModel([1, -a1, -a2], b).residual_tests(u, y)
        rejected.append([tests.p_value[-1] < 0.05, tests.input_p_value[0] < 0.05])
    white, independent = np.mean(rejected, axis=0)
    chance = 4 * np.sqrt(0.05 * 0.95 / RUNS)
    assert abs(white - 0.05) < chance
    assert independent < 0.05 + chance  # on the safe side, as the page says


def test_the_spread_of_cross_correlations_knows_both_spectra():
    random = np.random.default_rng(0)
    found, claimed = [], []
    for _ in range(RUNS):
        e = lfilter([1], [1, -0.8], random.normal(size=600))
        u = lfilter([1], [1, -0.9], random.normal(size=600))
        own = np.array([np.sum(e[lag:] * e[: 600 - lag]) for lag in range(41)])
        r, error = across(e, np.ones(600, bool), u, 40, own / own[0])
        found.append(r[40])
        claimed.append(error)
    assert np.mean(claimed) == pytest.approx(np.std(found), rel=0.2)
    assert np.std(found) > 2 / np.sqrt(600)  # were they white, it would be 1/√T


def test_noise_that_is_not_modelled_is_found():
    truth = fg.PolynomialModel([1, -0.8], [0.5], C=[1, 0.9])
    u, _, y = signals(truth, 2000)
    wrong = fg.PolynomialModel([1, -0.8], [0.5]).residual_tests(u, y)
    assert wrong.p_value[-1] < 1e-9 and wrong.input_p_value[0] > 1e-3
    assert wrong.judgement["residuals"].severity == "warning"
    assert abs(wrong.autocorrelation[0]) > wrong.band(0.99)
    right = truth.residual_tests(u, y)
    assert right.p_value[-1] > 1e-3 and right.judgement.severity == "good"


def test_dynamics_that_are_not_modelled_are_found_at_their_lag():
    truth = fg.PolynomialModel(B=[1.0, 0.0, 0.8], delay=1)
    u, _, y = signals(truth, 2000)
    wrong = fg.PolynomialModel(B=[1.0], delay=1).residual_tests(u, y)
    outside = np.abs(wrong.cross_correlation[0]) > wrong.cross_band(0.9999)[0]
    assert wrong.cross_lags[outside].tolist() == [3]
    assert wrong.input_p_value[0] < 1e-9 and wrong.judgement["inputs"].severity == "wrong"
    assert "u" in str(wrong)


def test_feedback_shows_at_negative_lags():
    random = np.random.default_rng(0)
    e, u, y = random.normal(size=3000), np.zeros(3000), np.zeros(3000)
    for k in range(1, 3000):
        y[k] = 0.5 * y[k - 1] + u[k - 1] + e[k]
        u[k] = -0.4 * y[k] + 0.5 * random.normal()
    tests = fg.PolynomialModel([1, -0.5], [1.0]).residual_tests(u, y)
    outside = np.abs(tests.cross_correlation[0]) > tests.cross_band(0.999)[0]
    assert outside[tests.cross_lags <= 0].any() and not outside[tests.cross_lags > 1].any()


def test_gaps_are_left_out():
    found = model("BJ")
    u, _, y = signals(found, 4000)
    y[::7] = np.nan
    tests = found.residual_tests(u, y)
    assert tests.samples < 4000 * 6 / 7
    assert (np.abs(tests.cross_correlation) < 2 * tests.cross_band(0.999)[:, None]).all()


def test_a_model_without_inputs_is_tested_for_whiteness():
    found = model("ARMA")
    _, _, y = signals(found, 1000)
    tests = found.residual_tests(None, y)
    assert tests.cross_correlation.shape == (0, 51) and tests.input_p_value.shape == (0,)
    assert tests.p_value[-1] > 1e-3


@pytest.mark.parametrize("lags", [0, -1, 2.5, 1000])
def test_lags_out_of_range_are_refused(lags):
    with pytest.raises(fg.InvalidInput, match="lags"):
        model("ARX").residual_tests(np.zeros(100), np.ones(100), lags)


def test_too_few_errors_are_refused():
    with pytest.raises(fg.InvalidInput, match="at least 4"):
        model("ARX").residual_tests(np.zeros(5), np.ones(5))


def test_errors_of_zero_and_inputs_that_stand_still_are_no_error():
    found = fg.PolynomialModel(B=[1.0], delay=0)
    tests = found.residual_tests(np.ones(100), np.ones(100))
    assert np.isfinite(tests.cross_correlation).all()
    assert np.isfinite(tests.autocorrelation).all()
