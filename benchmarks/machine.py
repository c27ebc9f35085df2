"""Machine and versions."""

from __future__ import annotations

import importlib.metadata
import os
import platform
from collections.abc import Iterator

import forgetting as fg

from . import native
from .compile import FLAG_SETS, FLAGS, NotAvailable, compiler_version
from .cpu import VARIABLE, caches, cores, level, levels, model
from .environment import THREADS
from .ledger import Ledger
from .plan import Plan

PACKAGES = ("numpy", "scipy", "numba", "padasip", "pyroomacoustics", "statsmodels", "river")


def version(package: str) -> str:
    """Of a Python package."""
    try:
        return f"{package} {importlib.metadata.version(package)}"
    except importlib.metadata.PackageNotFoundError:
        return f"{package} not installed"


def compiled() -> Iterator[str]:
    """The C++ side."""
    try:
        yield compiler_version()
    except NotAvailable as missing:
        yield str(missing)
        return
    for source in FLAG_SETS:
        try:
            yield native.version(source)
        except NotAvailable as missing:
            yield f"{source}: {missing}"
    added = [
        flags.removeprefix(FLAGS).strip() for sets in FLAG_SETS.values() for flags in sets.values()
    ]
    yield f"flags `{FLAGS}`, also with " + ", ".join(f"`{flag}`" for flag in added if flag)


def report(plan: Plan, ledger: Ledger) -> Iterator[str]:
    """Markdown."""
    sizes = ", ".join(f"{name} {size // 1024} KiB" for name, size in caches().items())
    forced = os.environ.get(VARIABLE)
    load = ", ".join(f"{load:.1f}" for load in os.getloadavg())
    yield f"- {model()}; {cores()} cores; caches {sizes or 'unknown'}; {platform.platform()}"
    yield (
        f"- forgetting {fg.__version__}, instructions {level()} of {', '.join(levels())}"
        f" ({VARIABLE} {forced or 'not set'}); C++ with what `-march=native` gives"
    )
    yield f"- Python {platform.python_version()}, " + ", ".join(map(version, PACKAGES))
    yield "- " + ", ".join(compiled())
    yield (
        f"- {THREADS} thread each, sides in turns, the least processor time of all turns; load"
        f" average at the start {load} (others' work slows all sides: read ratios)"
    )
