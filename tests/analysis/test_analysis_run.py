"""The analysis of runs of the estimator itself."""

import json

import dense_gf_rls as dense
import numpy as np
import pytest
from runs import OUTPUTS, data, run_of

import forgetting as fg
from forgetting.analysis import (
    Trajectory,
    certify,
    conditions,
    confidence,
    excitation,
    filtered_regressors,
    stability,
    ultimate_bound,
    windup,
)

RULES = {
    "none": (fg.NoForgetting(), dense.none()),
    "exponential": (fg.Exponential(0.97), dense.exponential(0.97)),
    "exponential_resetting": (
        fg.ExponentialResetting(0.97, information=0.5),
        dense.resetting(0.97, 0.5 * np.eye(3)),
    ),
    "subspace": (fg.Subspace(0.97, threshold=1e-3), dense.subspace(0.97, 1e-6)),
}


@pytest.mark.parametrize("rows", [1, 2])
@pytest.mark.parametrize("name", RULES)
def test_record_of_a_run_equals_the_dense_recursion(name, rows):
    phi, y, _ = data(rows)
    rule, reference = RULES[name]
    trajectory = Trajectory.from_run(run_of(rule, phi, y), phi, initial_covariance=1.0)
    expected = dense.simulate(reference, phi[None], y[None], np.eye(3)).trajectory()
    for part in ("before", "prior", "after"):
        np.testing.assert_allclose(
            getattr(trajectory, part), getattr(expected, part), rtol=1e-8, atol=1e-13
        )
    found, dense_found = conditions(trajectory), conditions(expected)
    assert [c.verdict for c in found] == [c.verdict for c in dense_found]
    assert found["A1"].verdict == "holds"
    for symbol in ("a", "b", "alpha", "beta", "window"):
        assert found.constants[symbol] == pytest.approx(dense_found.constants[symbol], rel=1e-8)


def test_conclusions_and_bound_of_a_run():
    phi, y, truth = data()
    run = run_of(fg.Exponential(0.97), phi, y)
    noise = y - phi @ truth
    found = conditions(
        run, phi, initial_covariance=1.0, true_theta=truth, measurement_noise=noise, window=20
    )
    assert stability(found)["globally uniformly exponentially stable"].outcome == "follows"
    bound = ultimate_bound(found, error=run.theta - truth)
    assert 0 < bound.observed < bound.bound < np.inf
    assert bound.errors_in_variables == bound.bound


def test_without_the_initial_covariance_the_record_starts_at_sample_one():
    phi, y, _ = data()
    run = run_of(fg.Exponential(0.97), phi, y)
    late, full = (
        Trajectory.from_run(run, phi),
        Trajectory.from_run(run, phi, initial_covariance=1.0),
    )
    assert (late.first, late.samples, full.samples) == (1, 399, 400)
    np.testing.assert_array_equal(late.prior, full.prior[1:])
    found = confidence(run, phi)
    assert len(found.error) == 399


@pytest.mark.parametrize("rule", [None, "exponential", fg.Subspace(0.97)])
def test_a_prior_that_is_set_late_is_no_forgetting(rule):
    phi, y, _ = data()
    phi[:150, :, 2] = 0.0
    phi[:, :, 1] = 0.0  # never switched on
    phi[:, :, 2] *= 1000.0  # P falls where its unit becomes known
    run = fg.RLS(3, rule=rule).run(phi, y, outputs=[*OUTPUTS, "prior_covariance"])
    found = certify(run, phi).conditions
    assert (found.trajectory.first, found["A1"].verdict) == (151, "holds")
    told = certify(run, phi, initial_covariance=np.asarray(run.covariance)[0]).conditions
    assert told["A1"].verdict == "fails"  # who says what P was before is taken at his word


def test_a_record_that_speaks_at_its_end_is_judged_all_the_same():
    phi, y, _ = data(samples=20)
    phi[:18, :, 2] = 0.0
    run = fg.RLS(3).run(phi, y, outputs=OUTPUTS)
    assert Trajectory.from_run(run, phi).samples == 2 * 3


def _nightly(rule):
    phi, y, _ = data(samples=1500, n=4, sigma=0.05)
    phi[500:1200] = 0.0
    y[500:1200] = 0.0
    return run_of(rule, phi, y, P0=100.0), phi


