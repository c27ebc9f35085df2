"""What everyone tries first."""

from __future__ import annotations

import pickle

import numpy as np
import pytest

import forgetting as fg

PHI, Y = np.random.default_rng(0).normal(size=(30, 2)), np.arange(30.0)


def test_a_forgetting_factor_without_a_rule():
    est = fg.RLS(2, forgetting_factor=0.98)
    assert est.rule == fg.Subspace(0.98)
    assert fg.RLS(2, rule="exponential", forgetting_factor=0.9).rule == fg.Exponential(0.9)
    assert fg.RLS(2, rule=fg.Exponential(0.5), forgetting_factor=0.9).rule == fg.Exponential(0.9)
    rate = fg.NoisePower()
    assert fg.RLS(2, forgetting_factor=rate).rule == fg.Subspace(rate)
    inner = fg.RLS(2, rule=fg.CovarianceResetting("exponential"), forgetting_factor=0.9)
    assert inner.rule.forgetting_factor == 0.9
    for rule in ("none", "random_walk", "multiple"):
        with pytest.raises(fg.InvalidInput, match=f"forgetting_factor .*{rule}"):
            fg.RLS(2, rule=rule, forgetting_factor=0.9)
    for factor in (0.0, 1.5, "often"):
        with pytest.raises(fg.InvalidInput):
            fg.RLS(2, forgetting_factor=factor)


@pytest.mark.parametrize("dtype", [np.float32, np.dtype("float32"), "float32"])
def test_number_types_of_numpy(dtype):
    assert fg.RLS(2, dtype=dtype).theta.dtype == np.float32
    assert fg.Bank(2, dtype=dtype).dtype == "float32"
    assert fg.Fleet(3, 2, dtype=dtype).dtype == "float32"


def test_other_number_types_are_refused():
    for dtype in (np.int64, "float16", "real"):
        with pytest.raises(fg.InvalidInput, match="dtype"):
            fg.RLS(2, dtype=dtype)


@pytest.mark.parametrize("make", [fg.RLS, fg.Bank])
def test_one_output_by_its_name(make):
    run = make(2).run(PHI, Y, outputs="error")
    assert run.error.shape == Y.shape and run.theta is None
    normalized = run.error**2 / (1 + make(2).run(PHI, Y, outputs="leverage").leverage)
    assert normalized.shape == Y.shape


@pytest.mark.parametrize("make", [fg.RLS, fg.Bank])
def test_errors_have_the_shape_of_y(make):
    for shape in ((30,), (30, 1), (30, 1, 1)):
        assert make(2).run(PHI, Y.reshape(shape)).error.shape == shape
    two = make(2, targets=2).run(PHI, np.column_stack([Y, -Y]))
    assert two.error.shape == (30, 2)


@pytest.mark.parametrize("make", [fg.RLS, fg.Bank])
def test_a_missing_sample_on_request(make):
    est = make(2)
    est.run(PHI, Y)
    before = est.to_bytes()
    for phi, y in (([np.nan, 1.0], 1.0), ([1.0, 1.0], np.nan)):
        update = est.update(phi, y, missing="skip")
        assert update.skipped == "missing" and np.isnan(update.error)
        with pytest.raises(fg.InvalidInput):
            est.update(phi, y)
    with pytest.raises(fg.InvalidInput, match="missing"):
        est.update(PHI[0], 1.0, missing="drop")
    assert est.to_bytes() == before
    assert est.update(PHI[0], 1.0, missing="skip").skipped is None


@pytest.mark.parametrize("make", [fg.RLS, fg.Bank])
def test_results_print_in_one_line_and_pickle(make):
    est = make(2, targets=2)
    run = est.run(PHI, np.column_stack([Y, -Y]))
    update, other = est.update(PHI[0], [1.0, 2.0]), make(2).update(PHI[0], 1.0)
    fleet = fg.Fleet(2, 2).update(PHI[:2], Y[:2])
    assert repr(run).startswith("Run(30 samples, 30 used; theta (30, 2, 2), error (30, 2)")
    for each in (run, update, other, fleet):
        assert "\n" not in repr(each)
        copy = pickle.loads(pickle.dumps(each))
        assert type(copy) is type(each) and repr(copy) == repr(each)
        for name in dir(each):
            one, two = getattr(each, name), getattr(copy, name)
            if not name.startswith("_") and not callable(one):
                assert np.array_equal(np.asarray(one), np.asarray(two))


def test_an_unknown_name_is_answered_with_those_that_there_are():
    for make in (fg.RLS, fg.Fleet):
        arguments = (2,) if make is fg.RLS else (2, 2)
        with pytest.raises(fg.InvalidInput, match=r"rule = .subspase. .*subspace"):
            make(*arguments, rule="subspase")
    with pytest.raises(fg.InvalidInput, match=r"weighting = .hubert. .*huber"):
        fg.Bank(2, weighting="hubert")


def test_a_fleet_may_start_empty():
    for rule in (None, "efra"):
        fleet = fg.Fleet(0, 2, rule=rule)
        assert len(fleet) == 0 and fleet.theta.shape == (0, 2)
        assert fleet.update(np.zeros((0, 2)), np.zeros(0)).used == 0
        assert fleet.health().status.tolist() == []
        fleet.append(3)
        other = fg.Fleet(3, 2, rule=rule)
        for each in (fleet, other):
            each.update(PHI[:3], Y[:3])
        assert [fleet[i].to_bytes() for i in range(3)] == [other[i].to_bytes() for i in range(3)]
        assert fg.Fleet.from_arrow(fg.Fleet(0, 2, rule=rule).to_arrow()).count == 0
    with pytest.raises(fg.InvalidInput, match="count"):
        fg.Fleet(-1, 2)
