"""Poles, gains and responses beside scipy.signal and python-control."""

import numpy as np
import pytest
from scipy import signal

import forgetting as fg

from .systems import model, outputs

control = pytest.importorskip("control")
CHANNELS = [("ARX", 0), ("ARMAX", 0), ("OE", 0), ("OE", 1), ("BJ", 1), ("all", 0), ("all", 1)]
channels = pytest.mark.parametrize(("name", "i"), CHANNELS)
T = 0.25
"""A sample time other than 1."""


def by_control(name, i):
    made = model(name, sample_time=T).to_control()
    return made[0, i]


@channels
def test_poles_and_zeros(name, i):
    found, other = model(name, sample_time=T), by_control(name, i)
    poles, zeros = found.poles(i).value, found.zeros(i).value
    for ours, theirs in ((poles, other.poles()), (zeros, other.zeros())):
        theirs = theirs[np.abs(theirs) > 1e-9]  # what only delays is at 0 in theirs
        np.testing.assert_allclose(np.sort_complex(ours), np.sort_complex(theirs), atol=1e-9)


@channels
def test_damping_and_frequency(name, i):
    poles = model(name, sample_time=T).poles(i)
    made = control.TransferFunction([1], np.real(np.poly(poles.value)), T)
    frequency, damping, theirs = control.damp(made, doprint=False)
    order = [int(np.argmin(np.abs(theirs - pole))) for pole in poles.value]
    np.testing.assert_allclose(poles.natural_frequency.value, frequency[order], rtol=1e-6)
    np.testing.assert_allclose(poles.damping.value, damping[order], rtol=1e-6)


@channels
def test_static_gain(name, i):
    gain = model(name).static_gain(i).value
    assert gain == pytest.approx(float(by_control(name, i).dcgain()))


@channels
def test_step_and_impulse(name, i):
    found, other = model(name, sample_time=T), by_control(name, i)
    for ours, theirs in (
        (found.step(60, i), control.step_response(other, T=T * np.arange(60))),
        (found.impulse(60, i), control.impulse_response(other, T=T * np.arange(60))),
    ):
        np.testing.assert_allclose(ours.time, theirs.time)
        scale = T if "impulse" in ours.title else 1.0  # theirs has the area of a continuous one
        np.testing.assert_allclose(ours.value, scale * theirs.outputs, atol=1e-9)


@channels
def test_frequency_response(name, i):
    found = model(name, sample_time=T)
    ours = found.frequency_response(input=i)
    above, below = (np.trim_zeros(x, "b") for x in found._transfer(i).polynomials())
    _, theirs = signal.freqz(above, below, ours.frequency * T)
    np.testing.assert_allclose(ours.value, theirs, rtol=1e-9)
    np.testing.assert_allclose(ours.value, by_control(name, i)(np.exp(1j * ours.frequency * T)))
    np.testing.assert_allclose(ours.magnitude * np.exp(1j * ours.phase), theirs, rtol=1e-9)


def test_the_noise_is_a_channel_too():
    found = model("all")
    shock = np.eye(1, 40)[0]
    level = found.offset / found.A.sum()
    wanted = outputs(found, np.zeros((40, 2)), shock) - level
    wanted -= outputs(found, np.zeros((40, 2)), 0 * shock) - level
    np.testing.assert_allclose(found.impulse(40, "noise").value, wanted, atol=1e-9)
    np.testing.assert_allclose(found.zeros("noise").value, [-0.5])
    assert found.poles("noise").value[0] == pytest.approx(0.9)


@pytest.mark.parametrize("name", ["ARX", "ARMAX", "OE", "BJ", "all", "static", "ARMA"])
def test_state_space(name):
    found = model(name)
    A, B, C, D, K = found.to_state_space()
    random = np.random.default_rng(2)
    u = random.normal(size=(80, found.structure.inputs))
    e = random.normal(size=80)
    level = (found.offset or 0.0) / found.A.sum()
    x, y = np.zeros(len(A)), np.zeros(80)
    for k in range(80):
        y[k] = (C @ x + D @ u[k])[0] + e[k] + level
        x = A @ x + B @ u[k] + K[:, 0] * e[k]
    np.testing.assert_allclose(y, outputs(found, u, e), atol=1e-8)


def test_a_state_space_has_no_more_states_than_it_needs():
    assert model("ARX").to_state_space().A.shape == (2, 2)
    assert model("static").to_state_space().A.shape == (0, 0)


def test_several_inputs_are_one_transfer_function_of_control():
    made = model("BJ", sample_time=T, input_names=["gas", "air"], output_name="T").to_control()
    assert (made.noutputs, made.ninputs, made.dt) == (1, 2, T)
    assert made.input_labels == ["gas", "air"] and made.output_labels == ["T"]


def test_time_constants_are_those_of_exponential_decay():
    found = fg.PolynomialModel([1, -np.exp(-0.1 / 2.5)], [1.0], sample_time=0.1)
    assert found.time_constants().value == pytest.approx([2.5])
    assert found.poles().damping.value == pytest.approx([1.0])


def test_an_oscillation_has_the_frequency_and_damping_it_was_made_of():
    s = complex(-0.3, 2.0)
    A = np.real(np.poly(np.exp(np.array([s, s.conjugate()]) * 0.1)))
    poles = fg.PolynomialModel(A, [1.0], sample_time=0.1).poles()
    assert poles.natural_frequency.value == pytest.approx([abs(s)] * 2)
    assert poles.damping.value == pytest.approx([0.3 / abs(s)] * 2)
    assert sorted(poles.continuous.value.imag) == pytest.approx([-2.0, 2.0])


@pytest.mark.parametrize(
    ("A", "stable"), [([1, -0.99], True), ([1, -1.0], False), ([1, -1.01], False), ([1], True)]
)
def test_stability(A, stable):
    assert fg.PolynomialModel(A, [1.0]).is_stable is stable
    assert ("unstable" in repr(fg.PolynomialModel(A, [1.0]))) is not stable


def test_an_integrator_and_a_pole_at_zero_give_limits_and_no_warnings():
    integrator = fg.PolynomialModel([1, -1.0], [1.0], covariance=1e-4 * np.eye(2))
    assert integrator.static_gain().value == np.inf
    assert integrator.time_constants().value == pytest.approx([-np.inf]) or np.isinf(
        integrator.time_constants().value
    )
    delay = fg.PolynomialModel([1, -0.5, 0.0], [1.0], covariance=1e-4 * np.eye(3))
    assert delay.time_constants().value[1] == 0.0
    assert np.isfinite(delay.poles().standard_error).all()
    twice = fg.PolynomialModel([1, -1.0, 0.25], [1.0], covariance=1e-4 * np.eye(3))
    assert not (twice.poles().standard_error < 1e3).any()  # of a double root it is infinite
    str(twice.poles()), repr(twice)


@pytest.mark.parametrize("wrong", [0.0, -1.0, 4.0, np.nan, [[1.0]]])
def test_frequencies_out_of_range_are_refused(wrong):
    with pytest.raises(fg.InvalidInput, match="π/sample_time"):
        model("ARX").frequency_response(wrong)


@pytest.mark.parametrize("wrong", [0, -3, 2.5])
def test_a_response_of_no_samples_is_refused(wrong):
    with pytest.raises(fg.InvalidInput, match="samples"):
        model("ARX").step(wrong)
