"""The examples in the package that writes the pages."""

from __future__ import annotations

import doctest
import importlib
import pkgutil

import pytest
import writing

MODULES = [
    module.name
    for module in pkgutil.walk_packages(writing.__path__, "writing.")
    if not module.ispkg
]


@pytest.mark.parametrize("name", MODULES)
def test_examples(name):
    if name == "writing.katex":
        pytest.importorskip("docutils")
    assert doctest.testmod(importlib.import_module(name)).failed == 0
