"""The bank: its mixers against their formulas, one member alone, silence, saving, parameters."""

from __future__ import annotations

import copy
import pickle

import numpy as np
import pytest

import forgetting as fg

from .test_units import RULES, record

WALKS = [10.0**power for power in (-10, -8, -6, -4, -2, 0, 2, 4)]


def mlpol(errors: np.ndarray, skip: int, ratio: float = 1.0) -> tuple[np.ndarray, np.ndarray]:
    """Errors of the mixture and weights of each sample, by the formulas, for errors (T, K)."""
    count = errors.shape[1]
    prior = ratio ** np.arange(count)
    regret, square, largest = np.zeros(count), np.zeros(count), np.zeros(count)
    mixed, weights = np.empty(len(errors)), np.empty_like(errors)
    for k, error in enumerate(errors):
        share = np.where(square > 0, np.maximum(regret, 0) / np.where(square > 0, square, 1), 0)
        share = prior * share if share.sum() > 0 else prior
        weights[k] = share / share.sum()
        mixed[k] = weights[k] @ error
        if k < skip:
            continue
        step = 2 * mixed[k] * (mixed[k] - error)
        regret += step
        after = np.maximum(largest, step**2)
        square += step**2 + after - largest
        largest = after
    return mixed, weights


def walk(noise: float) -> fg.RandomWalk:  # type: ignore[name-defined]
    return fg.RandomWalk(noise, bound=1e5)


def member_errors(phi: np.ndarray, y: np.ndarray, rules: list[object]) -> np.ndarray:
    runs = [fg.RLS(phi.shape[1], rule=rule).run(phi, y, outputs=("error",)) for rule in rules]
    return np.column_stack([np.asarray(run.error).reshape(-1) for run in runs])


def test_the_default_bank_is_mlpol_over_random_walks():
    phi, y = record()
    bank = fg.Bank(4)
    assert bank.members == [walk(noise) for noise in WALKS]
    run = bank.run(phi, y, outputs=("error", "weights"))
    mixed, weights = mlpol(member_errors(phi, y, bank.members), skip=12, ratio=0.93)
    np.testing.assert_allclose(run.error, mixed, rtol=1e-6, atol=1e-9)
    np.testing.assert_allclose(run.weights, weights, atol=1e-6)


@pytest.mark.parametrize("n", [11, 14, 24])
def test_so_it_is_with_many_parameters(n):
    random = np.random.default_rng(n)
    phi = random.normal(size=(600, n))
    phi[200:300, 2:] = 0.0  # silence, after which what was added to P in the meantime shows
    theta = np.cumsum(0.05 * random.normal(size=(600, n)), axis=0)
    y = (phi * theta).sum(axis=1) + random.normal(size=600)
    rules = [walk(noise) for noise in WALKS]
    bank = fg.Bank(n, rules, initial_covariance=1e4)
    run = bank.run(phi, y, outputs=("error", "weights", "theta"))
    members = [fg.RLS(n, rule=rule, initial_covariance=1e4) for rule in rules]
    alone = [member.run(phi, y, outputs=("error", "theta")) for member in members]
    errors = np.column_stack([np.asarray(one.error).reshape(-1) for one in alone])
    mixed, weights = mlpol(errors, skip=3 * n)
    np.testing.assert_allclose(run.error, mixed, rtol=1e-6, atol=1e-9)
    np.testing.assert_allclose(run.weights, weights, atol=1e-6)
    for i, member in enumerate(bank.members):
        assert member == rules[i]
    size = np.abs(members[3].covariance).max()
    one = fg.Bank(n, [rules[3]] * 2, initial_covariance=1e4)
    one.run(phi, y)
    np.testing.assert_allclose(one.covariance, members[3].covariance, rtol=0, atol=1e-10 * size)
    # sample by sample, saved and read again on the way, with the same bits
    single = fg.Bank(n, rules, initial_covariance=1e4)
    for k in range(600):
        if k == 250:
            single = fg.Bank.from_bytes(single.to_bytes())
        assert single.update(phi[k], y[k]).error == run.error[k]
    assert single.to_bytes() == bank.to_bytes()


