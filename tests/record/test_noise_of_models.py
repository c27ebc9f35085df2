"""The noise variance of a model with coloured noise, whose first samples count less."""

import numpy as np
import pandas as pd
import pytest

from forgetting.record import identify


def plant(seed: int, missing: bool) -> pd.DataFrame:
    """ARMAX of two inputs, of which one wanders; white noise of variance 0.04."""
    random, samples = np.random.default_rng(seed), 1500
    slow, fast = 0.1 * random.normal(size=samples).cumsum(), random.normal(size=samples)
    e, y = 0.2 * random.normal(size=samples), np.zeros(samples)
    for k in range(2, samples):
        y[k] = 1.2 * y[k - 1] - 0.4 * y[k - 2] + 0.5 * slow[k - 1] + 0.8 * fast[k - 1] + 0.3
        y[k] += e[k] + 0.6 * e[k - 1]
    if missing:
        y[700:720] = np.nan
    return pd.DataFrame({"slow": slow, "fast": fast, "y": y})


def found(rule: str, seed: int, missing: bool):
    return identify(
        plant(seed, missing),
        output="y",
        input=["slow", "fast"],
        model="armax:na=2,nb=1,nc=1,nk=1",
        rule=rule,
        level=0.9,
    )


@pytest.mark.parametrize("missing", [False, True])
@pytest.mark.parametrize("rule", ["auto", "none"])
def test_the_start_does_not_widen_intervals(rule, missing):
    for seed in range(4):
        held = found(rule, seed, missing).intervals.by_output(("y",))["y"]["mean_square"]
        assert 0.87 < held < 0.95


@pytest.mark.parametrize("missing", [False, True])
def test_the_noise_variance_is_that_of_the_noise(missing):
    variance = [found("none", seed, missing).noise_variance[-1, 0] for seed in range(4)]
    assert np.mean(variance) == pytest.approx(0.04, rel=0.15)
