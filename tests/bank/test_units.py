"""Without an initial covariance no prediction depends on the units of the columns."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

import forgetting as fg

RULES = [
    entry["name"]
    for entry in fg.rules()
    if not any(parameter["required"] for parameter in entry["parameters"])
]
# what each header says is in units of y
IN_UNITS_OF_Y = {"data_dependent"}


def record(
    samples: int = 400, n: int = 4, seed: int = 0, first: float | None = None
) -> tuple[np.ndarray, np.ndarray]:
    """Regressors of different sizes, one silent at first, one in the middle; drifting parameters.

    With `first`, the silent one has spoken all along, and is `first` times larger at the start.
    """
    random = np.random.default_rng(seed)
    phi = random.normal(size=(samples, n)) * [1.0, 20.0, 0.3, 1.0]
    if first is None:
        phi[:37, 1] = 0.0
    else:
        phi[0, 1] *= first
    phi[150:250, 2] = 0.0
    phi[:, 3] = 1.0
    theta = np.cumsum(0.02 * random.normal(size=(samples, n)), axis=0)
    return phi, (phi * theta).sum(axis=1) + 0.1 * random.normal(size=samples)


def moved(one: np.ndarray, other: np.ndarray) -> float:
    """The largest difference, relative to the root mean square of the errors."""
    return float(np.abs(one - other).max() / np.sqrt(np.mean(one**2)))


def errors(estimator: object, phi: np.ndarray, y: np.ndarray) -> np.ndarray:
    return np.asarray(estimator.run(phi, y, outputs=("error",)).error).reshape(-1)  # type: ignore[attr-defined]


@pytest.mark.parametrize("name", RULES)
def test_units_of_regressors_change_no_prediction(name):
    phi, y = record()
    plain = errors(fg.RLS(4, rule=name), phi, y)
    for units in ([1e6, 1e-6, 1e3, 10.0], [1e-4, 1e5, 1.0, 1e-6]):
        assert moved(plain, errors(fg.RLS(4, rule=name), phi * units, y)) < 1e-6


@pytest.mark.parametrize("name", sorted(set(RULES) - IN_UNITS_OF_Y))
def test_units_of_the_output_change_no_prediction(name):
    phi, y = record()
    plain = errors(fg.RLS(4, rule=name), phi, y)
    assert moved(plain, errors(fg.RLS(4, rule=name), phi, 1e6 * y) / 1e6) < 1e-6


def test_units_change_no_prediction_of_a_bank():
    phi, y = record()
    plain = errors(fg.Bank(4), phi, y)
    other = errors(fg.Bank(4), phi * [1e6, 1e-6, 1e3, 10.0], 1e-5 * y) * 1e5
    assert moved(plain, other) < 1e-6


@pytest.mark.parametrize("name", RULES)
def test_parameters_and_covariance_are_in_the_units_of_the_user(name):
    phi, y = record()
    units = np.array([1e3, 1e-2, 10.0, 1e-3])
    one, other = fg.RLS(4, rule=name), fg.RLS(4, rule=name)
    outputs = ("theta", "variance", "covariance", "prior_covariance")
    run = one.run(phi, y, outputs=outputs)
    scaled = other.run(phi * units, y, outputs=outputs)
    both = np.outer(units, units)
    for found, wanted in (
        # from where every regressor has been other than 0
        (scaled.theta[40:] * units, run.theta[40:]),
        (scaled.variance[40:] * units**2, run.variance[40:]),
        (scaled.covariance[40:] * both, run.covariance[40:]),
        (scaled.prior_covariance[40:] * both, run.prior_covariance[40:]),
        (other.covariance * both, one.covariance),
        (other.units / units, one.units),
    ):
        np.testing.assert_allclose(found, wanted, rtol=1e-5, atol=1e-9)
    unit, diagonal = other.factor()
    np.testing.assert_allclose(unit * diagonal @ unit.T, other.covariance, rtol=1e-9)


def test_units_are_typical_sizes_renewed_at_doublings():
    phi, y = record(samples=100)
    est = fg.RLS(4)
    assert est.units.tolist() == [1.0] * 4
    for k in range(100):
        est.update(phi[k], y[k])
        if k + 1 in (8, 16, 32, 64):
            seen = phi[: k + 1]
            counts = np.maximum((seen != 0).sum(axis=0), 1)
            wanted = (np.sqrt(np.abs(seen)).sum(axis=0) / counts) ** 2
            spoken = (seen != 0).any(axis=0)
            np.testing.assert_allclose(est.units[spoken], wanted[spoken], rtol=1e-12)


def test_a_sample_that_is_refused_changes_nothing():
    est = fg.RLS(2, initial_theta=[1.0, 2.0])
    fresh = est.to_bytes()
    for phi, y in (([np.nan, 1.0], 0.0), ([1.0, np.inf], 0.0), ([3.0, 2.0], np.nan)):
        with pytest.raises(fg.InvalidInput):
            est.update(phi, y)
        assert est.to_bytes() == fresh
    with pytest.raises(fg.InvalidInput, match=r"phi\[1\]"):
        est.update([1.0, np.nan], 0.0)
    assert est.theta.tolist() == [1.0, 2.0]


def test_the_first_estimate_is_that_which_was_given():
    est = fg.RLS(2, initial_theta=[1.0, 2.0])
    assert est.update([100.0, 0.0], 100.0).error == pytest.approx(0.0, abs=1e-12)
    assert est.update([0.0, 1e-3], 2e-3).error == pytest.approx(0.0, abs=1e-15)
    np.testing.assert_allclose(est.theta, [1.0, 2.0], rtol=1e-12)


@pytest.mark.parametrize("dtype", ["float64", "float32"])
def test_a_first_value_that_is_not_typical_is_harmless(dtype):
    plain = errors(fg.RLS(4, dtype=dtype), *record(seed=3, first=1.0))
    for first in (1e-3, 100.0):
        late = errors(fg.RLS(4, dtype=dtype), *record(seed=3, first=first))[100:]
        assert np.sqrt(np.mean(late**2)) < 1.1 * np.sqrt(np.mean(plain[100:] ** 2))


@pytest.mark.parametrize("name", RULES)
def test_saved_in_the_middle(name):
    phi, y = record()
    whole, first = fg.RLS(4, rule=name, monitor=True), fg.RLS(4, rule=name, monitor=True)
    run = whole.run(phi, y)
    first.run(phi[:137], y[:137])
    second = fg.RLS.from_bytes(first.to_bytes())
    assert np.array_equal(second.run(phi[137:], y[137:]).error, run.error[137:])
    assert second.to_bytes() == whole.to_bytes()


def bank(n: int, rule: fg.Rule | None = None, **choices: Any) -> fg.Bank:
    return fg.Bank(n, members=rule and [rule], **choices)


WEIGHTINGS = [entry["name"] for entry in fg.weightings()]
RATES = [
    rate
    for rate in fg.Rate.__subclasses__()
    if rate is not fg.Function  # asks for a function
]
CHOICES: list[dict[str, Any]] = [
    *({"rule": fg.Exponential(rate())} for rate in RATES),
    *({"weighting": name} for name in WEIGHTINGS),
    {"gate": "dead_zone"},
    {"gate": fg.DeadZone(1.0, otherwise="freeze"), "weighting": "huber"},
]


@pytest.mark.parametrize("choice", CHOICES, ids=str)
@pytest.mark.parametrize("make", [fg.RLS, bank])
def test_units_change_no_prediction_of_a_rate_a_weighting_or_a_gate(make, choice):
    phi, y = record()
    plain = errors(make(4, **choice), phi, y)
    other = errors(make(4, **choice), phi * [1e6, 1e-6, 1e3, 10.0], 1e6 * y) / 1e6
    assert moved(plain, other) < 1e-6
    assert moved(plain, errors(make(4, **choice), phi, 1e-5 * y) * 1e5) < 1e-6


@pytest.mark.parametrize("make", [fg.RLS, fg.Bank])
def test_units_change_no_prediction_where_gamma_is_given(make):
    phi, y = record()
    noise = 0.01 * (1 + np.arange(len(y)) % 3)

    def predicted(units: Any, unit_of_y: float) -> np.ndarray:
        est = make(4)
        samples = zip(phi * units, y * unit_of_y, noise * unit_of_y**2, strict=True)
        return np.array([est.update(p, v, gamma=g).error for p, v, g in samples]) / unit_of_y

    plain = predicted(1.0, 1.0)
    for unit_of_y in (1e-6, 1e6):
        assert moved(plain, predicted([1e6, 1e-6, 1e3, 10.0], unit_of_y)) < 1e-6
    # the noise is known, so what is known of the parameters is as good as without Γ
    assert np.std(plain[200:]) < 1.1 * np.std(errors(make(4), phi, y)[200:])


def test_robust_weightings_need_no_gamma():
    """Gross errors in one sample of twenty, in any unit of y: as if the noise were known."""
    deviations: dict[tuple[str, bool], list[np.ndarray]] = {}
    for seed in range(20):
        random = np.random.default_rng(seed)
        phi, theta = random.normal(size=(2000, 3)), np.array([10.0, -20.0, 30.0])
        y = phi @ theta + random.normal(size=2000)
        y += np.where(random.random(2000) < 0.05, 30.0, 0.0) * random.normal(size=2000)
        unit = 10.0 ** (seed % 7 - 3)
        for name in ("equal", "huber", "student_t"):
            est = fg.RLS(3, rule="none", weighting=name)
            est.run(phi, unit * y)
            deviations.setdefault((name, False), []).append(est.theta / unit - theta)
            est = fg.RLS(3, rule="none", weighting=name)
            est.run(phi, unit * y, gamma=np.full(2000, unit**2))
            deviations.setdefault((name, True), []).append(est.theta / unit - theta)
    rms = {key: float(np.sqrt(np.mean(np.square(found)))) for key, found in deviations.items()}
    for name in ("huber", "student_t"):
        assert rms[name, False] < 1.5 * rms[name, True]
        assert rms[name, False] < 0.3 * rms["equal", False]


@pytest.mark.parametrize("mixer", ["mlpol", "best", "dynamic_model_averaging"])
def test_units_of_several_outputs_change_no_prediction_of_a_bank(mixer):
    phi, y = record()
    other = record(seed=5)[1]
    both, units = np.column_stack([y, 3.0 + 20.0 * other]), np.array([1e5, 1e-4])
    one, two = (fg.Bank(4, targets=2, mixer=mixer) for _ in range(2))
    run = one.run(phi, both, outputs=("error", "weights", "variance"))
    scaled = two.run(phi * [1e6, 1e-6, 1e3, 10.0], both * units, outputs=("error", "weights"))
    assert moved(run.error, scaled.error / units) < 1e-6
    np.testing.assert_allclose(run.weights, scaled.weights, atol=1e-6)
    np.testing.assert_allclose(
        one.covariance, two.covariance * np.outer(u := [1e6, 1e-6, 1e3, 10.0], u), rtol=1e-5
    )


@pytest.mark.parametrize("size", [30.0, 1000.0])
def test_a_weighting_keeps_gross_errors_from_choosing_the_members(size):
    """One sample of twenty is wrong, by so many standard deviations."""
    off: dict[str, list[float]] = {}
    for seed in range(8):
        random = np.random.default_rng(seed)
        phi = random.normal(size=(3000, 3))
        theta = np.cumsum(0.03 * random.normal(size=(3000, 3)), axis=0)
        clean = (phi * theta).sum(axis=1) + random.normal(size=3000)
        wrong = np.where(random.random(3000) < 0.05, size, 0.0) * random.normal(size=3000)
        for name, weighting, y in (
            ("clean", "equal", clean),
            ("huber", "huber", clean + wrong),
            ("student_t", "student_t", clean + wrong),
        ):
            run = fg.Bank(3, weighting=weighting).run(phi, 1e-3 * y)
            error = np.linalg.norm(1e3 * run.theta[500:] - theta[500:], axis=1)
            off.setdefault(name, []).append(float(np.median(error)))
    for name in ("huber", "student_t"):
        assert np.max(off[name]) < 1.7 * np.mean(off["clean"])
        assert np.mean(off[name]) < 1.5 * np.mean(off["clean"])
