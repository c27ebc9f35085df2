"""Dead links are found, and living ones are left alone."""

from __future__ import annotations

import pytest
from writing.links import dead

ELSEWHERE = '<a href="https://example.org/x">a site</a><a href="mailto:a@example.org">a</a>'
ALIVE = (
    '<p id="here"><a href="#here">here</a> <a href="sub/">folder</a>'
    '<a href="sub/b.html#there">b</a><a href="sub/b.html#rule=none&level=2">settings</a>'
    '<img src="a%20b.png"><img src="data:image/png;base64,AA"></p>' + ELSEWHERE
)


@pytest.fixture
def pages(tmp_path):
    (tmp_path / "sub").mkdir()
    (tmp_path / "a b.png").write_bytes(b"")
    (tmp_path / "sub" / "index.html").write_text('<a href="../a.html">up</a>')
    (tmp_path / "sub" / "b.html").write_text('<h1 id="there">b</h1>')
    (tmp_path / "a.html").write_text(ALIVE)
    return tmp_path


def test_living_links(pages):
    assert list(dead(pages)) == []


@pytest.mark.parametrize(
    ("tag", "words"),
    [
        ('<a href="gone.html">x</a>', "no such file"),
        ('<a href="sub/gone/">x</a>', "no such file"),
        ('<a href="#gone">x</a>', "no such place"),
        ('<a href="sub/b.html#gone">x</a>', "no such place"),
        ('<img src="gone.png">', "no such file"),
        ('<script src="https://example.org/x.js"></script>', "from a network"),
        ('<link rel="stylesheet" href="//example.org/x.css">', "from a network"),
    ],
)
def test_dead_links(pages, tag, words):
    (pages / "c.html").write_text(tag)
    (found,) = dead(pages)
    assert "c.html" in found and words in found
