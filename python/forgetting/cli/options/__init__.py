"""Options that commands share, a file for each group of their help."""

from forgetting.cli.options import known, model, reading, rule, writing
from forgetting.cli.options.group import FILES, KNOWN, MODEL, READING, RULE, option

__all__ = [
    "FILES",
    "KNOWN",
    "MODEL",
    "READING",
    "RULE",
    "known",
    "model",
    "option",
    "reading",
    "rule",
    "writing",
]
