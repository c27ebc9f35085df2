"""Parameters to polynomials and back, and what is refused."""

import pickle

import numpy as np
import pytest

import forgetting as fg
from forgetting.polynomials import PolynomialModel, Structure

from .systems import SYSTEMS, model, random_covariance


def test_parameters_have_the_signs_of_the_difference_equation():
    structure = Structure(na=1, nb=(2, 1), nc=1, nd=1, nf=(0, 1), nk=(1, 0), offset=True)
    theta = [0.8, 0.5, 0.2, 3.0, 0.4, 0.9, 0.7, -2.0]
    names = ("a1", "b1[u1]", "b2[u1]", "b0[u2]", "c1", "d1", "f1[u2]", "offset")
    assert structure.names() == names
    found = PolynomialModel.from_parameters(structure, theta)
    assert found.parameter_names == names
    assert (found.A.tolist(), found.C.tolist(), found.D.tolist()) == (
        [1, -0.8],
        [1, 0.4],
        [1, -0.9],
    )
    assert [b.tolist() for b in found.B] == [[0, 0.5, 0.2], [3]]
    assert [f.tolist() for f in found.F] == [[1], [1, -0.7]]
    assert found.offset == -2.0


@pytest.mark.parametrize("name", SYSTEMS)
def test_polynomials_become_parameters_and_polynomials_again(name):
    found = model(name)
    again = PolynomialModel.from_parameters(found.structure, found.theta)
    assert again.structure == found.structure
    np.testing.assert_array_equal(again.theta, found.theta)
    np.testing.assert_array_equal(again.A, SYSTEMS[name].get("A", [1]))


def test_the_parameters_are_those_of_arx():
    random = np.random.default_rng(0)
    u, y = random.normal(size=400), np.zeros(400)
    for k in range(2, 400):
        y[k] = 1.5 * y[k - 1] - 0.7 * y[k - 2] + u[k - 1] + 0.5 * u[k - 2]
    fitted = fg.ARX(na=2, nb=2, nk=1, rule="none", initial_covariance=1e8).fit(u, y)
    found = PolynomialModel.from_parameters(Structure(na=2, nb=2, nk=1), fitted.theta_)
    np.testing.assert_allclose(found.A, [1, -1.5, 0.7], atol=1e-6)
    np.testing.assert_allclose(found.B[0], [0, 1.0, 0.5], atol=1e-6)


def test_covariance_is_scaled_by_the_noise():
    P = random_covariance(2, 1.0)
    found = PolynomialModel.from_parameters(Structure(na=1, nb=1), [0.5, 1.0], P, 0.25)
    np.testing.assert_allclose(found.covariance, 0.25 * P)
    without = PolynomialModel.from_parameters(Structure(na=1, nb=1), [0.5, 1.0], P)
    assert np.isnan(without.standard_errors).all() and without.noise_variance is None


def test_a_model_is_pickled_and_cannot_be_changed():
    found = model("BJ", covariance=random_covariance(9, 1e-2), noise_variance=2.0)
    again = pickle.loads(pickle.dumps(found))
    assert repr(again) == repr(found)
    with pytest.raises(ValueError, match="read-only"):
        found.theta[0] = 0.0


def test_a_model_is_printed_with_the_digits_that_its_errors_leave():
    text = repr(
        fg.PolynomialModel(
            [1, -0.81234],
            [[0.5123], [-2.0]],
            C=[1, 0.3],
            F=[[1], [1, -0.25]],
            delay=[1, 0],
            offset=12.3456,
            covariance=np.diag([0.01, 0.02, 0.3, 0.05, 0.1, 0.5]) ** 2,
            noise_variance=0.04,
            sample_time=0.5,
            input_names=["valve", "sun"],
            output_name="T",
        )
    )
    assert text == "\n".join(
        [
            "A(q) T = B_valve(q) valve + B_sun(q)/F_sun(q) sun + C(q) e + offset",
            "  A(q) = 1 − 0.812(±0.010) q⁻¹",
            "  B_valve(q) = 0.512(±0.020) q⁻¹",
            "  B_sun(q) = −2.00(±0.30)",
            "  C(q) = 1 + 0.300(±0.050) q⁻¹",
            "  F_sun(q) = 1 − 0.250(±0.10) q⁻¹",
            "  offset = 12.35(±0.50)",
            "  stable, sample time 0.5, noise variance 0.04",
        ]
    )


