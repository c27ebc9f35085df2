"""The section of a report that says when to trust the estimate."""

from __future__ import annotations

from matplotlib import pyplot as plt

from forgetting import plot
from forgetting.record.identification import Identification
from forgetting.report.page import Block
from forgetting.report.svg import inline

DRAWN = 24
"""Parameters drawn."""


def trust(found: Identification) -> Block:
    """Lay out excitation, eigenvalues of P with their guaranteed bounds, and alarms."""
    shown = min(len(found.samples.regressors), DRAWN)
    strips = 1 + sum(
        map(bool, (found.missing, found.dead_zone, found.within_bound, found.held, found.frozen))
    )
    heights = (1.1, 0.25 + 0.22 * shown, 1.8, 0.25 + 0.22 * strips)
    figure, axes = plt.subplots(
        4, 1, figsize=(9.4, 1.6 + sum(heights)), sharex=True, height_ratios=heights,
        layout="constrained",
    )  # fmt: skip
    plot.rank(found, axes[0])
    plot.excited(found, axes[1], DRAWN)
    plot.eigenvalues(found, axes[2])
    plot.alarms(found, axes[3])
    for ax in axes[:-1]:
        ax.set_xlabel("")
    picture = inline(
        figure, "directions and parameters excited, eigenvalues of P and alarms over time"
    )
    text = " ".join(sentences(found)).replace("e-", "e\N{NON-BREAKING HYPHEN}")
    return Block("When to trust it", text, pictures=[picture])


def sentences(found: Identification) -> list[str]:
    """What the picture shows, in words."""
    excited = found.excited
    words = [silence(found)]
    if excited.parameters > DRAWN:
        words.append(f"The first {DRAWN} of {excited.parameters} parameters are drawn.")
    words.append(str(found.guarantee))
    words.append(found.judgement["windup"].text)
    return words


def silence(found: Identification) -> str:
    """How much of the time everything is excited, and the longest time that it is not."""
    excited = found.excited
    first, length = excited.longest_silence()
    memory = f"the {excited.window} samples of the rule's memory"
    if not length:
        return f"All through the record {memory} excite every direction."
    share = f"{excited.fully_excited:.0%}" if excited.fully_excited else "no part"
    return (
        f"During {share} of the record {memory} excite every direction; the longest time in which "
        f"they do not begins in row {first + 1} and lasts {length} rows. Where a parameter has no "
        "bar, its estimate is that of before."
    )
