"""The report of one identification."""

from __future__ import annotations

from pathlib import Path

import numpy as np
from markupsafe import Markup
from matplotlib import pyplot as plt

from forgetting import plot
from forgetting.files import check_outputs
from forgetting.record.ahead import about_intervals
from forgetting.record.identification import Identification
from forgetting.record.parameters import table as in_words
from forgetting.report.page import Block, Figure, Page, Table, write
from forgetting.report.svg import inline
from forgetting.report.trust import trust
from forgetting.words.duration import spoken
from forgetting.words.rounding import brief

DRAWN = 24
"""Parameters drawn per output; the table and the estimates file have them all."""
STACKED = 6
"""Parameters in one picture."""


def save(found: Identification, path: str | Path) -> None:
    """Write the report of an identification as one HTML file."""
    check_outputs({"report": Path(path)}, found.samples.found.path)
    write(page(found), path)


def page(found: Identification) -> Page:
    """Lay out the report."""
    with plot.styled():
        blocks = [parameters(found), scores(found)]
        for output in range(len(found.samples.outputs)):
            blocks += [signals(found, output), histories(found, output)]
        blocks += [*changes(found), trust(found), memory(found), notes()]
    return Page(
        title=found.samples.source,
        subtitle=f"{found.samples.model} · {found.rule_in_words}",
        facts=found.samples.facts(),
        judgement=found.judgement,
        figures=figures(found),
        blocks=blocks,
    )


def figures(found: Identification) -> list[Figure]:
    """Key numbers at the top: how well, over how many samples, against how much noise."""
    held = found.left_out().replace(", ", " · ")
    used = Figure("samples used", f"{found.used:,}".replace(",", "\u202f"), held)
    several = len(found.samples.outputs) > 1
    shown = range(min(len(found.samples.outputs), 3))
    best = [figure for j in shown for figure in of_output(found, j, several)]
    return [*best, memory_figure(found), used]


def of_output(found: Identification, j: int, several: bool) -> list[Figure]:
    """Fit, error and noise of an output."""
    result, name = found.scores, found.samples.outputs[j]
    of, unit = (f" of {name}" if several else ""), found.unit(name)
    unit = f" {unit}" if unit else ""
    noise = float(found.noise[j])
    return [
        Figure(f"fit{of}, one step ahead", percent(result.fit[j]), "1 − error / spread of output"),
        Figure(
            f"one-step RMSE{of}",
            brief(result.model[j]) + unit,
            f"last value {brief(result.last_value[j])} · "
            f"no forgetting {brief(result.no_forgetting[j])}",
        ),
        *(
            []
            if several
            else [Figure("noise", brief(noise, 3) + unit, "standard deviation, last quarter")]
        ),
    ]


def memory_figure(found: Identification) -> Figure:
    """Over how many samples the estimate remembers."""
    memory = found.memory
    shown = f"{brief(memory, 3)} samples" if np.isfinite(memory) else "all samples"
    step = found.samples.usual_step
    time = f"{spoken(memory * step)}, " if step is not None and np.isfinite(memory) else ""
    return Figure("memory at the end", shown, f"{time}for {found.theta.shape[1]} parameters")


def percent(value: float) -> str:
    """A fit in percent, with the digits that tell good fits apart."""
    if not np.isfinite(value):
        return "–"  # the output is constant
    digits = 1 if value < 99 else 2
    return f"{value:.{digits}f} %".replace("-", "−")


def parameters(found: Identification) -> Block:
    """Final values."""
    more, rows = in_words(found)
    header = ("parameter (its regressor)", "value at the end", "± standard error")
    table = Table((*header, *more), rows)
    return Block("Parameters", found.uncertainty, table)


def scores(found: Identification) -> Block:
    """RMSE beside the baselines."""
    result = found.scores
    rows = [
        (name, brief(result.model[j]), brief(result.no_forgetting[j]), brief(result.last_value[j]))
        for j, name in enumerate(found.samples.outputs)
    ]
    text = (
        f"Root mean square one-step error, in the unit of the output, on the same "
        f"{result.samples} samples for all three. Each prediction is made before its sample is "
        f"learned."
    )
    text = " ".join([text, *about_intervals(found)])
    header = ("output", "this model", "same model, no forgetting", "last value repeated")
    return Block("One-step prediction", text, Table(header, rows))


