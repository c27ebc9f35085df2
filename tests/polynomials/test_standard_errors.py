"""Standard errors of the delta method beside models that are drawn at random."""

import numpy as np
import pytest

import forgetting as fg
from forgetting.polynomials import PolynomialModel, Structure

from .systems import model, random_covariance

DRAWS = 1500
MONTE_CARLO = 0.1
"""Relative error of a standard deviation from so many draws, 1/√(2 DRAWS) = 0.018, five times."""
SMALL = 2e-4
"""Standard deviation of the parameters: so small that only the first order is left."""


def drawn(name):
    """A model, and others drawn from the covariance of its parameters."""
    size = model(name).structure.parameters
    covariance = random_covariance(size, SMALL)
    found = model(name, covariance=covariance, sample_time=0.5)
    random = np.random.default_rng(3).multivariate_normal(found.theta, covariance, DRAWS)
    settings = {"sample_time": 0.5}
    return found, [PolynomialModel.from_parameters(found.structure, t, **settings) for t in random]


@pytest.fixture(scope="module", params=["ARX", "all"])
def pair(request):
    return drawn(request.param)


def spread(models, of):
    return np.std([of(each) for each in models], axis=0)


def agrees(claimed, measured):
    np.testing.assert_allclose(claimed, measured, rtol=MONTE_CARLO, atol=1e-9)


def test_gain_of_every_input_and_the_noise(pair):
    found, models = pair
    for i in [*range(found.structure.inputs), "noise"]:
        agrees(
            found.static_gain(i).standard_error,
            spread(models, lambda m, i=i: m.static_gain(i).value),
        )


def test_poles_and_what_follows_from_them(pair):
    found, models = pair

    def near(values):  # the roots of each in the order of those of the model
        nearest = np.abs(values[:, None] - found.poles().value).argmin(axis=0)
        assert len(set(nearest)) == len(values)
        return nearest

    every = [(m.poles(), near(m.poles().value)) for m in models]
    ours = found.poles()
    agrees(ours.standard_error[:, 0], np.std([r.value.real[o] for r, o in every], axis=0))
    agrees(ours.standard_error[:, 1], np.std([r.value.imag[o] for r, o in every], axis=0))
    for name in ("modulus", "natural_frequency", "damping", "time_constant"):
        measured = np.std([getattr(r, name).value[o] for r, o in every], axis=0)
        agrees(getattr(ours, name).standard_error, measured)


def test_zeros(pair):
    found, models = pair
    measured = spread(models, lambda m: m.zeros(0).value.real)
    agrees(found.zeros(0).standard_error[:, 0], measured)


def test_responses_in_time(pair):
    found, models = pair
    for what in ("step", "impulse"):
        ours = getattr(found, what)(40)
        measured = spread(models, lambda m, what=what: getattr(m, what)(40).value)
        agrees(ours.standard_error, measured)


def test_responses_over_frequency(pair):
    found, models = pair
    at = np.array([0.01, 0.3, 1.0, 3.0, 6.0])
    for i in (0, "noise"):
        ours = found.frequency_response(at, i)
        every = [m.frequency_response(at, i) for m in models]
        agrees(ours.log_error, np.std([np.log(r.magnitude) for r in every], axis=0))
        agrees(ours.phase_error, np.std([r.phase for r in every], axis=0))


def test_intervals_of_identified_models_cover_the_truth():
    """Least squares on 400 records: the 95 % intervals hold the truth about as often."""
    truth, inside = model("ARX"), []
    structure = Structure(na=2, nb=2, nk=1)
    at = np.array([0.1, 1.0, 2.0])
    for seed in range(400):
        random = np.random.default_rng(seed)
        u, y = random.normal(size=500), np.zeros(500)
        for k in range(2, 500):
            y[k] = 1.5 * y[k - 1] - 0.7 * y[k - 2] + u[k - 1] + 0.5 * u[k - 2] + random.normal()
        phi = np.column_stack([y[1:-1], y[:-2], u[1:-1], u[:-2]])
        est = fg.RLS(4, rule="none", initial_covariance=1e6)
        est.run(phi, y[2:], outputs=())
        noise = np.sum((y[2:] - phi @ est.theta) ** 2) / (len(phi) - 4)
        found = PolynomialModel.from_parameters(structure, est.theta, est.covariance, noise)
        inside.append(
            [
                within(found.static_gain().interval(), truth.static_gain().value),
                within(found.step(21).band(), truth.step(21).value)[20],
                within(found.poles().modulus.interval(), truth.poles().modulus.value)[0],
                within(found.poles().damping.interval(), truth.poles().damping.value)[0],
                *within(
                    found.frequency_response(at).magnitude_band(),
                    truth.frequency_response(at).magnitude,
                ),
                *within(
                    found.frequency_response(at).phase_band(), truth.frequency_response(at).phase
                ),
            ]
        )
    share = np.mean(inside, axis=0)
    assert (np.abs(share - 0.95) < 5 * np.sqrt(0.95 * 0.05 / 400)).all(), share


def within(interval, value):
    low, high = interval
    return (low <= value) & (value <= high)


def test_without_a_covariance_nothing_is_claimed():
    found = model("ARX")
    assert np.isnan(found.static_gain().standard_error)
    assert np.isnan(found.step().standard_error).all()
    assert np.isnan(found.poles().time_constant.standard_error).all()


def test_a_fixed_parameter_has_no_error():
    covariance = np.zeros((2, 2))
    covariance[1, 1] = 0.01
    found = fg.PolynomialModel([1, -0.8], [0.5], covariance=covariance)
    assert found.poles().standard_error.tolist() == [[0.0, 0.0]]
    assert found.static_gain().standard_error == pytest.approx(0.5)


@pytest.mark.parametrize("level", [0.0, 1.0, -1, np.nan])
def test_a_level_out_of_range_is_refused(level):
    with pytest.raises(fg.InvalidInput, match="level"):
        model("ARX").static_gain().interval(level)
