"""Every erratum is confirmed: its printed form fails, its corrected form holds."""

from collections import Counter

import pytest

from forgetting.papers.errata import ERRATA
from forgetting.papers.errata.markdown import entry


@pytest.mark.parametrize("each", ERRATA, ids=lambda each: each.name)
def test_erratum_is_confirmed(each):
    words, confirmed = each()
    assert confirmed, words


@pytest.mark.parametrize("each", ERRATA, ids=lambda each: each.name)
def test_errors_are_measured(each):
    """Only a slip of the pen may have nothing to measure."""
    assert each.measure is not None or each.kind == "typo"


def test_names_are_unique():
    repeated = [name for name, times in Counter(each.name for each in ERRATA).items() if times > 1]
    assert repeated == []


def test_an_erratum_that_is_not_confirmed_is_not_printed():
    from forgetting.papers.errata import Erratum

    wrong = Erratum("X-1", "nowhere", "error", "1 = 2", "1 = 1", "", lambda: ("1 is 2", False))
    with pytest.raises(ArithmeticError, match="X-1 is not confirmed"):
        entry(wrong)
