"""Every axis and every entry of its registry: a class each, and two functions an axis.

They are made at import; `registry.pyi`, written by ``tools/stubs.py``, lists them for type
checkers and editors.
"""

from .choices import AXES

_NAMES = {name: value for axis in AXES.values() for name, value in axis.exports().items()}
globals().update(_NAMES)
__all__ = tuple(_NAMES)
