"""Pictures of an identification, on Matplotlib axes.

Every function takes the axes to draw on (or makes them) and returns them. Colours are the
colour-blind safe set of Okabe and Ito (2008). Long records are thinned to what a screen can show,
keeping the extremes of every stretch. Needs ``pip install 'forgetting[cli]'``.
"""

from forgetting.plot.covariance import eigenvalues, forgetting_factor
from forgetting.plot.overview import overview, save_overview
from forgetting.plot.parameters import parameter
from forgetting.plot.signals import error, prediction
from forgetting.plot.style import PALETTE, styled
from forgetting.plot.trust import alarms, excited, rank

__all__ = [
    "PALETTE",
    "alarms",
    "eigenvalues",
    "error",
    "excited",
    "forgetting_factor",
    "overview",
    "parameter",
    "prediction",
    "rank",
    "save_overview",
    "styled",
]