def test_mlpol_keeps_its_bound_on_adversarial_sequences():
    for seed in range(20):
        random = np.random.default_rng(seed)
        count = int(random.integers(2, 9))
        # the leader changes, errors are heavy-tailed, some members are copies
        errors = random.standard_t(2, size=(500, count)) * random.uniform(0.1, 3, size=count)
        errors[250:] = errors[250:, ::-1]
        errors[:, -1] = errors[:, 0]
        for ratio in (1.0, 0.93, 0.3):
            mixed, _ = mlpol(errors, skip=0, ratio=ratio)
            steps = 2 * mixed[:, None] * (mixed[:, None] - errors)
            scale = (steps**2).sum(axis=0) + (steps**2).max(axis=0)
            prior = ratio ** np.arange(count)
            bound = np.sqrt((1 + np.log(1 + len(errors))) * scale * prior.sum() / prior)
            regret = np.square(mixed).sum() - np.square(errors).sum(axis=0)
            assert (regret <= bound).all()


@pytest.mark.parametrize("name", RULES)
def test_a_bank_of_one_is_that_estimator(name):
    phi, y = record()
    alone, bank = fg.RLS(4, rule=name), fg.Bank(4, [name])
    one, other = alone.run(phi, y), bank.run(phi, y)
    assert np.array_equal(one.error, other.error)
    assert np.array_equal(one.theta, other.theta)
    assert np.array_equal(alone.theta, bank.theta)
    assert bank.weights.tolist() == [1.0]


@pytest.mark.parametrize("mixer", ["mlpol", "best", "dynamic_model_averaging"])
def test_updates_a_run_and_a_saved_bank_say_the_same(mixer):
    phi, y = record()
    whole, single = fg.Bank(4, mixer=mixer), fg.Bank(4, mixer=mixer)
    run = whole.run(phi, y)
    for k in range(200):
        assert single.update(phi[k], y[k]).error == run.error[k]
    other = fg.Bank.from_bytes(single.to_bytes())
    assert np.array_equal(other.run(phi[200:], y[200:]).error, run.error[200:])
    assert other.to_bytes() == whole.to_bytes()
    assert pickle.loads(pickle.dumps(whole)).to_bytes() == whole.to_bytes()
    assert copy.copy(whole).to_bytes() == whole.to_bytes()
    whole.reset()
    assert whole.to_bytes() == fg.Bank(4, mixer=mixer).to_bytes()
    assert whole.describe()["mixer"]["name"] == mixer


def test_best_follows_the_smallest_discounted_error():
    phi, y = record()
    rules = [walk(noise) for noise in WALKS]
    run = fg.Bank(4, rules, mixer=fg.Best(0.9)).run(phi, y, outputs=("weights", "error"))
    errors = member_errors(phi, y, rules)
    loss = np.zeros(8)
    for k in range(len(y)):
        if k > 12:
            assert run.weights[k].argmax() == loss.argmin()
        loss = 0.9 * loss + (errors[k] ** 2 if k >= 12 else 0.0)


def test_probabilities_follow_bayes():
    phi, y = record()
    rules = [walk(1e-6), walk(1e-2)]
    mixer = fg.DynamicModelAveraging(0.95, 50.0)
    run = fg.Bank(4, rules, mixer=mixer).run(phi, y, outputs=("weights",))
    members = [fg.RLS(4, rule=rule).run(phi, y) for rule in rules]
    logarithm, variance, count = np.zeros(2), np.zeros(2), 0
    for k in range(len(y)):
        prior = np.exp(0.95 * logarithm)
        np.testing.assert_allclose(run.weights[k], prior / prior.sum(), rtol=1e-6, atol=1e-9)
        if k < 12:
            continue
        count += 1
        growth = np.array([1 + each.leverage[k] for each in members])
        square = np.array([each.error[k] ** 2 for each in members]) / growth
        logarithm = 0.95 * logarithm
        if count > 1:
            logarithm -= 0.5 * (np.log(variance * growth) + square / variance)
        variance += (square - variance) / min(count, 50)
        logarithm = np.maximum(logarithm - logarithm.max(), -60.0)


