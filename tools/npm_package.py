"""Writes package.json of the JavaScript module, with the version of the crates.

python3 tools/npm_package.py FOLDER
"""

from __future__ import annotations

import json
import sys
from pathlib import Path

ROOT = Path(__file__).parents[1]


def field(name: str) -> str:
    """A field that all crates share, from the workspace."""
    lines = (ROOT / "Cargo.toml").read_text(encoding="utf-8").splitlines()
    line = next(line for line in lines if line.startswith(f"{name} = "))
    return line.split('"')[1]


def package() -> dict[str, object]:
    """What npm wants to know."""
    files = ["forgetting.js", "forgetting.d.ts", "forgetting_bg.wasm", "forgetting_bg.wasm.d.ts"]
    return {
        "name": "forgetting",
        "version": field("version"),
        "description": "Recursive least squares with generalized forgetting: estimates from live "
        "data, and forgets only what it should.",
        "keywords": ["recursive least squares", "forgetting factor", "system identification"],
        "license": f"({field('license')})",
        "type": "module",
        "main": "forgetting.js",
        "types": "forgetting.d.ts",
        "exports": {
            ".": {"types": "./forgetting.d.ts", "default": "./forgetting.js"},
            "./forgetting_bg.wasm": "./forgetting_bg.wasm",
        },
        "files": [*files, "LICENSE-MIT", "LICENSE-APACHE"],
        "sideEffects": False,
    }


if __name__ == "__main__":
    text = json.dumps(package(), indent=2) + "\n"
    (Path(sys.argv[1]) / "package.json").write_text(text, encoding="utf-8")
