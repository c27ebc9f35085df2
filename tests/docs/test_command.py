"""The pages of the command have every command and every option."""

from __future__ import annotations

import re

import pytest
import typer.main
from writing import command, runs

from forgetting.cli.app import app

COMMANDS = typer.main.get_command(app).commands


def test_every_command_is_run():
    assert COMMANDS.keys() == runs.RUNS.keys()
    for name, lines in runs.RUNS.items():
        assert lines and all(f"forgetting {name}" in line for line in lines)


@pytest.mark.parametrize("name", COMMANDS)
def test_every_option_is_shown_with_its_words(name):
    text = "\n".join(command.options(COMMANDS[name]))
    for each in COMMANDS[name].params:
        for option in (*each.opts, *each.secondary_opts):
            shown = option if option.startswith("-") else option.upper()
            assert re.search(rf"^```{{option}} (.*, )?{re.escape(shown)}\b", text, re.MULTILINE)
        assert command.plain(each.help) in text


def test_a_line_that_fails_stops_the_build(tmp_path):
    runs.prepare(tmp_path)
    assert runs.printed("forgetting --version", tmp_path).startswith("forgetting ")
    with pytest.raises(RuntimeError, match=r"gone\.csv"):
        runs.printed("forgetting identify gone.csv --formula 'y ~ x'", tmp_path)
