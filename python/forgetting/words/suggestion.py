"""What somebody may have meant by a name that does not exist."""

from __future__ import annotations

import difflib

LISTED = 12
"""How many names are listed when none is close."""


def suggestion(known: list[str], name: str, otherwise: str) -> str:
    """End of a sentence that names what the user may have meant.

    Examples
    --------
    >>> suggestion(["voltage", "current"], "Voltag", "there are")
    "; close are 'voltage'"
    >>> suggestion(["voltage", "current"], "x", "there are")
    "; there are 'voltage', 'current'"
    """
    meant = close(known, name)
    if meant:
        return meant
    more = f" and {len(known) - LISTED} more" if len(known) > LISTED else ""
    return f"; {otherwise} {', '.join(map(repr, known[:LISTED]))}{more}"


def close(known: list[str], name: str) -> str:
    """End of a sentence that names up to three names that are close; empty where there are none.

    Examples
    --------
    >>> close(["voltage", "current"], "Voltag"), close(["voltage", "current"], "x")
    ("; close are 'voltage'", '')
    """
    lower = {column.lower(): column for column in known}
    alike = difflib.get_close_matches(name.lower(), lower, n=3, cutoff=0.55)
    contained = [column for column in lower if name.lower() in column and column not in alike]
    matches = [lower[match] for match in (alike + contained)[:3]]
    return f"; close are {', '.join(map(repr, matches))}" if matches and len(name) > 1 else ""
