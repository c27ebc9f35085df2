"""A bicycle ride with a power meter: mass, rolling resistance and drag area.

The record is ``activity_4078723797.tcx`` of sweat 0.25.0 (20 September 2019, 2.3 hours at 1 Hz in
the Belgian Ardennes). How the track becomes regressors stands in `forgetting.demo.ride`.
"""

from __future__ import annotations

from pathlib import Path

import numpy as np

import forgetting as fg
from forgetting.demo.cycling_page import TITLE, page, shown
from forgetting.demo.outcome import Outcome
from forgetting.demo.packaged import locate
from forgetting.demo.physics import Result, rider
from forgetting.demo.ride import energy_balance
from forgetting.demo.tcx import read_tcx
from forgetting.record import identify, read
from forgetting.record.read import Record
from forgetting.report import save, write

FORMULA = "power ~ 0 + energy_rate + weight_speed + speed_cubed"
MEMORY = 0.99
"""Forgetting factor: a memory of about 100 windows, 50 minutes."""
CITATION = "activity_4078723797.tcx (sweat 0.25.0)"


def cycling(folder: Path) -> Outcome:
    """Identify the ride with three rules and write the reports."""
    results, altitude = identified()
    comparison = folder / "cycling.html"
    write(page(results, altitude), comparison)
    reports = [folder / f"cycling-{name}.html" for name in results]
    for result, path in zip(results.values(), reports, strict=True):
        save(result.found, path)
    rows = [
        (
            name,
            shown(each.rider.mass),
            shown(each.rider.rolling),
            shown(each.rider.drag_area),
            f"{each.found.scores.model[0]:.1f} W",
        )
        for name, each in results.items()
    ]
    header = ("rule", "total mass (kg)", "Crr", "CdA (m²)", "one-step RMSE")
    return Outcome([comparison, *reports], TITLE, header, rows)


def ride_record() -> tuple[Record, float]:
    """Read the columns of the model from the installed record; also its mean altitude in m."""
    track = read_tcx(locate("sweat", "0.25.0", "sweat/examples/data/activity_4078723797.tcx"))
    altitude = float(np.nanmean(track["altitude"]))
    record = read(energy_balance(track), time="time")
    return Record(record.frame, record.clock, CITATION), altitude


def identified() -> tuple[dict[str, Result], float]:
    """Run the three rules over the ride; also returns its mean altitude in m."""
    record, altitude = ride_record()
    rules = {
        "none": fg.rule("none"),
        "exponential": fg.rule("exponential", forgetting_factor=MEMORY),
        "subspace": fg.rule("subspace", forgetting_factor=MEMORY),
    }
    found = {
        name: identify(record, formula=FORMULA, rule=rule, initial_covariance=100.0)
        for name, rule in rules.items()
    }
    return {name: Result(each, rider(each, altitude)) for name, each in found.items()}, altitude
