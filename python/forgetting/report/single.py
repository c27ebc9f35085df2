"""The report of one identification."""

from __future__ import annotations

from pathlib import Path

from markupsafe import Markup
from matplotlib import pyplot as plt

from forgetting import plot
from forgetting.files import check_outputs
from forgetting.record.identification import Identification
from forgetting.report.page import Block, Figure, Page, Table, write
from forgetting.report.svg import inline
from forgetting.report.trust import trust
from forgetting.words.rounding import brief, with_error

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
        blocks += [trust(found), memory(found), notes()]
    return Page(
        title=found.samples.source,
        subtitle=f"{found.samples.model} · {found.rule_in_words}",
        facts=found.samples.facts(),
        verdicts=found.verdicts,
        figures=figures(found),
        blocks=blocks,
    )


def figures(found: Identification) -> list[Figure]:
    """Key numbers at the top."""
    scores = found.scores
    best = [
        Figure(
            f"one-step RMSE of {name}" if len(found.samples.outputs) > 1 else "one-step RMSE",
            brief(scores.model[j]),
            f"last value {brief(scores.last_value[j])} · "
            f"no forgetting {brief(scores.no_forgetting[j])}",
        )
        for j, name in enumerate(found.samples.outputs[:3])
    ]
    held = found.left_out().replace(", ", " · ")
    ends = found.trace.eigenvalues[-1]
    spread = f"eigenvalues {brief(ends[0], 3)} to {brief(ends[-1], 3)}"
    return [
        *best,
        Figure("samples used", f"{found.used:,}".replace(",", " "), held),
        Figure("spread of P at the end", brief(found.covariance_ratio, 3), spread),
    ]


def parameters(found: Identification) -> Block:
    """Final values."""
    several = len(found.samples.outputs) > 1
    rows = [
        (f"{output}: {name}" if several else name, *with_error(value, error))
        for output, name, value, error in found.final()
    ]
    table = Table(("parameter (its regressor)", "value at the end", "standard error"), rows)
    return Block("Parameters", table=table)


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


def memory(found: Identification) -> Block:
    """Forgetting factor."""
    figure, ax = plt.subplots(figsize=(9.4, 1.9), layout="constrained")
    plot.forgetting_factor(found, ax)
    return Block(
        "Forgetting", pictures=[inline(figure, "forgetting factor, or memory of a bank, over time")]
    )


def notes() -> Block:
    """How to read the numbers."""
    return Block(
        "How to read this",
        "Standard error: square root of the noise variance times the diagonal of P. The noise "
        "variance is the mean over the used samples of e²/(1 + φPφᵀ), the first n samples left "
        "out. It describes parameters that drift as the rule assumes, is an upper bound when they "
        "do not drift, and does not cover a wrong model or errors correlated in time. A sample "
        "with a missing value, or with a lag across a gap of the clock, is skipped; a sample in "
        "the dead zone carries less information than the rule's threshold. "
        "Excited: a direction about which the samples in the rule's memory inform at least 1 % as "
        "much as the record does on average. Windup: the variance of a direction grew to more than "
        "ten times what it was when data last informed about it, and none do now.",
        folded=True,
    )
