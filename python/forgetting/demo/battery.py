"""A battery cell under load, computed: a resistance that grows, rests without current, a gap.

The record ships in this package, so that everything can be tried on it; ``tools/battery.py`` of the
repository makes it and says how. In the model

    V(k) = a V(k−1) + b₀ I(k) + b₁ I(k−1) + c

b₀ is minus the resistance, which the cell was computed with: 30 mΩ at the begin, 45 at the end.
"""

from __future__ import annotations

from pathlib import Path

import forgetting as fg
from forgetting.demo.outcome import Outcome
from forgetting.files import whole
from forgetting.record import Identification, identify
from forgetting.report import save
from forgetting.words.rounding import brief

RECORD = Path(__file__).parent / "data" / "battery.csv"
TITLE = "A battery cell under load, computed with a resistance from 30 to 45 mΩ"
HEADER = ("rule", "resistance at the end", "one-step RMSE", "largest s.e. of the resistance")
MEMORY = 0.98
CURRENT, AFTER = 1, 200
"""Place of I(k) among the regressors; samples until the estimates have settled."""
NEXT = (
    "forgetting identify {record} --show",
    "forgetting identify {record} --output V --input I --arx 1,2,0 --report out.html",
    "forgetting tune {record} --output V --input I",
    "forgetting certify {record} --output V --input I --arx 1,2,0",
)
"""What to try next."""


def battery(folder: Path) -> Outcome:
    """Write a copy of the record, identify it with three rules and write the report of the bank."""
    record, page = folder / RECORD.name, folder / "battery.html"
    with whole(record) as made:
        made.write_bytes(RECORD.read_bytes())
    found = identified(record)
    save(found["bank"], page)
    rows = [row(name, each) for name, each in found.items()]
    lines = [line.format(record=record) for line in NEXT]
    return Outcome([record, page], TITLE, HEADER, rows, lines)


def identified(record: Path = RECORD) -> dict[str, Identification]:
    """Run the bank and two rules over the record."""
    rules = {"bank": "auto", "exponential": fg.Exponential(MEMORY), "subspace": fg.Subspace(MEMORY)}
    return {
        name: identify(record, output="V", input="I", arx=(1, 2, 0), rule=rule)
        for name, rule in rules.items()
    }


def row(name: str, found: Identification) -> tuple[str, ...]:
    """One line of the table."""
    resistance = -1000 * found.theta[:, CURRENT, 0]
    error = 1000 * found.standard_error_of(CURRENT)
    return (
        name,
        f"{resistance[-1]:.1f} ± {error[-1]:.1f} mΩ",
        f"{1000 * found.scores.model[0]:.1f} mV",
        f"{brief(float(error[AFTER:].max()), 3)} mΩ",
    )
