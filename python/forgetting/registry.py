"""Every rule, rate, weighting and gate of the registries, each a class of its own.

The classes are made at import; `registry.pyi`, written by ``tools/stubs.py``, tells type
checkers and editors of them.
"""

from .choices import CLASSES

globals().update(CLASSES)
__all__ = tuple(CLASSES)
