"""A1-A8, their constants and what follows from them, against dense brute force."""

import json

import dense_gf_rls as dense
import numpy as np
import pytest

from forgetting import InvalidInput
from forgetting.analysis import (
    Trajectory,
    conditions,
    excitation,
    lyapunov,
    lyapunov_decrease,
    observed_decrease,
    stability,
    trend,
)


def _brute(phi, path, prior, window):
    """a, b, α, β, c_N by definition, one matrix at a time."""
    a = min(np.linalg.eigvalsh(P)[0] for P in path)
    b = max(np.linalg.eigvalsh(P)[-1] for P in prior)
    sums = [
        sum(f.T @ f for f in phi[k : k + window]) for k in range(len(phi) - window + 1)
    ]  # fmt: skip
    alpha = min(np.linalg.eigvalsh(S)[0] for S in sums)
    beta = max(np.linalg.svd(f)[1][0] ** 2 for f in phi)
    size = (1 + b * beta) * (1 + (window - 1) / 2 * (b * beta) ** 2)
    return a, b, alpha, beta, alpha / window / size


def _compare(trajectory, path, window):
    found = conditions(trajectory, window=window)
    known = found.constants
    a, b, alpha, beta, c_N = _brute(trajectory.phibar, path, trajectory.prior, window)
    assert known["a"] == pytest.approx(a, rel=1e-10)
    assert known["b"] == pytest.approx(b, rel=1e-12)
    assert known["alpha"] == pytest.approx(alpha, rel=1e-8, abs=1e-13 * beta * window)
    assert known["beta"] == pytest.approx(beta, rel=1e-12)
    if alpha > 0:
        assert lyapunov_decrease(alpha, beta, b, window) == pytest.approx(c_N, rel=1e-12)
    return found


@pytest.mark.parametrize("rows", [1, 2])
@pytest.mark.parametrize("window", [3, 10])
def test_constants_on_random_records(rows, window):
    rng = np.random.default_rng(rows + window)
    phi = dense.exciting(rng, 1, 80, rows, 3, window)
    for rule in (dense.exponential(0.9), dense.random_walk(0.1 * np.eye(3))):
        trajectory = dense.simulate(rule, phi, None, 2 * np.eye(3)).trajectory()
        path = [*trajectory.before, trajectory.after[-1]]
        found = _compare(trajectory, path, window)
        assert stability(found).decrease == pytest.approx(
            _brute(trajectory.phibar, path, trajectory.prior, window)[-1], rel=1e-9
        )


def test_constants_on_measured_records(measured):
    phi = measured[0][:400]
    scale = np.abs(phi).max(axis=0)
    trajectory = dense.simulate(
        dense.exponential(0.98), (phi / scale)[None, :, None, :], None, np.eye(phi.shape[1])
    ).trajectory()
    _compare(trajectory, [*trajectory.before, trajectory.after[-1]], 100)


@pytest.mark.parametrize("rule", ["exponential", "subspace"])
def test_constants_on_the_papers_records(of_a_paper, rule):
    phi = of_a_paper[:200]
    made = {"exponential": dense.exponential(0.98), "subspace": dense.subspace(0.98, 1e-4)}[rule]
    trajectory = dense.simulate(made, phi[None], None, np.eye(phi.shape[-1])).trajectory()
    _compare(trajectory, [*trajectory.before, trajectory.after[-1]], 50)


def test_observed_decrease_equals_the_products_written_out():
    rng = np.random.default_rng(2)
    phi = dense.exciting(rng, 1, 40, 1, 2, 4)
    trajectory = dense.simulate(dense.oblique_projection(0.9), phi, None, np.eye(2)).trajectory()
    expected = []
    for k in range(37):
        M = np.eye(2)
        for i in range(k, k + 4):
            f = trajectory.phibar[i]
            M = (np.eye(2) - trajectory.after[i] @ f.T @ f) @ M
        last = np.linalg.inv(trajectory.after[k + 3])
        expected.append(np.linalg.eigvalsh(np.linalg.inv(trajectory.before[k]) - M.T @ last @ M)[0])
    np.testing.assert_allclose(observed_decrease(trajectory, 4), expected, rtol=1e-9)


PROPER = {
    "none": dense.none(),
    "exponential": dense.exponential(0.9),
    "variable_rate": dense.variable_rate(np.linspace(0.8, 1.0, 80)),
    "exponential_resetting": dense.resetting(0.9, 0.2 * np.eye(3)),
    "variable_direction": dense.variable_direction(0.9, 0.1),
    "oblique_projection": dense.oblique_projection(0.9),
    "subspace": dense.subspace(0.9, 0.01),
    "random_walk": dense.random_walk(0.1 * np.eye(3)),
    "component_discount": dense.component_discount(np.array([0.9, 0.8, 0.99])),
    "restricted": dense.restricted(0.9),
}
IMPROPER = {
    "constant_trace": dense.constant_trace(1.0, 0.01),
    "multiple": dense.multiple(np.array([0.98, 0.98, 0.98])),
    "cyclic_resetting": dense.cyclic(0.9, 5.0),
    "vector_type": dense.vector_type(np.array([0.6, 0.99, 0.99])),
    "data_dependent_as_printed": dense.data_dependent_printed(np.resize([0.9, 0.2, 0.5, 0.1], 81)),
}


