"""α, β and the excited directions equal sums written out one window at a time."""

import sys

import numpy as np
import pytest

from forgetting import InvalidInput
from forgetting.analysis import (
    excitation,
    excited,
    information_content,
    persistency_window,
    spectrum,
    trend,
)


def _one_by_one(phi, window, gamma=None):
    """Extreme eigenvalues of every window, summed sample by sample, and the bound of a sample."""
    phi = phi if phi.ndim == 3 else phi[:, None, :]
    samples, rows, n = phi.shape
    gammas = np.broadcast_to(np.eye(rows) if gamma is None else gamma, (samples, rows, rows))
    smallest, largest, single = [], [], 0.0
    for k in range(samples - window + 1):
        total = np.zeros((n, n))
        for i in range(k, k + window):
            total += phi[i].T @ np.linalg.inv(gammas[i]) @ phi[i]
        values = np.linalg.eigvalsh(total)
        smallest.append(values[0])
        largest.append(values[-1])
    for i in range(samples):
        single = max(single, np.linalg.eigvalsh(phi[i].T @ np.linalg.inv(gammas[i]) @ phi[i])[-1])
    return np.array(smallest), np.array(largest), single


@pytest.mark.parametrize("rows", [1, 2])
@pytest.mark.parametrize("window", [1, 2, 7, 40, 60])
def test_every_window_of_random_records(rows, window):
    rng = np.random.default_rng(10 * rows + window)
    phi = rng.normal(size=(60, rows, 3)) * np.array([1.0, 1e-2, 10.0])
    root = rng.normal(size=(60, rows, rows))
    gamma = root @ np.swapaxes(root, 1, 2) + 0.1 * np.eye(rows)
    for weight in (None, gamma[0], gamma):
        found = excitation(phi, window, weight)
        smallest, largest, single = _one_by_one(phi, window, weight)
        scale = 1e-13 * largest.max()
        np.testing.assert_allclose(found.smallest, np.maximum(smallest, 0), atol=scale)
        np.testing.assert_allclose(found.largest, largest, rtol=1e-12)
        assert found.generalized == pytest.approx((found.alpha, single, window))
        assert found.alpha == pytest.approx(smallest.min(), abs=scale)


def test_windows_longer_than_a_chunk_and_short_ones_agree_with_brute_force():
    rng = np.random.default_rng(3)
    phi = rng.normal(size=(9000, 1, 2))  # more windows than are summed at once
    found = excitation(phi, 5)
    for k in (0, 1, 4095, 8189, 8190, 8191, 8192, 8995):
        values = np.linalg.eigvalsh(np.einsum("tpi,tpj->ij", phi[k : k + 5], phi[k : k + 5]))
        np.testing.assert_allclose((found.smallest[k], found.largest[k]), values, rtol=1e-11)


def test_measured_records(measured):
    _agrees(measured[0], 100)


def test_the_papers_records(of_a_paper):
    _agrees(of_a_paper, 50)


def _agrees(phi, window):
    found = excitation(phi, window)
    smallest, largest, single = _one_by_one(phi, window)
    assert found.alpha == pytest.approx(smallest.min(), abs=1e-13 * largest.max())
    assert found.beta == pytest.approx(largest.max(), rel=1e-12)
    assert found.sample_bound == pytest.approx(single, rel=1e-12)


def test_conventions_of_the_two_papers():
    # Goel et al. sum φ_j ... φ_{j+N}, one sample more than Lai and Bernstein. Of
    # φ = 0, 1, 0, 1, ... their α is 1 for N = 1 and still 1 for N = 2; 2 needs N = 3.
    phi = np.tile([0.0, 1.0], 20)[:, None]
    alphas = {w - 1: excitation(phi, w).tutorial.alpha for w in (2, 3, 4)}
    assert alphas == {1: 1.0, 2: 1.0, 3: 2.0}
    found = excitation(phi, 4)
    assert (found.generalized.window, found.tutorial.window) == (4, 3)
    assert (found.generalized.beta, found.tutorial.beta) == (1.0, 2.0)
    assert found.generalized.alpha <= found.generalized.window * found.generalized.beta


def test_first_failure_and_the_shortest_window():
    rng = np.random.default_rng(4)
    phi = rng.normal(size=(300, 2))
    phi[100:130, 1] = 0.0
    found = excitation(phi, 10)
    # The first window without the second direction starts at sample 100.
    assert found.first_failure == 100
    assert excitation(phi, 31).persistent and not excitation(phi, 30).persistent
    assert persistency_window(phi) == 31
    assert set(found.rank[100:121]) == {1} and found.rank[:90].min() == 2
    assert persistency_window(phi, threshold=1e9) is None


def test_the_shortest_window_equals_a_search_one_by_one():
    rng = np.random.default_rng(6)
    for _ in range(10):
        phi = rng.normal(size=(60, 1, 3)) * (rng.uniform(size=(60, 1, 3)) < 0.4)
        limit = 1e-6
        fits = [w for w in range(3, 31) if _one_by_one(phi, w)[0].min() > limit]
        assert persistency_window(phi, threshold=limit) == (fits[0] if fits else None)


def _three_tones(samples):
    k = np.arange(samples)
    return sum(np.sin(2 * np.pi * k / period) for period in (17, 23, 53))


def _example_10(samples):
    """Regressors (35) of the fifth-order system (34) under the input (27)."""
    u, y = _three_tones(samples + 5), np.zeros(samples + 5)
    b, a = (0.68, -0.16, -0.12, -0.18, 0.09), (-1.0, 0.41, -0.17, -0.03, 0.01)
    for k in range(5, samples + 5):
        past = range(1, 6)
        y[k] = sum(b[i - 1] * u[k - i] for i in past) - sum(a[i - 1] * y[k - i] for i in past)
    return np.stack([s[5 - i : -i] for s in (u, y) for i in range(1, 6)], axis=1)


