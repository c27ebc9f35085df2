"""Which columns of a table make the samples of a stream."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import asdict, dataclass
from typing import Any

from forgetting._core import InvalidInput
from forgetting.models.lags import names
from forgetting.models.named import NamedModel
from forgetting.models.orders import Each, Orders
from forgetting.words.duration import seconds_of

NAMES = ("prediction", "error", "leverage", "theta", "variance", "skipped")
"""All outputs of a row."""
STANDING = ("rows", "samples", "missing", "late", "status")
"""What is told of a stream, besides its parameters."""


@dataclass(frozen=True)
class Model:
    """The columns of a fleet's tables, and how regressors are made of them.

    Parameters
    ----------
    key, y : str
        The columns that say whose row it is and what was measured.
    phi : tuple of str
        The regressors; with `arx` the inputs of the ARX model.
    time : str, optional
        When the row was measured.
    offset : bool
        Whether a regressor of 1 comes after the others.
    arx : Orders, optional
        Past outputs, inputs and delay; lags are those of the row's own stream.
    gap : float, optional
        Longest step in time that lags reach across, in seconds where times are dates, else in
        their unit; any if there is none.

    Raises
    ------
    forgetting.InvalidInput
        When a column is not named by a text, is used twice, or no regressor is left.
    """

    key: str
    y: str
    phi: tuple[str, ...] = ()
    time: str | None = None
    offset: bool = False
    arx: Orders | None = None
    gap: float | None = None

    def __post_init__(self) -> None:
        for name in self.columns:
            if not isinstance(name, str) or not name:
                raise InvalidInput(f"a column is {name!r}, allowed: the name of a column")
        for role in (self.key, self.time):
            if role is not None and self.columns.count(role) > 1:
                raise InvalidInput(f"column {role!r} has two roles: key, time, y and phi are apart")
            if role in (*NAMES, *STANDING):
                raise InvalidInput(f"column {role!r} as key or time, allowed: no name of an output")
        if self.y in self.phi or len(set(self.phi)) < len(self.phi):
            raise InvalidInput(f"phi = {list(self.phi)}, allowed: each column once, and not y")
        if self.arx is not None and bool(self.phi) != bool(self.arx.nb):
            raise InvalidInput(f"phi = {list(self.phi)} with nb = {self.arx.nb}: inputs go with nb")
        if self.arx is not None:
            self.arx.input_lags(len(self.phi))  # says when orders are for other inputs
        if self.gap is not None and (self.time is None or self.arx is None or not self.gap > 0):
            raise InvalidInput(f"gap = {self.gap}, allowed: above 0, with time and arx")
        if len(set(self.regressors)) < len(self.regressors):
            raise InvalidInput(f"regressors are {self.regressors}, allowed: each name once")
        if not self.regressors:
            raise InvalidInput("phi is empty, allowed: one column or more, an offset, or arx")

    @property
    def columns(self) -> list[str]:
        """All columns that are read: key, time, y, phi."""
        return [self.key, *([] if self.time is None else [self.time]), self.y, *self.phi]

    @property
    def regressors(self) -> list[str]:
        """What each parameter belongs to, as in ``V(k-1)``, ``I(k)`` or ``offset``."""
        own = list(self.phi) if self.arx is None else names([self.y], self.phi, self.arx)
        return own + ["offset"] * self.offset

    def to_dict(self) -> dict[str, Any]:
        """All of it in plain values."""
        return asdict(self)

    @classmethod
    def of(cls, values: dict[str, Any]) -> Model:
        """The model that `to_dict` has told."""
        orders = None if values["arx"] is None else Orders(**values["arx"])
        return cls(**{**values, "phi": tuple(values["phi"]), "arx": orders})


def arx_of(model: str) -> Orders:
    """The orders of a named model, which must be linear in its parameters.

    Raises
    ------
    forgetting.InvalidInput
        When it is not, or cannot be read.

    Examples
    --------
    >>> arx_of("fir:nb=3,nk=1")
    Orders(na=0, nb=3, nk=1)
    """
    orders = NamedModel.parse(model).arx
    if orders is None:
        raise InvalidInput(
            f"model = {model!r}, allowed: fir, ar and arx; the regressors of others follow from "
            "the estimates, and a fleet keeps no signals of a model for each key"
        )
    return orders


def made(
    key: str,
    y: str,
    phi: str | Sequence[str],
    time: str | None,
    offset: bool,
    arx: Sequence[Each] | Orders | None,
    model: str | None,
    gap: Any,
) -> Model:
    """The model of what a user gives; one column needs no list, and a gap may be a text."""
    if model is not None:
        if arx is not None:
            raise InvalidInput(f"arx = {arx} and model = {model!r}, allowed: one of them")
        arx = arx_of(model)
    if arx is not None and not isinstance(arx, Orders):
        if len(arx) != 3:
            raise InvalidInput(f"arx = {tuple(arx)}, allowed: three whole numbers na, nb, nk")
        arx = Orders.of(arx)
    try:
        longest = None if gap is None else seconds_of(gap)
    except ValueError as error:
        raise InvalidInput(f"gap = {gap!r}: {error}") from None
    columns = (phi,) if isinstance(phi, str) else tuple(phi)
    return Model(key, y, columns, time, offset, arx, longest)
