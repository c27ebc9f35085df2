"""Records for `benchmarks.accuracy`: a folder of them, or those that ship inside packages."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from forgetting.demo.cycling import FORMULA as RIDE
from forgetting.demo.packaged import locate
from forgetting.demo.ride import energy_balance
from forgetting.demo.solar import FORMULA as ARRAY
from forgetting.demo.solar import solar_record
from forgetting.demo.tcx import read_tcx
from forgetting.record.identify import build
from forgetting.record.read import read
from forgetting.record.samples import Samples

Array = NDArray[np.float64]
Problem = tuple[str, Array, Array]

SUFFIXES = (".csv", ".parquet")
SOLAR = (
    (
        "module temperature",
        "nrel_RSF_II.csv",
        "module_temp__1056",
        ("poa_irradiance__1055", "ambient_temp__1053", "wind_speed__1051"),
    ),
    (
        "string current",
        "snow_data.csv",
        "INV1 CB2 Current [A]",
        ("POA [W/m²]", "Module Temp [C]"),
    ),
    (
        "irradiance",
        "irradiance_RMIS_NREL.csv",
        "irradiance_poa__7984",
        ("irradiance_ghi__7981", "irradiance_dni__7982", "irradiance_dhi__7983"),
    ),
)
"""Records of pvanalytics: name, file, output and inputs."""


def of_folder(folder: Path, formula: str | None) -> Iterator[Problem]:
    """Each record as an ARX(2,2,1) of its last column on the others, or as the formula says."""
    for path in sorted(p for p in folder.iterdir() if p.suffix in SUFFIXES):
        record = read(path)
        names = [str(name) for name in record.frame.columns]
        if record.clock is not None:
            names.remove(record.clock.name)
        if formula is None:
            samples = build(record, None, [names[-1]], names[:-1], (2, 2, 1))
        else:
            samples = build(record, formula, [], [], None)
        yield complete(path.stem, samples)


def packaged() -> Iterator[Problem]:
    """Those inside the packages that `make demo` installs: solar arrays and a ride."""
    yield complete("solar array, gain", build(solar_record(), ARRAY, [], [], None))
    for name, file, output, inputs in SOLAR:
        record = read(locate("pvanalytics", "0.2.2", f"pvanalytics/data/{file}"))
        yield complete(name, build(record, None, [output], list(inputs), (2, 2, 1)))
    track = read_tcx(locate("sweat", "0.25.0", "sweat/examples/data/activity_4078723797.tcx"))
    yield complete("ride, speed", build(read(track), None, ["speed"], ["power"], (2, 2, 1)))
    balance = read(energy_balance(track), time="time")
    yield complete("ride, energy", build(balance, RIDE, [], [], None))


def complete(name: str, samples: Samples) -> Problem:
    """The samples without a missing value."""
    rows = samples.complete
    return name, samples.phi[rows], samples.y[rows, 0]