def test_theta_covariance_and_prediction_are_those_of_the_mixture():
    phi, y = record()
    bank = fg.Bank(4)
    bank.run(phi, y)
    estimates = [fg.RLS(4, rule=rule) for rule in bank.members]
    for each in estimates:
        each.run(phi, y)
    weights = bank.weights
    theta = sum(w * each.theta for w, each in zip(weights, estimates, strict=True))
    np.testing.assert_allclose(bank.theta, theta, rtol=1e-9)
    np.testing.assert_allclose(bank.predict(phi), phi @ theta, rtol=1e-9)
    apart = [each.theta - theta for each in estimates]
    covariance = sum(
        w * (each.covariance + np.outer(d, d) / bank.noise_variance)
        for w, each, d in zip(weights, estimates, apart, strict=True)
    )
    np.testing.assert_allclose(bank.covariance, covariance, rtol=1e-8)
    run = fg.Bank(4).run(phi, y, outputs=("variance", "covariance"))
    np.testing.assert_allclose(run.covariance[-1], covariance, rtol=1e-8)
    np.testing.assert_allclose(run.variance[-1], covariance.diagonal(), rtol=1e-8)


@pytest.mark.parametrize("outliers", [False, True])
@pytest.mark.parametrize("dtype", ["float64", "float32"])
def test_it_lives_through_silence_jumps_and_outliers(dtype, outliers):
    random = np.random.default_rng(0)
    bank = fg.Bank(4, dtype=dtype)
    theta = np.ones(4)
    for block in range(60):
        phi = random.normal(size=(2000, 4)) * (block % 3 != 1)
        theta = theta + random.normal(size=4) * (block % 7 == 0)
        y = phi @ theta + 0.1 * random.normal(size=2000)
        if outliers:
            y += 0.1 * random.standard_t(1, size=2000)
            y[::100] = 1e9
        run = bank.run(phi, y, outputs=("error", "weights"))
        assert np.isfinite(run.error).all()
        np.testing.assert_allclose(run.weights.sum(axis=1), 1.0, rtol=1e-5)
        assert (run.weights >= 0).all()
    assert np.isfinite(bank.theta).all() and np.isfinite(bank.covariance).all()
    if not outliers:
        # awake again: the first informative samples bring the parameters back
        phi = random.normal(size=(300, 4))
        bank.run(phi, phi @ theta)
        np.testing.assert_allclose(bank.theta, theta, atol=0.1)


def systems() -> dict[str, np.ndarray]:
    """Steps of four parameters a sample, (T, 4), for each kind of system."""
    samples = 1500
    random = np.random.default_rng(1)
    drift = 0.03 * random.normal(size=(samples, 4))
    jumps = np.zeros((samples, 4))
    jumps[[500, 1000]] = random.normal(size=(2, 4)) * 3
    return {
        "constant": np.zeros((samples, 4)),
        "drifting": drift,
        "jumping": jumps,
        "one drifts": drift * [1, 0, 0, 0],
    }


@pytest.mark.parametrize("excitation", ["rich", "poor"])
@pytest.mark.parametrize("kind", list(systems()))
def test_parameters_are_as_good_as_those_of_the_best_member(kind, excitation):
    steps = systems()[kind]
    of_bank, of_members = 0.0, np.zeros(len(WALKS))
    for seed in range(100):
        random = np.random.default_rng(100 + seed)
        phi = random.normal(size=steps.shape)
        if excitation == "poor":
            phi[:, 1] = 0.9 * phi[:, 0] + 0.3 * phi[:, 1]
            phi[:, 2] *= np.arange(len(phi)) % 10 == 0
        theta = 1.0 + np.cumsum(steps, axis=0)
        y = (phi * theta).sum(axis=1) + 0.5 * random.normal(size=len(phi))
        start = 100

        def off(run: object, theta: np.ndarray = theta, start: int = start) -> float:
            return float(np.mean((run.theta[start:-1] - theta[start + 1 :]) ** 2))  # type: ignore[attr-defined]

        of_bank += off(fg.Bank(4).run(phi, y))
        of_members += [off(fg.RLS(4, rule=walk(noise)).run(phi, y)) for noise in WALKS]
    assert np.sqrt(of_bank) < 1.1 * np.sqrt(of_members.min())


