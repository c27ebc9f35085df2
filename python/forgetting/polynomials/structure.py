"""Orders of a polynomial model, and the one place where parameters become polynomials.

A difference equation is written with a plus before every term, y(k) = a1 y(k-1) + b1 u(k-1) + ...,
while the polynomials that multiply an output have it on the other side: A(q) = 1 - a1 q⁻¹ - ...
So a, d and f change their sign between the two, and b and c do not:

    A(q) y = Σ B_i(q)/F_i(q) u_i + C(q)/D(q) e + offset
    A = 1 - a1 q⁻¹ - ...     D = 1 - d1 q⁻¹ - ...     F_i = 1 - f1 q⁻¹ - ...
    C = 1 + c1 q⁻¹ + ...     B_i = b_nk q⁻ⁿᵏ + ... + b_(nk+nb-1) q⁻⁽ⁿᵏ⁺ⁿᵇ⁻¹⁾
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from forgetting._core import InvalidInput
from forgetting.polynomials.checks import whole

Array = NDArray[np.float64]
Orders = int | Sequence[int]

SIGN = {"a": -1.0, "b": 1.0, "c": 1.0, "d": -1.0, "f": -1.0}
"""What a parameter is multiplied by to be a coefficient of its polynomial."""
ENTRIES = ("nb", "nf", "nk")
"""Orders that every input has its own of."""


@dataclass(frozen=True)
class Block:
    """The parameters of one polynomial.

    Attributes
    ----------
    letter : str
        "a", "b", "c", "d" or "f".
    input : int or None
        Which input it belongs to.
    start : int
        Where its parameters begin in theta.
    lags : range
        The power of q⁻¹ of each.
    """

    letter: str
    input: int | None
    start: int
    lags: range

    @property
    def places(self) -> slice:
        """Where its parameters are in theta."""
        return slice(self.start, self.start + len(self.lags))


@dataclass(frozen=True)
class Structure:
    """Orders of A(q) y = Σ B_i(q)/F_i(q) u_i + C(q)/D(q) e + offset.

    ARX has nc = nd = nf = 0, ARMAX adds nc, output error (OE) has nb and nf alone, Box-Jenkins (BJ)
    has all but na. An order that every input has its own of may be given as one number for one
    input or as a sequence with one entry an input.

    The parameters are in the order a1 ... a_na; for each input b_nk ... b_(nk+nb-1); c1 ... c_nc;
    d1 ... d_nd; for each input f1 ... f_nf; the offset.

    Parameters
    ----------
    na, nc, nd : int
        Orders of A, C and D, >= 0.
    nb : int or sequence of int
        Coefficients of B for each input, >= 0; 0 or an empty sequence where there is no input.
    nf : int or sequence of int
        Order of F for each input, >= 0.
    nk : int or sequence of int
        Delay of each input in samples, >= 0.
    offset : bool
        Whether the last parameter is a constant.

    Raises
    ------
    forgetting.InvalidInput
        When an order is out of range, or there is no parameter at all.

    Examples
    --------
    >>> Structure(na=1, nb=(1, 2), nk=(1, 0), nc=1).names()
    ('a1', 'b1[u1]', 'b0[u2]', 'b1[u2]', 'c1')
    """

    na: int = 0
    nb: Orders = ()
    nc: int = 0
    nd: int = 0
    nf: Orders = 0
    nk: Orders = 1
    offset: bool = False

    def __post_init__(self) -> None:
        for name in ("na", "nc", "nd"):
            object.__setattr__(self, name, whole(name, getattr(self, name)))
        if np.array_equal(self.nb, 0):  # one number, as there is no input to have any
            object.__setattr__(self, "nb", ())
        inputs = np.size(self.nb)
        for name in ENTRIES:
            object.__setattr__(self, name, entries(name, getattr(self, name), inputs))
        if self.parameters == 0:
            raise InvalidInput("all orders are 0; a model needs at least one parameter")

    @property
    def inputs(self) -> int:
        """Number of inputs."""
        return np.size(self.nb)

    @property
    def parameters(self) -> int:
        """Number n of parameters."""
        return self.na + self.nc + self.nd + int(np.sum(self.nb) + np.sum(self.nf)) + self.offset

    def blocks(self) -> tuple[Block, ...]:
        """Where the parameters of each polynomial are, in the order of theta."""
        nb, nf, nk = (np.atleast_1d(getattr(self, name)).astype(int) for name in ENTRIES)
        sizes: list[tuple[str, int | None, range]] = [("a", None, range(1, self.na + 1))]
        sizes += [("b", i, range(nk[i], nk[i] + nb[i])) for i in range(self.inputs)]
        sizes += [("c", None, range(1, self.nc + 1)), ("d", None, range(1, self.nd + 1))]
        sizes += [("f", i, range(1, nf[i] + 1)) for i in range(self.inputs)]
        starts = np.cumsum([0, *(len(lags) for _, _, lags in sizes)]).tolist()
        return tuple(
            Block(letter, owner, start, lags)
            for (letter, owner, lags), start in zip(sizes, starts, strict=False)
        )

    def names(self, inputs: Sequence[str] | None = None) -> tuple[str, ...]:
        """Name the parameters: a1, b0, ...; with several inputs b0[u1], b0[u2], ..."""
        inputs = [f"u{i + 1}" for i in range(self.inputs)] if inputs is None else inputs
        of = ["" if self.inputs == 1 else f"[{name}]" for name in inputs]
        made = [
            f"{block.letter}{lag}" + ("" if block.input is None else of[block.input])
            for block in self.blocks()
            for lag in block.lags
        ]
        return (*made, "offset") if self.offset else tuple(made)

    def from_lag_order(self) -> NDArray[np.intp]:
        """Where each parameter stands if inputs are in the order of lags, as those of `ARX` are.

        There, b of all inputs at the shortest lag come first, then those at the next, and so on.
        ``theta[order]`` and ``covariance[np.ix_(order, order)]`` are in the order used here.

        Examples
        --------
        >>> structure = Structure(na=1, nb=(2, 2), nk=0)
        >>> structure.names(), structure.from_lag_order().tolist()
        (('a1', 'b0[u1]', 'b1[u1]', 'b0[u2]', 'b1[u2]'), [0, 1, 3, 2, 4])
        """
        lags = [lag for block in self.blocks() if block.letter == "b" for lag in block.lags]
        order = np.arange(self.parameters)
        rank = np.argsort(np.argsort(lags, kind="stable"))
        order[self.na : self.na + len(lags)] = self.na + rank
        return order

    def polynomial(self, theta: Array, block: Block) -> Array:
        """The coefficients of one polynomial, of q⁰, q⁻¹, ...; the delay of B is zeros."""
        made = np.zeros(max(block.lags.stop, 1))
        made[list(block.lags)] = SIGN[block.letter] * theta[block.places]
        if block.letter != "b":
            made[0] = 1.0
        return made


def entries(name: str, value: Orders, inputs: int) -> tuple[int, ...]:
    """An order of each input, checked; one number stands for all of them."""
    given = list(value) if isinstance(value, Sequence) else np.ravel(value).tolist()
    given = given * inputs if np.ndim(value) == 0 else given
    if len(given) != inputs:
        raise InvalidInput(f"{name} has {len(given)} entries, allowed: one for each of {inputs}")
    return tuple(whole(name, each) for each in given)
