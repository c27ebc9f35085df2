"""Files of measuring systems: TDMS of LabVIEW, MDF of vehicles, ULog of PX4."""

from __future__ import annotations

import gc
import sys
import warnings
from typing import Any, BinaryIO

import numpy as np
import pandas as pd

from forgetting.extras import extra
from forgetting.record.formats.source import on_disk
from forgetting.record.formats.table import Table, choose
from forgetting.words.errors import RecordError, first_line


def tdms(stream: BinaryIO, source: str, part: str | None) -> Table:
    """Read a group of a TDMS file by npTDMS; a waveform brings its own time."""
    library = extra("nptdms", "reading TDMS", "tdms")
    content = opened(library.TdmsFile.read, stream, source, "TDMS")
    groups = {group.name: group for group in content.groups() if group.channels()}
    group = groups[choose(list(groups), part, source, "group")]
    channels = group.channels()
    columns = {channel.name: pd.Series(channel[:]) for channel in channels}
    if all("wf_increment" in channel.properties for channel in channels) and "time" not in columns:
        columns = {"time": pd.Series(channels[0].time_track()), **columns}
    units = [channel.properties.get("unit_string", "") for channel in channels]
    extra_columns = len(columns) - len(channels)
    return Table(
        pd.DataFrame(columns),
        "TDMS",
        {"group": repr(group.name)},
        {i + extra_columns: str(unit) for i, unit in enumerate(units) if unit},
    )


def mdf(stream: BinaryIO, source: str, part: str | None) -> Table:
    """Read a channel group of an MDF file by asammdf; groups have clocks of their own."""
    library = extra("asammdf", "reading MDF", "mdf")
    # a file of our own: of one that it cannot read, the library leaves open what it opened
    with on_disk(stream, ".mf4") as path, open(path, "rb") as file:
        content = opened(library.MDF, file, source, "MDF")
        try:
            names = {group_name(content, i): i for i in range(len(content.groups))}
            names = {name: i for name, i in names.items() if content.groups[i].channels}
            name = choose(list(names), part, source, "group")
            frame = quiet(content.get_group, names[name], ignore_value2text_conversions=True)
            units = {channel.name: channel.unit for channel in content.groups[names[name]].channels}
        finally:
            content.close()
    frame = frame.rename_axis("time").reset_index()
    by_place = {i: units[str(n)] for i, n in enumerate(frame.columns) if units.get(str(n))}
    return Table(frame, "MDF", {"group": repr(name)}, {0: "s", **by_place})


def group_name(content: Any, index: int) -> str:
    """Name of a channel group, or its number when it has none or not one of its own."""
    name = str(content.groups[index].channel_group.acq_name or "").strip()
    others = [str(group.channel_group.acq_name or "").strip() for group in content.groups]
    return name if name and others.count(name) == 1 else str(index)


def ulog(stream: BinaryIO, source: str, part: str | None) -> Table:
    """Read a topic of a ULog file by pyulog; its time stamps are microseconds."""
    library = extra("pyulog", "reading ULog", "ulog")
    stream.seek(0)
    content = opened(library.ULog, stream, source, "ULog")
    several = [topic.name for topic in content.data_list]
    topics = {
        topic.name if several.count(topic.name) == 1 else f"{topic.name}.{topic.multi_id}": topic
        for topic in content.data_list
    }
    name = choose(list(topics), part, source, "topic")
    frame = pd.DataFrame({key: np.asarray(value) for key, value in topics[name].data.items()})
    places = [i for i, column in enumerate(frame.columns) if column == "timestamp"]
    return Table(frame, "ULog", {"topic": repr(name)}, {i: "µs" for i in places})


def opened(reader: Any, content: Any, source: str, kind: str) -> Any:
    """Open by a library; whatever it makes of broken bytes becomes one sentence."""
    hook, sys.unraisablehook = sys.unraisablehook, lambda _: None
    try:
        try:
            return quiet(reader, content)
        except Exception as error:
            words = first_line(error)
        gc.collect()  # what the library made of half a file may fail once more when it ends
    finally:
        sys.unraisablehook = hook
    raise RecordError(f"{source} is not a whole {kind} file: {words}")


def quiet(function: Any, *arguments: Any, **options: Any) -> Any:
    """Call a function of a library whose warnings are about its own inner life."""
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        return function(*arguments, **options)
