"""What pictures of a model show: the numbers of the model."""

import matplotlib as mpl
import numpy as np
import pytest
from matplotlib import pyplot as plt
from matplotlib.patches import Ellipse

import forgetting as fg
from forgetting import plot

from .systems import model, random_covariance, signals


@pytest.fixture(autouse=True)
def no_screen():
    mpl.use("Agg")
    with plot.styled():
        yield
    plt.close("all")


def known(name):
    size = model(name).structure.parameters
    return model(name, covariance=random_covariance(size, 0.01), sample_time=0.5)


def test_step_responses_of_two_models_with_their_bands():
    one, other = known("ARX").step(30), known("ARMAX").step(30)
    ax = plot.time_response(one, other, labels=["before", "after"])
    before, after = ax.lines[:2]
    np.testing.assert_array_equal(before.get_ydata(), one.value)
    np.testing.assert_array_equal(after.get_xdata(), other.time)
    assert [text.get_text() for text in ax.get_legend().get_texts()] == ["before", "after"]
    assert ax.get_title(loc="left") == "step response, u → y" and len(ax.collections) == 2


def test_a_bode_diagram_is_in_decibel_and_degrees():
    found = known("OE").frequency_response(input=1)
    gain, phase = plot.frequency_response(found)
    np.testing.assert_allclose(gain.lines[0].get_ydata(), 20 * np.log10(np.abs(found.value)))
    turned = np.exp(1j * np.radians(phase.lines[0].get_ydata()))
    np.testing.assert_allclose(turned, found.value / np.abs(found.value))
    assert gain.get_title(loc="left") == "u2 → y" and gain.get_legend() is None


def test_ellipses_hold_as_many_roots_as_they_say():
    found = known("ARX")
    ax = plot.poles_and_zeros(found, level=0.9)
    ellipses = [patch for patch in ax.patches if isinstance(patch, Ellipse) and patch.width != 2]
    pole, upper = found.poles().value[0], found.poles()
    drawn = np.random.default_rng(0).multivariate_normal(
        [pole.real, pole.imag], upper.covariance[0], 4000
    )
    shape = next(e for e in ellipses if np.allclose(e.center, (pole.real, pole.imag)))
    inside = shape.contains_points(shape.get_transform().transform([(0, 0)]))
    assert inside.all()
    unit = (shape.get_patch_transform().inverted()).transform(drawn)
    assert np.mean((unit**2).sum(axis=1) <= 1) == pytest.approx(0.9, abs=0.02)


def test_without_a_covariance_there_are_no_ellipses():
    ax = plot.poles_and_zeros(model("ARX"))
    assert not [patch for patch in ax.patches if type(patch) is Ellipse]


def test_residuals_have_a_row_for_themselves_and_one_for_each_input():
    found = model("OE")
    u, _, y = signals(found, 800)
    tests = found.residual_tests(u, y)
    axes = plot.residual_tests(tests)
    assert len(axes) == 3
    assert "with u2" in axes[2].get_title(loc="left") and "Ljung–Box" in axes[0].get_title(
        loc="left"
    )


def test_bars_out_of_the_band_stand_out():
    found = model("ARMA")
    _, _, y = signals(found, 800)
    tests = model("ARMA").residual_tests(None, np.cumsum(y))
    ax = plot.autocorrelation(tests)
    inside, outside = (len(c.get_segments()) for c in ax.collections[-2:])
    assert outside == np.sum(np.abs(tests.autocorrelation) > tests.band(0.99)) > 0
    assert inside + outside == len(tests.lags)


def test_the_measured_output_beside_the_free_run():
    found = model("ARX", output_name="T", output_unit="°C")
    u, _, y = signals(found, 300)
    ax = plot.simulated(found, u, y)
    assert ax.get_title(loc="left") == f"fit {found.fit_percent(u, y):.1f} %"
    assert ax.get_ylabel() == "T [°C]"
    labels = [text.get_text() for text in ax.get_legend().get_texts()]
    assert labels == ["measured", "free run"]


def test_labels_and_inputs_that_do_not_fit_are_refused():
    found = model("ARX").step(5)
    with pytest.raises(fg.InvalidInput, match="1 responses and 2 labels"):
        plot.time_response(found, labels=["a", "b"])
    with pytest.raises(fg.InvalidInput, match="0 responses"):
        plot.frequency_response()
    u, _, y = signals(model("ARX"), 100)
    with pytest.raises(fg.InvalidInput, match="input = 1, allowed: 0 to 0"):
        plot.cross_correlation(model("ARX").residual_tests(u, y), 1)
