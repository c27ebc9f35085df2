"""`forgetting demo`: what it prints, and the sentence when the records are not installed."""

from __future__ import annotations

from importlib.metadata import PackageNotFoundError

import pytest

from forgetting.demo import DEMOS
from forgetting.demo.outcome import Outcome


def test_prints_the_table_and_the_files(forgetting, tmp_path, monkeypatch):
    folders = []

    def fake(folder):
        folders.append(folder)
        return Outcome([folder / "page.html"], "Title", ("rule", "mass"), [("none", "[87] ± 2")])

    for name in DEMOS:
        monkeypatch.setitem(DEMOS, name, fake)
    run = forgetting("demo", "--output", tmp_path / "new" / "folder")
    assert run.code == 0 and folders == [tmp_path / "new" / "folder"] * 2
    assert folders[0].is_dir()
    assert "[87] ± 2" in run.out and f"wrote {folders[0] / 'page.html'}" in run.out
    assert forgetting("demo", "solar", "-o", tmp_path).code == 0 and len(folders) == 3


@pytest.mark.parametrize(
    ("name", "package"), [("solar", "pvanalytics==0.2.2"), ("cycling", "sweat==0.25.0")]
)
def test_records_that_are_not_installed(forgetting, tmp_path, monkeypatch, name, package):
    def nothing(_):
        raise PackageNotFoundError

    monkeypatch.setattr("forgetting.demo.packaged.distribution", nothing)
    run = forgetting("demo", name, "-o", tmp_path)
    assert f"which is not installed; pip install --no-deps {package}" in run.sentence()
