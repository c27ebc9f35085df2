"""C++ sources compiled when first needed, into `build/bench/`, with `$CXX` (c++ if not set).

What is missing is told by name, never installed.
"""

from __future__ import annotations

import ctypes
import hashlib
import os
import shutil
import subprocess
from concurrent.futures import ThreadPoolExecutor
from functools import cache
from pathlib import Path

from .cpu import processor

SOURCES = Path(__file__).parent / "cpp"
BUILT = Path(__file__).parent.parent / "build" / "bench"
FLAGS = "-std=gnu++17 -O3 -march=native -DNDEBUG -pthread"
# by peer, what is tried; the best counts
FLAG_SETS = {
    "eigen": {"": FLAGS, "-ffast-math": f"{FLAGS} -ffast-math"},
    "dlib": {
        "own loops": f"{FLAGS} -DOWN_LOOPS",
        "OpenBLAS": f"{FLAGS} -l:libopenblas.so.0",
    },
}
# what the compiler does not find: what to install
PACKAGES = {
    "Eigen/Dense": "libeigen3-dev",
    "dlib/": "libdlib-dev",
    "libopenblas.so.0": "libopenblas0-pthread",
}


class NotAvailable(Exception):
    """Says what is missing."""


@cache
def compiler() -> str:
    """The C++ compiler."""
    command = os.environ.get("CXX", "c++")
    found = shutil.which(command)
    if found is None:
        raise NotAvailable(f"no C++ compiler `{command}` (Debian: g++)")
    return found


@cache
def compiler_version() -> str:
    """Its first line about itself."""
    answer = subprocess.run([compiler(), "--version"], capture_output=True, text=True, check=True)
    return answer.stdout.splitlines()[0]


def library(source: str, flags: str = FLAGS) -> ctypes.CDLL:
    """`cpp/<source>.cpp`, compiled with `flags`; raises NotAvailable."""
    found = attempt(source, flags)
    if isinstance(found, NotAvailable):
        raise found
    return found


@cache
def attempt(source: str, flags: str) -> ctypes.CDLL | NotAvailable:
    """One compilation, or why it failed, so that nothing is tried twice."""
    try:
        built = BUILT / f"{source}-{fingerprint(source, flags)}.so"
        if not built.exists():
            compile_to(built, SOURCES / f"{source}.cpp", flags)
        return ctypes.CDLL(str(built))
    except NotAvailable as missing:
        return missing
    except OSError as unloadable:
        return NotAvailable(str(unloadable))


def fingerprint(source: str, flags: str) -> str:
    """Of all that decides what the compiler makes."""
    texts = [(SOURCES / name).read_text() for name in (f"{source}.cpp", "filter.h")]
    made_for = [flags, compiler_version(), str(processor().get("flags"))]
    return hashlib.sha256("\n".join(texts + made_for).encode()).hexdigest()[:12]


def compile_to(built: Path, source: Path, flags: str) -> None:
    """Compile one source; raises NotAvailable."""
    BUILT.mkdir(parents=True, exist_ok=True)
    unfinished = built.with_suffix(".part")
    command = [compiler(), "-shared", "-fPIC", "-isystem", "/usr/include/eigen3"]
    command += ["-o", str(unfinished), str(source), *flags.split()]
    answer = subprocess.run(command, capture_output=True, text=True, check=False)
    if answer.returncode:
        raise NotAvailable(why(answer.stderr))
    unfinished.rename(built)


def why(said: str) -> str:
    """What the compiler's or linker's message means."""
    signs = ("error:", "cannot find", "not found")
    told = [line for line in said.splitlines() if any(sign in line for sign in signs)]
    first = (told[0] if told else said[-200:]).split("error:")[-1].strip()
    needed = [package for name, package in PACKAGES.items() if name in first]
    return f"{first} (Debian: {needed[0]})" if needed else first


def build() -> None:
    """Compile all, two at a time."""
    with ThreadPoolExecutor(2) as pool:
        pool.submit(attempt, "limits", FLAGS)
        for source, sets in FLAG_SETS.items():
            for flags in sets.values():
                pool.submit(attempt, source, flags)
