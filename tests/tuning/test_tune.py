"""The search: chosen on the first part only, whatever the units, and reported on the rest."""

from __future__ import annotations

import numpy as np
import pytest

import forgetting as fg
from forgetting.tuning import grid
from forgetting.tuning.candidate import Candidate
from forgetting.tuning.code import code, estimator_code, model_code
from forgetting.tuning.runner import Trial
from forgetting.tuning.worth import preferred

KEY = {"bank", "no_forgetting", "last_value"}


def drifting(samples=1200, n=3, drift=0.05, seed=0, outputs=1):
    """Parameters that walk, white regressors, some noise."""
    random = np.random.default_rng(seed)
    phi = random.normal(size=(samples, n))
    theta = 1 + np.cumsum(drift * random.normal(size=(samples, n, outputs)), axis=0)
    y = np.einsum("ti,tij->tj", phi, theta) + 0.2 * random.normal(size=(samples, outputs))
    return phi, y[:, 0] if outputs == 1 else y


def tried(found):
    """Everything that was tried, as Python says it, and its error."""
    return [(code(t.candidate.rule), t.candidate.initial_covariance, t.error) for t in found.trials]


def test_what_is_chosen_predicts_the_rest_as_it_says():
    phi, y = drifting()
    found = fg.tune(phi, y)
    estimator = eval(found.python)
    error = np.asarray(estimator.run(phi, y, outputs=("error",)).error)
    rest = error[found.split.row :]
    assert found.rest.errors["tuned"][0] == pytest.approx(np.sqrt(np.mean(rest**2)), rel=1e-12)
    assert found.split.row == 800 and found.split.reporting.sum() == 400
    assert found.rest.errors["tuned"] < found.rest.errors["no_forgetting"]
    assert found.rest.differences["no_forgetting"].beyond_chance
    assert set(found.rest.differences) == KEY


def test_the_chosen_has_the_least_error_of_all_but_the_margin():
    """A bounded rule, a plain factor and the usual prior each may cost the margin of 0.5 %."""
    phi, y = drifting()
    found = fg.tune(phi, y)
    rules = [t.error for t in found.trials if t.candidate.rule is not None]
    assert found.best.error <= min(rules) / 0.995**3
    stages = {trial.stage for trial in found.trials}
    assert stages == {"bank", "factors", "parameters", "rates", "priors"} - (
        {"priors"} if found.rule.parameters else set()
    )


def test_the_rest_has_no_say_in_the_choice():
    phi, y = drifting()
    one = fg.tune(phi, y)
    other_y, other_phi = y.copy(), phi.copy()
    other_y[800:] = np.random.default_rng(9).normal(size=400) * 50
    other_phi[800:] *= 7
    other = fg.tune(other_phi, other_y)
    assert tried(one) == tried(other) and one.python == other.python
    assert one.rest.errors["tuned"] != other.rest.errors["tuned"]


def test_parameters_that_stand_still_are_not_forgotten():
    phi, y = drifting(drift=0.0)
    found = fg.tune(phi, y)
    assert found.rest.error("tuned") < 1.01 * found.rest.error("no_forgetting")
    assert not found.rest.differences["no_forgetting"].beyond_chance
    only = fg.tune(phi, y, rules="none")
    assert only.python == "fg.RLS(3, rule=fg.NoForgetting())"
    assert "What was chosen is no forgetting." in only.verdicts()


@pytest.mark.parametrize("outputs", [1, 2])
def test_units_change_neither_choice_nor_verdict(outputs):
    phi, y = drifting(outputs=outputs)
    units, unit = np.array([1e6, 1e-5, 30.0]), 1e-4 if outputs == 1 else np.array([1e5, 1e-3])
    one, other = fg.tune(phi, y), fg.tune(phi * units, y * unit)
    assert [(type(t.candidate.rule), t.stage) for t in one.trials] == [
        (type(t.candidate.rule), t.stage) for t in other.trials
    ]
    scale = float(np.prod(np.atleast_1d(unit)) ** (1 / outputs))
    # the mixer of a bank weighs several outputs in the units that they are given in
    counts = [outputs == 1 or t.candidate.rule is not None for t in one.trials]
    ours = np.array([t.error for t in one.trials])[counts]
    theirs = np.array([t.error for t in other.trials])[counts] / scale
    # six digits of what is given in the units of the user, and their rounding
    assert np.allclose(ours, theirs, rtol=1e-4)
    assert type(one.rule) is type(other.rule)
    for name, difference in one.rest.differences.items():
        if name == "bank" and outputs > 1:
            continue
        assert other.rest.differences[name].p_value == pytest.approx(difference.p_value, rel=1e-3)


def test_threads_and_progress_change_nothing():
    phi, y = drifting(600)
    told = []
    one = fg.tune(phi, y, threads=1, progress=lambda *counts: told.append(counts))
    other = fg.tune(phi, y, threads=4)
    assert tried(one) == tried(other)
    assert [done for done, _ in told[:-1]] == list(range(1, one.runs + 1))
    assert told[-1] == (one.runs, one.runs) and all(done <= total for done, total in told)


@pytest.mark.parametrize("rules", ["shortlist", "all"])
def test_the_number_of_runs_is_bounded(rules):
    phi, y = drifting(400)
    found = fg.tune(phi, y, rules=rules)
    names = grid.named_rules(rules)
    assert found.runs <= 13 * len(names) + 2 * 34 + 20
    assert len({repr(trial.candidate) for trial in found.trials}) == found.runs


def test_a_rule_that_may_wind_up_must_be_worth_it():
    bounded = Trial(Candidate(fg.Subspace(0.9)), 1.0, "factors")
    for error, wanted in ((0.996, "subspace"), (0.994, "exponential")):
        unbounded = Trial(Candidate(fg.Exponential(0.9)), error, "factors")
        assert preferred([unbounded, bounded]).candidate.rule.name == wanted
        assert preferred([unbounded]) is unbounded


