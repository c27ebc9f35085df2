"""Runs candidates side by side in threads, counts them and keeps what each scored."""

from __future__ import annotations

import os
from collections.abc import Callable, Iterable, Sequence
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass

import numpy as np

from forgetting._core import InvalidInput, NumericalRange
from forgetting.tuning.baseline import rms, typical
from forgetting.tuning.candidate import Candidate
from forgetting.tuning.problem import Array, Problem, Split
from forgetting.tuning.structures import ModelOrders

Make = Callable[[ModelOrders | None], Problem]
Progress = Callable[[int, int], None]


@dataclass(frozen=True)
class Trial:
    """A candidate and its one-step error on the samples that choose.

    Attributes
    ----------
    candidate : Candidate
        What was tried.
    error : float
        Root mean square, of several outputs the geometric mean; infinite where the run failed.
    stage : str
        What it was tried for: "orders", "bank", "factors", "parameters", "rates" or "priors".
    """

    candidate: Candidate
    error: float
    stage: str


class Runner:
    """Runs candidates on the first part of a record.

    Parameters
    ----------
    make : callable
        Makes the problem of given orders; None stands for the only model.
    split : Split
        The two parts.
    threads : int, optional
        How many run side by side; one for each core if not given.
    progress : callable, optional
        Called with (runs done, runs expected) after each run.
    """

    def __init__(
        self, make: Make, split: Split, threads: int | None = None, progress: Progress | None = None
    ) -> None:
        if threads is not None and threads < 1:
            raise InvalidInput(f"threads = {threads}, allowed: 1 or more")
        self.make, self.split, self.progress = make, split, progress
        self.threads = threads or os.cpu_count() or 1
        self.trials: list[Trial] = []
        self.expected = 0
        self._known: dict[Candidate, float] = {}
        self._kept: tuple[ModelOrders | None, Problem] | None = None

    @property
    def runs(self) -> int:
        """Runs so far."""
        return len(self._known)

    def problem(self, orders: ModelOrders | None) -> Problem:
        """The problem of a model; that of the model in `keep` is made once."""
        if self._kept is not None and self._kept[0] == orders:
            return self._kept[1]
        return self.make(orders)

    def keep(self, orders: ModelOrders | None) -> Problem:
        """Keep the problem of one model in memory."""
        self._kept = orders, self.problem(orders)
        return self._kept[1]

    def score(self, candidates: Iterable[Candidate], stage: str) -> list[Trial]:
        """Run those that are new, and give all of them in their order, best first."""
        wanted = list(dict.fromkeys(candidates))
        new = [each for each in wanted if each not in self._known]
        with ThreadPoolExecutor(self.threads) as pool:
            try:
                for candidate, error in zip(new, pool.map(self._error, new), strict=True):
                    self._known[candidate] = error
                    self.trials.append(Trial(candidate, error, stage))
                    self._tell()
            except BaseException:
                pool.shutdown(cancel_futures=True)
                raise
        found = [Trial(each, self._known[each], stage) for each in wanted]
        return sorted(found, key=lambda trial: trial.error)

    def _tell(self) -> None:
        if self.progress is not None:
            self.progress(self.runs, max(self.expected, self.runs))

    def _error(self, candidate: Candidate) -> float:
        try:
            error = candidate.errors(self.problem(candidate.orders), self.split.row)
        except (NumericalRange, InvalidInput):
            return float("inf")
        return chosen_error(error, self.split)


def chosen_error(error: Array, split: Split) -> float:
    """The error of a run on the samples that choose; `error` has at least the first part."""
    return typical(rms(error[split.choosing[: len(error)]]))


def best(trials: Sequence[Trial]) -> Trial:
    """The first of the least error."""
    return trials[int(np.argmin([trial.error for trial in trials]))]