def _noise_free(rule, silent=False):
    rng = np.random.default_rng(9)
    phi = rng.normal(size=(20, 80, 1, 3)) * (rng.uniform(size=(20, 80, 1, 1)) < 0.5)
    if silent:
        phi[:, 40:] *= 1e-3
    truth = rng.normal(size=(20, 3))
    y = np.einsum("btpn,bn->btp", phi, truth)
    runs = dense.simulate(rule, phi, y, np.eye(3))
    return runs, runs.theta - truth[:, None, :]


def _values(runs, error, run):
    path = np.concatenate([runs.before[run], runs.after[run][-1:]])
    return lyapunov(error[run], path)


@pytest.mark.parametrize("name", PROPER)
@pytest.mark.parametrize("silent", [False, True])
def test_lyapunov_function_never_rises_without_noise(name, silent):
    runs, error = _noise_free(PROPER[name], silent)
    for run in range(len(error)):
        V = _values(runs, error, run)
        assert (np.diff(V) <= 1e-9 * V[0]).all()
        assert conditions(runs.trajectory(run), window=40)["A1"].verdict == "holds"


@pytest.mark.parametrize("name", IMPROPER)
def test_improper_rules_have_a_counterexample(name):
    runs, error = _noise_free(IMPROPER[name], silent=True)
    rises, verdicts = [], []
    for run in range(len(error)):
        V = _values(runs, error, run)
        rises.append(np.diff(V).max() / V[0])
        verdicts.append(conditions(runs.trajectory(run), window=40)["A1"])
    worst = int(np.argmax(rises))
    assert rises[worst] > 1e-3
    assert verdicts[worst].verdict == "fails"
    # A1 fails first no later than V rises first.
    V = _values(runs, error, worst)
    assert verdicts[worst].sample <= int(np.argmax(np.diff(V) > 1e-9 * V[0]))


def test_cyclic_resetting_is_improper_inside_a_cycle_only():
    phi = np.zeros((1, 60, 1, 3))
    trajectory = dense.simulate(dense.cyclic(0.9, 1.0), phi, None, np.eye(3)).trajectory()
    assert conditions(trajectory)["A1"].verdict == "fails"
    cycle = Trajectory.from_arrays(
        np.zeros((20, 1, 3)),
        np.concatenate([trajectory.before[::3], trajectory.after[-1:]]),
        prior_covariance=trajectory.after[2::3],
    )
    assert conditions(cycle)["A1"].verdict == "holds"


def test_exponential_resetting_is_improper_when_it_starts_below():
    phi = np.zeros((1, 60, 1, 2))
    trajectory = dense.simulate(
        dense.resetting(0.9, 4 * np.eye(2)), phi, None, np.eye(2)
    ).trajectory()
    found = conditions(trajectory)["A1"]
    assert (found.verdict, found.sample) == ("fails", 0)


def test_windup_leaves_b_open_and_the_trend_is_the_forgetting_factor():
    phi = np.zeros((1, 400, 1, 2))
    phi[0, :, 0, 0] = np.random.default_rng(1).normal(size=400)
    trajectory = dense.simulate(dense.exponential(0.98), phi, None, np.eye(2)).trajectory()
    found = conditions(trajectory)
    assert found["A2"].verdict == "not decidable"
    assert found["A2"].trend.slope == pytest.approx(-np.log(0.98), rel=1e-6)
    assert found["A4"].verdict == "fails" and found["A4"].sample == 0
    words = str(stability(found))
    assert "globally asymptotically stable does not follow (A4 fail)" in words
    assert "Lyapunov stable cannot be decided (A2 cannot be decided" in words


def test_plain_least_squares_has_no_lower_bound_and_bounded_rules_have_both():
    rng = np.random.default_rng(2)
    phi = dense.exciting(rng, 1, 1000, 1, 2, 2)
    verdicts = {}
    for name, rule in {"none": dense.none(), "exponential": dense.exponential(0.95)}.items():
        found = conditions(dense.simulate(rule, phi, None, np.eye(2)).trajectory())
        verdicts[name] = [found[c].verdict for c in ("A1", "A2", "A3", "A4")]
        outcome = stability(found)["globally uniformly exponentially stable"].outcome
        assert outcome == ("not decidable" if name == "none" else "follows")
    assert verdicts["none"] == ["holds", "holds", "not decidable", "holds"]
    assert verdicts["exponential"] == ["holds"] * 4


