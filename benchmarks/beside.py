"""What other packages do in situations that every recursive estimator meets.

    python -m benchmarks.beside

Three situations, the same samples for all: a parameter that changes, inputs that stand still, and a
missing measurement. Each package is used as its documentation shows, with a
forgetting factor of 0.98 where it has one. A package that is not installed is named.
"""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
from numpy.typing import NDArray

import forgetting as fg

from .markdown import table

Array = NDArray[np.float64]
Run = Callable[[Array, Array], Array]

FACTOR = 0.98
NOISE = 0.1


def ours(phi: Array, y: Array) -> Array:
    """Estimates after every sample (T, n), of the default of `forgetting identify`."""
    run = fg.Bank(phi.shape[1]).run(phi, y, outputs=("theta",), missing="skip")
    return np.asarray(run.theta)


def exponential(phi: Array, y: Array) -> Array:
    """Plain exponential forgetting, here too the textbook's."""
    est = fg.RLS(phi.shape[1], rule=fg.Exponential(FACTOR))
    return np.asarray(est.run(phi, y, outputs=("theta",), missing="skip").theta)


def river(phi: Array, y: Array) -> Array:
    """`BayesianLinearRegression(smoothing=0.98)`, a sample at a time."""
    from river.linear_model import BayesianLinearRegression

    model, n = BayesianLinearRegression(smoothing=FACTOR), phi.shape[1]
    found = np.empty_like(phi)
    for k, (row, target) in enumerate(zip(phi.tolist(), y.tolist(), strict=True)):
        model.learn_one(dict(enumerate(row)), target)
        found[k] = [model.predict_one({i: 1.0}) for i in range(n)]
    return found


def statsmodels(phi: Array, y: Array) -> Array:
    """`RecursiveLS(y, X).fit()`, which does not forget."""
    from statsmodels.regression.recursive_ls import RecursiveLS

    return np.asarray(RecursiveLS(y, phi).fit().recursive_coefficients.filtered.T)


PACKAGES: dict[str, Run] = {
    "forgetting, bank": ours,
    "forgetting, exponential": exponential,
    "river": river,
    "statsmodels": statsmodels,
}


def signals(samples: int, seed: int = 0) -> tuple[Array, Array]:
    """Regressors (T, 2) and noise (T,)."""
    random = np.random.default_rng(seed)
    return random.normal(size=(samples, 2)), NOISE * random.normal(size=samples)


def change(run: Run) -> str:
    """Error of a parameter that went from 1 to 2, 200 samples after it did."""
    phi, noise = signals(1200)
    truth = np.where(np.arange(1200) < 1000, 1.0, 2.0)
    theta = run(phi, phi[:, 0] * truth - phi[:, 1] + noise)
    return f"{abs(theta[-1, 0] - 2.0):.3f}"


def silence(run: Run) -> str:
    """Largest error while both inputs stand still for 3000 samples."""
    phi, noise = signals(3500)
    phi[500:] = [1.0, 0.5]
    theta = run(phi, phi @ [1.0, -1.0] + noise)
    return f"{np.abs(theta[500:] - [1.0, -1.0]).max():.3g}"


def missing(run: Run) -> str:
    """Error at the end of a record in which one measurement of 500 is NaN."""
    phi, noise = signals(500)
    y = phi @ [1.0, -1.0] + noise
    y[250] = np.nan
    error = np.abs(run(phi, y)[-1] - [1.0, -1.0]).max()
    return f"{error:.3f}" if np.isfinite(error) else "NaN ever after"


SITUATIONS = {
    "parameter 1 → 2, error after 200 samples": change,
    "largest error in 3000 samples of a constant input": silence,
    "one of 500 outputs missing, error at the end": missing,
}


def answer(situation: Callable[[Run], str], run: Run) -> str:
    """What a package does; its own words where it refuses."""
    try:
        with np.errstate(all="ignore"):
            return situation(run)
    except ImportError:
        return "not installed"
    except Exception as error:
        return f"{type(error).__name__}: {str(error)[:40]}"


def main() -> None:
    """Print the table."""
    rows = [
        [words, *(answer(situation, run) for run in PACKAGES.values())]
        for words, situation in SITUATIONS.items()
    ]
    print(table(["", *PACKAGES], rows))


if __name__ == "__main__":
    main()
