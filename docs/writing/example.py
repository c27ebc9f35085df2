"""The example of each choice: Python that runs when the page is written, with what it prints."""

from __future__ import annotations

import contextlib
import io
from collections.abc import Mapping
from typing import Any

from .shown import FACTOR, made

DATA = """import numpy as np
import forgetting as fg

random = np.random.default_rng(1)
phi = random.normal(size=(300, 2))
phi[100:200, 1] = 0.0  # the second input is silent
y = phi @ [3.0, 0.5] + random.normal(size=300)
"""
GROSS = "y[::25] += 20.0  # gross errors\n"
RUN = {
    "rule": """
est = fg.RLS(2, rule={made}, initial_covariance=100.0)
run = est.run(phi, y, outputs=["theta", "variance"])
for k in (99, 199, 299):  # before the silence, at its end, at the end
    print(k, run.theta[k].round(2), run.variance[k].round(4))
""",
    "rate": """
est = fg.RLS(2, rule=fg.Exponential({made}), initial_covariance=100.0)
run = est.run(phi, y, outputs=["theta", "forgetting_factor"])
print(run.theta[-1].round(2))
print(np.quantile(run.forgetting_factor, [0, 0.5, 1]).round(4))  # least, median, largest
""",
    "weighting": """
est = fg.RLS(2, rule=fg.Subspace({factor}), weighting={made}, initial_covariance=100.0)
run = est.run(phi, y, outputs=["theta", "weight"])
print(run.theta[-1].round(2))
print(run.weight[::25].max().round(2), np.median(run.weight).round(2))  # gross errors, others
""",
    "gate": """
est = fg.RLS(2, rule=fg.Exponential({factor}), gate={made}, initial_covariance=100.0)
run = est.run(phi, y, outputs=["theta", "gate"])
print(run.theta[-1].round(2))
for code, answer in fg.GATE.items():
    print(answer, int((run.gate == code).sum()))
""",
    "mixer": """
bank = fg.Bank(2, mixer={made})
run = bank.run(phi, y, outputs=["theta", "weights"])
print(run.theta[-1].round(2))
print(run.weights[-1].round(2))  # of the members, from slow to fast
print(bank.memory)  # samples
""",
}


def code(axis: str, about: Mapping[str, Any]) -> str:
    """The Python of the example."""
    data = DATA + (GROSS if axis == "weighting" else "")
    return data + RUN[axis].format(made=made(about), factor=FACTOR)


def printed(text: str) -> str:
    """What the Python prints."""
    out = io.StringIO()
    with contextlib.redirect_stdout(out):
        exec(compile(text, "example", "exec"), {"__name__": "example"})
    return out.getvalue()
