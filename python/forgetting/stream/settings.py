"""What a stream is told: the model, the rule, and how lines are read."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, fields
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from forgetting.models.orders import Each
from forgetting.record.known import Bounds, Known
from forgetting.record.polynomial import which
from forgetting.words.errors import RecordError

OF_KNOWN = ("bounds", "fixed", "prior", "noise")


@dataclass(frozen=True)
class Settings:
    """Settings of a stream; each means what it means for `forgetting.record.identify`.

    Parameters
    ----------
    output, input : sequence of str
        Columns of an ARX model; without `arx` of a regression on the inputs of the same row.
    arx : sequence of three, optional
        Orders na, nb, nk; nb and nk may be sequences, with an order for each input.
    model : str, optional
        In the place of `arx` a structure and its orders, such as ``"armax:na=1,nb=1,nc=1,nk=1"``.
    formula : str, optional
        A regression whose terms need no more than the row and its lags.
    offset : bool
        Whether an ARX model or a regression by columns has a constant.
    rule, half_life, gate, initial_covariance, dtype
        The estimator; without a rule a bank.
    bounds, fixed, prior, noise
        What is known of parameters; a prior needs the noise.
    time, gap, missing
        The clock, its gaps in seconds, and what stands for missing values.
    separator : str, optional
        Between cells; found in the first lines when absent.
    names : sequence of str, optional
        The columns of a stream that has no line of names.
    """

    output: Sequence[str] = ()
    input: Sequence[str] = ()
    arx: Sequence[Each] | None = None
    model: str | None = None
    formula: str | None = None
    offset: bool = True
    rule: Any = "auto"
    half_life: Any = None
    gate: Any = None
    initial_covariance: ArrayLike | None = None
    dtype: str = "float64"
    bounds: Bounds = field(default_factory=dict)
    fixed: Mapping[str, float] = field(default_factory=dict)
    prior: Mapping[str, tuple[float, float]] = field(default_factory=dict)
    noise: float | None = None
    time: str | None = None
    gap: float | None = None
    missing: Sequence[str] = ()
    separator: str | None = None
    names: Sequence[str] | None = None

    def __post_init__(self) -> None:
        arx, named = which(self.formula, self.arx, self.model)
        if named is not None and self.half_life is not None:
            raise RecordError(
                f"the model {self.model} forgets by samples; leave out what counts time"
            )
        if named is not None and Known(self.bounds, self.fixed, self.prior, self.noise):
            raise RecordError(f"the model {self.model} takes no bounds, fixed values and priors")
        object.__setattr__(self, "arx", arx)
        object.__setattr__(self, "model", None if named is None else str(named))

    def known(self, regressors: Sequence[str], outputs: Sequence[str]) -> Known:
        """What is known of the parameters of a model with these regressors and outputs.

        Raises
        ------
        RecordError
            For a parameter that is not there, or a prior without the noise.
        """
        known = Known(self.bounds, self.fixed, self.prior, self.noise)
        if known.prior and known.noise is None:
            raise RecordError(
                "a prior is weighed against the noise, which a stream does not tell beforehand; "
                "give its standard deviation as noise"
            )
        known.check(regressors, outputs)
        return known

    def as_data(self) -> dict[str, str]:
        """Every setting as text, to be compared with that of a saved state; but nothing known."""
        found = {each.name: getattr(self, each.name) for each in fields(self)}
        unknown = [name for name in OF_KNOWN if not found[name]]
        return {name: text_of(found[name]) for name in found if name not in unknown}


def text_of(value: Any) -> str:
    """A setting as text; lists of any kind alike."""
    if isinstance(value, np.ndarray):
        value = value.tolist()
    return repr(lists(value))


def lists(value: Any) -> Any:
    """Sequences as lists, those in them too."""
    return [lists(each) for each in value] if isinstance(value, list | tuple) else value
