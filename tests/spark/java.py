"""Say which Java runtime there is; end with a sentence where none fits."""

from __future__ import annotations

import os
import re
import shutil
import subprocess
import sys
from pathlib import Path

OLDEST = 17
"""The version that Spark 4 needs."""
NEEDED = (
    f"Spark needs a Java runtime of version {OLDEST} or later (Debian: openjdk-17-jre-headless)"
)


def java() -> str | None:
    """The program that Spark would start."""
    home = os.environ.get("JAVA_HOME")
    return shutil.which(str(Path(home, "bin", "java")) if home else "java")


def version(program: str) -> int:
    """Its version; those before 9 call themselves 1.8 and the like."""
    told = subprocess.run([program, "-version"], capture_output=True, text=True, check=False)
    found = re.search(r'version "(?:1\.)?(\d+)', told.stderr + told.stdout)
    return int(found[1]) if found else 0


def main() -> str | None:
    """What is wrong, if anything."""
    program = java()
    if program is None:
        return f"{NEEDED}: there is none on PATH or in JAVA_HOME"
    found = version(program)
    if found < OLDEST:
        return f"{NEEDED}: {program} is of version {found}"
    print(f"Java {found}: {program}")
    return None


if __name__ == "__main__":
    sys.exit(main())
