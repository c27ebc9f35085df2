"""The bounds that a rule states, its claims and the words of the report say the same."""

import numpy as np
import pytest

import forgetting as fg
from forgetting.analysis import guaranteed_bounds

RULES = {about["name"]: about for about in fg.rules()}
SILENT = "No formula for bounds of P is known for this rule; see its page."


def _rule(name, **parameters):
    """The rule with its defaults; `custom` is exponential."""
    if name == "custom":
        parameters["forgetting_matrix"] = lambda r, phi, error: 0.1 * r
    return fg.rule(name, **parameters)


def _bounds(rule, beta=4.0, factors=(0.9, 0.95)):
    return guaranteed_bounds(
        rule, 3.0, parameters=2, forgetting_factors=factors, regressor_bound=beta
    )


@pytest.mark.parametrize("name", RULES)
def test_a_rule_states_no_bound_that_it_denies(name):
    about, found = RULES[name], _bounds(_rule(name))
    if about["bounded_above"] == "always":
        assert found.bounded
    if about["bounded_above"] == "no":
        assert not found.bounded and found.upper is None
    if about["bounded_below"] == "no":
        assert found.lower is None
    assert found.upper is None or (found.bounded and found.upper >= 3.0)
    assert found.lower is None or 0 < found.lower <= 3.0
    assert (str(found) == SILENT) == (found.lower is None and found.upper is None)


def test_what_has_no_formula_says_so():
    for name in ("restricted", "variable_direction"):
        assert str(_bounds(_rule(name))) == SILENT


def test_the_first_sample_of_constant_trace_is_measured_with_the_first_covariance():
    rule = fg.ConstantTrace(10.0, 1.0)
    constants = {"parameters": 1, "forgetting_factors": (1.0, 1.0), "regressor_bound": 7.0}
    found = guaranteed_bounds(rule, 0.05, **constants)
    est = fg.RLS(1, rule=rule, initial_covariance=0.05)
    est.update([7.0**0.5], 0.0)
    assert est.covariance.item() == pytest.approx(found.lower, rel=1e-14)
    assert found.lower == pytest.approx(1.0 / 27.0, rel=1e-14)


def test_the_eigenvalues_of_a_full_matrix_are_those_of_the_matrix():
    root = np.random.default_rng(1).normal(size=(5, 5))
    matrix = root @ root.T + 0.1 * np.eye(5)
    small, *_, large = np.linalg.eigvalsh(matrix)
    options = {"parameters": 5, "forgetting_factors": (0.9, 0.9), "regressor_bound": 2.0}
    found = guaranteed_bounds(fg.ExponentialResetting(0.9, information=matrix), 1e3, **options)
    assert found.upper == pytest.approx(max(1 / small, 1e3), rel=1e-9)
    assert found.lower == pytest.approx(1 / (2.0 / 0.1 + large), rel=1e-9)
    found = guaranteed_bounds(fg.RandomWalk(matrix), 1e3, **options)
    assert found.lower == pytest.approx(1 / (2.0 + 1 / small), rel=1e-9)
    singular = np.ones((5, 5))
    found = guaranteed_bounds(fg.ExponentialResetting(0.9, information=singular), 1.0, **options)
    assert found.upper is None and not found.bounded


def test_words():
    assert str(_bounds(fg.Subspace(0.9, threshold=0.5))) == (
        "The rule keeps P below 3 whatever the input, and above 0.0125 for regressors as large as "
        "in this record."
    )
    assert str(_bounds(fg.Exponential(0.9), beta=10.0)) == (
        "The rule guarantees P no upper bound; for regressors as large as in this record P stays "
        "above 0.005."
    )
    # without a bound of the regressors there is none of P from below
    assert _bounds(fg.Exponential(0.9), beta=np.inf).lower is None
    assert _bounds(fg.Exponential(0.9), factors=(1.0, 1.0)).lower is None
