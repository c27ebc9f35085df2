"""The one judge: what speaks for and against an estimate, each with its figure and what to do.

Every verdict of the package is made here, of `forgetting identify` and `certify`, of their reports
and JSON, and of `RLS.health`. Nothing here has a unit: a change of unit of any column changes no
verdict. A test that rejects is no verdict either: with a hundred thousand samples it rejects any
model, so an effect must also be large enough to matter.

    regressors     parameters that no sample tells of, or that no sample tells apart
    residuals      whether one-step errors follow from their own past
    inputs         whether they follow from the inputs of before
    memory         whether the estimate stands on enough samples
    poles          whether the model diverges when it runs on its own outputs
    windup         whether P grew without information
    excitation     whether what is remembered informs about every parameter
    intervals      whether errors are as large as predicted
    baselines      whether simpler predictions are as good
"""

from .finding import Finding, Judgement, Severity

__all__ = ["Finding", "Judgement", "Severity"]
