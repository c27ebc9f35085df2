"""The state of a stream as a file: whole or not at all, and refused when it was altered."""

from __future__ import annotations

import hashlib
import json
from collections.abc import Mapping
from pathlib import Path
from typing import Any

from forgetting.files import write_text
from forgetting.words.errors import RecordError

FORMAT = "state of forgetting stream"
VERSION = 1


def save(path: Path, state: Mapping[str, Any]) -> None:
    """Write a state; the one before stays until all of the new one is on disk."""
    body = json.dumps({"format": FORMAT, "version": VERSION, **state})
    write_text(path, f"{digest(body)}\n{body}\n")


def load(path: Path) -> dict[str, Any] | None:
    """Read a state; None where there is no file yet.

    Raises
    ------
    RecordError
        When the file is no state, is of another version, or is not as it was written.
    """
    try:
        text = path.read_text(encoding="utf-8")
    except FileNotFoundError:
        return None
    except UnicodeDecodeError:
        raise RecordError(f"--state {path} is no state of a stream") from None
    mark, _, body = text.partition("\n")
    if FORMAT not in body[:100]:
        raise RecordError(f"--state {path} is no state of a stream")
    if mark != digest(body.rstrip("\n")):
        raise RecordError(f"--state {path} was altered since it was written; it cannot be trusted")
    state: dict[str, Any] = json.loads(body)
    if state["version"] != VERSION:
        raise RecordError(
            f"--state {path} is of version {state['version']}, but this command reads {VERSION}"
        )
    return state


def digest(body: str) -> str:
    """A digest by which any change of the file shows."""
    return hashlib.blake2b(body.encode(), digest_size=16).hexdigest()


def check_settings(path: Path, saved: Mapping[str, Any], now: Mapping[str, Any]) -> None:
    """Refuse to go on with other settings than those that the state was made with.

    Raises
    ------
    RecordError
        Naming the first that differs.
    """
    for name in (*now, *saved):
        # of a setting that there was not yet nothing was said
        before, after = (each.get(name, "None") for each in (saved, now))
        if before != after:
            raise RecordError(
                f"--state {path} was made with {name} {before}, and now it is "
                f"{after}; go on with the same, or name another state"
            )
