"""The shared library through ctypes, for the tests."""

from __future__ import annotations

import ctypes
import os
from ctypes import POINTER, c_char_p, c_double, c_float, c_int32, c_size_t, c_void_p

import numpy as np
from numpy.typing import NDArray

NUMBERS = {"float32": 4, "float64": 8}
OK = 0
MEMBERS = 8


class Parameter(ctypes.Structure):
    """`fg_parameter`."""

    _fields_ = [("name", c_char_p), ("number", c_double), ("word", c_char_p)]


class Choice(ctypes.Structure):
    """`fg_choice`."""

    _fields_ = [("name", c_char_p), ("parameters", POINTER(Parameter)), ("count", c_size_t)]

    @classmethod
    def of(cls, name: str, parameters: dict[str, float | str]) -> Choice:
        """The choice of this name."""
        words = [
            Parameter(key.encode(), 0, value.encode())
            if isinstance(value, str)
            else Parameter(key.encode(), value, None)
            for key, value in parameters.items()
        ]
        return cls(name.encode(), (Parameter * len(words))(*words), len(words))


class Settings(ctypes.Structure):
    """`fg_settings`."""

    _fields_ = [
        ("parameters", c_size_t),
        ("rule", Choice),
        ("rate", Choice),
        ("weighting", Choice),
        ("gate", Choice),
        ("forgetting_factor", c_double),
        ("initial_covariance", c_double),
        ("initial_theta", POINTER(c_double)),
        ("monitor", c_int32),
    ]


def load() -> ctypes.CDLL:
    """The library that the environment names, with the types of its functions."""
    library = ctypes.CDLL(os.environ["FORGETTING_LIBRARY"])
    library.fg_find.restype = c_void_p
    library.fg_find.argtypes = [c_char_p, c_int32, c_size_t]
    library.fg_size.restype = library.fg_alignment.restype = c_size_t
    library.fg_size.argtypes = library.fg_alignment.argtypes = [c_void_p]
    library.fg_strerror.restype = c_char_p
    for name, real in (("f32", c_float), ("f64", c_double)):
        update = getattr(library, f"fg_update_{name}")
        update.argtypes = [c_void_p, c_void_p, c_size_t, real, c_void_p]
        after = getattr(library, f"fg_update_after_{name}")
        after.argtypes = [c_void_p, real, c_void_p, c_size_t, real, c_void_p, c_void_p]
        bounded = getattr(library, f"fg_bounded_{name}")
        bounded.argtypes = [c_void_p, c_void_p, c_void_p, c_size_t, c_void_p]
        for function in ("set_theta", "theta", "covariance", "weights"):
            one = getattr(library, f"fg_{function}_{name}")
            one.argtypes = [c_void_p, c_void_p, c_size_t]
    library.fg_init.argtypes = [c_void_p, c_size_t, c_void_p, c_void_p, c_void_p, c_void_p]
    library.fg_load.argtypes = [
        c_void_p,
        c_size_t,
        c_void_p,
        c_char_p,
        c_size_t,
        c_void_p,
        c_void_p,
    ]
    library.fg_save.argtypes = [c_void_p, c_void_p, c_size_t, c_void_p]
    return library


class Estimator:
    """An estimator in memory of its own."""

    def __init__(self, library: ctypes.CDLL, rule: str | None, dtype: str, n: int) -> None:
        """Memory for a kind."""
        self.library, self.n = library, n
        name = None if rule is None else rule.encode()
        self.kind = library.fg_find(name, NUMBERS[dtype], n)
        assert self.kind, (rule, dtype, n)
        self.size = library.fg_size(self.kind)
        self.memory = (c_double * (self.size // 8 + 1))()
        self.dtype, short = np.dtype(dtype), dtype.replace("loat", "")
        self.update_one = getattr(library, f"fg_update_{short}")
        self.update_one_after = getattr(library, f"fg_update_after_{short}")
        self.bounded_theta = getattr(library, f"fg_bounded_{short}")
        self.put_theta = getattr(library, f"fg_set_theta_{short}")
        self.read_covariance = getattr(library, f"fg_covariance_{short}")
        self.read_theta = getattr(library, f"fg_theta_{short}")
        self.read_weights = getattr(library, f"fg_weights_{short}")

    def init(self, settings: Settings) -> Estimator:
        """Made from settings."""
        self.check(self.library.fg_init(*self.place, ctypes.byref(settings), None, None))
        return self

    def load(self, state: bytes) -> Estimator:
        """Made from a saved state."""
        self.check(self.library.fg_load(*self.place, state, len(state), None, None))
        return self

    @property
    def place(self) -> tuple[object, ...]:
        """Memory, size and kind."""
        return ctypes.addressof(self.memory), self.size, self.kind

    def check(self, code: int) -> None:
        """Refuses a refusal."""
        assert code == OK, self.library.fg_strerror(code)

    def update(self, phi: NDArray[np.floating], y: NDArray[np.floating]) -> None:
        """Takes samples."""
        phi = np.ascontiguousarray(phi)
        memory = ctypes.addressof(self.memory)
        for row, value in zip(phi, y, strict=True):
            self.check(self.update_one(memory, row.ctypes.data, self.n, value, None))

    def update_after(
        self, elapsed: float, phi: NDArray[np.floating], y: np.floating, gamma: float | None
    ) -> None:
        """Takes a sample after a time, of this variance of its noise if that is known."""
        known = None if gamma is None else np.array([gamma], self.dtype).ctypes.data_as(c_void_p)
        memory = ctypes.addressof(self.memory)
        self.check(self.update_one_after(memory, elapsed, phi.ctypes.data, self.n, y, known, None))

    def bounded(
        self, lower: NDArray[np.floating], upper: NDArray[np.floating]
    ) -> NDArray[np.floating]:
        """The estimate within bounds."""
        theta = np.empty(self.n, self.dtype)
        bounds = [np.ascontiguousarray(x, self.dtype) for x in (lower, upper)]
        places = [x.ctypes.data for x in bounds]
        memory = ctypes.addressof(self.memory)
        self.check(self.bounded_theta(memory, *places, self.n, theta.ctypes.data))
        return theta

    def theta(self) -> NDArray[np.floating]:
        """The estimate."""
        theta = np.empty(self.n, self.dtype)
        self.check(self.read_theta(ctypes.addressof(self.memory), theta.ctypes.data, self.n))
        return theta

    def weights(self) -> NDArray[np.floating]:
        """How far each member of a bank is believed."""
        weights = np.empty(MEMBERS, self.dtype)
        place = ctypes.addressof(self.memory)
        self.check(self.read_weights(place, weights.ctypes.data, MEMBERS))
        return weights

    def covariance(self) -> NDArray[np.floating]:
        """P."""
        p = np.empty((self.n, self.n), self.dtype)
        self.check(self.read_covariance(ctypes.addressof(self.memory), p.ctypes.data, self.n))
        return p

    def set_theta(self, theta: NDArray[np.floating]) -> None:
        """Goes on from another estimate."""
        self.check(self.put_theta(ctypes.addressof(self.memory), theta.ctypes.data, self.n))

    def to_bytes(self) -> bytes:
        """As Python's."""
        length = c_size_t()
        memory = ctypes.addressof(self.memory)
        self.check(self.library.fg_save(memory, None, 0, ctypes.byref(length)))
        state = ctypes.create_string_buffer(length.value)
        self.check(self.library.fg_save(memory, state, length.value, ctypes.byref(length)))
        return state.raw
