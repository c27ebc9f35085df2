"""`fg.tune_model`: orders of a named structure, for arrays."""

from __future__ import annotations

import numpy as np
import pytest

import forgetting as fg
from forgetting.models.named import CLASSES, NamedModel
from forgetting.tuning.structures import models_of, widest_of
from reference.polynomial import SYSTEMS, record

FAST = {"rules": ["none"], "rates": False, "priors": False}


def test_every_structure_of_the_registry_has_its_class():
    assert list(CLASSES) == list(fg._core.structures())


@pytest.mark.parametrize(
    ("name", "said", "expected"),
    [
        ("armax", "armax:na=1-2,nb=2,nc=0-2,nk=0-2", "armax:na=2,nb=2,nc=2,nk=1"),
        ("oe", "oe:nb=1-2,nf=1-3,nk=1", "oe:nb=2,nf=2,nk=1"),
        ("arma", "arma:na=1-2,nc=0-2", "arma:na=1,nc=1"),
    ],
)
def test_the_orders_of_simulated_systems_are_found(name, said, expected):
    u, y = record(SYSTEMS[name], 1, 4000)
    found = fg.tune_model(u, y, said, **FAST)
    assert str(found.orders) == expected
    model = eval(found.python).fit(u, y)
    assert np.abs(model.theta_ - SYSTEMS[name].theta).max() < 0.25


def test_errors_are_those_of_the_models_whatever_is_missing():
    u, y = record(SYSTEMS["armax"], 2, 1500)
    u, y = u + 5.0, y + 70.0
    u[300], y[500:503] = np.nan, np.nan
    found = fg.tune_model(u, y, "armax:na=2,nb=2,nc=1-2,nk=1", offset=True, **FAST)
    tried = {trial.candidate.orders: trial for trial in found.trials if trial.stage == "orders"}
    assert len(tried) == 2
    for named, choosing in ((each, found.split.choosing) for each in tried):
        rules = [t.candidate.rule for t in found.trials if t.candidate.orders == named]
        for rule in filter(None, rules):
            error = named.make(offset=True, rule=rule).course(u, y, "error")["error"]
            scored = np.sqrt(np.mean(error[choosing] ** 2))
            known = [
                t.error
                for t in found.trials
                if t.candidate.orders == named and t.candidate.rule == rule
            ]
            assert known == pytest.approx([scored], rel=1e-12)
    assert not found.split.choosing[[300, 301, 500, 501, 502, 503, 504]].any()
    assert "offset=True" in found.python


def test_linear_structures_are_those_of_tune_arx():
    u, y = record(SYSTEMS["armax"], 0, 800)
    by_name = fg.tune_model(u, y, "arx:na=1-2,nb=1-2,nk=1-2", **FAST)
    by_orders = fg.tune_arx(u, y, na=[1, 2], nb=[1, 2], nk=[1, 2], **FAST)
    assert by_name.summary() == by_orders.summary()
    fir = fg.tune_model(u, y, "fir:nb=3-5,nk=1", **FAST)
    assert (fir.orders.na, fir.orders.nk) == (0, 1)


def test_units_change_no_choice():
    u, y = record(SYSTEMS["oe"], 0, 1200)
    one = fg.tune_model(u, y, "oe:nb=1-2,nf=1-2,nk=1", rates=False)
    two = fg.tune_model(1e3 * u, 1e-5 * y, "oe:nb=1-2,nf=1-2,nk=1", rates=False)
    assert (one.orders, one.rule.name) == (two.orders, two.rule.name)
    assert two.rest.error("tuned") == pytest.approx(1e-5 * one.rest.error("tuned"), rel=1e-6)


def test_lags_of_all_models_are_held_by_the_widest():
    models = models_of("bj:nb=2/1,nc=1-2,nd=1,nf=1,nk=0-3", 2)
    assert len(models) == 8
    widest = widest_of(models, 2)
    assert widest == NamedModel.parse("bj:nc=2,nd=1,nf=1,nb=5/4,nk=0")


def test_what_does_not_go_is_refused():
    u, y = record(SYSTEMS["oe"], 0, 400)
    with pytest.raises(fg.InvalidInput, match="y has 2 outputs; a model oe has one"):
        fg.tune_model(u, np.column_stack([y, y]), "oe:nb=1,nf=1", **FAST)
    with pytest.raises(fg.InvalidInput, match="has no coefficient"):
        fg.tune_model(None, y, "arma:na=0,nc=0", **FAST)
    with pytest.raises(fg.InvalidInput, match="at least 50 and 30"):
        fg.tune_model(u[:40], y[:40], "oe:nb=1,nf=1,nk=1", **FAST)
