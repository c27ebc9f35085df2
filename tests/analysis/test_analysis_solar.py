"""Five days of a solar array: what the live part sees of its nights."""

from itertools import pairwise

import numpy as np
import pytest

import forgetting as fg
from forgetting.demo.solar import MEMORY, NIGHT

WINDOW = 16
"""Samples of the meter: four hours."""


def _nights(phi):
    """Stretches of at least a meter's window without sun, as slices; the record has six."""
    dark = np.concatenate([[0], (np.linalg.norm(phi, axis=1) < NIGHT).astype(int), [0]])
    starts, stops = np.flatnonzero(np.diff(dark) > 0), np.flatnonzero(np.diff(dark) < 0)
    nights = [slice(a, b) for a, b in zip(starts, stops, strict=True) if b - a >= WINDOW]
    assert len(nights) == 6
    return nights


def test_the_meter_sees_every_night_and_every_day(solar):
    phi, _ = solar
    meter = fg.ExcitationMeter(2, WINDOW)
    rank = np.zeros(len(phi), dtype=int)
    for k, row in enumerate(phi):
        meter.add(row)
        rank[k] = meter.rank(NIGHT**2)
        inside = phi[max(0, k - WINDOW + 1) : k + 1]
        values = np.linalg.eigvalsh(inside.T @ inside)
        assert meter.alpha == pytest.approx(values[0], abs=1e-9 * max(values[1], 1.0))
        assert meter.beta == pytest.approx(values[1], rel=1e-9, abs=1e-9)
    nights = _nights(phi)
    for night in nights:
        assert rank[night.stop - 1] == 0
        assert rank[night.start + WINDOW - 1 : night.stop].max() == 0
    for night, following in pairwise(nights):
        assert rank[night.stop : following.start].max() == 2


def test_the_alarm_fires_every_night_for_exponential_and_never_for_subspace(solar):
    phi, power = solar
    alarm = {}
    for rule in (fg.Exponential(MEMORY), fg.Subspace(MEMORY, threshold=NIGHT)):
        est = fg.RLS(2, rule=rule, monitor=True)
        alarm[rule.name] = np.array(
            [est.update(x, y).windup for x, y in zip(phi, power, strict=True)]
        )
        run = fg.RLS(2, rule=rule, monitor=True).run(phi, power, outputs=["windup"])
        assert np.array_equal(run.windup, alarm[rule.name])
    assert not alarm["subspace"].any()
    nights = _nights(phi)
    assert all(alarm["exponential"][night].any() for night in nights)
    assert np.mean(np.concatenate([alarm["exponential"][night] for night in nights])) > 0.65
    # and it ends: by noon the array has told enough
    noons = slice(48, None, 96)
    assert not alarm["exponential"][noons].any()


def test_a_gate_keeps_exponential_forgetting_from_winding_up(solar):
    phi, power = solar
    gate = fg.MinimumInformation(1e-3)
    est = fg.RLS(2, rule=fg.Exponential(MEMORY), gate=gate, monitor=True)
    run = est.run(phi, power, outputs=["windup", "gate", "variance"])
    assert not run.windup.any()
    for night in _nights(phi):
        assert (run.gate[night.start + 1 : night.stop - 1] != 0).mean() > 0.9
        held = run.variance[night.start + 4 : night.stop - 4]
        assert held.max() <= held.min() * 20