@pytest.mark.parametrize(
    ("given", "words"),
    [
        ({"A": [0.5, 1]}, "A = .*, allowed: a polynomial that begins with 1"),
        ({"C": []}, "C = "),
        ({"B": [np.nan]}, "B = .*, allowed: a row of finite"),
        ({"B": 3.0}, "B = 3.0, allowed: one polynomial for each input"),
        ({"B": [[1.0], [[2.0]]]}, "B = .*, allowed: a row of finite"),
        ({"B": [1.0], "F": [[1.0], [1.0]]}, "F has 2 polynomials, allowed: 1"),
        ({"B": [1.0], "delay": -1}, "nk = -1, allowed: a whole number >= 0"),
        ({"B": [1.0], "delay": [1, 2]}, "nk has 2 entries, allowed: one for each of 1"),
        ({}, "at least one parameter"),
        ({"B": [1.0], "offset": np.inf}, "offset = inf"),
        ({"B": [1.0], "sample_time": 0.0}, "sample_time = 0.0, allowed: a number in \\(0, inf\\)"),
        ({"B": [1.0], "sample_time": None}, "sample_time = None"),
        ({"B": [1.0], "sample_time": "1 s"}, "sample_time = '1 s', allowed: a number in"),
        ({"B": [1.0], "offset": "x"}, "offset = 'x', allowed: a number in"),
        ({"A": "abc"}, "A must hold numbers"),
        ({"B": [1.0], "noise_variance": -1.0}, "noise_variance = -1.0"),
        ({"B": [1.0], "covariance": np.eye(2)}, "covariance has shape"),
        ({"B": [1.0], "covariance": [[-1.0]]}, "variance below 0"),
        ({"B": [1.0, 2.0], "covariance": [[1, 0], [1, 1]]}, "not symmetric"),
        ({"B": [1.0], "input_names": ["a", "b"]}, "input_names has 2 entries, allowed: 1"),
    ],
)
def test_what_is_no_model_is_refused(given, words):
    with pytest.raises(fg.InvalidInput, match=words):
        fg.PolynomialModel(**given)


@pytest.mark.parametrize(
    ("orders", "words"),
    [
        ({"na": -1}, "na = -1"),
        ({"nb": (1, -1)}, "nb = -1, allowed: a whole number >= 0"),
        ({"nb": (1, 1), "nf": (1,)}, "nf has 1 entries, allowed: one for each of 2"),
        ({"na": 1.5}, "na = 1.5"),
        ({"nb": 0}, "at least one parameter"),
    ],
)
def test_orders_out_of_range_are_refused(orders, words):
    with pytest.raises(fg.InvalidInput, match=words):
        Structure(**orders)


@pytest.mark.parametrize("theta", [[1.0], [1.0, np.nan], [[1.0, 2.0]]])
def test_parameters_that_do_not_fit_are_refused(theta):
    with pytest.raises(fg.InvalidInput, match="2 finite numbers"):
        PolynomialModel.from_parameters(Structure(na=1, nb=1), theta)


def test_an_unknown_input_is_refused_with_those_there_are():
    with pytest.raises(fg.InvalidInput, match="one of u1, u2, or its number, or 'noise'"):
        model("OE").step(input="u3")
    with pytest.raises(fg.InvalidInput, match="no input"):
        model("ARMA").step()


def test_parameters_of_arx_with_several_inputs_are_reordered():
    random = np.random.default_rng(0)
    truth = fg.PolynomialModel([1, -0.5], [[1.0, 0.4, 0.2], [-2.0, 0.7, 0.1]], delay=0)
    u = random.normal(size=(600, 2))
    fitted = fg.ARX(na=1, nb=3, nk=0, rule="none", initial_covariance=1e8)
    fitted.fit(u, truth.simulate(u))
    structure = Structure(na=1, nb=(3, 3), nk=0)
    order = structure.from_lag_order()
    found = PolynomialModel.from_parameters(structure, fitted.theta_[order])
    for ours, theirs in zip(found.B, truth.B, strict=True):
        np.testing.assert_allclose(ours, theirs, atol=1e-6)


def test_unequal_delays_are_reordered_as_lags_come():
    structure = Structure(nb=(2, 1), nk=(2, 1))
    assert structure.names() == ("b2[u1]", "b3[u1]", "b1[u2]")
    assert structure.from_lag_order().tolist() == [1, 2, 0]


def test_an_input_may_have_no_effect():
    found = PolynomialModel.from_parameters(Structure(na=1, nb=(1, 0), nk=0), [0.5, 2.0])
    assert found.static_gain(1).value == 0.0 and len(found.zeros(1).value) == 0
    assert repr(found).startswith("A(q) y = B_u1(q) u1 + e\n")
    u = np.random.default_rng(0).normal(size=(20, 2))
    alone = fg.PolynomialModel([1, -0.5], [2.0], delay=0).simulate(u[:, 0])
    np.testing.assert_allclose(found.simulate(u), alone)


def test_a_noise_variance_that_is_not_known_yet_leaves_the_errors_open():
    found = PolynomialModel.from_parameters(Structure(na=1), [0.5], [[1.0]], float("nan"))
    assert found.noise_variance is None and np.isnan(found.standard_errors).all()
