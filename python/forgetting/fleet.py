"""A fleet's health, and fleets as Arrow tables."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ._core import Fleet, InvalidInput
from .extras import extra
from .health import EDGE

#: Where a table keeps the state of a new stream, among the metadata of its schema.
FRESH = b"forgetting.fleet.fresh"


@dataclass(frozen=True, eq=False)
class FleetHealth:
    """What is known of each stream's P: one number a stream.

    Attributes
    ----------
    largest_eigenvalue, smallest_eigenvalue : (count,) ndarray
        The largest and smallest element of D: the largest eigenvalue of P is at least that, the
        smallest at most that.
    condition : (count,) ndarray
        Their ratio: a lower bound of the condition number of P.
    windup : (count,) ndarray of bool
        Whether D has grown to more than ten times its first largest element.
    saturated : (count,) ndarray of bool
        Whether P is at the edge of its number type.
    samples : (count,) ndarray of int64
        Samples used since the start.

    Examples
    --------
    >>> import numpy as np
    >>> import forgetting as fg
    >>> fleet = fg.Fleet(3, 2, rule=fg.Exponential(0.9))
    >>> phi = np.array([[1.0, 0.0], [1.0, 0.0], [0.0, 1.0]])  # one direction each
    >>> for k in range(200):
    ...     u = fleet.update(phi, np.ones(3), mask=np.array([True, False, True]))
    >>> fleet.health().status.tolist()
    ['windup', 'ok', 'windup']
    """

    largest_eigenvalue: NDArray[np.floating[Any]]
    smallest_eigenvalue: NDArray[np.floating[Any]]
    condition: NDArray[np.floating[Any]]
    windup: NDArray[np.bool_]
    saturated: NDArray[np.bool_]
    samples: NDArray[np.int64]

    @property
    def status(self) -> NDArray[np.str_]:
        """In a word, (count,): "ok", "windup" or "saturated"."""
        return np.where(self.saturated, "saturated", np.where(self.windup, "windup", "ok"))


def health_of(
    dtype: str,
    largest: NDArray[np.floating[Any]],
    smallest: NDArray[np.floating[Any]],
    windup: NDArray[np.bool_],
    samples: NDArray[np.int64],
) -> FleetHealth:
    """The health of streams with these extreme elements of D; see `Fleet.health`."""
    edge = largest.dtype.type(EDGE[dtype])
    saturated = (largest > edge) | (smallest < 1 / edge)
    # D is from 2**-500 to 2**500 (2**-62 to 2**62): the ratio of two fits only in f64
    with np.errstate(over="ignore"):
        condition = largest / smallest
    return FleetHealth(largest, smallest, condition, windup, saturated, samples)


def to_arrow(fleet: Fleet) -> Any:
    """The streams as an Arrow table; see `Fleet.to_arrow`."""
    pa = extra("pyarrow", "a saved fleet")
    fresh, *states = fleet._states()
    schema = pa.schema(
        [pa.field("stream", pa.int64(), False), pa.field("state", pa.large_binary(), False)],
        metadata={FRESH: fresh},
    )
    return pa.table([np.arange(len(states)), states], schema=schema)


def from_arrow(table: Any) -> Fleet:
    """The fleet of an Arrow table; see `Fleet.from_arrow`."""
    pa = extra("pyarrow", "a saved fleet")
    if not isinstance(table, pa.Table):
        raise InvalidInput(f"table is of type {type(table).__name__}, allowed: a pyarrow.Table")
    names = table.column_names
    if "state" not in names:
        raise InvalidInput(f"table has the columns {names}, but no column state")
    if names.count("state") > 1 or names.count("stream") > 1:
        raise InvalidInput(f"table has the columns {names}, allowed: state and stream once each")
    states = table.column("state").to_pylist()
    kept = (table.schema.metadata or {}).get(FRESH)
    fresh = states[0] if kept is None and states else kept
    if fresh is None or not all(isinstance(state, bytes) for state in states):
        raise InvalidInput("the column state must hold the state of one stream or more, as bytes")
    return Fleet._of_states(fresh, _in_order(table, states))


def _in_order(table: Any, states: list[bytes]) -> list[bytes]:
    """The states by the number of their stream, if the table has it: rows may be in any order."""
    if "stream" not in table.column_names:
        return states
    streams = table.column("stream").to_pylist()
    if not all(isinstance(each, int) for each in streams) or len(set(streams)) < len(streams):
        raise InvalidInput("the column stream must hold whole numbers, each of them once")
    return [state for _, state in sorted(zip(streams, states, strict=True))]
