"""Pictures: the axes given are the axes returned, and they show the numbers of the analysis."""

import dense_gf_rls as dense
import numpy as np
import pytest

from forgetting import analysis

matplotlib = pytest.importorskip("matplotlib")
matplotlib.use("Agg")
from matplotlib import pyplot as plt  # noqa: E402

from forgetting import plot  # noqa: E402


@pytest.fixture
def ax():
    figure, axes = plt.subplots()
    yield axes
    plt.close(figure)


@pytest.fixture(scope="module")
def run():
    rng = np.random.default_rng(0)
    phi = dense.exciting(rng, 1, 300, 1, 2, 2)
    phi[:, 150:250] = 0.0
    noise = 0.1 * rng.normal(size=(1, 300, 1))
    y = phi @ np.array([1.0, -1.0]) + noise
    done = dense.simulate(dense.exponential(0.95), phi, y, np.eye(2))
    return done, done.trajectory()


def _line(ax, label):
    return next(line for line in ax.lines if line.get_label() == label).get_ydata()


def test_excitation(run, ax):
    found = analysis.excitation(run[1].phibar, 10)
    assert plot.excitation(found, ax) is ax
    np.testing.assert_array_equal(
        _line(ax, "largest"), np.maximum(found.largest, 1e-18 * found.beta)
    )
    assert len(ax.patches) == 1  # one stretch without excitation


def test_content_and_spectrum(run, ax):
    found = analysis.excitation(run[1].phibar, 10)
    assert plot.content(found, ax, ["first", "second"]) is ax
    assert ax.images[0].get_array().shape == (2, 300)
    other = plt.subplots()[1]
    assert plot.spectrum(found.spectrum, other, ["x", "y"]) is other
    np.testing.assert_allclose(_line(other, "x"), np.maximum(found.spectrum.power[:, 0], 1e-300))
    plt.close(other.figure)


def test_conditions_and_stability(run, ax):
    found = analysis.conditions(run[1])
    assert plot.conditions(found, ax) is ax
    expected = np.linalg.eigvalsh(run[1].prior)[:, -1]
    np.testing.assert_allclose(_line(ax, "largest, after forgetting"), expected)
    assert _line(ax, "b")[0] == found.constants["b"]
    other = plt.subplots()[1]
    plot.stability(analysis.stability(found), other)
    plt.close(other.figure)


def test_stability_shows_the_guarantee(ax):
    phi = dense.exciting(np.random.default_rng(1), 1, 200, 1, 2, 2)
    trajectory = dense.simulate(dense.exponential(0.9), phi, None, np.eye(2)).trajectory()
    found = analysis.stability(analysis.conditions(trajectory))
    assert plot.stability(found, ax) is ax
    assert _line(ax, "guaranteed, c_N")[0] == found.decrease
    assert (_line(ax, "seen, at least") >= found.decrease).all()


def test_ultimate_bound(ax):
    known = dict(a=0.1, b=0.2, alpha=1.0, beta=1.0, window=1)
    error = np.full(20, 1e-3)
    found = analysis.ultimate_bound(known, parameter_drift=1e-3, error=error)
    assert plot.ultimate_bound(found, ax) is ax
    assert _line(ax, "bound")[0] == found.bound and _line(ax, "seen")[3] == 1e-3


def test_confidence(run, ax):
    done, trajectory = run
    found = analysis.confidence(trajectory, errors=done.errors[0])
    assert plot.confidence(found, ax) is ax
    missed = np.abs(found.error[found.counted]) > found.half_width[found.counted]
    assert len(_line(ax, "outside")) == int(missed.sum())


def test_windup(run, ax):
    found = analysis.windup(run[1])
    assert found.occurred and plot.windup(found, ax) is ax
    assert len(ax.patches) == 1


def test_axes_are_made_where_none_are_given(run):
    made = plot.windup(analysis.windup(run[1]))
    assert made.get_xlabel() == "sample"
    plt.close(made.figure)
