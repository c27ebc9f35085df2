"""Errors of the three papers, each with what was printed, what it should be, and evidence.

>>> from forgetting.papers.errata import ERRATA
>>> next(each for each in ERRATA if each.name == "V-2")()
('α = 1 for N = 1, 1 for 2N, 2 for 2N + 1', True)
"""

from . import gf, opd, vdf
from .erratum import Erratum

ERRATA = (*gf.ERRATA, *vdf.ERRATA, *opd.ERRATA)

__all__ = ["ERRATA", "Erratum"]