def test_a_rate_is_proposed_where_it_pays():
    random = np.random.default_rng(4)
    phi = random.normal(size=(3000, 3))
    theta = np.repeat(random.normal(size=(10, 3)), 300, axis=0)
    y = (phi * theta).sum(axis=1) + 0.3 * random.normal(size=3000)
    found = fg.tune(phi, y, rules=["none", "exponential"])
    assert isinstance(found.rule.forgetting_factor, fg.Rate)
    assert eval(found.python).rule == found.rule
    plain = fg.tune(phi, y, rules=["none", "exponential"], rates=False)
    assert found.rest.error("tuned") < plain.rest.error("tuned")


def test_a_choice_that_fails_on_the_rest_is_told(monkeypatch):
    phi, y = drifting(6000, 2, drift=0.5)
    errors = Candidate.errors

    def fail(candidate, problem, stop=None):
        chosen = candidate.rule is not None and candidate.rule.about["name"] == "exponential"
        if stop is None and chosen:
            raise fg.NumericalRange("sample 5000: too large")
        return errors(candidate, problem, stop)

    monkeypatch.setattr(Candidate, "errors", fail)
    found = fg.tune(phi, y, rules=["exponential"], rates=False, priors=False)
    assert found.rest.failed is not None and found.rest.error("tuned") == np.inf
    assert found.bank_is_better
    assert found.verdicts()[0].startswith("What was chosen did not get through the rest: ")
    assert found.summary()["errors_on_rest"]["tuned"]["y0"] is None


def test_missing_samples_are_left_out():
    phi, y = drifting()
    phi[100:200, 1], y[900:950] = np.nan, np.nan
    found = fg.tune(phi, y)
    assert found.split.row == 100 + int(1050 * 2 / 3)
    assert found.split.reporting.sum() == 350
    assert np.isfinite(found.rest.error("tuned"))


def test_every_rate_is_tried_or_known_not_to_be():
    names = {entry["name"] for entry in fg.rates()}
    assert names == set(grid.RATES) | set(grid.NOT_TRIED)


@pytest.mark.parametrize("name", grid.named_rules("all"))
def test_code_makes_the_same_rule(name):
    plain = grid.plain_rule(name)
    assert eval(code(plain)) == plain
    if plain.about["forgetting_factor"]:
        for rate in grid.rates(1):
            rule = fg.rule(name, forgetting_factor=rate)
            assert eval(code(rule)) == rule


def test_code_of_several_outputs_and_of_a_prior():
    phi, y = drifting(outputs=2)
    found = fg.tune(phi, y, rates=False)
    for line in (found.lines.python, found.lines_of_bank.python):
        assert eval(line).targets == 2
    line = estimator_code(Candidate(fg.Exponential(0.9), (1e-7, 2.0, 3e9)), 3, 1)
    assert np.allclose(eval(line).covariance, np.diag([1e-7, 2.0, 3e9]), rtol=1e-12)
    line = model_code(Candidate(fg.Exponential(0.9), (0.5, 2.0), fg.models.Orders(1, 1, 1)))
    assert np.allclose(eval(line).fit([0.0], [0.0]).covariance_, np.diag([0.5, 2.0]))


def test_without_noise_it_goes_through():
    phi, _ = drifting(400)
    for y in (phi @ [1.0, 2.0, 3.0], np.zeros(400)):
        found = fg.tune(phi, y)
        assert found.rest.error("tuned") < 1e-6
        assert eval(found.python).parameters == 3


def test_orders_are_found():
    random = np.random.default_rng(1)
    u, y = random.normal(size=1200), np.zeros(1200)
    for k in range(4, 1200):
        y[k] = 1.2 * y[k - 1] - 0.5 * y[k - 2] + 0.8 * u[k - 3] + 0.3 * u[k - 4]
        y[k] += 0.02 * random.normal()
    found = fg.tune_arx(u, y, rates=False, priors=False)
    assert found.orders == fg.models.Orders(2, 2, 3)
    model = eval(found.python).fit(u, y)
    assert np.allclose(model.theta_, [1.2, -0.5, 0.8, 0.3], atol=0.05)
    alone = fg.tune_arx(None, y, na=[1, 2], rates=False, priors=False)
    assert alone.orders.nb == 0
    assert eval(alone.python).fit(None, y).samples_ == 1200


@pytest.mark.parametrize(
    ("arguments", "words"),
    [
        ({"share": 1.0}, r"share = 1, allowed: between 0 and 1"),
        ({"share": 0.99}, "12 to report on; at least 50 and 30"),
        ({"rules": "subspce"}, "rule = 'subspce', allowed: shortlist, all, none"),
        ({"rules": ["custom"]}, "rule = 'custom'"),
        ({"rules": []}, "allowed: shortlist, all, or names of rules"),
        ({"threads": 0}, "threads = 0, allowed: 1 or more"),
    ],
)
def test_bad_input_is_one_sentence(arguments, words):
    phi, y = drifting()
    with pytest.raises(fg.InvalidInput, match=words):
        fg.tune(phi, y, **arguments)


def test_bad_orders_are_refused():
    phi, y = drifting()
    with pytest.raises(fg.InvalidInput, match="phi has 1200 rows and y has 1199"):
        fg.tune(phi, y[1:])
    with pytest.raises(fg.InvalidInput, match="400 models are to be tried, allowed: 1 to 300"):
        fg.tune_arx(phi[:, 0], y, na=range(1, 11), nb=range(1, 11))
    with pytest.raises(fg.InvalidInput, match="nb is 0 where there is no input"):
        fg.tune_arx(None, y, nb=2)
