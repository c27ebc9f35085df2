"""A plant's lines, streams in this process and as a process of their own."""

from __future__ import annotations

import io
import json
import subprocess
import sys
from collections.abc import Callable, Iterable
from dataclasses import dataclass
from tempfile import TemporaryFile
from typing import Any

import numpy as np
import pytest

from forgetting.cli import main
from forgetting.stream import Settings, Stream

COMMAND = [sys.executable, "-m", "forgetting.cli", "stream"]
PLANT = ("--output", "y", "--input", "u", "--arx", "1,1,1")


def plant(samples: int, seed: int = 5) -> np.ndarray:
    """Rows (time, u, y) of y(k) = 0.8 y(k-1) + 0.5 u(k-1) + 2, with noise, every tenth second."""
    rng = np.random.default_rng(seed)
    u, noise = rng.normal(size=samples), 0.05 * rng.normal(size=samples)
    y = np.full(samples, 10.0)
    for k in range(1, samples):
        y[k] = 0.8 * y[k - 1] + 0.5 * u[k - 1] + 2.0 + noise[k]
    return np.column_stack([np.arange(samples) / 10, u, y])


def as_csv(table: Iterable[Iterable[float]], header: str = "t_s,u,y") -> bytes:
    """Lines of CSV in which every number keeps all of its digits."""
    lines = [",".join(repr(float(value)) for value in row) for row in table]
    return "\n".join([header, *lines, ""]).encode()


def objects(lines: Iterable[bytes]) -> list[dict[str, Any]]:
    """Lines of JSON as objects."""
    return [json.loads(line) for line in lines]


def rows(lines: Iterable[bytes]) -> list[dict[str, Any]]:
    """The same without alarms."""
    return [each for each in objects(lines) if "alarm" not in each]


def arx(**more: Any) -> Settings:
    """Settings of the plant's model."""
    return Settings(**({"output": ("y",), "input": ("u",), "arx": (1, 1, 1)} | more))


def fed(data: bytes, settings: Settings, fields: str | None = None, to: str = "json") -> Stream:
    """A stream that has taken all lines; they stand in its attribute `lines`."""
    stream = Stream(settings, to, fields)
    stream.lines = stream.feed(data).lines
    return stream


@dataclass(frozen=True)
class Finished:
    """A command that has ended."""

    returncode: int
    stdout: bytes
    stderr: bytes


def command(*arguments: object, data: bytes = b"") -> Finished:
    """Run the command in this process on lines of standard input."""
    said = io.StringIO()
    with TemporaryFile() as given, TemporaryFile() as out, pytest.MonkeyPatch.context() as patch:
        given.write(data)
        given.seek(0)
        patch.setattr(sys, "stdin", given)
        patch.setattr(sys, "stdout", out)
        patch.setattr(sys, "stderr", said)
        code = main(["stream", *map(str, arguments)])
        out.seek(0)
        return Finished(code, out.read(), said.getvalue().encode())


@pytest.fixture
def started() -> Iterable[Callable[..., subprocess.Popen]]:
    """Start the command; what still runs at the end is ended."""
    processes: list[subprocess.Popen] = []

    def start(*arguments: object, **more: Any) -> subprocess.Popen:
        pipes = {"stdin": subprocess.PIPE, "stdout": subprocess.PIPE, "stderr": subprocess.PIPE}
        processes.append(subprocess.Popen([*COMMAND, *map(str, arguments)], **(pipes | more)))
        return processes[-1]

    yield start
    for process in processes:
        process.kill()
        process.wait()
        for pipe in (process.stdin, process.stdout, process.stderr):
            if pipe is not None:
                pipe.close()
