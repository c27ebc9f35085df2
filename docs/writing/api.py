"""The pages of the Python interface: every public name, module by module."""

from __future__ import annotations

import importlib
import inspect
from pathlib import Path
from typing import Any

from .modules import DATA, MODULES, Module
from .write import write

OURS = ("forgetting", "builtins", "functools")
"""Modules of what is this package's in a class; the compiled classes say `builtins`."""


def pages(docs: Path) -> None:
    """Write the page of every module, and one that lists them."""
    for module in MODULES:
        write(docs / "api" / f"{module.name}.rst", page(module))
    write(docs / "api" / "index.rst", overview())


def page(module: Module) -> str:
    """The page of a module."""
    parts = [heading(module.title, "="), f".. automodule:: {module.name}\n   :no-members:"]
    parts.append(f".. currentmodule:: {module.name}")
    for title, names in module.parted():
        parts += [heading(title, "-")] if title else []
        parts += [entry(module.name, name) for name in names]
    return "\n\n".join(parts) + "\n"


def entry(module: str, name: str) -> str:
    """What Sphinx is told of one name."""
    where, _, last = name.rpartition(".")
    value: Any = getattr(importlib.import_module(where or module), last)
    if inspect.isclass(value) and issubclass(value, BaseException):
        return f".. autoexception:: {name}"
    if inspect.isclass(value):
        called = "\n   :special-members: __call__" if "__call__" in vars(value) else ""
        return f".. autoclass:: {name}\n   :members: {members(value)}{called}"
    if inspect.isroutine(value):
        return f".. autofunction:: {name}"
    return f".. py:data:: {name}\n\n   {DATA[name]}"


def members(kind: type) -> str:
    """The public members of a class that are this package's; its bases may be another's."""
    bases = [each for each in kind.__mro__ if each.__module__.startswith(OURS)]
    found = {
        name: value for each in bases if each is not object for name, value in vars(each).items()
    }
    return ", ".join(
        name
        for name, value in found.items()
        if not name.startswith("_") and type(value).__module__.startswith(OURS)
    )


def heading(text: str, line: str) -> str:
    """A heading."""
    return f"{text}\n{line * len(text)}"


def overview() -> str:
    """The list of modules."""
    rows = "\n".join(
        f"   * - :doc:`{m.title} <{m.name}>`\n     - ``{m.name}``\n     - {first(m.name)}"
        for m in MODULES
    )
    names = "\n".join(f"   {module.name}" for module in MODULES)
    return OVERVIEW.format(rows=rows, names=names)


def first(module: str) -> str:
    """The first sentence of a module's docstring."""
    text = inspect.getdoc(importlib.import_module(module)) or ""
    return " ".join(text.split("\n\n")[0].split()).replace("`", "``")


OVERVIEW = """Python
======

``import forgetting as fg`` brings the estimators and every choice; other modules are imported by
their names, and only when they are used. Rules, rates, weightings, gates and mixers are classes of
``forgetting`` and have a page each: :doc:`../rules/index`, :doc:`../rates/index`,
:doc:`../weightings/index`, :doc:`../gates/index`, :doc:`../mixers/index`. The index of all names is
:ref:`genindex`.

.. list-table::

{rows}

.. toctree::
   :hidden:

{names}
"""
