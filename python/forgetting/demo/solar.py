"""Five winter days of a solar array: nights without input, and a gain that drops at once.

The record is ``serf_west_15min.csv`` of pvanalytics 0.2.2 (SERF west array, NREL, Golden,
Colorado; 2 to 6 January 2022, 480 samples of 15 minutes). The model is that of a module datasheet,

    dc_power = (gain + slope · t_module) · poa

with poa the irradiance on the plane of the array (W/m²; the pyranometer's negative night offset is
set to zero) and t_module the mean of three module temperatures, in tens of degrees above 25 °C.
During 14 hours of night the regressor is zero, or close to it. On the last day the array gives
about 2 % of its power, as in the first morning: it looks covered by snow.
"""

from __future__ import annotations

from pathlib import Path

import pandas as pd

import forgetting as fg
from forgetting.demo.outcome import Outcome
from forgetting.demo.packaged import locate
from forgetting.demo.solar_page import REGULAR, TITLE, page, widest
from forgetting.demo.windup_picture import save_windup
from forgetting.record import Identification, identify, read
from forgetting.record.read import Record
from forgetting.report import save, write
from forgetting.words.rounding import brief

FORMULA = "dc_power ~ 0 + poa + poa:t_module"
MEMORY = 0.7
"""Forgetting factor of both rules that have one: a memory of about 50 minutes."""
NIGHT = 10.0
"""Threshold of the subspace rule: a regressor shorter than this is night."""
CITATION = "serf_west_15min.csv (pvanalytics 0.2.2)"


def solar(folder: Path) -> Outcome:
    """Identify the record by the bank and by three rules; write the reports and the picture."""
    found = identified()
    comparison, windup = folder / "solar.html", folder / "windup.png"
    write(page(found), comparison)
    picture(windup, found)
    reports = [folder / f"solar-{name}.html" for name in found]
    for result, path in zip(found.values(), reports, strict=True):
        save(result, path)
    rows = [
        (name, f"{each.scores.model[0]:.1f} W", brief(widest(each), 3), str(each.dead_zone))
        for name, each in found.items()
    ]
    header = ("rule", "one-step RMSE", "largest s.e. of gain", "samples held")
    return Outcome([comparison, *reports, windup], TITLE, header, rows)


def picture(path: Path, found: dict[str, Identification] | None = None) -> None:
    """Write only the picture of windup, as PNG."""
    found = found or identified()
    save_windup(found["exponential"], found["subspace"], REGULAR, path)


def identified() -> dict[str, Identification]:
    """Run the bank, which is told nothing, and three rules over the record."""
    record = solar_record()
    rules = {
        "none": fg.rule("none"),
        "exponential": fg.rule("exponential", forgetting_factor=MEMORY),
        "subspace": fg.rule("subspace", forgetting_factor=MEMORY, threshold=NIGHT),
    }
    return {"bank": identify(record, formula=FORMULA)} | {
        name: identify(record, formula=FORMULA, rule=rule, initial_covariance=100.0)
        for name, rule in rules.items()
    }


def solar_record() -> Record:
    """Read the columns of the model from the installed record."""
    raw = read(locate("pvanalytics", "0.2.2", "pvanalytics/data/serf_west_15min.csv")).frame
    modules = raw[[name for name in raw.columns if name.startswith("module_temp_")]]
    frame = pd.DataFrame(
        {
            "time": raw.iloc[:, 0],
            "dc_power": raw["dc_power__772"],
            "poa": raw["poa_irradiance__771"].clip(lower=0.0),
            "t_module": (modules.mean(axis=1) - 25.0) / 10.0,
        }
    )
    record = read(frame, time="time")
    return Record(record.frame, record.clock, CITATION)
