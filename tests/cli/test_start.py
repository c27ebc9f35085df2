"""What the command loads, and what it leaves until it is needed."""

from __future__ import annotations

import subprocess
import sys

import pytest

from forgetting.papers import SEEDS

HEAVY = ("pandas", "matplotlib", "scipy", "formulaic", "jinja2", "pyarrow")
OTHERS = ("forgetting.papers", "forgetting.demo")

SCRIPT = """
import sys
from forgetting.cli import main
code = main(sys.argv[1:])
print("loaded", *sorted(sys.modules))
sys.exit(code)
"""


def loaded(*arguments) -> set[str]:
    """Modules that a command has imported when it is done."""
    done = subprocess.run(
        [sys.executable, "-c", SCRIPT, *map(str, arguments)],
        capture_output=True,
        text=True,
        timeout=60,
    )
    assert done.returncode == 0, done.stderr
    return set(done.stdout.splitlines()[-1].split()[1:])


@pytest.mark.parametrize("arguments", [["--help"], ["identify", "--help"], ["rules"]])
def test_help_and_rules_load_nothing_heavy(arguments):
    assert not loaded(*arguments) & {*HEAVY, *OTHERS, "forgetting.record", "forgetting.analysis"}


def test_identify_loads_what_the_model_needs(battery):
    arx = loaded("identify", battery, "-y", "V", "-u", "I", "--arx", "1,2,0")
    assert "pandas" in arx
    assert not arx & {"matplotlib", "formulaic", "jinja2", "forgetting.plot", *OTHERS}
    formula = loaded("identify", battery, "-f", "V ~ I")
    assert "formulaic" in formula and not formula & {"matplotlib", "forgetting.plot", *OTHERS}


def test_the_help_of_reproduce_says_how_many_seeds(forgetting):
    assert f"{SEEDS} if absent" in " ".join(forgetting("reproduce", "--help").out.split())