def signals(found: Identification, output: int) -> Block:
    """Output against prediction, and the error."""
    name = found.samples.outputs[output]
    figure, axes = plt.subplots(
        2, 1, figsize=(9.4, 4.9), sharex=True, height_ratios=(1.7, 1), layout="constrained"
    )
    plot.prediction(found, output, axes[0]).set_xlabel("")
    plot.error(found, output, axes[1])
    figure.align_ylabels()
    picture = inline(figure, f"{name} measured and predicted, and the one-step error, over time")
    return Block(f"Output and prediction: {name}", pictures=[picture])


def histories(found: Identification, output: int) -> Block:
    """Each parameter over time."""
    names = found.samples.regressors
    shown = list(range(min(len(names), DRAWN)))
    pictures = [history(found, shown[i : i + STACKED], output) for i in shown[::STACKED]]
    text = "Estimate after every sample, with a band of ± 2 standard errors."
    if len(names) > DRAWN:
        text += f" The first {DRAWN} of {len(names)} parameters are drawn."
    return Block(f"Parameters over time: {found.samples.outputs[output]}", text, pictures=pictures)


def history(found: Identification, indices: list[int], output: int) -> Markup:
    """A few parameters over time, above one another."""
    count = len(indices)
    figure, axes = plt.subplots(
        count,
        1,
        figsize=(9.4, 0.5 + 1.75 * count),
        sharex=True,
        squeeze=False,
        layout="constrained",
    )
    for index, ax in zip(indices, axes[:, 0], strict=True):
        plot.parameter(found, index, output, ax)
        if ax is not axes[-1, 0]:
            ax.set_xlabel("")
    names = ", ".join(found.samples.regressors[index] for index in indices)
    return inline(figure, f"estimates of {names} over time with their bands")


def changes(found: Identification) -> list[Block]:
    """When the errors became larger than those before allow; none where they never did."""
    if not found.changes:
        return []
    rows = [
        (str(each.row), each.time or "–", "–" if each.until is None else str(each.until))
        for each in found.changes
    ]
    text = "Rows from which the errors of ten samples are larger than those of a hundred allow."
    return [Block("Changes", text, Table(("row", "time", "over at row"), rows))]


def memory(found: Identification) -> Block:
    """How fast the parameters change, or how fast the rule forgets."""
    if found.memories is not None:
        figure, ax = plt.subplots(figsize=(9.4, 3.0), layout="constrained")
        plot.memories(found, ax)
        text = (
            f"{found.memories.describe()} The darker, the more the bank believes in members that "
            "remember so many samples."
        )
        picture = inline(figure, "weights of the members of the bank over time, by their memory")
        return Block("How fast do the parameters change?", text, pictures=[picture])
    figure, ax = plt.subplots(figsize=(9.4, 1.9), layout="constrained")
    plot.forgetting_factor(found, ax)
    return Block("Forgetting", pictures=[inline(figure, "forgetting factor over time")])


def notes() -> Block:
    """How to read the numbers."""
    return Block(
        "How to read this",
        "Parameters: a lag of the output stands with the sign of y(k) = a1 y(k-1) + …, so that a "
        "first-order model has its pole at a1. Standard error: of a bank such that two of them "
        "hold about 95 % of what the parameter may be, for noise that is correlated and parameters "
        "that drift as is most likely in this record; of a rule the square root of the noise "
        "variance times the diagonal of P, for white noise and parameters that drift as the rule "
        "supposes. Neither covers a wrong model. A sample "
        "with a missing value, or with a lag across a gap of the clock, is skipped; a sample in "
        "the dead zone carries less information than the rule's threshold. "
        "Excited: a direction about which the samples in the rule's memory inform at least 1 % as "
        "much as the record does on average. Windup: the variance of a direction grew to more than "
        "ten times what it was when data last informed about it, and none do now.",
        folded=True,
    )