def test_certificate_of_a_night():
    names = ["a", "b", "c", "d"]
    found = {}
    for rule in (fg.Exponential(0.98), fg.Subspace(0.98, threshold=1e-3)):
        run, phi = _nightly(rule)
        found[rule.name] = certify(run, phi, initial_covariance=100.0, names=names)
        json.dumps(found[rule.name].to_dict(), allow_nan=False)
    wound, calm = found["exponential"], found["subspace"]
    assert wound.windup_occurred and not calm.windup_occurred
    assert 500 + 100 < wound.windup.sample < 500 + 130  # ln 10 / -ln 0.98 = 114 samples
    assert wound.windup.growth == pytest.approx(0.98**-700, rel=0.2)
    assert wound.excitation.first_failure <= 500
    assert "do not trust" in wound.verdict and calm.verdict.startswith("No windup")


@pytest.mark.parametrize("rule", [fg.NoForgetting(), fg.Exponential(0.7)])
def test_roundoff_in_a_reconstruction_is_not_said_to_be_improper(rule):
    # Nearly parallel regressors of size 1e3 on P = 100 I: φP₊φᵀ loses six digits to cancelling.
    rng = np.random.default_rng(2)
    lengths = 1e3 * rng.uniform(size=(300, 1)) * (np.arange(300) % 100 < 40)[:, None]
    phi = lengths * (np.array([1.0, -0.4]) + 0.3 * rng.uniform(size=(300, 1)) * [0.0, 1.0])
    est = fg.RLS(2, rule=rule, initial_covariance=100.0)
    run = est.run(phi, np.zeros(300), outputs=OUTPUTS)
    assert conditions(run, phi, initial_covariance=100.0)["A1"].verdict != "fails"


def test_a_run_that_has_lost_every_digit_to_windup_can_still_be_judged():
    phi = np.random.default_rng(3).normal(size=(1600, 4))
    phi[100:1500] = 0.0  # 0.95^-1400 = 2e31
    run = fg.RLS(4, rule=fg.Exponential(0.95)).run(phi, np.zeros(1600), outputs=OUTPUTS)
    trajectory = Trajectory.from_run(run, phi, initial_covariance=100.0)
    assert not trajectory.resolved[1500] and trajectory.resolved[:1500].all()
    np.testing.assert_array_equal(trajectory.prior[1500], trajectory.before[1500])
    found = certify(run, phi, initial_covariance=100.0)
    assert found.windup_occurred and found.conditions["A1"].verdict == "not decidable"
    json.dumps(found.to_dict(), allow_nan=False)


#: Rules whose monitor and record must agree, and inputs after 500 samples of excitation.
WATCHED = {
    "none": fg.NoForgetting(),
    "exponential": fg.Exponential(0.99),
    "exponential_resetting": fg.ExponentialResetting(0.99, information=1.0),
    "subspace": fg.Subspace(0.99, threshold=1e-2),
}


@pytest.mark.parametrize("name", WATCHED)
def test_the_live_watch_and_the_record_agree_on_windup(name):
    rng = np.random.default_rng(0)
    day, constant = rng.normal(size=(500, 4)), rng.normal(size=4)
    later = {
        "night": np.zeros((800, 4)),
        "constant": np.tile(constant, (800, 1)),
        "noise only": 1e-3 * rng.normal(size=(800, 4)),
        "weaker": 0.3 * rng.normal(size=(800, 4)),
    }
    for given, rest in later.items():
        phi = np.concatenate([day, rest])
        est = fg.RLS(4, rule=WATCHED[name], initial_covariance=1.0, monitor=True)
        run = est.run(phi, np.zeros(1300), outputs=(*OUTPUTS, "windup"))
        found = windup(run, phi, initial_covariance=1.0, rule=est.rule)
        expected = name == "exponential" and given != "weaker"
        assert found.occurred is bool(run.windup.any()) is expected, given
        if expected:  # the monitor looks once a block of half a memory, 50 samples
            assert found.sample <= np.argmax(run.windup) <= found.sample + 100


def test_resetting_returns_to_its_ceiling_and_no_further():
    rule = fg.ExponentialResetting(0.98, information=0.01)
    run, phi = _nightly(rule)
    assert not windup(run, phi, initial_covariance=100.0, rule=rule).occurred
    assert not certify(run, phi, initial_covariance=100.0, rule=rule).windup_occurred
    assert windup(run, phi, initial_covariance=100.0).occurred
    assert not windup(run, phi, initial_covariance=100.0, ceiling=100.0).occurred


