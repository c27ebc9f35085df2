"""`forgetting rules`, help and version."""

from __future__ import annotations

import pytest
from typer.testing import CliRunner

import forgetting as fg
from forgetting.cli.app import app


def test_lists_the_registry(forgetting):
    run = forgetting("rules")
    assert run.code == 0
    words = " ".join(run.out.split())
    for rule in fg.rules():
        assert f"{rule['name']}: {rule['summary']}" in words
        assert all(each["name"] in words for each in rule["parameters"])
        assert rule["bounded_above"] in words


@pytest.mark.parametrize("rule", fg.rules(), ids=lambda rule: rule["name"])
def test_prints_the_header_of_a_rule(forgetting, rule):
    run = forgetting("rules", rule["name"])
    assert (run.code, run.out) == (0, rule["header"].strip() + "\n")


def test_version(forgetting):
    run = forgetting("--version")
    assert (run.code, run.out) == (0, f"forgetting {fg.__version__}\n")


@pytest.mark.parametrize("command", [[], ["identify"], ["rules"], ["demo"]])
def test_help(command):
    run = CliRunner().invoke(app, [*command, "--help"], env={"COLUMNS": "120"})
    assert run.exit_code == 0 and "Usage:" in run.output


def test_identify_help_has_groups():
    text = CliRunner().invoke(app, ["identify", "--help"], env={"COLUMNS": "120"}).output
    for part in ("Model", "Forgetting", "What to write", "--formula", "--arx", "--report"):
        assert part in text


def test_without_a_command_the_help_and_code_2(forgetting):
    run = forgetting()
    assert run.code == 2 and "identify" in run.out + run.err
