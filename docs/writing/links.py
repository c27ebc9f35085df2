"""Finds dead links in the built pages: no such file, no such anchor, or loaded from a network.

    python -m writing.links _build

Links to other sites are not followed: a build needs no network. A page may link to one, but must
not load anything from it, so that all of them work without.
"""

from __future__ import annotations

import sys
from collections.abc import Iterator
from dataclasses import dataclass, field
from html.parser import HTMLParser
from pathlib import Path
from urllib.parse import unquote, urlsplit

LOADED = {("script", "src"), ("img", "src"), ("link", "href"), ("iframe", "src"), ("source", "src")}
NOT_LOADED = {"canonical", "alternate", "license", "author"}
"""Kinds of `<link>` that fetch nothing."""


@dataclass
class Page(HTMLParser):
    """What a page links to, loads, and can be linked to.

    Attributes
    ----------
    links, loaded : list of str
        Addresses as they stand in the page.
    anchors : set of str
        Every `id` and `name`.
    """

    links: list[str] = field(default_factory=list)
    loaded: list[str] = field(default_factory=list)
    anchors: set[str] = field(default_factory=set)

    def __post_init__(self) -> None:
        super().__init__()

    def handle_starttag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        """Note what a tag links to."""
        values = dict(attrs)
        for name in ("id", "name"):
            if values.get(name):
                self.anchors.add(str(values[name]))
        if tag == "a" and values.get("href"):
            self.links.append(str(values["href"]))
        for name, value in attrs:
            fetched = (tag, name) in LOADED and values.get("rel") not in NOT_LOADED
            if fetched and value and not value.startswith("data:"):
                self.loaded.append(value)


def dead(root: Path) -> Iterator[str]:
    """One line for everything that does not lead anywhere, page by page.

    Parameters
    ----------
    root : Path
        Folder of HTML pages.
    """
    pages = {path: parsed(path) for path in sorted(root.rglob("*.html"))}
    for path, page in pages.items():
        name = path.relative_to(root)
        for address in page.loaded:
            if urlsplit(address).netloc:
                yield f"{name} loads {address} from a network"
        for address in dict.fromkeys([*page.links, *page.loaded]):
            parts = urlsplit(address)
            if parts.scheme or parts.netloc:
                continue
            target = (path.parent / unquote(parts.path)).resolve() if parts.path else path
            target = target / "index.html" if target.is_dir() else target
            if not target.exists():
                yield f"{name} links to {address}: there is no such file"
            elif is_place(parts.fragment) and target.suffix == ".html":
                known = pages.get(target)
                if known is None or unquote(parts.fragment) not in known.anchors:
                    yield f"{name} links to {address}: there is no such place on that page"


def is_place(fragment: str) -> bool:
    """Whether a fragment is a place on a page, and not settings such as ``rule=subspace``."""
    return bool(fragment) and "=" not in fragment


def parsed(path: Path) -> Page:
    """The links of a page."""
    page = Page()
    page.feed(path.read_text(encoding="utf-8"))
    return page


def main() -> int:
    """Print what is dead; exit code 1 if anything is."""
    root = Path(sys.argv[1]).resolve()
    found = list(dead(root))
    print("\n".join(found) or f"no dead link in {len(list(root.rglob('*.html')))} pages")
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main())
