"""The page that compares three rules on the bicycle ride."""

from __future__ import annotations

from markupsafe import Markup
from matplotlib import pyplot as plt

from forgetting import plot
from forgetting.demo.physics import Estimate, Result, air_density
from forgetting.plot.style import BLUE, GREEN, VERMILLION
from forgetting.report.page import Block, Figure, Page, Table
from forgetting.report.svg import inline
from forgetting.words.rounding import brief, with_error

COLOURS = {"none": GREEN, "exponential": VERMILLION, "subspace": BLUE}
AXES = ("m (kg)", "Crr · m (kg)", "k = ½ ρ CdA (kg/m)")
RANGES = ((55.0, 115.0), (0.0, 3.0), (-0.05, 0.4))
TITLE = "A bicycle ride of 2.3 hours"
SUBTITLE = (
    "P = m d(v²/2 + g h)/dt + Crr m g v + k v³ · energy balance in windows of 30 s · "
    "three forgetting rules on the same record"
)
VALUES = """Values at the end of the ride, ± one standard error. Repeating the last window's power
has an RMSE of {last} W: a rider holds power steady on a climb, which physics does not know. The
model is here to weigh the rider, not to guess the legs. Mass and drag do not change on a ride, so a
long memory is right, and the three rules agree within their errors."""
HISTORIES = """Estimates with bands of ± 2 standard errors. A climb at constant speed teaches one
combination of mass and rolling resistance; the drag is learned on the fast stretches between."""
METHOD = """Over each window of 30 s the mean power equals the gain in kinetic and potential energy,
plus rolling and air resistance; differences over windows take the place of derivatives. Altitude:
median over 31 s, mean over 11 s. Windows are left out when the rider coasts in more than a quarter
of them or slows by more than 0.4 m/s² (braking cannot be told from coasting), rides slower than
1.5 m/s, or the altimeter jumps. Noise in the altitude makes the mass come out a few kilograms low
at this window length; the opposite regression, energy on power, errs to the other side and gives
about 100 kg. Wind and drivetrain losses are not in the model. Air density {density:.3f} kg/m³,
standard atmosphere at {altitude:.0f} m."""
Results = dict[str, Result]


def page(results: Results, altitude: float) -> Page:
    """Lay out the comparison."""
    main = results["subspace"].rider
    named = (
        ("total mass", main.mass),
        ("rolling resistance Crr", main.rolling),
        ("drag area CdA", main.drag_area),
    )
    with plot.styled():
        blocks = [table(results), histories(results), power(results), method(altitude)]
    return Page(
        title=TITLE,
        subtitle=SUBTITLE,
        figures=[Figure(f"{name}, subspace", shown(each), each.unit) for name, each in named],
        blocks=blocks,
    )


def shown(estimate: Estimate) -> str:
    """Value ± standard error."""
    return " ± ".join(with_error(estimate.value, estimate.error))


def table(results: Results) -> Block:
    """Rules side by side."""
    rows = [
        (
            name,
            shown(each.rider.mass),
            shown(each.rider.rolling),
            shown(each.rider.drag_area),
            f"{each.found.scores.model[0]:.1f}",
            f"{each.found.used} / {each.found.missing}",
        )
        for name, each in results.items()
    ]
    header = ("rule", "mass (kg)", "Crr", "CdA (m²)", "one-step RMSE (W)", "used / left out")
    last = brief(results["none"].found.scores.last_value[0], 3)
    return Block("Rider and bicycle", VALUES.format(last=last), Table(header, rows))


def histories(results: Results) -> Block:
    """Every parameter under every rule."""
    pictures = [history(results, index) for index in range(3)]
    return Block("Parameters over the ride", HISTORIES, pictures=pictures)


def history(results: Results, index: int) -> Markup:
    """One parameter under every rule."""
    figure, axes = plt.subplots(1, 3, figsize=(9.4, 2.3), sharey=True, layout="constrained")
    for (name, each), ax in zip(results.items(), axes, strict=True):
        plot.parameter(each.found, index, 0, ax, color=COLOURS[name])
        ax.set_title(name)
        ax.set_xlabel("")
    axes[0].set_ylabel(AXES[index])
    axes[0].set_ylim(*RANGES[index])
    return inline(figure, f"{AXES[index]} over the ride under three rules")


def power(results: Results) -> Block:
    """Power and its prediction."""
    figure, axes = plt.subplots(
        2, 1, figsize=(9.4, 4.6), sharex=True, height_ratios=(1.6, 1), layout="constrained"
    )
    found = results["subspace"].found
    plot.prediction(found, 0, axes[0]).set_xlabel("")
    axes[0].set_ylabel("power (W)")
    plot.error(found, 0, axes[1]).set_ylabel("error (W)")
    figure.align_ylabels()
    text = "Mean power of each window and its prediction by the subspace rule; gaps are left out."
    return Block("Power", text, pictures=[inline(figure, "power measured and predicted")])


def method(altitude: float) -> Block:
    """How the track became regressors."""
    text = METHOD.format(density=air_density(altitude), altitude=altitude)
    return Block("How the track became regressors", text, folded=True)