def test_skipped_samples_inform_nothing():
    phi, y, _ = data()
    y[50:60] = np.nan
    phi[100:120] *= 1e-6
    est = fg.RLS(3, rule=fg.Subspace(0.97, threshold=1e-3), initial_covariance=1.0)
    run = est.run(phi[:, 0], y[:, 0], outputs=OUTPUTS, missing="skip")
    trajectory = Trajectory.from_run(run, phi, initial_covariance=1.0)
    assert (run.skipped[50:60] == 2).all() and (run.skipped[100:120] == 1).all()
    assert (trajectory.phibar[50:60] == 0).all() and (trajectory.phibar[100:120] == 0).all()
    np.testing.assert_array_equal(trajectory.prior[100:120], trajectory.before[100:120])
    assert conditions(trajectory)["A1"].verdict == "holds"
    assert not confidence(run, phi).counted[49:59].any()  # sample 0 is not in the record


def test_a_filtered_part_of_a_sample():
    phi, y, _ = data(rows=2)
    phi[:, 1] *= 1e-2
    rule = fg.Subspace(0.97, threshold=0.5)
    run = run_of(rule, phi, y, P0=1e6)
    with pytest.raises(fg.InvalidInput, match="filtered_regressors"):
        conditions(run, phi, initial_covariance=1e6)
    used = filtered_regressors(phi, 0.5)
    assert conditions(run, used, initial_covariance=1e6)["A1"].verdict == "holds"
    assert set(np.linalg.matrix_rank(used).tolist()) == {0, 1}


def test_full_weighting_and_two_targets():
    rng = np.random.default_rng(1)
    phi, _, _ = data(rows=2)
    gamma = np.array([[2.0, 0.5], [0.5, 1.0]])
    truth = rng.normal(size=(3, 2))
    noise = 0.1 * rng.normal(size=(400, 2, 2))
    y = phi @ truth + np.einsum("pq,tqm->tpm", np.linalg.cholesky(gamma), noise)
    est = fg.RLS(3, rule=fg.NoForgetting(), rows=2, targets=2, initial_covariance=100.0)
    run = est.run(phi, y, gamma, outputs=OUTPUTS)
    found = confidence(run, phi, gamma=gamma, initial_covariance=100.0)
    assert found.half_width.shape == (400, 2, 2) and found.standard_error.shape == (400, 3, 2)
    assert found.noise_variance[-1] == pytest.approx([0.01, 0.01], rel=0.2)
    assert found.coverage == pytest.approx(0.95, abs=4 * found.uncertainty)
    beta = excitation(phi, 5, gamma).sample_bound
    assert conditions(run, phi, gamma=gamma).constants["beta"] == pytest.approx(beta)


def test_single_precision_is_judged_with_its_own_roundoff():
    phi, y, _ = data(samples=2000)
    run = run_of(fg.Exponential(0.97), phi, y, dtype="float32")
    trajectory = Trajectory.from_run(run, phi, initial_covariance=1.0)
    if run.covariance.dtype == np.float32:
        assert trajectory.precision == pytest.approx(float(np.finfo(np.float32).eps))
    assert conditions(trajectory)["A1"].verdict == "holds"


def test_what_is_missing_from_a_run_is_named():
    phi, y, _ = data()
    run = fg.RLS(3).run(phi[:, 0], y[:, 0], outputs=("theta",))
    with pytest.raises(fg.InvalidInput, match="covariance"):
        certify(run, phi)
    with pytest.raises(fg.InvalidInput, match="error"):
        confidence(run, phi)
    with pytest.raises(fg.InvalidInput, match="regressors"):
        conditions(run_of(fg.NoForgetting(), phi, y))


def test_a_measured_record(measured):
    phi, y = measured
    scale = np.abs(phi).max(axis=0)
    est = fg.RLS(phi.shape[1], rule=fg.Exponential(0.95), initial_covariance=100.0)
    run = est.run(phi / scale, y, outputs=OUTPUTS)
    found = certify(run, phi / scale, initial_covariance=100.0)
    expected = np.linalg.eigvalsh(run.covariance)
    assert found.conditions.constants["a"] <= expected.min() * (1 + 1e-9)
    assert found.conditions["A1"].verdict in {"holds", "not decidable"}
    json.dumps(found.to_dict(), allow_nan=False)
