"""Each refusal names the parameter, its value and what is allowed, and changes nothing."""

import numpy as np
import pytest

import forgetting as fg

BAD_ARGUMENTS = [
    ({"parameters": 0}, r"parameters = 0, allowed: whole numbers"),
    ({"parameters": -1}, r"parameters = -1, allowed: whole numbers"),
    ({"rows": 0}, r"rows = 0, allowed: whole numbers"),
    ({"targets": 99999}, r"targets = 99999, allowed: whole numbers from 1 to 32768"),
    ({"rule": "nonsense"}, r'rule = "nonsense" is not known'),
    ({"rule": 3}, r"rule = 3, allowed: a name or a rule object"),
    ({"rule": fg.Exponential(1.5)}, r"forgetting_factor = 1.5, allowed: \(0, 1\]"),
    ({"rule": fg.Exponential(0.0)}, r"forgetting_factor = 0, allowed: \(0, 1\]"),
    ({"rule": fg.Subspace(float("nan"))}, r"forgetting_factor = NaN, allowed: \(0, 1\]"),
    ({"rule": fg.Subspace(0.9, threshold=-1)}, r"threshold = -1, allowed: \(0, inf\)"),
    (
        {"rule": fg.ExponentialResetting(0.9, information=-2)},
        r"information = -2, allowed: \[0, inf\)",
    ),
    ({"rule": fg.ExponentialResetting(0.9, information=[1, 2])}, r"information has 2 elements"),
    (
        {"rule": fg.ExponentialResetting(0.9, information=np.diag([1.0, 2, -3]))},
        r"information is not positive semidefinite",
    ),
    ({"weighting": "nonsense"}, r'weighting = "nonsense" is not known'),
    ({"initial_covariance": -1}, r"initial_covariance\[0\] = -1, allowed: positive"),
    ({"initial_covariance": [1, np.inf, 1]}, r"initial_covariance\[1\] = inf"),
    (
        {"initial_covariance": [1, 2]},
        r"initial_covariance has shape \(2,\), expected \(\), \(3,\) or",
    ),
    ({"initial_covariance": np.ones((3, 3))}, r"initial_covariance is not positive definite"),
    (
        {"initial_covariance": np.triu(np.ones((3, 3)))},
        r"initial_covariance\[3\] = 0, allowed: a sym",
    ),
    ({"initial_theta": [1, 2]}, r"initial_theta has shape \(2,\), expected \(3,\)"),
    ({"initial_theta": [1, 2, np.nan]}, r"initial_theta\[2\] = NaN"),
    ({"dtype": "int32"}, r'dtype = "int32", allowed: "float64", "float32"'),
]


@pytest.mark.parametrize(("arguments", "message"), BAD_ARGUMENTS, ids=lambda a: str(a)[:40])
def test_constructor(arguments, message):
    with pytest.raises(fg.InvalidInput, match=message):
        fg.RLS(**{"parameters": 3, **arguments})


BAD_SAMPLES = [
    (([1, 2], 1.0), r"phi has shape \(2,\), expected \(3,\)"),
    (([1, 2, 3], [1.0, 2.0]), r"y has shape \(2,\), expected \(\)"),
    (([1, np.nan, 3], 1.0), r"phi\[1\] = NaN, allowed: finite"),
    (([1, 2, -np.inf], 1.0), r"phi\[2\] = -inf, allowed: finite"),
    (([1, 2, 3], np.inf), r"y\[0\] = inf, allowed: finite"),
    ((["a", 2, 3], 1.0), r"phi must hold numbers"),
    (([1, 2, 3], None), r"y must hold numbers|y\[0\] = NaN"),
    (([1, 2, 3], 1.0, 0.0), r"gamma = 0, allowed: positive"),
    (([1, 2, 3], 1.0, np.nan), r"gamma = NaN, allowed: positive"),
    (([1, 2, 3], 1.0, np.eye(2)), r"gamma has shape \(2, 2\), expected \(\)"),
    (([1e200, 2, 3], 1.0), r"exceeds the numerical range"),
    (([1, 2, 3], 1e300), r"exceeds the numerical range"),
]


@pytest.mark.parametrize("rule", ["none", "exponential", "subspace"])
@pytest.mark.parametrize(("sample", "message"), BAD_SAMPLES, ids=lambda a: str(a)[:40])
def test_sample(sample, message, rule):
    est = fg.RLS(3, rule=rule)
    for k in range(5):
        est.update([1.0, k, k * k], 2.0 * k)
    before = est.to_bytes()
    with pytest.raises((fg.InvalidInput, fg.NumericalRange), match=message):
        est.update(*sample)
    assert est.to_bytes() == before


def test_full_noise_must_be_positive_definite():
    est = fg.RLS(2, rows=2)
    before = est.to_bytes()
    for gamma, message in [
        ([[1.0, 2.0], [2.0, 1.0]], "gamma is not positive definite"),
        ([[1.0, 0.5], [0.0, 1.0]], "a symmetric matrix"),
        ([[1.0, np.nan], [np.nan, 1.0]], r"gamma\[1\] = NaN"),
    ]:
        with pytest.raises(fg.InvalidInput, match=message):
            est.update(np.ones((2, 2)), np.ones(2), gamma=gamma)
    assert est.to_bytes() == before


def test_a_refused_record_leaves_the_estimator_as_it_was():
    est = fg.RLS(2)
    est.update([1.0, 2.0], 3.0)
    before = est.to_bytes()
    phi, y = np.ones((50, 2)), np.ones(50)
    y[33] = np.inf
    with pytest.raises(fg.InvalidInput, match=r"sample 33: y\[0\] = inf"):
        est.run(phi, y, missing="skip")
    for bad in [
        {"phi": np.ones((50, 3)), "y": np.ones(50)},
        {"phi": np.ones((50, 2)), "y": np.ones(49)},
        {"phi": phi, "y": np.ones(50), "gamma": np.ones(3)},
        {"phi": phi, "y": np.ones(50), "outputs": ["nonsense"]},
        {"phi": phi, "y": np.ones(50), "missing": "nonsense"},
        {"phi": 3.0, "y": np.ones(50)},
    ]:
        with pytest.raises(fg.InvalidInput):
            est.run(**bad)
    assert est.to_bytes() == before


def test_a_parameter_that_the_rule_does_not_have():
    with pytest.raises(TypeError):
        fg.Exponential(0.9, threshold=1)
    with pytest.raises(fg.InvalidInput, match="its parameters: forgetting_factor"):
        fg.rule("exponential", threshold=1)
    with pytest.raises(fg.InvalidInput, match="rule = 'nonsense', allowed: "):
        fg.rule("nonsense")


def test_every_altered_or_truncated_state_is_refused():
    est = fg.RLS(3, rule=fg.ExponentialResetting(0.9, information=np.eye(3)), targets=2)
    est.update([1, 2, 3], [1, 2])
    state = est.to_bytes()
    for length in range(len(state)):
        with pytest.raises(fg.InvalidInput, match="state: "):
            fg.RLS.from_bytes(state[:length])
    for position in range(len(state)):
        altered = bytearray(state)
        altered[position] ^= 0x10
        with pytest.raises(fg.InvalidInput, match="state: "):
            fg.RLS.from_bytes(bytes(altered))
    with pytest.raises(fg.InvalidInput, match="state: "):
        fg.RLS.from_bytes(state + b"0")
