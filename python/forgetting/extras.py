"""Libraries that only some functions need, imported when such a function is called."""

from __future__ import annotations

from importlib import import_module
from typing import Any


def extra(module: str, purpose: str, name: str = "cli") -> Any:
    """Import a library of an extra.

    Parameters
    ----------
    module : str
        Such as "scipy.stats".
    purpose : str
        What it is needed for, as the subject of a sentence: "a free run".
    name : str
        The extra that brings it.

    Raises
    ------
    ImportError
        When it is not installed; the message says what to install.
    """
    try:
        return import_module(module)
    except ModuleNotFoundError as error:
        package = module.partition(".")[0]
        advice = f"pip install 'forgetting[{name}]' brings it"
        raise ImportError(f"{purpose} needs {package}: {advice}", name=error.name) from None