def test_drift_is_rarely_seen_where_there_is_none():
    rng = np.random.default_rng(3)
    seen = 0
    for _ in range(400):
        steps = rng.normal(size=1600)
        series = np.zeros(1600)
        for k in range(1, 1600):  # memory of 20 samples, stationary
            series[k] = 0.95 * series[k - 1] + 0.2 * steps[k]
        found = trend(np.exp(series), memory=20.0)
        seen += found.rises or found.falls
    assert seen <= 12  # 1 % of chance in theory; 3 % is the margin for what correlation is left


def test_trend_is_exact_in_rank_and_slope():
    # 8 blocks in perfect order: chance 2/8!.
    found = trend(np.exp(0.01 * np.arange(16.0)), memory=1e9)
    assert found.blocks == 8 and found.significance == pytest.approx(2 / 40320, rel=1e-12)
    assert found.slope == pytest.approx(0.01)
    assert not trend(np.ones(5)).decidable
    constant = trend(np.ones(100))
    assert constant.significance == pytest.approx(1.0) and constant.slope == 0.0


def test_disturbances_are_measured_or_left_open():
    rng = np.random.default_rng(4)
    phi = rng.normal(size=(50, 2, 3))
    root = np.array([[2.0, 0.0], [1.0, 1.0]])
    gamma = root @ root.T
    trajectory = Trajectory.from_arrays(phi, np.tile(0.01 * np.eye(3), (51, 1, 1)), gamma=gamma)
    truth = np.cumsum(rng.normal(size=(50, 3)), axis=0)
    noise, blur = rng.normal(size=(50, 2)), rng.normal(size=(50, 2, 3))
    known = conditions(
        trajectory, window=5, true_theta=truth, measurement_noise=noise, regressor_noise=blur
    ).constants
    inverse = np.linalg.inv(gamma)
    assert known["parameter_drift"] == pytest.approx(
        max(np.linalg.norm(truth[k + 1] - truth[k]) for k in range(49))
    )
    assert known["parameter_norm"] == pytest.approx(max(np.linalg.norm(t) for t in truth))
    assert known["measurement_noise"] ** 2 == pytest.approx(max(v @ inverse @ v for v in noise))
    assert known["regressor_noise"] == pytest.approx(
        max(np.linalg.eigvalsh(d.T @ inverse @ d)[-1] for d in blur)
    )
    open_ = conditions(trajectory, window=5)
    assert [open_[c].verdict for c in ("A5", "A6", "A7", "A8")] == ["not decidable"] * 4
    assert conditions(trajectory, true_theta=np.ones(3))["A5"].constants == {"parameter_drift": 0.0}


def test_p_bar_is_reconstructed_where_it_was_not_recorded():
    rng = np.random.default_rng(5)
    phi = dense.exciting(rng, 1, 60, 2, 3, 3)
    runs = dense.simulate(dense.subspace(0.9, 1e-3), phi, None, np.eye(3))
    path = np.concatenate([runs.before[0], runs.after[0][-1:]])
    rebuilt = Trajectory.from_arrays(runs.phi[0], path)
    np.testing.assert_allclose(rebuilt.prior, runs.prior[0], rtol=1e-9, atol=1e-12)
    F = np.linalg.inv(runs.before[0]) - np.linalg.inv(runs.prior[0])
    given = Trajectory.from_arrays(runs.phi[0], path, forgetting=F)
    np.testing.assert_allclose(given.prior, runs.prior[0], rtol=1e-8, atol=1e-12)
    assert conditions(rebuilt)["A1"].verdict == conditions(given)["A1"].verdict == "holds"


def test_limits_fail_at_the_first_sample_outside():
    variance = np.linspace(1.0, 2.0, 101)[:, None, None]
    trajectory = Trajectory.from_arrays(np.zeros((100, 1)), variance)
    found = conditions(trajectory, limits=(0.5, 1.5))
    assert found["A2"].sample == int(np.argmax(trajectory.prior[:, 0, 0] > 1.5))
    assert conditions(trajectory, limits=(1.005, 9.0))["A3"].sample == 0


def test_words_and_json():
    phi = dense.exciting(np.random.default_rng(1), 1, 60, 1, 2, 2)
    found = conditions(dense.simulate(dense.exponential(0.9), phi, None, np.eye(2)).trajectory())
    json.dumps(found.to_dict())
    json.dumps(stability(found).to_dict())
    json.dumps(excitation(phi[0], 2).to_dict())
    assert str(found).count("\n") == 7 and found.window == 2


def test_a_record_and_its_regressors_are_not_given_twice():
    trajectory = Trajectory.from_arrays(np.ones((3, 1)), np.full((4, 1, 1), 0.5))
    with pytest.raises(InvalidInput, match="regressors"):
        conditions(trajectory, np.ones((3, 1)))
    # P₊ = 2 after a sample that informs by 1 would need information below zero before it.
    with pytest.raises(InvalidInput, match="covariance"):
        Trajectory.from_arrays(np.ones((3, 1)), np.full((4, 1, 1), 2.0))
    with pytest.raises(InvalidInput, match="covariance"):
        Trajectory.from_arrays(np.ones((3, 1)), np.ones((3, 1, 1)))
