"""The dense simulator, the measured records and those of the papers, for the tests here."""

import sys
from importlib.metadata import PackageNotFoundError, distribution
from pathlib import Path

import pytest

sys.path.insert(0, str(Path(__file__).parent))


def _measured(name):
    """A measured record of the demos: regressors (T, n) and output (T,), no value missing."""
    package = {"solar": "pvanalytics", "ride": "sweat"}[name]
    try:
        distribution(package)
    except PackageNotFoundError:
        pytest.skip(f"{package}, which ships the record, is not installed")
    if name == "solar":
        from forgetting.demo.solar import FORMULA, solar_record

        record, formula = solar_record(), FORMULA
    else:
        from forgetting.demo.cycling import FORMULA, ride_record

        record, formula = ride_record()[0], FORMULA
    from forgetting.record.regression import regression

    samples = regression(record, formula)
    return samples.phi[samples.complete], samples.y[samples.complete, 0]


@pytest.fixture(params=["solar", "ride"])
def measured(request):
    """Regressors (T, n) and output (T,) of a measured record."""
    return _measured(request.param)


@pytest.fixture
def solar():
    """Regressors (T, 2) and output (T,) of the solar array, night and day."""
    return _measured("solar")


def _of_the_papers():
    """Regressors (T, rows, n) of the examples of the three papers."""
    from forgetting.papers.gf.every_rule import data
    from forgetting.papers.opd import system as opd
    from forgetting.papers.vdf import systems as vdf

    one = {
        "vdf, two lags of three sinusoids": vdf.two_lags(vdf.three_sinusoids(300)),
        "vdf, fifth order": vdf.fifth_order(600)[0],
        "vdf, finite response": vdf.finite_response(300)[0],
        "vdf, first order": vdf.first_order(vdf.three_sinusoids(300))[0],
        "vdf, constrained": vdf.constrained(300)[0],
        "gf, excited": data("excited", 300)[0],
        "gf, silent": data("silent", 300)[0],
    }
    found = {name: phi[:, None, :] for name, phi in one.items()}
    found["opd, two outputs"] = opd.simulate(opd.FITTED, 0)[0][:300]
    return found


PAPERS = _of_the_papers()


@pytest.fixture(params=PAPERS, ids=str)
def of_a_paper(request):
    """Regressors (T, rows, n) of one of the papers' examples."""
    return PAPERS[request.param]
