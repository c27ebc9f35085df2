"""All of an identification in one picture."""

from __future__ import annotations

from pathlib import Path

from matplotlib import pyplot as plt
from matplotlib.figure import Figure

from forgetting.files import check_outputs, whole
from forgetting.plot.covariance import eigenvalues, forgetting_factor
from forgetting.plot.memories import memories
from forgetting.plot.parameters import parameter
from forgetting.plot.signals import error, prediction
from forgetting.plot.style import literal, styled
from forgetting.record.identification import Identification
from forgetting.words.errors import RecordError

SHOWN = 12
"""Parameters drawn at most; beyond this a picture is no overview."""
FORMATS = (".png", ".svg", ".pdf")


def overview(found: Identification, output: int = 0) -> Figure:
    """Draw prediction, error, parameters, memory and eigenvalues of P of one output."""
    shown = min(len(found.samples.regressors), SHOWN)
    with styled():
        heights = [2.4, 1.5] + [1.5] * shown + [1.2 if found.memories is None else 1.8, 1.8]
        figure, axes = plt.subplots(
            len(heights),
            1,
            figsize=(9.5, 1.15 * sum(heights)),
            sharex=True,
            height_ratios=heights,
            layout="constrained",
        )
        prediction(found, output, axes[0])
        error(found, output, axes[1])
        for index in range(shown):
            parameter(found, index, output, axes[2 + index])
        (forgetting_factor if found.memories is None else memories)(found, axes[-2])
        eigenvalues(found, axes[-1])
        for ax in axes[:-1]:
            ax.set_xlabel("")
        figure.align_ylabels()
        figure.suptitle(
            literal(f"{found.samples.source}: {found.samples.model}\n{found.rule_in_words}"),
            x=0.01,
            ha="left",
            fontsize=11.5,
        )
    return figure


def save_overview(found: Identification, path: str | Path) -> None:
    """Write the overview as PNG, SVG or PDF, by suffix."""
    path = Path(path)
    if path.suffix.lower() not in FORMATS:
        raise RecordError(f"a plot goes to {', '.join(FORMATS)}, but the file is {path.name!r}")
    check_outputs({"plot": path}, found.samples.found.path)
    figure = overview(found)
    with styled(), whole(path) as made:
        figure.savefig(made, dpi=150)
    plt.close(figure)
