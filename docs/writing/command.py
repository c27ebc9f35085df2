"""The pages of the command: every option as the command has it, and runs with their output."""

from __future__ import annotations

import re
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import typer.main

from forgetting.cli.app import app

from .runs import RUNS, runs
from .write import write


def pages(docs: Path) -> None:
    """Write a page for every command, and one that lists them."""
    commands = typer.main.get_command(app).commands  # type: ignore[attr-defined]
    missing = commands.keys() ^ RUNS.keys()
    if missing:
        raise LookupError(f"commands without a run, or runs without a command: {missing}")
    for name, command in commands.items():
        write(docs / "command" / f"{name}.md", page(name, command))
    write(docs / "command" / "index.md", overview(commands))


def page(name: str, command: Any) -> str:
    """The page of a command."""
    parts = [f"# forgetting {name}", plain(command.help), usage(name, command), "## Runs", GIVEN]
    parts += runs(RUNS[name])
    parts += ["## Options", f"```{{program}} forgetting {name}\n```", *options(command)]
    return "\n\n".join(parts) + "\n"


GIVEN = (
    "They were run when this page was built, in a folder with `record.csv`, the record that "
    "`forgetting demo` writes, and `data`, a folder of tables of four devices."
)


def usage(name: str, command: Any) -> str:
    """How it is called."""
    arguments = " ".join(
        each.name.upper() if each.required else f"[{each.name.upper()}]"
        for each in command.params
        if not is_option(each)
    )
    return f"```text\nforgetting {name} [OPTIONS] {arguments}".rstrip() + "\n```"


def options(command: Any) -> Iterator[str]:
    """Arguments and options, in the groups of the help."""
    groups: dict[str, list[Any]] = {}
    for each in command.params:
        group = getattr(each, "rich_help_panel", None) or "Options"
        groups.setdefault(group if is_option(each) else "Arguments", []).append(each)
    for group, members in groups.items():
        if len(groups) > 1:
            yield f"### {group}"
        for each in members:
            yield option(each)


def option(each: Any) -> str:
    """One option, as an entry of the index; an argument is one in capitals."""
    shown = [*each.opts, *each.secondary_opts] if is_option(each) else [each.name.upper()]
    value = f" {each.metavar or kind(each)}" if is_option(each) and not is_flag(each) else ""
    words = [plain(each.help or "")]
    if each.required and not is_option(each):
        words.append("Required.")
    elif each.default not in (None, False, [], ()) and not is_flag(each):
        told = each.show_default if isinstance(each.show_default, str) else each.default
        words.append(f"Default: `{told}`.")
    elif is_flag(each) and each.secondary_opts:
        words.append(f"Default: `{each.opts[0] if each.default else each.secondary_opts[0]}`.")
    return f"```{{option}} {', '.join(shown)}{value}\n{' '.join(words)}\n```"


def is_option(each: Any) -> bool:
    """Whether a parameter has a name with dashes."""
    return str(each.opts[0]).startswith("-")


def is_flag(each: Any) -> bool:
    """Whether an option takes no value."""
    return bool(getattr(each, "is_flag", False))


def kind(each: Any) -> str:
    """What stands for the value of an option."""
    return "NUMBER" if isinstance(each.default, int | float) else "TEXT"


def plain(text: str) -> str:
    """Help as Markdown, names of options as code."""
    text = text.replace("*", r"\*").replace("<", r"\<").strip()
    return re.sub(r"(?<![\w`-])--?[a-z][a-z-]*", r"`\g<0>`", text)


def overview(commands: Any) -> str:
    """The list of commands."""
    rows = [f"| [`{n}`]({n}.md) | {c.help.split(chr(10))[0]} |" for n, c in commands.items()]
    return OVERVIEW.format(rows="\n".join(rows), names="\n".join(commands))


OVERVIEW = """# The command

    pip install 'forgetting[cli]'

| `forgetting` | |
|---|---|
{rows}

Every command has `--help`. `forgetting --version` prints the version.

The exit code is 0 when all went well; 1 when the result itself is a warning (`certify`: the
covariance wound up; `reproduce`: a claim does not hold; `fleet`: the saved state of a stream was
refused); 2 for bad use and bad data, with one line that says what was wrong; 130 after Ctrl-C. A
file is written whole or not at all.

```{{toctree}}
:hidden:

{names}
```
"""
