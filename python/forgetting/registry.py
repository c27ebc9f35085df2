"""Every rule, rate, weighting and gate of the registries, each a class of its own.

The classes are made at import; `registry.pyi`, written by ``tools/stubs.py``, lists them
for type checkers and editors.
"""

from .choices import CLASSES

globals().update(CLASSES)
__all__ = tuple(CLASSES)
