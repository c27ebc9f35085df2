"""Writes where the project lives into what is published: its metadata and its README.

    python tools/addresses.py https://example.org/someone/forgetting v0.1.0

The sources name no address, as a copy of them may live anywhere. A registry shows the README alone,
so its pictures and links must be absolute there, and the metadata should say where to look and
whom to tell. The workflow that builds wheels runs this on its own copy, before it builds.
"""

from __future__ import annotations

import re
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parents[1]
PICTURE = re.compile(r"(!\[[^\]]*\]\()(?![a-z]+:)([^)]+\))")
LINK = re.compile(r"((?<!!)\[[^\]]*\]\()(?![a-z]+:|#)([^)]+\))")
ADDRESS = re.compile(r"https://[\w.-]+(?:/[\w.-]+)+")
URLS = """
[project.urls]
Homepage = "{address}"
Source = "{address}"
Documentation = "{address}/tree/{tag}/docs"
Changelog = "{address}/blob/{tag}/CHANGELOG.md"
Issues = "{address}/issues"
"""


def readme(text: str, address: str, tag: str) -> str:
    """The README with absolute pictures and links.

    Examples
    --------
    >>> readme("![p](a.png) [l](B.md) [h](#x)", "https://a.org/b/c", "v1")
    '![p](https://a.org/b/c/raw/v1/a.png) [l](https://a.org/b/c/blob/v1/B.md) [h](#x)'
    """
    text = PICTURE.sub(rf"\g<1>{address}/raw/{tag}/\g<2>", text)
    return LINK.sub(rf"\g<1>{address}/blob/{tag}/\g<2>", text)


def metadata(text: str, address: str, tag: str) -> str:
    """The pyproject.toml with the addresses of the project.

    Raises
    ------
    ValueError
        If it has some already.
    """
    if "[project.urls]" in text:
        raise ValueError("pyproject.toml has [project.urls] already")
    before, mark, after = text.partition("\n[project.scripts]")
    if not mark:
        raise ValueError("pyproject.toml has no [project.scripts], before which the addresses go")
    return before + URLS.format(address=address, tag=tag) + mark + after


def main(arguments: list[str]) -> int:
    """Write both files, or neither."""
    if len(arguments) != 2 or not ADDRESS.fullmatch(arguments[0].rstrip("/")):
        print("usage: addresses.py https://HOST/OWNER/NAME TAG", file=sys.stderr)
        return 2
    address, tag = arguments[0].rstrip("/"), arguments[1]
    made = {
        ROOT / name: change((ROOT / name).read_text(encoding="utf-8"), address, tag)
        for name, change in (("README.md", readme), ("pyproject.toml", metadata))
    }
    for path, text in made.items():
        path.write_text(text, encoding="utf-8")
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
