"""The judge's findings on an identification, gathered from the record and its run."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from forgetting.analysis import Excited
from forgetting.health import Health
from forgetting.judgement import Finding, Judgement, accuracy, covariance, inputs, poles, residuals
from forgetting.judgement.finding import judgement
from forgetting.record.feedback import Feedback
from forgetting.record.moved import Moved
from forgetting.record.scores import Scores
from forgetting.record.trace import DEAD_ZONE, HELD, USED, Trace
from forgetting.record.uncertainty import noise_variance

Array = NDArray[np.float64]
Marks = NDArray[np.bool_]

ROUNDING = 1e-4
"""Errors below this share of the output's own changes are not worth a judgement."""
MOST_INPUTS = 24
"""Inputs that errors are compared with."""


@dataclass(frozen=True)
class Judged:
    """What is judged.

    Attributes
    ----------
    samples, trace, scores
        The problem, its run and its scores on samples that are `settled`.
    feedback : Feedback
        Which regressors are past outputs.
    excited : Excited
        What the samples remembered excite.
    initial_variance : ndarray, shape (n,)
        Diagonal of P before the first sample.
    health : Health or None
        At the end, where the estimator had a monitor.
    """

    samples: Moved
    trace: Trace
    scores: Scores
    feedback: Feedback
    excited: Excited
    initial_variance: Array
    health: Health | None

    @property
    def parameters(self) -> int:
        """Number n of parameters."""
        return self.samples.parameters

    @property
    def settled(self) -> Marks:
        """Samples used after the start, (T,)."""
        return settled(self.trace)

    @property
    def memory(self) -> float:
        """Samples that the estimate stands on, typically; a sample decides n/memory of its fit."""
        settled = self.settled
        if self.trace.memory is not None:
            known = self.trace.memory[settled]
            return float(np.median(known)) if len(known) else float("nan")
        leverage = self.trace.leverage[settled]
        own = float(np.mean(leverage / (1 + leverage))) if len(leverage) else 0.0
        return self.parameters / own if own > 0 else float("inf")


def settled(trace: Trace) -> Marks:
    """Samples used after the start, whose errors show the initial guess, (T,)."""
    used = trace.skipped == USED
    start, total = 5 * trace.theta.shape[1] + 20, int(used.sum())
    return np.asarray(used & (np.cumsum(used) > (start if total >= 2 * start else 1)))


def judge(judged: Judged) -> Judgement:
    """Put all findings together."""
    return judgement([*of_the_whole(judged), *of_outputs(judged)])


def of_the_whole(judged: Judged) -> Iterator[Finding | None]:
    """Findings on regressors, covariance and memory, which all outputs share."""
    samples, trace, names = judged.samples, judged.trace, judged.samples.regressors
    information, silent = samples.information(), samples.silent
    blind = covariance.regressors(information, silent, names)
    yield blind
    yield windup(judged)
    elsewhere = silent | covariance.inseparable(information, silent)
    share = trace.variance.min(axis=0) / judged.initial_variance
    if not (blind is not None and elsewhere.all()):
        yield covariance.excitation(
            names,
            np.where(elsewhere, np.nan, share),
            ~judged.excited.informed[-1] & ~elsewhere & forgets(judged),
            judged.excited.window,
        )
    used = int((trace.skipped == USED).sum())
    yield accuracy.too_few(used, judged.parameters) or accuracy.memory(
        judged.memory, judged.parameters, gain_by_forgetting(judged.scores)
    )
    yield left_out(trace)


def gain_by_forgetting(scores: Scores) -> float:
    """How many times larger the errors are without forgetting, of the output where it is most."""
    pairs = zip(scores.no_forgetting, scores.model, strict=True)
    return max((plain / model for plain, model in pairs if model > 0), default=1.0)


def windup(judged: Judged) -> Finding:
    """Judge windup by the monitor."""
    health = judged.health
    if health is None or health.parts is None or health.growth is None:
        return covariance.windup(judged.trace.windup)
    along = covariance.involved(health.parts, judged.samples.regressors)
    return covariance.windup(judged.trace.windup, health.growth, along)


