"""The pages of the Python interface show every public name, once."""

from __future__ import annotations

import ast
import importlib
import pkgutil

import pytest
from writing.api import entry, page
from writing.modules import CLASSES, DESCRIBED, INTERNAL, MODULES

import forgetting

from .conftest import ROOT


def test_every_module_has_a_page_or_is_internal():
    found = {module.name for module in pkgutil.iter_modules(forgetting.__path__)} - {"__main__"}
    paged = {module.name.partition(".")[2] for module in MODULES} - {""}
    assert found == paged | set(INTERNAL) | set(DESCRIBED)
    assert not paged & {*INTERNAL, *DESCRIBED}


@pytest.mark.parametrize("name", DESCRIBED)
def test_a_module_without_a_page_is_described_by_hand(name):
    text = (ROOT / "docs" / f"{name}.md").read_text(encoding="utf-8")
    source = (ROOT / "python" / "forgetting" / name / "__init__.py").read_text(encoding="utf-8")
    public = ast.literal_eval(source.partition("__all__ = ")[2])
    assert [each for each in public if each.islower() and each not in text] == []


@pytest.mark.parametrize("module", MODULES, ids=lambda module: module.name)
def test_every_name_is_on_its_page(module):
    shown = [name for _, names in module.parted() for name in names]
    assert len(shown) == len(set(shown))
    assert set(shown) == set(module.names())
    text = page(module)
    for name in shown:
        assert f":: {name}\n" in text
        assert entry(module.name, name)


def test_no_public_name_is_left_out():
    shown = {name for module in MODULES for name in module.names()} | CLASSES | {"__version__"}
    for module in MODULES:
        public = getattr(importlib.import_module(module.name), "__all__", ())
        assert set(public) <= shown
