"""The three papers, reproduced and corrected: examples, figures, tables, claims and errata.

vdf
    A. Goel, A. L. Bruce, D. S. Bernstein, "Recursive least squares with variable-direction
    forgetting: compensating for the loss of persistency", IEEE Control Systems Magazine 40(4),
    2020 (arXiv 2003.03523)
gf
    B. Lai, D. S. Bernstein, "Generalized forgetting recursive least squares: stability and
    robustness guarantees", IEEE Transactions on Automatic Control (arXiv 2308.04259)
opd
    K. Zhu, C. Yu, Y. Wan, "Recursive least squares identification with variable-direction
    forgetting via oblique projection decomposition", IEEE/CAA Journal of Automatica Sinica 9(3),
    2022

``forgetting reproduce`` measures every claim, draws every figure and writes a report. Every claim
is a `Check`: call it and see what was measured beside what was printed.

>>> from forgetting.papers import all_checks
>>> claim = all_checks("vdf", example=7)[0]()
>>> claim.verdict, claim.holds
('reproduced', True)
"""

from .catalogue import PAPERS, all_checks, all_pictures
from .claim import SEEDS, Check, Claim

__all__ = ["PAPERS", "SEEDS", "Check", "Claim", "all_checks", "all_pictures"]