def forgets(judged: Judged) -> bool:
    """Whether what happened in the first half of the record is forgotten at its end."""
    return judged.memory < len(judged.samples) / 2


def left_out(trace: Trace) -> Finding | None:
    """Say which samples rule and gate left out."""
    words = []
    idle, held = int((trace.skipped == DEAD_ZONE).sum()), int((trace.skipped == HELD).sum())
    if idle:
        words.append(
            f"{idle} samples carried less information than the rule's threshold; they were neither "
            f"learned nor forgotten, and the estimates were held."
        )
    if held:
        words.append(
            f"{held} samples were held by the gate: neither learned from nor forgotten for."
        )
    return Finding("samples", "good", " ".join(words)) if words else None


def of_outputs(judged: Judged) -> Iterator[Finding | None]:
    """Findings on the errors of each output, and the poles of all."""
    settled, trace = judged.settled, judged.trace
    if trace.weights is not None:  # P of members that do not count swells the leverage of a bank
        trace = replace(trace, leverage=np.broadcast_to(0.0, trace.leverage.shape))
    spread = np.sqrt(1 + trace.leverage)
    for j, name in enumerate(judged.samples.outputs):
        yield beside(judged.scores, j, name)
        if negligible(judged.scores, j):
            yield Finding("residuals", "good", f"The one-step errors of {name} are negligible.")
            continue
        error = np.where(settled, trace.error[:, j], np.nan)
        yield accuracy.intervals(error, predicted(trace, spread, j), name)
        error /= spread  # in place: a long record is not there twice
        deep = judged.feedback.deepest + judged.feedback.of_noise
        past = residuals.own_past(error, deep)
        yield residuals.whiteness(past, name, deep)
        if past is not None:
            white = inputs.whitened(error, past.prediction)
            yield inputs.inputs(white, signals(judged), name)
    yield stability(judged)


def predicted(trace: Trace, spread: Array, j: int) -> Array:
    """Standard deviation of the error of output j as known before each sample, (T,)."""
    noise = noise_variance(trace)[:, j]
    found = np.full_like(noise, np.nan)
    np.sqrt(noise[:-1], out=found[1:])
    found *= spread
    return found


def beside(scores: Scores, j: int, name: str) -> Finding | None:
    """Judge the scores of an output."""
    alone = None if scores.without_inputs is None else scores.without_inputs[j]
    return accuracy.baselines(scores.model[j], scores.last_value[j], scores.mean[j], alone, name)


def negligible(scores: Scores, j: int) -> bool:
    """Whether errors are so small beside the output's own changes that only rounding is left."""
    return not scores.model[j] > ROUNDING * min(scores.last_value[j], scores.mean[j])


def signals(judged: Judged) -> Iterator[tuple[str, Array]]:
    """The regressors that are inputs and move, by name, one after the other."""
    layout = judged.samples.samples.layout
    every = range(judged.parameters) if layout is None else layout.past_inputs
    places = [i for i in every if i not in judged.feedback.lags]
    for place in places[:MOST_INPUTS]:
        yield judged.samples.regressors[place], judged.samples.column(place)


def stability(judged: Judged) -> Finding | None:
    """Judge the poles at the end, with models drawn from the uncertainty of the coefficients."""
    if not judged.feedback.lags:
        return None
    trace = judged.trace
    noise = np.sqrt(np.nan_to_num(noise_variance(trace)[-1]))
    values, vectors = np.linalg.eigh(trace.covariance)
    root = vectors * np.sqrt(np.maximum(values, 0.0))
    random = np.random.default_rng(0)
    drawn = random.normal(size=(poles.SAMPLED, *trace.theta[-1].shape))
    models = np.array([judged.feedback.matrices(root @ each * noise) for each in drawn])
    return poles.poles(judged.feedback.model(trace.theta[-1]), models)
