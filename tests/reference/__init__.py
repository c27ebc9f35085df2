"""Dense, high-precision reference of recursive least squares with generalized forgetting.

Everything here is written from the published formulas and solved densely, with 256-bit
arithmetic: no factor is propagated, nothing is tuned for speed, and no code is shared with the
package under test. ``README.md`` beside this file is the table of definitions.
"""
