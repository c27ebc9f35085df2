"""The command, its files and its exit code."""

import csv

import pytest
from matplotlib import pyplot as plt

import forgetting as fg
from forgetting.cli.reproduce import measured, reproduce
from forgetting.papers import Check, Claim, all_checks, all_pictures, catalogue
from forgetting.plot import styled

PICTURES = all_pictures()


@pytest.mark.parametrize("each", PICTURES, ids=lambda each: each.name)
def test_every_figure_can_be_drawn(each):
    with styled():
        figure = each(5)
    assert all(ax.get_title(loc="left") or ax.axison is False for ax in figure.axes)
    plt.close(figure)


def test_every_figure_of_the_papers_is_there():
    names = {each.name for each in PICTURES}
    wanted = {f"vdf_figure_{n:02d}" for n in (*range(1, 8), 9, 10, 11)}
    wanted |= {f"opd_figure_{n}" for n in range(1, 5)} | {"opd_table_1", "gf_figure_1"}
    assert names == wanted


def test_one_example_writes_figures_table_and_page(tmp_path, capsys):
    assert reproduce("vdf", example=8, output=tmp_path) == 0
    with (tmp_path / "claims.csv").open(encoding="utf-8") as stream:
        rows = list(csv.DictReader(stream))
    assert len(rows) == len(all_checks("vdf", 8))
    assert {row["holds"] for row in rows} == {"True"}
    assert (tmp_path / "vdf_figure_06.png").stat().st_size > 10_000
    assert (tmp_path / "vdf_figure_06.svg").exists()
    page = (tmp_path / "report.html").read_text(encoding="utf-8")
    assert "VDF Figure 6" in page and "<svg" in page
    assert "http://" not in page.replace("http://www.w3.org", "") and "https://" not in page
    assert "4 claims" in capsys.readouterr().out


def test_a_claim_that_fails_is_said_and_decides_the_exit_code(tmp_path, capsys, monkeypatch):
    def fails():
        return "1 is not 2", False

    fails.__module__ = "forgetting.papers.vdf.example07"  # the page sorts claims by paper
    wrong = Check("nowhere", "1 = 2", "reproduced", "", fails)
    monkeypatch.setattr(catalogue, "all_checks", lambda *_: [wrong])
    assert reproduce("vdf", example=7, output=tmp_path) == 1
    assert "1 fails" in capsys.readouterr().out
    assert "does not hold" in (tmp_path / "report.html").read_text(encoding="utf-8")


def test_a_claim_that_cannot_be_measured_does_not_hold():
    def breaks():
        raise fg.NumericalRange("P overflows")

    claim = measured(Check("nowhere", "1 = 1", "reproduced", "", breaks), seeds=2)
    words = "could not be measured: NumericalRange: P overflows"
    assert claim == Claim("nowhere", "1 = 1", words, "reproduced", "", False)


@pytest.mark.parametrize(
    ("paper", "example", "words"),
    [
        ("abc", None, "paper = 'abc', allowed: vdf, gf, opd"),
        ("vdf", 13, "example = 13, allowed: 1 to 12"),
        ("gf", 1, "example = 1, allowed: none"),
    ],
)
def test_what_there_is_not_is_refused(paper, example, words):
    with pytest.raises(fg.InvalidInput, match=words):
        all_checks(paper, example)
