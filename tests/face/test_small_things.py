"""What everyone tries first."""

from __future__ import annotations

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
