"""One call from Python, n = 4, beside calls that do nothing and the same step by hand."""

from __future__ import annotations

import importlib.machinery
import importlib.util
import os
import platform
import shutil
import subprocess
import sys
import timeit
from collections.abc import Callable, Iterator
from functools import cache
from pathlib import Path
from typing import Any

import numpy as np

import forgetting as fg

from .compile import BUILT, NotAvailable
from .hand import BlasFilter, NumpyFilter
from .ledger import Ledger
from .markdown import table
from .packages import PadasipFilter
from .plan import Plan
from .record import LAMBDA
from .timing import Side, race

N = 4
# calls in one turn
CALLS = 2000
CRATE = Path(__file__).parent / "noop"


@cache
def noop() -> Any:
    """The module of the crate `noop`, built by cargo; raises NotAvailable."""
    if shutil.which("cargo") is None:
        raise NotAvailable("no cargo")
    environment = os.environ | {"PYO3_PYTHON": sys.executable, "PYO3_BUILD_EXTENSION_MODULE": "1"}
    if platform.system() == "Darwin":
        environment["RUSTFLAGS"] = "-C link-arg=-undefined -C link-arg=dynamic_lookup"
    command = ["cargo", "build", "--release", "--quiet", "--manifest-path", CRATE / "Cargo.toml"]
    command += ["--target-dir", BUILT / "noop"]
    answer = subprocess.run(command, env=environment, capture_output=True, text=True, check=False)
    built = [path for path in (BUILT / "noop" / "release").glob("*noop.*") if path.suffix != ".d"]
    if answer.returncode or not built:
        raise NotAvailable(
            answer.stderr.strip().splitlines()[-1] if answer.stderr else "no library"
        )
    return loaded(built[0])


def loaded(library: Path) -> Any:
    """A module from a library of whatever name."""
    loader = importlib.machinery.ExtensionFileLoader("noop", str(library))
    spec = importlib.util.spec_from_file_location("noop", library, loader=loader)
    if spec is None:
        raise NotAvailable(f"{library} is no module")
    module = importlib.util.module_from_spec(spec)
    loader.exec_module(module)
    return module


def call(name: str, setup: str, prepare: Callable[[], object] = lambda: None, **names: Any) -> Side:
    """`CALLS` calls of what `setup` names f, with the same arguments.

    `prepare` starts afresh: the same regressor for ever would wind exponential forgetting up.
    """
    names |= {"regressor": np.random.default_rng(0).standard_normal(N)}
    timer = timeit.Timer("f(phi, y)", f"{setup}; phi = regressor; y = 0.3", globals=names)
    timer.timeit(1)
    return Side(name, lambda: timer.timeit(CALLS), prepare, each=CALLS)


def floors(ledger: Ledger) -> Iterator[Side]:
    """Calls that do nothing."""
    yield call("C function that does nothing (operator.is_)", "from operator import is_ as f")
    try:
        empty = noop().Empty()
    except NotAvailable as missing:
        ledger.unavailable("PyO3 method that does nothing", missing)
        return
    yield call("PyO3 method that does nothing", "f = empty.update", empty=empty)
    yield call("PyO3 method that returns a new object", "f = empty.answer", empty=empty)


def rivals(ledger: Ledger) -> Iterator[Side]:
    """The same step by hand and in a package."""
    makers = {
        "NumPy by hand": NumpyFilter,
        "SciPy BLAS dsymv, dsyr": BlasFilter,
        "padasip FilterRLS, adapt": PadasipFilter,
    }
    for name, make in makers.items():
        try:
            made = make(N)
        except ImportError as missing:
            ledger.unavailable(f"{name}, one call", missing)
            continue
        yield call(name, "f = made.update", made.reset, made=made)


def report(plan: Plan, ledger: Ledger) -> Iterator[str]:
    """Markdown."""
    rules = {"exponential": fg.Exponential(LAMBDA), "subspace (the default)": fg.Subspace(LAMBDA)}
    mine = []
    for name, rule in rules.items():
        est = fg.RLS(N, rule=rule)
        mine.append(call(f"`RLS.update`, {name}", "f = est.update", est.reset, est=est))
    beside, by_hand = list(floors(ledger)), list(rivals(ledger))
    sides = [*mine, *beside, *by_hand]
    race(sides, plan.seconds)
    base = mine[0].nanoseconds
    times = [(side.name, side.nanoseconds) for side in sides]
    rows = [[name, f"{time:.0f}", f"{time / base:.2f}"] for name, time in times]
    yield table(["f(phi, y)", "ns", "times the first"], rows)
    for side in by_hand:
        ledger.compare("one call", f"n = {N}", side.name, side.nanoseconds / base)
