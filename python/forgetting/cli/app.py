"""The commands, and the one place where an error becomes a sentence and an exit code."""

from __future__ import annotations

import sys
from contextlib import nullcontext

import typer

import forgetting as fg
from forgetting.cli.certify import certify
from forgetting.cli.compare import compare
from forgetting.cli.demo import demo
from forgetting.cli.fleet import fleet
from forgetting.cli.identify import identify
from forgetting.cli.interrupt import STOPPED, Interrupt, interruptible
from forgetting.cli.reproduce import reproduce
from forgetting.cli.rules import rules
from forgetting.cli.stream import stream
from forgetting.cli.tables import leave_quietly, say
from forgetting.cli.tune import tune
from forgetting.words.errors import RecordError

BAD = 2
"""Exit code for bad use and bad data."""

WITH_SIGNALS = ("stream",)
"""Commands to which Ctrl-C says to save and stop, in their own time."""

app = typer.Typer(
    name="forgetting",
    help="Identify models from measured records, recursively, and forget old data the right way.",
    add_completion=False,
    rich_markup_mode="rich",
    pretty_exceptions_enable=False,
    context_settings={"help_option_names": ["-h", "--help"]},
)
app.command()(identify)
app.command()(tune)
app.command()(compare)
app.command()(certify)
app.command()(stream)
app.command()(fleet)
app.command()(rules)
app.command()(demo)
app.command()(reproduce)


def show_version(wanted: bool) -> None:
    """Print the version and stop."""
    if wanted:
        say(f"forgetting {fg.__version__}")
        raise typer.Exit


@app.callback()
def forgetting(
    version: bool = typer.Option(
        False, "--version", callback=show_version, is_eager=True, help="Show the version and exit."
    ),
) -> None:
    """Identify models from measured records, recursively, and forget old data the right way."""


def run(arguments: list[str]) -> int:
    """Run a command line; Ctrl-C ends it, whatever a library makes of that."""
    if not arguments:
        run(["--help"])
        return BAD
    alone = arguments[0] in WITH_SIGNALS
    with nullcontext(Interrupt()) if alone else interruptible() as interrupt:
        try:
            code = outcome(arguments)
        except BaseException:
            if not interrupt.pressed:
                raise
    if interrupt.pressed or code == STOPPED:
        complain("stopped")
        return STOPPED
    return code


def outcome(arguments: list[str]) -> int:
    """Run a command; whatever the user can cause ends as a sentence, never a traceback."""
    try:
        code = app(args=arguments, standalone_mode=False, prog_name="forgetting")
        sys.stdout.flush()
    except (RecordError, fg.InvalidInput, fg.NumericalRange) as error:
        return complain(str(error))
    except MemoryError:
        return complain("the record does not fit into memory")
    except (BrokenPipeError, SystemExit):
        # The reader (such as `head`) has what it wanted; rich, which prints the help, exits then.
        leave_quietly()
        return 0
    except OSError as error:
        return complain(f"{error.filename}: {error.strerror}" if error.filename else str(error))
    except KeyboardInterrupt:
        return STOPPED
    except ImportError as error:
        return complain(advice(error))
    except Exception as error:
        # Usage errors of the option parser; its classes moved between versions of typer.
        if hasattr(error, "format_message"):
            return complain(error.format_message())
        if type(error).__name__ == "Abort":
            return STOPPED
        raise
    return code if isinstance(code, int) else 0


def advice(error: ImportError) -> str:
    """Which extra brings what is missing; `forgetting.extras` says it already."""
    words = str(error)
    if "pip install" in words:
        return words
    return f"{error.name} is missing; install it with pip install 'forgetting[cli]'"


def complain(message: str) -> int:
    """Write one sentence to stderr."""
    sentence = " ".join(message.split()).rstrip(".")
    print(f"forgetting: {sentence}.", file=sys.stderr)
    return BAD
