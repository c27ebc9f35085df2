"""The page that compares the bank and three rules on the solar array."""

from __future__ import annotations

from markupsafe import Markup
from matplotlib import pyplot as plt

from forgetting import plot
from forgetting.demo.windup_picture import windup
from forgetting.plot.style import BLUE, FAINT, GREEN, PURPLE, VERMILLION, legend_above
from forgetting.plot.timeline import label_time, timeline
from forgetting.record import Identification
from forgetting.report.page import Block, Figure, Page, Table
from forgetting.report.single import memory
from forgetting.report.svg import inline
from forgetting.words.rounding import brief

DAY = 96
"""Samples in a day."""
REGULAR = slice(25, 410)
"""First light of the first day to the last hour before the day of the snow."""
COLOURS = {"bank": PURPLE, "none": GREEN, "exponential": VERMILLION, "subspace": BLUE}
UNITS = ("W per W/m²", "W per W/m² and 10 °C")
RANGES = ((-2.5, 10.5), (-4.0, 4.0))
TITLE = "A solar array over five winter days"
SUBTITLE = (
    "dc_power ~ 0 + poa + poa:t_module · 480 samples of 15 minutes · "
    "the bank and three forgetting rules on the same record"
)
LESSON = """Every night exponential forgetting throws away what the day taught it: its standard
error of the gain grows to {ratio:,.0f} times that of subspace forgetting, which forgets only
where new information arrives and waits for the morning unchanged. Without forgetting the gain
cannot follow what looks like snow on the last day."""
RULES = """One-step errors on the same {samples} samples; repeating the last value gives {last} W.
The bank is told nothing and predicts best; its P, which mixes those of its members, is in other
units. The rules have a forgetting factor of 0.7 and P₀ = 100. Exponential forgetting predicts a
little better than subspace forgetting here, because starting anew every morning suits an
array that snow covers and uncovers; the price is a covariance that says nothing about the gain at
dawn. Gain in W per W/m², its standard error taken after the first day."""
NIGHTS = """Gain at 25 °C over the four days before the snow. At night the regressor is zero.
Exponential forgetting divides P by the forgetting factor at every sample all the same, so the
standard error grows without bound until dawn, and the first light throws the estimate about.
Subspace forgetting has nothing to forget where nothing arrives."""
PARAMETERS = """Estimates with bands of ± 2 standard errors. On the last day, at −5 °C and probably
under snow, only one combination of gain and slope is excited. Exponential forgetting has lost both
and starts anew; subspace forgetting moves that combination and keeps the other, so its gain at
25 °C stays that of a clean array, with a band that knows nothing of snow."""
RECORD = """Array SERF west, NREL, Golden, Colorado, 2 to 6 January 2022, from {source}. poa:
irradiance on the plane of the array (W/m²), its negative night offset set to zero. t_module: mean
of three module temperatures, in tens of degrees above 25 °C, so that both regressors have a
similar size: where P₀ is given, directional rules depend on units. Full
reports of each rule lie beside this page."""
Found = dict[str, Identification]


def page(found: Found) -> Page:
    """Lay out the comparison."""
    ratio = widest(found["exponential"]) / widest(found["subspace"])
    with plot.styled():
        blocks = [table(found), nights(found), power(found), parameters(found)]
        blocks += [memory(found["bank"]), model(found)]
    return Page(
        title=TITLE,
        subtitle=SUBTITLE,
        verdicts=[LESSON.format(ratio=round(ratio, -3))],
        figures=[
            Figure(f"one-step RMSE, {name}", f"{brief(each.scores.model[0])} W", told(name, each))
            for name, each in found.items()
        ],
        blocks=blocks,
    )


def told(name: str, found: Identification) -> str:
    """What an estimator was told."""
    return "told nothing" if name == "bank" else str(found.rule)


def widest(found: Identification) -> float:
    """Largest standard error of the gain after the first day, W per W/m²."""
    return float(found.standard_error_of(0)[DAY:].max())


def table(found: Found) -> Block:
    """Rules side by side."""
    rows = [row(name, each) for name, each in found.items()]
    header = (
        "rule",
        "RMSE (W)",
        "largest s.e. of gain",
        "largest eigenvalue of P",
        "used",
        "held",
        "gain at 25 °C",
        "slope / 10 °C",
    )
    scores = found["none"].scores
    text = RULES.format(samples=scores.samples, last=brief(scores.last_value[0]))
    return Block("The bank and three rules", text, Table(header, rows))


def row(name: str, found: Identification) -> tuple[str, ...]:
    """One rule of the table."""
    final = found.theta[-1, :, 0]
    return (
        name,
        f"{found.scores.model[0]:.1f}",
        brief(widest(found), 3),
        "–" if name == "bank" else brief(float(found.trace.eigenvalues[:, -1].max()), 3),
        str(found.used),
        str(found.dead_zone),
        brief(final[0], 3),
        brief(final[1], 3),
    )


def nights(found: Found) -> Block:
    """The windup picture."""
    figure = windup(found["exponential"], found["subspace"], REGULAR)
    picture = inline(figure, "standard error and estimate of the gain under both rules")
    return Block("What the nights do", NIGHTS, pictures=[picture])


def power(found: Found) -> Block:
    """Predictions on the last two days."""
    figure, ax = plt.subplots(figsize=(9.4, 3.3), layout="constrained")
    x, label = timeline(found["none"])
    last = slice(len(x) - 2 * DAY, None)
    measured = found["none"].samples.y[last, 0]
    ax.plot(x[last], measured, color=FAINT, lw=3, alpha=0.5, label="measured")
    for name, each in found.items():
        ax.plot(x[last], each.prediction[last, 0], color=COLOURS[name], lw=1.2, label=name)
    ax.set_ylabel("DC power (W)")
    label_time(ax, x[last], label)
    legend_above(ax, 4)
    picture = inline(figure, "measured and predicted power of the last two days")
    text = "Power, and its prediction before each sample was learned."
    return Block("The last two days", text, pictures=[picture])


def parameters(found: Found) -> Block:
    """Every parameter under every rule."""
    return Block("Parameters", PARAMETERS, pictures=[history(found, index) for index in range(2)])


def history(found: Found, index: int) -> Markup:
    """One parameter under every rule, above one another."""
    figure, axes = plt.subplots(
        len(found), 1, figsize=(9.4, 6.8), sharex=True, sharey=True, layout="constrained"
    )
    label = found["none"].samples.regressors[index]
    for (name, each), ax in zip(found.items(), axes, strict=True):
        plot.parameter(each, index, 0, ax, color=COLOURS[name])
        ax.set_title(f"{label}, {name}")
        ax.set_xlabel("")
    axes[-1].set_ylim(*RANGES[index])
    axes[2].set_ylabel(UNITS[index])
    return inline(figure, f"estimate of {label} under the bank and three rules")


def model(found: Found) -> Block:
    """Where the data come from."""
    text = RECORD.format(source=found["none"].samples.source)
    return Block("Record and model", text, folded=True)
