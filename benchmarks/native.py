"""Peers in C++: compiled when first used, called through ctypes.

`peer("eigen").library(...)` compiles `cpp/eigen.cpp` into `build/bench/` with `$CXX` (c++ if not
set). What is missing is told by name, never installed.
"""

from __future__ import annotations

import contextlib
import ctypes
import hashlib
import os
import platform
import shutil
import subprocess
from concurrent.futures import ThreadPoolExecutor
from functools import cache
from pathlib import Path

import numpy as np

SOURCES = Path(__file__).parent / "cpp"
BUILT = Path(__file__).parent.parent / "build" / "bench"
FLAGS = "-std=c++17 -O3 -march=native -DNDEBUG"
# the best counts
FLAG_SETS = {
    "eigen": {"": FLAGS, "-ffast-math": f"{FLAGS} -ffast-math"},
    "dlib": {
        "own loops": f"{FLAGS} -DOWN_LOOPS",
        "OpenBLAS": f"{FLAGS} -l:libopenblas.so.0",
    },
}
# source: what it includes, Debian's package, and where that puts it if not where compilers look
NEEDS = {
    "eigen": ("Eigen/Dense", "libeigen3-dev", ["-isystem", "/usr/include/eigen3"]),
    "dlib": ("dlib/svm/rls.h", "libdlib-dev", []),
}


class NotAvailable(Exception):
    """Says what is missing."""


@cache
def compiler() -> str:
    """The C++ compiler."""
    command = os.environ.get("CXX", "c++")
    found = shutil.which(command)
    if found is None:
        raise NotAvailable(f"no C++ compiler ({command}); Debian: g++")
    return found


@cache
def compiler_version() -> str:
    """Its first line about itself."""
    answer = subprocess.run([compiler(), "--version"], capture_output=True, text=True, check=True)
    return answer.stdout.splitlines()[0]


@cache
def library(source: str, flags: str = FLAGS) -> ctypes.CDLL:
    """`cpp/<source>.cpp`, compiled with `flags`; raises NotAvailable."""
    path = SOURCES / f"{source}.cpp"
    header, package, include = NEEDS.get(source, ("", "", []))
    text = path.read_bytes() + (SOURCES / "filter.h").read_bytes()
    key = f"{flags} {compiler_version()} {platform.node()}".encode()
    built = BUILT / f"{source}-{hashlib.sha256(text + key).hexdigest()[:12]}.so"
    if not built.exists():
        BUILT.mkdir(parents=True, exist_ok=True)
        unfinished = built.with_suffix(".part")
        command = [compiler(), "-shared", "-fPIC", *include, "-o", str(unfinished), str(path)]
        command += flags.split()
        answer = subprocess.run(command, capture_output=True, text=True, check=False)
        if answer.returncode:
            raise NotAvailable(why(answer.stderr, header, package))
        unfinished.rename(built)
    return declared(ctypes.CDLL(str(built)), filters=source in NEEDS)


def build() -> None:
    """Compile all that can be, two at a time; what cannot is told when it is asked for."""

    def attempt(source: str, flags: str) -> None:
        with contextlib.suppress(NotAvailable):
            library(source, flags)

    with ThreadPoolExecutor(2) as pool:
        for source, sets in FLAG_SETS.items():
            for flags in sets.values():
                pool.submit(attempt, source, flags)


def why(said: str, header: str, package: str) -> str:
    """What the compiler's message means."""
    errors = [line for line in said.splitlines() if "error" in line or "cannot find" in line]
    error = errors[0] if errors else said[-200:]
    if header and header in error:
        return f"<{header}> is missing (Debian: {package})"
    return error


def declared(found: ctypes.CDLL, filters: bool) -> ctypes.CDLL:
    """The types of filter.h."""
    if filters:
        pointer, size = ctypes.c_void_p, ctypes.c_long
        found.variant_name.argtypes, found.variant_name.restype = [size], ctypes.c_char_p
        found.filter_make.argtypes = [size, size, ctypes.c_bool, ctypes.c_double, ctypes.c_double]
        found.filter_make.restype = pointer
        found.filter_reset.argtypes = found.filter_free.argtypes = [pointer]
        found.filter_run.argtypes = [pointer, size, pointer, pointer, pointer]
        found.filter_theta.argtypes = [pointer, pointer]
        for name in ("filter_reset", "filter_free", "filter_run", "filter_theta"):
            getattr(found, name).restype = None
    return found


class NativeFilter:
    """One variant of a peer, with a record to run over."""

    def __init__(self, found: ctypes.CDLL, handle: int, phi: np.ndarray, y: np.ndarray) -> None:
        self.found, self.handle = found, handle
        self.phi, self.y, self.errors = phi, y, np.empty_like(y)  # held: C++ reads their memory
        arrays = (array.ctypes.data for array in (phi, y, self.errors))
        self.arguments = (handle, len(y), *arrays)

    def reset(self) -> None:
        self.found.filter_reset(self.handle)

    def run(self) -> None:
        self.found.filter_run(*self.arguments)

    @property
    def theta(self) -> np.ndarray:
        out = np.empty(self.phi.shape[1], self.phi.dtype)
        self.found.filter_theta(self.handle, out.ctypes.data)
        return out

    def __del__(self) -> None:
        self.found.filter_free(self.handle)


def filters(
    source: str, phi: np.ndarray, y: np.ndarray, factor: float, p0: float
) -> dict[str, NativeFilter]:
    """Every variant of a peer for this record's size and type, with each set of flags."""
    made, missing = {}, []
    for label, flags in FLAG_SETS[source].items():
        try:
            found = library(source, flags)
        except NotAvailable as reason:
            missing.append(reason)
            continue
        for name, made_filter in variants(found, phi, y, factor, p0).items():
            made[f"{name}, {label}".rstrip(", ")] = made_filter
    if not made:
        raise missing[0]
    return made


def variants(
    found: ctypes.CDLL, phi: np.ndarray, y: np.ndarray, factor: float, p0: float
) -> dict[str, NativeFilter]:
    """Every variant of one library, by name."""
    made, index = {}, 0
    n, single = phi.shape[1], phi.dtype == np.float32
    while (name := found.variant_name(index)) is not None:
        if handle := found.filter_make(index, n, single, factor, p0):
            made[name.decode()] = NativeFilter(found, handle, phi, y)
        index += 1
    return made
