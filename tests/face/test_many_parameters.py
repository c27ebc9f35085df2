"""Process noise of many parameters: a number is added where a sample needs it, a matrix at once."""

from __future__ import annotations

import numpy as np
import pytest

import forgetting as fg

N = 13
NOISE = 0.01


def record(rows: int, targets: int = 1) -> tuple[np.ndarray, np.ndarray]:
    """150 samples, of which some are silent and in some only half of the parameters are excited."""
    random = np.random.default_rng(rows)
    phi = random.normal(size=(150, rows, N))
    phi[40:60] = 0.0
    phi[90:, :, N // 2 :] *= np.arange(60)[:, None, None] % 5 == 0
    y = phi @ random.normal(size=(N, targets)) + 0.1 * random.normal(size=(150, rows, targets))
    y[120] += 20.0
    return (phi if rows > 1 else phi[:, 0]), y.squeeze()


def pair(**settings: object) -> tuple[fg.RLS, fg.RLS]:
    """The same estimator with c for Q, and with c I."""
    bound = settings.pop("bound", None)
    bound = {} if bound is None else {"bound": bound}
    own = fg.RLS(N, rule=fg.RandomWalk(process_noise=NOISE, **bound), **settings)
    whole = fg.RLS(N, rule=fg.RandomWalk(process_noise=NOISE * np.eye(N), **bound), **settings)
    return own, whole


def same(own: object, whole: object, rtol: float) -> None:
    scale = np.abs(np.asarray(whole, dtype=float)).max(initial=1e-300)
    np.testing.assert_allclose(own, whole, rtol=0.0, atol=rtol * scale)


SETTINGS = [
    {},
    {"bound": 50.0},
    {"rows": 2},
    {"rows": 3, "targets": 2},
    {"monitor": True},
    {"gate": fg.MinimumInformation(1e-3)},
    {"gate": fg.DeadZone(0.1)},
    {"weighting": "huber"},
    {"weighting": "student_t", "rows": 2},
    {"initial_covariance": 10.0},
]


@pytest.mark.parametrize("settings", SETTINGS, ids=str)
@pytest.mark.parametrize("dtype", ["float64", "float32"])
def test_a_number_is_that_number_for_every_parameter(settings: dict, dtype: str) -> None:
    phi, y = record(settings.get("rows", 1), settings.get("targets", 1))
    own, whole = pair(**settings, dtype=dtype)
    outputs = ("theta", "error", "leverage", "variance", "covariance", "prior_covariance", "windup",
               "skipped", "gate", "weight", "whitened_innovation")  # fmt: skip
    found, wanted = own.run(phi, y, outputs=outputs), whole.run(phi, y, outputs=outputs)
    # P0 that follows the data starts with variances that are 1e7 times those of the end
    rtol = 1e-10 if dtype == "float64" else 1e-3
    for name in outputs:
        same(getattr(found, name)[N:], getattr(wanted, name)[N:], rtol)
    same(own.covariance, whole.covariance, rtol)
    for first, second in zip(own.factor(), whole.factor(), strict=True):
        same(first, second, rtol)
    if settings.get("monitor"):
        health, other = own.health(), whole.health()
        same(health.noise_variance, other.noise_variance, rtol)
        assert health.windup == other.windup
        same(own.health(exact=True).direction, whole.health(exact=True).direction, 1e-3)


@pytest.mark.parametrize("settings", SETTINGS, ids=str)
def test_one_by_one_and_resumed_it_is_the_same_bit_for_bit(settings: dict) -> None:
    phi, y = record(settings.get("rows", 1), settings.get("targets", 1))
    (at_once, _), (one_by_one, _) = pair(**settings), pair(**settings)
    at_once.run(phi, y)
    for k in range(len(phi)):
        one_by_one.update(phi[k], y[k])
        if k % 29 == 0:
            one_by_one = fg.RLS.from_bytes(one_by_one.to_bytes())
    assert one_by_one.to_bytes() == at_once.to_bytes()


def test_time_that_passes() -> None:
    phi, y = record(1)
    elapsed = np.where(np.arange(len(y)) % 40 == 7, 1e3, 1.0) * np.where(
        np.arange(len(y)) % 9, 1.0, 0.1
    )
    own, whole = pair(bound=50.0)
    for k, passed in enumerate(elapsed):
        own.update(phi[k], y[k], elapsed=passed)
        whole.update(phi[k], y[k], elapsed=passed)
        same(own.covariance, whole.covariance, 1e-10)


def test_columns_in_other_units() -> None:
    phi, y = record(1)
    units = 10.0 ** np.linspace(-6, 6, N)
    plain, other = fg.RLS(N).run(phi, y), fg.RLS(N).run(phi * units, y)
    np.testing.assert_allclose(other.error, plain.error, rtol=0.0, atol=1e-8)


def test_a_reset_of_p_goes_on_as_with_a_matrix() -> None:
    phi, y = record(1)
    found = []
    for noise in (NOISE, NOISE * np.eye(N)):
        inner = fg.RandomWalk(process_noise=noise)
        rule = fg.CovarianceResetting(inner, "period", covariance=3.0, period=20)
        est = fg.RLS(N, rule=rule, initial_covariance=3.0)
        found.append(est.run(phi, y, outputs=("variance",)).variance)
    same(*found, 1e-10)


def test_streams_of_a_fleet_are_such_estimators() -> None:
    random = np.random.default_rng(2)
    fleet, alone = fg.Fleet(3, N), [fg.RLS(N) for _ in range(3)]
    for _ in range(60):
        phi, y = random.normal(size=(3, N)), random.normal(size=3)
        fleet.update(phi, y)
        for one, f, value in zip(alone, phi, y, strict=True):
            one.update(f, value)
    np.testing.assert_array_equal(fleet.theta, [one.theta for one in alone])
    assert fleet[1].to_bytes() == alone[1].to_bytes()
