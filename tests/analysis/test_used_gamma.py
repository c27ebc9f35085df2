"""The Γ that a sample was really taken with is told, and every theorem stands on it."""

from __future__ import annotations

import numpy as np
import pytest

import forgetting as fg
from forgetting.analysis import Trajectory, confidence

OUTPUTS = ("error", "leverage", "skipped", "whitened_innovation", "weight", "covariance")
GAMMA = 0.7


def names() -> list[str]:
    given = {"function"}
    return [
        about["name"]
        for about in fg.rules()
        if not any(p["kind"] in given for p in about["parameters"])
    ]


def record(samples: int = 120) -> tuple[np.ndarray, np.ndarray]:
    rng = np.random.default_rng(5)
    phi = rng.standard_normal((samples, 3))
    y = phi @ [1.0, -2.0, 0.5] + 0.3 * rng.standard_normal(samples)
    y[::17] += 8.0
    return phi, y


@pytest.mark.parametrize("weighting", ["equal", "huber", "student_t"])
@pytest.mark.parametrize("name", names())
def test_leverage_weight_and_innovation_are_those_of_the_sample_as_it_was_used(
    name: str, weighting: str
) -> None:
    phi, y = record()
    make = lambda: fg.RLS(3, rule=name, weighting=weighting, initial_covariance=4.0)  # noqa: E731
    run = make().run(phi, y, gamma=GAMMA, outputs=(*OUTPUTS, "prior_covariance"))
    est, changed = make(), False
    for k in range(len(phi)):
        update = est.update(phi[k], y[k], gamma=GAMMA)
        assert (update.weight, update.leverage) == (run.weight[k], run.leverage[k])
        if run.skipped[k]:
            continue
        prior = run.prior_covariance[k]
        spread = phi[k] @ prior @ phi[k] / GAMMA
        # what the weighting did, apart from what the rule did, is in the leverage alone
        own = run.leverage[k] / spread
        assert own <= 1 + 1e-9
        used = run.weight[k] * np.outer(phi[k], phi[k]) / GAMMA
        after = np.linalg.inv(np.linalg.inv(prior) + used)
        assert run.covariance[k] == pytest.approx(after, rel=1e-6, abs=1e-9), k
        white = run.error[k] / np.sqrt(GAMMA / own * (1 + run.leverage[k]))
        assert run.whitened_innovation[k] == pytest.approx(white, rel=1e-7)
        if weighting == "equal":
            assert own == pytest.approx(1.0, rel=1e-7)
        changed |= run.weight[k] != 1.0
    assert changed == (weighting != "equal" or name in {"efra", "data_dependent"})
    assert run.reweighted == changed


@pytest.mark.parametrize("rule", [fg.Efra(0.98), fg.DataDependent(noise_bound=0.5)])
@pytest.mark.parametrize("weighting", ["equal", "huber"])
def test_a_trajectory_obeys_theorem_1(rule: fg.Rule, weighting: str) -> None:
    phi, y = record()
    est = fg.RLS(3, rule=rule, weighting=weighting, initial_covariance=4.0)
    run = est.run(phi, y, gamma=GAMMA, outputs=(*OUTPUTS, "prior_covariance"))
    path = Trajectory.from_run(run, phi, gamma=GAMMA, initial_covariance=4.0)
    gained = np.linalg.inv(path.after) - np.linalg.inv(path.prior)
    wanted = np.einsum("tpi,tpj->tij", path.phibar, path.phibar)
    size = np.abs(np.linalg.inv(path.after)).max()
    assert np.abs(gained - wanted).max() < 1e-9 * size
    without = est.run(phi, y, gamma=GAMMA, outputs=("covariance",))
    with pytest.raises(fg.InvalidInput, match=r"run\.weight"):
        Trajectory.from_run(without, phi, gamma=GAMMA, initial_covariance=4.0)


def test_standard_errors_of_a_rule_that_sets_its_own_weights() -> None:
    """Fixed parameters, white noise: the true deviation over many records, within a half."""
    rng = np.random.default_rng(6)
    phi = rng.standard_normal((300, 2))
    found, stated = [], []
    for _ in range(150):
        y = phi @ [1.0, -1.0] + 0.3 * rng.standard_normal(300)
        est = fg.RLS(2, rule=fg.DataDependent(noise_bound=0.3), initial_covariance=4.0)
        run = est.run(phi, y, outputs=(*OUTPUTS, "prior_covariance"))
        told = confidence(run, phi, initial_covariance=4.0, noise_variance=0.09)
        found.append(est.theta - [1.0, -1.0])
        stated.append(told.fixed_standard_error[-1, :, 0])
    true = np.std(found, axis=0)
    assert np.mean(stated, axis=0) == pytest.approx(true, rel=0.5)
