"""The front page leads to the playground where that was built, and nowhere where it was not."""

from __future__ import annotations

from types import SimpleNamespace

from writing import playground

from .conftest import ROOT


def test_the_front_page_has_its_place():
    assert (ROOT / "docs" / "index.md").read_text(encoding="utf-8").count(playground.MARK) == 1


def test_it_is_linked_and_copied_only_if_it_is_there(tmp_path):
    app = SimpleNamespace(srcdir=str(tmp_path), outdir=str(tmp_path / "out"))
    text = [f"a {playground.MARK} b"]
    playground.link(app, "index", text)
    playground.copy(app, None)
    assert text == ["a  b"] and not (tmp_path / "out").exists()
    (tmp_path / "playground").mkdir()
    (tmp_path / "playground" / "index.html").write_text("<p>here</p>")
    text = [f"a {playground.MARK} b"]
    playground.link(app, "index", text)
    playground.copy(app, None)
    assert "playground/index.html" in text[0]
    assert (tmp_path / "out" / "playground" / "index.html").read_text() == "<p>here</p>"
