"""Gates: whether a sample is used, and what is told of it."""

from __future__ import annotations

import copy

import numpy as np
import pytest

import forgetting as fg


def record(samples=120, parameters=3, rows=1, targets=1, seed=4):
    """Regressors and outputs; the middle third is silent."""
    random = np.random.default_rng(seed)
    phi = random.normal(size=(samples, rows, parameters))
    phi[samples // 3 : 2 * samples // 3] *= 1e-4
    y = phi @ random.normal(size=(parameters, targets))
    return phi, y + 0.1 * random.normal(size=y.shape)


def gamma(rows):
    return np.eye(rows) + 0.3 if rows > 1 else 1.3


GATES = [
    fg.MinimumInformation(1e-3),
    fg.MinimumInformation(1e-3, otherwise="freeze"),
    fg.DeadZone(0.1),
    fg.DeadZone(0.1, otherwise="freeze"),
]


@pytest.mark.parametrize("gate", GATES, ids=repr)
def test_updates_and_a_run_say_the_same(gate):
    phi, y = record(rows=2, targets=2)
    every = ["theta", "gate", "skipped", "whitened_innovation", "prior_covariance", "leverage"]
    one, other = (fg.RLS(3, rows=2, targets=2, rule="exponential", gate=gate) for _ in range(2))
    run = one.run(phi, y, gamma(2), outputs=every)
    for k in range(len(phi)):
        before = other.to_bytes()
        update = other.update(phi[k], y[k], gamma(2))
        assert fg.GATE[int(run.gate[k])] == update.gate
        assert fg.SKIPPED[int(run.skipped[k])] == update.skipped
        assert np.array_equal(run.whitened_innovation[k], update.whitened_innovation)
        assert run.leverage[k] == update.leverage
        if update.gate == "hold":
            assert update.skipped == "gate" and other.to_bytes() == before
        if update.gate != "update":
            assert update.forgetting_factor == 1.0 and update.rank == 0
    assert one.to_bytes() == other.to_bytes()
    assert len(set(run.gate.tolist())) == 2, "the gate both opens and shuts"


def test_silence_behind_a_gate_does_not_wind_up():
    phi, y = record(3000)
    largest = {}
    for gate in (None, fg.MinimumInformation(1e-3)):
        est = fg.RLS(3, rule=fg.Exponential(0.98), gate=gate, monitor=True)
        est.run(phi[:2000], y[:2000, 0])
        largest[gate] = est.covariance.diagonal().max()
    assert largest[None] > 1e6
    assert largest[fg.MinimumInformation(1e-3)] < 1.0


def test_a_callable_is_a_gate():
    seen = []

    def gate(evidence):
        seen.append((evidence.error, evidence.leverage, evidence.normalized_error))
        return ["update", "freeze", "hold"][len(seen) % 3]

    est = fg.RLS(2, gate=gate, weighting=fg.Huber(1.0), initial_covariance=100.0)
    update = est.update([1.0, 2.0], 30.0)
    # not clipped by the weighting; P before forgetting
    assert seen == [(30.0, 500.0, pytest.approx(900 / 501))]
    assert update.gate == "freeze" and est.samples == 1
    assert est.update([1.0, 2.0], 3.0).skipped == "gate" and est.samples == 1
    assert est.gate.parameters["function"] is gate
    with pytest.raises(fg.InvalidInput, match="function of yours cannot be saved"):
        est.to_bytes()


@pytest.mark.parametrize("answer", ["maybe", None, 1, True])
def test_any_other_answer_refuses_the_sample(answer):
    est = fg.RLS(1, gate=lambda evidence: answer)
    with pytest.raises(fg.InvalidInput, match=f"gate answered {answer!r}, allowed"):
        est.update([1.0], 1.0)
    with pytest.raises(fg.InvalidInput, match="allowed"):
        est.run(np.ones((3, 1)), np.ones(3))
    assert est.samples == 0 and est.theta[0] == 0.0


def test_an_exception_of_the_callable_comes_through():
    def gate(evidence):
        raise KeyError("valve")

    with pytest.raises(KeyError, match="valve"):
        fg.RLS(1, gate=gate).update([1.0], 1.0)


@pytest.mark.parametrize("gate", [*GATES, fg.Open()], ids=repr)
@pytest.mark.parametrize("dtype", ["float64", "float32"])
def test_is_kept_by_a_save_and_a_copy(gate, dtype):
    est = fg.RLS(2, gate=gate, dtype=dtype)
    for twin in (fg.RLS.from_bytes(est.to_bytes()), copy.deepcopy(est), est):
        assert twin.gate == gate


@pytest.mark.parametrize(
    ("gate", "words"),
    [
        ("shut", 'gate = "shut" is not known'),
        (fg.DeadZone, "a name or a gate object"),
        (fg.Subspace(), 'gate = "subspace" is not known'),
        (7, "gate = 7, allowed: a name or a gate object"),
        (fg.DeadZone(-1.0), "width = -1, allowed"),
        (fg.MinimumInformation(0.0), "information = 0, allowed"),
        (fg.DeadZone(1.0, otherwise="skip"), "otherwise"),
    ],
)
def test_bad_gates_are_refused(gate, words):
    with pytest.raises(fg.InvalidInput) as refused:
        fg.RLS(2, gate=gate)
    assert words in str(refused.value)


@pytest.mark.parametrize("rows", [1, 3])
@pytest.mark.parametrize("rule", ["exponential", "subspace"])
def test_whitened_innovations_are_those_of_the_prior_covariance(rows, rule):
    phi, y = record(rows=rows, targets=2)
    est = fg.RLS(3, rows=rows, targets=2, rule=rule)
    wanted = ("error", "whitened_innovation", "prior_covariance")
    run = est.run(phi, y, gamma(rows), outputs=wanted)
    for k in range(len(phi)):
        spread = gamma(rows) * np.eye(rows) if rows == 1 else gamma(rows)
        root = np.linalg.cholesky(spread + phi[k] @ run.prior_covariance[k] @ phi[k].T)
        expected = np.linalg.solve(root, run.error[k])
        assert np.allclose(run.whitened_innovation[k], expected, rtol=1e-9, atol=1e-12)


def test_the_prior_covariance_of_a_missing_sample_is_the_covariance():
    est = fg.RLS(2, rule=fg.Exponential(0.5), initial_covariance=4.0)
    phi = np.array([[1.0, 0.0], [np.nan, 0.0], [1.0, 0.0]])
    wanted = ("prior_covariance", "covariance", "whitened_innovation", "gate")
    run = est.run(phi, np.ones(3), outputs=wanted, missing="skip")
    assert np.array_equal(run.prior_covariance[0], 8.0 * np.eye(2))
    assert np.array_equal(run.prior_covariance[1], run.covariance[0])
    assert np.allclose(run.prior_covariance[2], 2.0 * run.covariance[1], rtol=1e-15)
    assert np.isnan(run.whitened_innovation).tolist() == [False, True, False]
    assert run.gate.tolist() == [0, 0, 0]
