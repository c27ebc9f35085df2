"""Filters in C++, called through ctypes: the other side of `cpp/filter.h`."""

from __future__ import annotations

import ctypes
from collections.abc import Iterator
from functools import cache

import numpy as np

from .compile import FLAG_SETS, NotAvailable, library


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


def declared(found: ctypes.CDLL) -> ctypes.CDLL:
    """The types of filter.h."""
    pointer, size = ctypes.c_void_p, ctypes.c_long
    found.peer_version.restype = found.variant_name.restype = ctypes.c_char_p
    found.variant_name.argtypes = [size]
    found.filter_make.argtypes = [size, size, ctypes.c_bool, ctypes.c_double, ctypes.c_double]
    found.filter_make.restype = pointer
    found.filter_reset.argtypes = found.filter_free.argtypes = [pointer]
    found.filter_run.argtypes = [pointer, size, pointer, pointer, pointer]
    found.filter_theta.argtypes = [pointer, pointer]
    for name in ("filter_reset", "filter_free", "filter_run", "filter_theta"):
        getattr(found, name).restype = None
    return found


def libraries(source: str, missing: dict[str, str]) -> dict[str, ctypes.CDLL]:
    """A peer compiled with each set of flags; raises NotAvailable if none can be."""
    found, reasons = {}, {}
    for label, flags in FLAG_SETS[source].items():
        try:
            found[label] = declared(library(source, flags))
        except NotAvailable as reason:
            reasons[f"{source}, {label}"] = reason
    if not found:
        raise next(iter(reasons.values()))
    missing.update({name: str(reason) for name, reason in reasons.items()})
    return found


@cache
def version(source: str) -> str:
    """As the peer's header says."""
    return next(iter(libraries(source, {}).values())).peer_version().decode()


def filters(
    source: str,
    record: tuple[np.ndarray, np.ndarray],
    setting: tuple[float, float],
    missing: dict[str, str],
    only: str = "",
) -> dict[str, NativeFilter]:
    """Every variant of a peer for a record's size and type, with each set of flags, by name.

    `setting` is the forgetting factor and the variance before the first sample, `only` what the
    name of a variant must contain. A set of flags that fails is noted in `missing`; raises
    NotAvailable if all fail.
    """
    (phi, y), made = record, {}
    n, single = phi.shape[1], phi.dtype == np.float32
    for label, found in libraries(source, missing).items():
        for index, name in enumerate(names(found)):
            handle = found.filter_make(index, n, single, *setting) if only in name else None
            if handle:
                made[f"{name}, {label}".removesuffix(", ")] = NativeFilter(found, handle, phi, y)
    return made


def names(found: ctypes.CDLL) -> Iterator[str]:
    """Of the variants in one library."""
    index = 0
    while (name := found.variant_name(index)) is not None:
        yield name.decode()
        index += 1
