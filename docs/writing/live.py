"""The playground on the page of a rule, where it is built: see `docs/playground`."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

HEIGHT = 1080
"""What the story takes in a column of a page; more is scrolled."""

LIVE = """````{{only}} playground
**Live.** Switch the input off: the covariance of `exponential` grows without limit, and below it is
what `{name}` and others make of the same samples. All of it is computed in your browser;
<a href="../playground.html#rule={name}">the playground begins with `{name}`</a> and takes files of
yours, too.

```{{raw}} html
<iframe src="../playground.html#only=windup&rule={name}" title="{name}, live" loading="lazy"
 style="width: 100%; height: {height}px; border: 0"></iframe>
```
````"""


def live(axis: str, about: Mapping[str, Any]) -> list[str]:
    """The playground with this rule, if it has it: it offers those that need nothing to be given.

    Examples
    --------
    >>> live("rule", {"name": "custom", "parameters": [{"required": True}]})
    []
    >>> "playground.html#rule=none" in live("rule", {"name": "none", "parameters": []})[0]
    True
    """
    needs = any(parameter["required"] for parameter in about["parameters"])
    if axis != "rule" or needs:
        return []
    other = "subspace" if about["name"] == "exponential" else about["name"]
    return [LIVE.format(name=other, height=HEIGHT)]
