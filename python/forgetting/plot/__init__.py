"""Pictures of an identification and of its analysis, on Matplotlib axes.

Every function takes the axes to draw on (or makes them) and returns them. Colours are the
colour-blind safe set of Okabe and Ito (2008). Long records are thinned to what a screen can show,
keeping the extremes of every stretch. Needs ``pip install 'forgetting[cli]'``.

An `Identification` is drawn by `prediction`, `error`, `parameter`, `eigenvalues`,
`forgetting_factor`, `memories` (of a bank), `rank`, `excited` and `alarms`; `overview` puts them
into one picture. What `forgetting.analysis` found is drawn by the function of the same name:
`excitation`, `content`, `spectrum`, `conditions`, `stability`, `ultimate_bound`,
`guaranteed_bounds`, `windup`, `confidence`; an `Excited` by `excited_directions` and
`excited_parameters`. `weights` draws which members of a `Bank` are believed in a run.

A `PolynomialModel` is drawn by `poles_and_zeros` and `simulated`, what its methods return by
`time_response`, `frequency_response` (a Bode diagram) and `residual_tests` (or `autocorrelation`
and `cross_correlation` alone).
"""

from forgetting.plot.bars import bars, excited_directions, excited_parameters
from forgetting.plot.covariance import eigenvalues, forgetting_factor, guaranteed_bounds, windup
from forgetting.plot.intervals import confidence
from forgetting.plot.members import weights
from forgetting.plot.memories import memories
from forgetting.plot.overview import overview, save_overview
from forgetting.plot.parameters import parameter
from forgetting.plot.regressors import content, excitation, spectrum
from forgetting.plot.residual_tests import autocorrelation, cross_correlation, residual_tests
from forgetting.plot.responses import frequency_response, time_response
from forgetting.plot.roots import poles_and_zeros
from forgetting.plot.signals import error, prediction
from forgetting.plot.simulated import simulated
from forgetting.plot.style import PALETTE, styled
from forgetting.plot.theorems import conditions, stability, ultimate_bound
from forgetting.plot.trust import alarms, excited, rank

__all__ = [
    "PALETTE",
    "alarms",
    "autocorrelation",
    "bars",
    "conditions",
    "confidence",
    "content",
    "cross_correlation",
    "eigenvalues",
    "error",
    "excitation",
    "excited",
    "excited_directions",
    "excited_parameters",
    "forgetting_factor",
    "frequency_response",
    "guaranteed_bounds",
    "memories",
    "overview",
    "parameter",
    "poles_and_zeros",
    "prediction",
    "rank",
    "residual_tests",
    "save_overview",
    "simulated",
    "spectrum",
    "stability",
    "styled",
    "time_response",
    "ultimate_bound",
    "weights",
    "windup",
]
