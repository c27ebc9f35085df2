"""Read the track of a TCX file (Garmin Training Center XML)."""

from __future__ import annotations

import xml.etree.ElementTree as ElementTree
from pathlib import Path

import pandas as pd

from forgetting.words.errors import RecordError

FIELDS = {"Time": "time", "AltitudeMeters": "altitude", "Speed": "speed", "Watts": "power"}
"""Elements of a track point and the columns they become: m, m/s, W."""


def read_tcx(path: Path) -> pd.DataFrame:
    """Return time (UTC), altitude (m), speed (m/s) and power (W) of every track point.

    A point that lacks a value has NaN there.
    """
    rows = []
    try:
        for _, element in ElementTree.iterparse(path):
            if local(element.tag) == "Trackpoint":
                rows.append(fields(element))
                element.clear()
    except ElementTree.ParseError as error:
        raise RecordError(f"{path} is not XML: {error}") from None
    if not rows:
        raise RecordError(f"{path} has no track points")
    frame = pd.DataFrame(rows, columns=list(FIELDS.values()))
    frame["time"] = pd.to_datetime(frame["time"], utc=True)
    for name in ("altitude", "speed", "power"):
        frame[name] = pd.to_numeric(frame[name])
    return frame


def fields(point: ElementTree.Element) -> dict[str, str | None]:
    """Texts of a track point; speed and power stand in its extensions."""
    return {
        FIELDS[local(child.tag)]: child.text for child in point.iter() if local(child.tag) in FIELDS
    }


def local(tag: str) -> str:
    """Tag without its namespace."""
    return tag.rpartition("}")[2]
