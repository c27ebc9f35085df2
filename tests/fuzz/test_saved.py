"""Bytes that no estimator saved are refused with one line, or are an estimator that goes on."""

from __future__ import annotations

import forgetting as fg

from .saved import banks, changed, estimators, goes_on
from .target import fuzz


def test_rls() -> None:
    fuzz("RLS.from_bytes", 1000, changed(estimators()), lambda x: goes_on(fg.RLS.from_bytes(x)))


def test_bank() -> None:
    fuzz("Bank.from_bytes", 500, changed(banks()), lambda x: goes_on(fg.Bank.from_bytes(x)))
