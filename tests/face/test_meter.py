"""The live meter against sums of the window's own samples."""

import numpy as np
import pytest

import forgetting as fg


@pytest.mark.parametrize(("n", "rows", "window"), [(1, 1, 1), (3, 1, 7), (4, 2, 25), (6, 3, 2)])
def test_the_meter_agrees_with_the_window(n, rows, window):
    random = np.random.default_rng(n)
    phi = random.normal(size=(200, rows, n))
    phi[60:120] = phi[60]
    phi[120:160] = 0.0
    meter = fg.ExcitationMeter(n, window, rows=rows)
    for k in range(200):
        meter.add(phi[k])
        inside = phi[max(0, k - window + 1) : k + 1].reshape(-1, n)
        values = np.linalg.svd(inside, compute_uv=False) ** 2
        values = np.concatenate([values, np.zeros(max(0, n - len(values)))])
        assert meter.beta == pytest.approx(values.max(), rel=1e-12, abs=1e-10)
        assert meter.alpha == pytest.approx(values.min(), rel=1e-6, abs=1e-10)
        assert meter.rank(1e-6) == (values > 1e-6).sum()
    assert meter.seen == 200


def test_noise_covariance_whitens():
    gamma = np.array([[2.0, 0.5], [0.5, 1.0]])
    phi = np.random.default_rng(0).normal(size=(2, 3))
    meter = fg.ExcitationMeter(3, 5, rows=2)
    meter.add(phi, gamma)
    assert np.allclose(meter.information, phi.T @ np.linalg.inv(gamma) @ phi)
    scalar = fg.ExcitationMeter(3, 5)
    scalar.add(phi[0], 4.0)
    assert np.allclose(scalar.information, np.outer(phi[0], phi[0]) / 4)


def test_large_samples_leave_no_trace_behind_them():
    meter = fg.ExcitationMeter(2, 10)
    for k in range(100):
        meter.add([1e8, 0.0] if k < 50 else [1.0, k % 2])
    assert meter.alpha == pytest.approx(1.9098300562505, rel=1e-9)


def test_bad_input():
    for arguments, message in [
        ((0, 5), "parameters = 0, allowed: whole numbers"),
        ((2, 0), "window = 0, allowed: whole numbers"),
        ((2, -3), "window = -3, allowed: whole numbers"),
    ]:
        with pytest.raises(fg.InvalidInput, match=message):
            fg.ExcitationMeter(*arguments)
    meter = fg.ExcitationMeter(2, 5)
    meter.add([1, 2])
    before = meter.information
    for bad in [([1],), ([1, np.nan],), ([np.inf, 0],), ([1e200, 0],), ([1, 2], -1.0)]:
        with pytest.raises(fg.InvalidInput):
            meter.add(*bad)
    assert np.array_equal(meter.information, before)
