"""When to trust an estimate: excitation, stability, bounds and intervals after the fact.

The theory of Lai and Bernstein (generalized forgetting RLS, arXiv 2308.04259) and of Goel,
Bruce and Bernstein (variable-direction forgetting, arXiv 2003.03523), with their errata
corrected, applied to a finished run:

    excitation           what the regressors excite, and since when not
    excited              how many directions and which parameters, all along the record
    information_content  the information-rich subspace, sample by sample
    spectrum             the frequencies in the regressors
    conditions           A1-A8 with the constants found
    stability            which conclusions of Theorem 2 follow
    guaranteed_bounds    bounds of P that a rule guarantees, by formula
    ultimate_bound       Theorem 3, corrected
    windup               where P grew without information
    confidence           standard errors, prediction intervals, coverage
    certify              all of it, and the verdict in plain words

`forgetting.plot` draws each of them (it needs matplotlib).
"""

from .certificate import Certificate, certify
from .conditions import Condition, Conditions, conditions
from .confidence import Confidence, confidence
from .content import Content, information_content
from .direction import describe_direction
from .excitation import Excitation, Persistency, excitation, persistency_window
from .excited import Excited, excited
from .guarantee import Guarantee, guaranteed_bounds
from .information import filtered_regressors
from .lyapunov import lyapunov, lyapunov_decrease, observed_decrease
from .spectrum import Spectrum, spectrum
from .stability import Conclusion, Stability, stability
from .trajectory import Trajectory
from .trend import Trend, trend
from .ultimate_bound import Amplification, UltimateBound, amplification, ultimate_bound
from .windup import Windup, windup

__all__ = [
    "Amplification",
    "Certificate",
    "Conclusion",
    "Condition",
    "Conditions",
    "Confidence",
    "Content",
    "Excitation",
    "Excited",
    "Guarantee",
    "Persistency",
    "Spectrum",
    "Stability",
    "Trajectory",
    "Trend",
    "UltimateBound",
    "Windup",
    "amplification",
    "certify",
    "conditions",
    "confidence",
    "describe_direction",
    "excitation",
    "excited",
    "filtered_regressors",
    "guaranteed_bounds",
    "information_content",
    "lyapunov",
    "lyapunov_decrease",
    "observed_decrease",
    "persistency_window",
    "spectrum",
    "stability",
    "trend",
    "ultimate_bound",
    "windup",
]