def test_weights_beforehand_are_for_members_in_an_order():
    phi, y = record()
    rules = [fg.NoForgetting(), fg.Exponential(0.9)]
    for mixer, prior in ((fg.mixer("mlpol", prior_ratio=0.25), [0.8, 0.2]), ("mlpol", [0.5, 0.5])):
        run = fg.Bank(4, rules, mixer=mixer).run(phi, y, outputs=("error", "weights"))
        np.testing.assert_allclose(run.weights[0], prior, rtol=1e-15)
        mixed, weights = mlpol(member_errors(phi, y, rules), skip=12, ratio=prior[1] / prior[0])
        np.testing.assert_allclose(run.error, mixed, rtol=1e-6, atol=1e-9)
        np.testing.assert_allclose(run.weights, weights, atol=1e-6)
    # the default members have theirs, whether or not their mixer is named
    named = fg.Bank(4, mixer="mlpol").run(phi, y)
    assert (named.error == fg.Bank(4).run(phi, y).error).all()
    for ratio in (0.0, 1.5, np.nan):
        with pytest.raises(fg.InvalidInput, match="prior_ratio"):
            fg.Bank(4, mixer=fg.mixer("mlpol", prior_ratio=ratio))


def test_members_and_mixers_are_refused_by_name():
    with pytest.raises(fg.InvalidInput, match="members"):
        fg.Bank(2, [])
    with pytest.raises(fg.InvalidInput, match=r"mixer = .median."):
        fg.Bank(2, mixer="median")
    with pytest.raises(fg.InvalidInput, match="rule"):
        fg.Bank(2, ["exponentially"])
    with pytest.raises(fg.InvalidInput, match="function"):
        fg.Bank(2, [fg.Exponential(lambda evidence: 0.9)])
    with pytest.raises(fg.InvalidInput, match="initial_theta"):
        fg.Bank(2, initial_theta=[1.0, 2.0])
    with pytest.raises(fg.InvalidInput, match="output"):
        fg.Bank(2).run([[1.0, 2.0]], [1.0], outputs=("rank",))
    bank = fg.Bank(2)
    fresh = bank.to_bytes()
    for phi, y in (([np.nan, 1.0], 0.0), ([1.0, 1.0], np.inf)):
        with pytest.raises(fg.InvalidInput):
            bank.update(phi, y)
        assert bank.to_bytes() == fresh
    with pytest.raises(fg.InvalidInput, match="sample 1"):
        bank.run([[1.0, 2.0], [np.nan, 1.0]], [1.0, 2.0])
    assert bank.to_bytes() == fresh
    altered = bytearray(fresh)
    altered[40] ^= 1
    with pytest.raises(fg.InvalidInput, match="altered"):
        fg.Bank.from_bytes(bytes(altered))
    with pytest.raises(fg.InvalidInput, match="bank"):
        fg.RLS.from_bytes(fresh)


def test_rows_targets_noise_gates_and_missing_samples():
    random = np.random.default_rng(5)
    phi = random.normal(size=(300, 2, 3))
    theta = random.normal(size=(3, 2))
    y = phi @ theta + 0.1 * random.normal(size=(300, 2, 2))
    gamma = np.array([[0.02, 0.005], [0.005, 0.03]])
    bank = fg.Bank(3, rows=2, targets=2)
    y[17] = np.nan
    run = bank.run(phi, y, gamma=gamma, missing="skip")
    assert run.theta.shape == (300, 3, 2) and run.error.shape == (300, 2, 2)
    assert run.skipped_count == 1 and np.isnan(run.error[17]).all()
    np.testing.assert_allclose(bank.theta, theta, atol=0.05)
    gated = fg.Bank(3, gate=fg.MinimumInformation(1e-3), weighting="huber")
    held = gated.run(phi[:, 0] * (np.arange(300) % 2)[:, None], phi[:, 0] @ theta[:, 0])
    assert held.skipped_count == 150


def test_the_memory_of_exponential_forgetting_is_that_of_its_factor():
    random = np.random.default_rng(2)
    phi = random.normal(size=(3000, 3))
    bank = fg.Bank(3, [fg.Exponential(0.98)])
    bank.run(phi, phi.sum(axis=1))
    assert bank.memory == pytest.approx(50.0, rel=0.05)


def test_every_output_has_a_number_for_each_sample():
    random = np.random.default_rng(0)
    phi, y = random.normal(size=(100, 3)), random.normal(size=100)
    names = ("theta", "error", "leverage", "forgetting_factor", "skipped", "gate", "windup")
    names += ("variance", "covariance", "weights", "memory")
    for part in (*((name,) for name in names), names, names[:7]):
        run = fg.Bank(3).run(phi, y, outputs=part)
        assert all(len(getattr(run, name)) == 100 for name in part)
