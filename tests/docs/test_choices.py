"""What the pages of rules, rates, weightings, gates and mixers are made of."""

from __future__ import annotations

import pytest
from writing import example, figure
from writing.advice import when_not
from writing.header import parsed
from writing.live import live
from writing.record import BOTH_SILENT, ONE_SILENT, record
from writing.shown import made, making

from forgetting.choices import AXES

from .heads import heads

HEADS = heads()
CHOICES = [(axis, about) for axis in AXES.values() for about in axis.entries]
NAMES = [f"{axis.plural}/{about['name']}" for axis, about in CHOICES]


@pytest.mark.parametrize("name", HEADS)
def test_a_head_says_what_a_page_needs(name):
    head = parsed(HEADS[name][0])
    assert head.summary and head.equations and head.cost and head.use
    assert bool(head.guarantees) == name.startswith("rules/")


@pytest.mark.parametrize(("axis", "about"), CHOICES, ids=NAMES)
def test_every_choice_has_an_example_that_prints(axis, about):
    text = example.code(axis.name, about)
    assert made(about) in text
    assert example.printed(text).strip()


@pytest.mark.parametrize(("axis", "about"), CHOICES, ids=NAMES)
def test_every_choice_runs_over_the_record_of_the_figure(axis, about):
    assert isinstance(making(about), axis.classes[about["name"]])
    shown = record(gross=axis.name == "weighting")
    run = figure.estimator(axis.name, about).run(
        shown.phi, shown.y, outputs=figure.outputs(axis.name)
    )
    assert run.theta.shape == shown.theta.shape


def test_the_record_falls_silent():
    shown = record()
    assert not shown.phi[ONE_SILENT, 1].any() and shown.phi[ONE_SILENT, 0].all()
    assert not shown.phi[BOTH_SILENT].any() and shown.phi[BOTH_SILENT.stop :].all()


def test_a_figure_is_written(tmp_path):
    about = AXES["mixer"].entries[0]
    figure.save("mixer", about, tmp_path / "figure.png")
    assert (tmp_path / "figure.png").read_bytes().startswith(b"\x89PNG")


def test_windup_is_said_of_rules_without_a_bound():
    entries = {about["name"]: about for about in AXES["rule"].entries}
    assert any("silent" in each for each in when_not("rule", entries["exponential"]))
    assert not any("silent" in each for each in when_not("rule", entries["subspace"]))


def test_a_rule_is_shown_live_where_the_playground_offers_it():
    shown = {about["name"] for axis, about in CHOICES if live(axis.name, about)}
    rules = {about["name"] for about in AXES["rule"].entries}
    assert shown == rules - {"custom"}  # which takes a function
