"""What is published says where the project lives; the sources do not."""

from __future__ import annotations

import importlib.util
import re

import pytest

from .conftest import ROOT

try:
    import tomllib
except ImportError:  # Python 3.10
    tomllib = pytest.importorskip("tomli")

HOME, TAG = "https://example.org/someone/forgetting", "v1.2.3"


@pytest.fixture
def addresses(monkeypatch, tmp_path):
    """The tool, on copies of both files."""
    spec = importlib.util.spec_from_file_location("addresses", ROOT / "tools" / "addresses.py")
    tool = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(tool)
    for name in ("README.md", "pyproject.toml"):
        (tmp_path / name).write_text((ROOT / name).read_text("utf-8"), "utf-8")
    monkeypatch.setattr(tool, "ROOT", tmp_path)
    return tool


def test_both_files_are_written(addresses, tmp_path):
    assert addresses.main([HOME + "/", TAG]) == 0
    project = tomllib.loads((tmp_path / "pyproject.toml").read_text("utf-8"))["project"]
    assert project["urls"]["Issues"] == f"{HOME}/issues"
    assert all(url.startswith(HOME) for url in project["urls"].values())
    assert {"authors", "keywords", "classifiers", "readme", "license"} <= project.keys()
    text = (tmp_path / "README.md").read_text("utf-8")
    pictures = re.findall(r"!\[[^\]]*\]\(([^)]+)\)", text)
    assert pictures and all(each.startswith(f"{HOME}/raw/{TAG}/") for each in pictures)
    assert f"[CHANGELOG.md]({HOME}/blob/{TAG}/CHANGELOG.md)" in text


def test_what_is_linked_is_there(addresses, tmp_path):
    addresses.main([HOME, TAG])
    text = (tmp_path / "README.md").read_text("utf-8")
    found = re.findall(rf"\({re.escape(HOME)}/(?:raw|blob)/{TAG}/([^)#]+)", text)
    assert found and all((ROOT / path).exists() for path in found)


@pytest.mark.parametrize("given", [[], [HOME], ["http://example.org/a/b", TAG], ["here", TAG]])
def test_wrong_use_writes_nothing(addresses, tmp_path, capsys, given):
    before = (tmp_path / "README.md").read_text("utf-8")
    assert addresses.main(given) == 2
    assert "usage" in capsys.readouterr().err
    assert (tmp_path / "README.md").read_text("utf-8") == before


def test_addresses_are_written_once(addresses, tmp_path):
    addresses.main([HOME, TAG])
    before = (tmp_path / "README.md").read_text("utf-8")
    with pytest.raises(ValueError, match="already"):
        addresses.main([HOME, TAG])
    assert (tmp_path / "README.md").read_text("utf-8") == before
