"""Choices by their parameters, as scikit-learn reads and sets them; it is not needed for that."""

from __future__ import annotations

import copy
import pickle

import pytest

import forgetting as fg
from forgetting.choices import AXES

ENTRIES = [kind for axis in AXES.values() for kind in axis.classes.values()]
NEEDED = {
    "function": lambda *given: 0.9,
    "forgetting_matrix": lambda *given: 0.0,
    "process_noise": 0.01,
    "factors": [0.9, 0.99],
    "schedule": [0.9, 0.95],
}


def made(kind):
    required = [entry["name"] for entry in kind.about["parameters"] if entry["required"]]
    return kind(**{name: NEEDED[name] for name in required})


@pytest.mark.parametrize("kind", ENTRIES, ids=lambda kind: kind.__name__)
def test_parameters_make_the_same_again(kind):
    choice = made(kind)
    given = choice.get_params(deep=False)
    assert kind(**given) == choice
    assert copy.deepcopy(choice).set_params(**choice.get_params()) == choice
    # a copy is made of what it was told, and told the same objects
    again = choice.__sklearn_clone__()
    assert again is not choice
    assert again == choice


def test_parameters_of_choices_are_set_all_or_none():
    rule = fg.CovarianceResetting(rule=fg.Subspace(0.98))
    rate = fg.Fortescue(memory=20.0)
    assert rule.set_params(period=7, rule__forgetting_factor=rate) is rule
    assert rule == fg.CovarianceResetting(rule=fg.Subspace(fg.Fortescue(memory=20.0)), period=7)
    rule.set_params(rule__forgetting_factor__memory=30.0)
    assert rule.get_params()["rule__forgetting_factor__memory"] == 30.0
    assert rate == fg.Fortescue(memory=20.0)  # what was handed in stays as it was
    before = repr(rule)
    for wrong in ({"period": 8, "perio": 9}, {"period": 8, "rule__x": 1}, {"period__x": 1}):
        with pytest.raises(fg.InvalidInput, match="no parameter"):
            rule.set_params(**wrong)
        assert repr(rule) == before


def test_a_half_life_is_set_in_the_place_of_the_factor():
    rule = fg.Subspace(0.9).set_params(half_life=5)
    assert rule == fg.Subspace(half_life=5)
    assert rule.set_params(forgetting_factor=0.9) == fg.Subspace(0.9)
    with pytest.raises(fg.InvalidInput, match="forgetting_factor and half_life"):
        rule.set_params(forgetting_factor=0.9, half_life=5)


def test_factors_in_the_place_of_a_factor_stay_there():
    rule = fg.Component([0.9, 0.8])
    assert rule.get_params()["forgetting_factor"] is None
    assert pickle.loads(pickle.dumps(rule)) == rule
    assert fg.Component(**rule.get_params()) == rule
