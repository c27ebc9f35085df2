"""Reports and plots: self-contained, small, complete."""

from __future__ import annotations

import re
from html.parser import HTMLParser

import matplotlib as mpl
import numpy as np
import pandas as pd
import pytest

import forgetting as fg
from forgetting.plot import save_overview
from forgetting.record import RecordError, identify
from forgetting.report import save

from .conftest import plant_record

LOADS = {"src", "href", "xlink:href", "data", "poster", "srcset", "action"}


class Links(HTMLParser):
    """Collect everything a page could load, and check that tags close."""

    def __init__(self):
        super().__init__()
        self.loads, self.text, self.stack = [], [], []

    def handle_starttag(self, tag, attributes):
        self.loads += [value for name, value in attributes if name in LOADS]
        if tag not in ("meta", "br", "link", "path", "use", "rect"):
            self.stack.append(tag)

    def handle_endtag(self, tag):
        if tag not in ("path", "use", "rect"):
            assert self.stack.pop() == tag

    def handle_startendtag(self, tag, attributes):
        self.loads += [value for name, value in attributes if name in LOADS]

    def handle_data(self, data):
        self.text.append(data)


def parsed(path):
    page = Links()
    page.feed(path.read_text(encoding="utf-8"))
    assert page.stack == []
    return page


@pytest.fixture(scope="module")
def found():
    plant = plant_record()
    plant.loc[100, "u1"] = np.nan
    plant = plant.rename(columns={"u1": "<b>u1</b> & co"})
    return identify(plant, output=["y1", "y2"], input="<b>u1</b> & co", arx=(1, 1, 0))


@pytest.fixture(scope="module")
def drawn(found, tmp_path_factory):
    """A folder with the page and the plot, and the user's style before and after."""
    folder, before = tmp_path_factory.mktemp("drawn"), dict(mpl.rcParams)
    save(found, folder / "report.html")
    for suffix in ("png", "pdf"):
        save_overview(found, folder / f"plot.{suffix}")
    return folder, before, dict(mpl.rcParams)


@pytest.fixture(scope="module")
def html(drawn):
    return (drawn[0] / "report.html").read_text(encoding="utf-8")


def test_the_page_loads_nothing(drawn, html):
    page = parsed(drawn[0] / "report.html")
    # a picture in the page itself is not loaded from anywhere
    assert all(link.startswith(("#", "data:image/png;base64,")) for link in page.loads)
    assert "http:" not in html and "https:" not in html and "@import" not in html
    assert re.findall(r"url\((?!#)", html) == []


def test_the_page_has_its_parts(found, drawn, html):
    text = " ".join(parsed(drawn[0] / "report.html").text)
    for part in (
        "Parameters",
        "One-step prediction",
        "Output and prediction: y1",
        "Output and prediction: y2",
        "Parameters over time: y2",
        "When to trust it",
        "Directions of 4 that the last",
        "Alarms and samples left out",
        "eigenvalues of P",
        "memory (samples)",
    ):
        assert part in text, part
    assert all(verdict in text for verdict in found.verdicts)
    # One of signals and one of parameters for each output, one of trust, one of forgetting.
    assert html.count("<svg ") == 6
    assert "prefers-color-scheme: dark" in html


def test_the_page_of_a_rule_shows_its_forgetting_factor(plant, tmp_path):
    found = identify(plant, output="y1", input="u1", arx=(1, 1, 0), rule="exponential")
    save(found, tmp_path / "report.html")
    text = " ".join(parsed(tmp_path / "report.html").text)
    assert "forgetting factor" in text and "memory (samples)" not in text


def test_long_records_stay_small(tmp_path):
    rng = np.random.default_rng(6)
    frame = pd.DataFrame(rng.normal(size=(60_000, 6)), columns=list("abcdef"))
    frame["y"] = frame.sum(axis=1) + rng.normal(size=60_000)
    save(identify(frame, formula="y ~ a + b + c + d + e + f"), tmp_path / "long.html")
    assert (tmp_path / "long.html").stat().st_size < 3_000_000


def test_names_are_escaped(html):
    assert "<b>u1</b>" not in html and "&lt;b&gt;u1&lt;/b&gt; &amp; co(k)" in html


@pytest.mark.parametrize("rows", [1, 2, 5])
def test_short_records_have_a_report(tmp_path, rows):
    frame = pd.DataFrame({"x": np.ones(rows), "y": np.ones(rows)})
    found = identify(frame, formula="y ~ x")
    save(found, tmp_path / "short.html")
    save_overview(found, tmp_path / "short.png")
    html = (tmp_path / "short.html").read_text(encoding="utf-8")
    # Two parameters have no standard error before a third sample.
    assert ("not known" in html) == (rows < 3)


@pytest.mark.parametrize(("suffix", "magic"), [(".png", b"\x89PNG"), (".pdf", b"%PDF")])
def test_plot(drawn, suffix, magic):
    assert (drawn[0] / f"plot{suffix}").read_bytes().startswith(magic)


def test_plot_goes_to_known_files(found, tmp_path):
    with pytest.raises(RecordError, match=r"the file is 'plot\.docx'"):
        save_overview(found, tmp_path / "plot.docx")


def test_plots_take_and_return_axes(found):
    from matplotlib import pyplot as plt

    from forgetting import plot

    _, ax = plt.subplots()
    for draw in (plot.prediction, plot.error):
        assert draw(found, 1, ax) is ax
    assert plot.parameter(found, 0, 1, ax) is ax
    for draw in (plot.eigenvalues, plot.forgetting_factor, plot.rank, plot.excited, plot.alarms):
        own = plt.figure().add_subplot()
        assert draw(found, own) is own
    assert plot.prediction(found).get_ylabel() == "y1"
    plt.close("all")


def test_thinning_keeps_peaks_and_gaps():
    from forgetting.plot import thinning

    y = np.sin(np.arange(100_000.0) / 5000)
    y[70_001] = 9.0
    y[20_000:30_000] = np.nan
    x, thin = thinning.line(np.arange(100_000), y)
    assert len(x) <= thinning.POINTS + 4
    assert np.nanmax(thin) == 9.0 and x[np.nanargmax(thin)] == 70_001
    assert np.isnan(thin).any() and (np.diff(x) > 0).all()


def test_user_style_is_left_alone(drawn):
    _, before, after = drawn
    assert after == before


def test_the_page_says_the_version(html):
    assert fg.__version__ in html