def test_information_rich_subspace_of_example_10_has_six_dimensions():
    phi = _example_10(3000)[1000:]  # three harmonics excite six of ten directions
    found = excitation(phi, 400, threshold=1e-6)
    assert found.rich == 6 and found.silent_subspace.shape == (10, 4)
    assert np.abs(phi @ found.silent_subspace).max() < 1e-5
    np.testing.assert_allclose(found.directions.T @ found.directions, np.eye(10), atol=1e-12)
    np.testing.assert_allclose(found.content, np.abs(phi @ found.directions), atol=1e-12)


def test_silent_information_is_what_forgetting_leaves():
    """Equations (57)-(63): along U_2 the information shrinks by λ and the directions stay."""
    rng = np.random.default_rng(7)
    basis = np.linalg.qr(rng.normal(size=(4, 4)))[0]
    phi = rng.normal(size=(50, 2)) @ basis[:, :2].T
    factor, R = 0.95, basis @ np.diag([2.0, 3.0, 5.0, 7.0]) @ basis.T
    path = []
    for row in phi:
        path.append(np.linalg.inv(R))
        R = factor * R + np.outer(row, row)
    found = information_content(phi, path)
    assert set(found.rank.tolist()) == {2}
    for k in (0, 20, 49):
        rich, silent = found.subspace(k), found.directions[k][:, ~found.rich[k]]
        np.testing.assert_allclose(np.abs(basis[:, 2:].T @ rich).max(), 0.0, atol=1e-7)
        expected = np.sort(factor**k * np.array([5.0, 7.0]))
        np.testing.assert_allclose(np.sort(found.information[k][~found.rich[k]]), expected)
        psi = phi[k] @ silent
        np.testing.assert_allclose(psi, 0.0, atol=1e-7)


def test_spectrum_finds_the_tones_and_keeps_the_power():
    found = spectrum(np.stack([_three_tones(20000), np.ones(20000)], axis=1))
    peaks = found.frequencies[np.argsort(found.power[:, 0])[::-1]]
    for period in (17, 23, 53):
        assert np.abs(peaks[:9] - 1 / period).min() < 1 / 1024
    assert found.power.sum(axis=0) == pytest.approx([1.5, 1.0], rel=0.01)
    assert spectrum(_three_tones(20000)[:, None]).lines() == 3


def test_spectrum_is_the_mean_of_windowed_periodograms():
    """Welch (1967): half-overlapping segments, a periodic Hann window, mean squares per bin."""
    x = np.random.default_rng(9).normal(size=(300, 2))
    found = spectrum(x, segment=50)
    window = 0.5 - 0.5 * np.cos(2 * np.pi * np.arange(50) / 50)
    parts = [
        np.abs(np.fft.fft(window[:, None] * x[k : k + 50], axis=0)) ** 2 for k in range(0, 251, 25)
    ]
    two_sided = np.mean(parts, axis=0) / (50 * np.sum(window**2))
    expected = two_sided[:26].copy()
    expected[1:25] += two_sided[:-25:-1]
    assert found.segments == len(parts) == 11
    np.testing.assert_allclose(found.power, expected, rtol=1e-12)


def test_the_rows_of_a_single_sample_are_averaged():
    assert spectrum([[[1.0], [3.0]]]).power.tolist() == [[5.0]]


@pytest.mark.parametrize("ask", [lambda: spectrum(np.ones((8, 1))), lambda: trend(np.ones(99))])
def test_what_needs_scipy_says_so(ask, monkeypatch):
    for name in ("scipy", "scipy.stats", "scipy.signal"):
        monkeypatch.setitem(sys.modules, name, None)
    with pytest.raises(ImportError, match=r"needs scipy: pip install 'forgetting\[cli\]'"):
        ask()
    assert excitation(np.ones((8, 1)), 2).persistent


def test_a_missing_sample_is_no_information():
    phi = np.random.default_rng(8).normal(size=(30, 2, 2))
    holed, zeroed = phi.copy(), phi.copy()
    holed[7, 1, 0], zeroed[7] = np.nan, 0.0
    np.testing.assert_array_equal(excitation(holed, 4).smallest, excitation(zeroed, 4).smallest)


@pytest.mark.parametrize(
    ("change", "words"),
    [
        ({"window": 0}, "window = 0"),
        ({"window": 31}, "window = 31"),
        ({"gamma": np.zeros((1, 1))}, "gamma"),
        ({"gamma": np.ones((2, 2))}, "gamma"),
        ({"threshold": -1.0}, "threshold"),
        ({"regressors": np.full((30, 2), np.inf)}, "regressors"),
        ({"regressors": np.ones(30)}, "regressors"),
    ],
)
def test_misuse_is_refused_by_name(change, words):
    given = {"regressors": np.ones((30, 2)), "window": 3, **change}
    with pytest.raises(InvalidInput, match=words):
        excitation(**given)


@pytest.mark.parametrize("window", [3, 20, 77, 400])
def test_excited_sums_windows_as_if_one_by_one(window):
    """Stretches are summed once: the same as the sum over each window."""
    random = np.random.default_rng(5)
    phi = random.normal(size=(1003, 3)) * (np.arange(1003)[:, None] // 200 % 2 == [0, 1, 0])
    found = excited(phi, window, most=50)
    mean = phi.T @ phi / len(phi)
    for k, rank in zip(found.samples, found.rank, strict=True):
        part = phi[max(0, k - window + 1) : k + 1]
        values = np.linalg.eigvals(np.linalg.solve(mean, part.T @ part / window)).real
        assert rank == (values >= 0.01).sum()
