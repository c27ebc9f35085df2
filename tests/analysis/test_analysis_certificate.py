"""The certificate on records that are short, empty, broken or measured."""

import json

import numpy as np
import pytest

import forgetting as fg
from forgetting.analysis import Trajectory, certify, windup

OUTPUTS = ("error", "covariance", "skipped", "forgetting_factor")


@pytest.mark.parametrize("samples", [1, 2, 3, 5, 20])
@pytest.mark.parametrize("amplitude", [0.0, 1.0])
def test_the_shortest_records_have_a_certificate(samples, amplitude):
    phi = amplitude * np.random.default_rng(samples).normal(size=(samples, 2))
    est = fg.RLS(2, rule=fg.Exponential(0.9), initial_covariance=100.0)
    run = est.run(phi, np.ones(samples), outputs=OUTPUTS)
    found = certify(run, phi, initial_covariance=100.0)
    json.dumps(found.to_dict(), allow_nan=False)
    if samples == 20:  # 0.9^-20 = 8.2 < 10
        assert not found.windup_occurred
        expected = "holds" if amplitude else "fails"
        assert found.conditions["A4"].verdict == expected
    assert found.conditions["A1"].verdict == "holds"


def _plain_update(samples, factor):
    """P = (P - K φ P)/λ as often written, on a regressor that never changes: it overflows."""
    P, path, prior = np.eye(2), [np.eye(2)], []
    phi = np.ones((samples, 2))
    with np.errstate(all="ignore"):
        for row in phi:
            prior.append(P / factor)
            gain = P @ row / (factor + row @ P @ row)
            P = (P - np.outer(gain, row) @ P) / factor
            path.append(P)
    return phi, np.array(path), np.array(prior)


def test_a_covariance_that_overflows_is_told_sample_by_sample():
    phi, path, prior = _plain_update(1500, 0.5)
    found = certify(Trajectory.from_arrays(phi, path, prior_covariance=prior))
    lost = int(np.argmin(np.isfinite(prior).all(axis=(1, 2))))
    assert found.conditions["A2"].verdict == "fails"
    assert found.conditions["A2"].sample in {lost - 1, lost}  # the eigenvalue overflows first
    assert found.conditions["A3"].verdict == "fails"
    assert found.windup.sample == 3  # 0.5^-3 = 8, 0.5^-4 = 16: after the fourth sample
    np.testing.assert_allclose(np.abs(found.windup.direction), [0.5**0.5] * 2)
    assert "does not follow (A1, A2, A3, A4 fail)" in str(found)
    with pytest.raises(fg.InvalidInput, match="covariance"):
        windup(Trajectory.from_arrays(phi, np.full_like(path, np.nan), prior_covariance=prior))


def test_a_night_winds_up_exponential_forgetting_only(solar):
    """While the sun is down nothing is said about how the power follows it."""
    from forgetting.demo.solar import MEMORY, NIGHT

    phi, power = solar
    verdicts = {}
    for rule in (fg.Exponential(MEMORY), fg.Subspace(MEMORY, threshold=NIGHT)):
        est = fg.RLS(2, rule=rule, initial_covariance=100.0)
        run = est.run(phi, power, outputs=OUTPUTS)
        verdicts[rule.name] = certify(run, phi, initial_covariance=100.0, names=["gain", "slope"])
    wound = verdicts["exponential"]
    assert wound.windup_occurred and wound.windup.persists
    assert not verdicts["subspace"].windup_occurred
    # the record begins at midnight: P grows tenfold in ln 10/-ln 0.7 = 6.5 samples
    assert wound.windup.sample == 6


def test_names_are_used_and_counted():
    phi = np.random.default_rng(0).normal(size=(60, 2))
    phi[:, 1] = 0.0
    run = fg.RLS(2, rule=fg.NoForgetting()).run(phi, phi[:, 0], outputs=OUTPUTS)
    assert "along gain the initial estimate" in certify(run, phi, names=["pole", "gain"]).verdict
    with pytest.raises(fg.InvalidInput, match="names"):
        str(certify(run, phi, names=["pole"]))
