"""The test of Diebold and Mariano: against other computations, and on what chance makes of it."""

import math

import numpy as np
import pytest
from scipy import stats

import forgetting as fg
from forgetting.tuning import difference
from forgetting.tuning.difference import window


def autoregressive(random, samples, slope):
    """Noise of which each value remembers the last one."""
    found = random.normal(size=samples)
    for k in range(1, samples):
        found[k] += slope * found[k - 1]
    return found


def test_without_lags_it_is_the_t_test():
    random = np.random.default_rng(0)
    loss, other = random.normal(size=(2, 60)) ** 2
    found = difference(loss, other, lags=0)
    known = stats.ttest_1samp(loss - other, 0.0)
    assert found.statistic == pytest.approx(known.statistic, rel=1e-12)
    assert found.p_value == pytest.approx(known.pvalue, rel=1e-10)


def test_with_lags_it_is_the_sum_over_all_pairs():
    random = np.random.default_rng(1)
    total, lags = 80, 5
    loss, other = autoregressive(random, total, 0.6) ** 2, random.normal(size=total) ** 2
    d = [float(value) for value in loss - other]
    mean = math.fsum(d) / total
    pairs = [
        (1 - abs(i - j) / (lags + 1)) * (d[i] - mean) * (d[j] - mean)
        for i in range(total)
        for j in range(total)
        if abs(i - j) <= lags
    ]
    plain = mean / math.sqrt(math.fsum(pairs) / total**2)
    h = lags + 1
    wanted = plain * math.sqrt((total + 1 - 2 * h + h * (h - 1) / total) / total)
    found = difference(loss, other, lags=lags)
    assert found.statistic == pytest.approx(wanted, rel=1e-12)
    assert found.p_value == pytest.approx(2 * stats.t.sf(abs(wanted), total - 1), rel=1e-10)


@pytest.mark.parametrize("slope", [0.0, 0.5, 0.8])
def test_chance_is_seldom_called_a_difference(slope):
    """5 % are asked for; in 600 draws 5 % vary by 0.9, and correlation that is estimated costs."""
    random = np.random.default_rng(2)
    called = 0
    for _ in range(600):
        one, other = (autoregressive(random, 300, slope) for _ in range(2))
        called += difference(one**2, other**2).beyond_chance
    assert 0.02 < called / 600 < 0.09


def test_a_difference_that_is_there_is_found():
    random = np.random.default_rng(3)
    for _ in range(20):
        one, other = random.normal(size=(2, 1000))
        found = difference(one**2, 1.5 * other**2)
        assert found.beyond_chance and found.statistic < 0 and 0.7 < found.ratio < 0.95


def test_more_lags_where_the_past_counts_more():
    random = np.random.default_rng(4)
    short, long = (window(autoregressive(random, 1000, slope)) for slope in (0.0, 0.9))
    assert short == 10 and 40 < long <= 250


def test_units_change_nothing():
    loss, other = np.random.default_rng(5).normal(size=(2, 200)) ** 2
    one, two = difference(loss, other), difference(1e-12 * loss, 1e-12 * other)
    assert two.p_value == pytest.approx(one.p_value, rel=1e-9) and two.lags == one.lags


def test_words_say_when_there_is_no_difference():
    loss, other = np.random.default_rng(6).normal(size=(2, 400)) ** 2
    assert difference(loss, other).words("it").startswith("No difference to it beyond chance: ")
    assert "10 times smaller than that of it" in difference(loss, 100 * loss).words("it")
    assert "more than chance" in difference(loss, 0.5 * loss).words("it")
    same = difference(loss, loss)
    assert (same.statistic, same.p_value, same.ratio) == (0.0, 1.0, 1.0)
    assert "the error is the same" in same.words("it")


def test_losses_of_nothing_are_the_same():
    found = difference(np.zeros(50), np.zeros(50))
    assert (found.p_value, found.ratio) == (1.0, 1.0)
    assert difference(np.zeros(50), np.ones(50)).p_value == 0.0


@pytest.mark.parametrize(
    ("loss", "other", "lags", "words"),
    [
        (np.ones(7), np.ones(7), None, "T >= 8"),
        (np.ones(9), np.ones(10), None, r"\(9,\) and other \(10,\)"),
        (np.full(9, np.nan), np.ones(9), None, "not finite"),
        (np.ones(20), np.ones(20), 6, "lags = 6, allowed: 0 to 5"),
    ],
)
def test_what_cannot_be_compared_is_refused(loss, other, lags, words):
    with pytest.raises(fg.InvalidInput, match=words):
        difference(loss, other, lags)
