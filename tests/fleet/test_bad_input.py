"""Each refusal names the parameter, its value and what is allowed, and changes nothing."""

import numpy as np
import pytest

import forgetting as fg

BAD_ARGUMENTS = [
    ({"count": -1}, r"count = -1, allowed: whole numbers from 0"),
    ({"count": -3}, r"count = -3, allowed: whole numbers from 0"),
    ({"parameters": 0}, r"parameters = 0, allowed: whole numbers"),
    ({"parameters": -1}, r"parameters = -1, allowed: whole numbers"),
    ({"rule": "nonsense"}, r'rule = "nonsense" is not known'),
    ({"rule": fg.Exponential(1.5)}, r"forgetting_factor = 1.5, allowed: \(0, 1\]"),
    ({"rule": fg.Exponential(lambda evidence: 1.0)}, r"a fleet takes no function of yours"),
    ({"rule": fg.Custom(lambda r, phi, error: 0 * r)}, r"a fleet takes no function of yours"),
    ({"forgetting_factor": 0.0}, r"forgetting_factor = 0, allowed: \(0, 1\]"),
    ({"forgetting_factor": [0.9, 1.0, 1.1, 0.9]}, r"stream 2: forgetting_factor = 1.1, allowed"),
    ({"forgetting_factor": [0.9, 1.0]}, r"forgetting_factor has shape \(2,\), expected \(\)"),
    ({"forgetting_factor": 0.9, "rule": "none"}, r"the rule none uses none"),
    ({"forgetting_factor": 0.9, "rule": fg.NoForgetting()}, r"the rule none uses none"),
    (
        {"forgetting_factor": 0.9, "rule": fg.Exponential(fg.Fortescue())},
        r"forgetting_factor is given twice: the rule has the rate fortescue",
    ),
    ({"gate": print}, r"a fleet takes no function of yours"),
    ({"gate": "nonsense"}, r'gate = "nonsense" is not known'),
    ({"weighting": "nonsense"}, r'weighting = "nonsense" is not known'),
    ({"initial_covariance": -1}, r"initial_covariance\[0\] = -1, allowed: positive"),
    ({"initial_covariance": [1, 2]}, r"initial_covariance has shape \(2,\), expected \(\)"),
    ({"initial_covariance": np.ones((3, 3))}, r"initial_covariance is not positive definite"),
    (
        {"initial_covariance": [[1, 1, 1], [1, 1, 1], [1, -1, 1], [1, 1, 1]]},
        r"stream 2: initial_covariance\[1\] = -1, allowed: positive",
    ),
    ({"initial_theta": [1, 2]}, r"initial_theta has shape \(2,\), expected \(3,\) or \(4, 3\)"),
    ({"initial_theta": np.full((4, 3), np.nan)}, r"stream 0: initial_theta\[0\] = NaN"),
    ({"threads": 0}, r"threads = 0, allowed: whole numbers from 1"),
    ({"dtype": "int32"}, r'dtype = "int32", allowed: "float64", "float32"'),
]


@pytest.mark.parametrize(("arguments", "message"), BAD_ARGUMENTS, ids=lambda a: str(a)[:40])
def test_constructor(arguments, message):
    with pytest.raises(fg.InvalidInput, match=message):
        fg.Fleet(**{"count": 4, "parameters": 3, **arguments})


def test_more_streams_than_there_is_memory_for():
    with pytest.raises(MemoryError, match="not enough memory"):
        fg.Fleet(2**60, 3)


ONES, FOUR = np.ones((4, 3)), np.ones(4)
BAD_SAMPLES = [
    ({"phi": np.ones((3, 4))}, r"phi has shape \(3, 4\), expected \(4, 3\)"),
    ({"phi": np.ones(12)}, r"phi has shape \(12,\), expected \(4, 3\)"),
    ({"phi": [["a", 1, 1]] * 4}, r"phi must hold numbers"),
    ({"y": np.ones(3)}, r"y has shape \(3,\), expected \(4,\)"),
    ({"y": np.ones((4, 1))}, r"y has shape \(4, 1\), expected \(4,\)"),
    ({"y": None}, r"y has shape \(\), expected \(4,\)|y must hold numbers"),
    ({"mask": [True, False]}, r"mask has shape \(2,\), expected \(4,\)"),
    ({"mask": [1, 0, 1, 1]}, r"mask must hold True or False"),
    ({"mask": "abcd"}, r"mask must hold True or False"),
    ({"outputs": ["theta"]}, r'outputs has "theta", allowed: error, leverage, skipped'),
]


@pytest.mark.parametrize("rule", [fg.Exponential(0.9), fg.RandomWalk()], ids=repr)
@pytest.mark.parametrize(("sample", "message"), BAD_SAMPLES, ids=lambda a: str(a)[:40])
def test_sample(sample, message, rule):
    fleet = fg.Fleet(4, 3, rule=rule)
    fleet.update(ONES, FOUR)
    before = fleet._states()
    with pytest.raises(fg.InvalidInput, match=message):
        fleet.update(**{"phi": ONES, "y": FOUR, **sample})
    with pytest.raises(fg.InvalidInput):
        fleet.predict(np.ones((4, 2)))
    with pytest.raises(fg.InvalidInput, match="mask"):
        fleet.reset(np.ones(3, bool))
    assert fleet._states() == before


def test_indices():
    fleet = fg.Fleet(4, 3)
    for index in (4, -5, 2**40):
        with pytest.raises(IndexError, match=f"stream {index} of a fleet of 4"):
            fleet[index]
        with pytest.raises(IndexError):
            fleet[index] = fg.RLS(3)
        with pytest.raises(IndexError):
            fleet.covariance(index)
    with pytest.raises(TypeError, match="a whole number"):
        fleet[0:2]


STRANGERS = [
    (fg.RLS(4), "as many parameters as its fleet"),
    (fg.RLS(3, targets=2), "one row and one target"),
    (fg.RLS(3, rows=2), "one row and one target"),
    (fg.RLS(3, rule="exponential"), "the rule of its fleet"),
    (fg.RLS(3, rule=fg.Subspace(0.99, threshold=0.5)), "the rule of its fleet"),
    (fg.RLS(3, rule=fg.Subspace(fg.Fortescue())), "the rate of its fleet"),
    (fg.RLS(3, rule="subspace", weighting="huber"), "the weighting of its fleet"),
    (fg.RLS(3, rule="subspace", gate=fg.MinimumInformation()), "the gate of its fleet"),
    (fg.RLS(3, monitor=True), "not monitored"),
    (fg.RLS(3, dtype="float32"), "the dtype of its fleet"),
]


@pytest.mark.parametrize(("stranger", "message"), STRANGERS, ids=lambda a: str(a)[:60])
def test_an_estimator_of_another_kind(stranger, message):
    fleet = fg.Fleet(4, 3, rule="subspace")
    before = fleet._states()
    with pytest.raises(fg.InvalidInput, match=message):
        fleet[1] = stranger
    assert fleet._states() == before


def test_what_cannot_be_added():
    fleet = fg.Fleet(4, 3)
    before = fleet._states()
    with pytest.raises(fg.InvalidInput, match="count = 0, allowed"):
        fleet.append(0)
    with pytest.raises(fg.InvalidInput, match="more = 'x', allowed"):
        fleet.append("x")
    with pytest.raises(fg.InvalidInput, match="the rule of its fleet"):
        fleet.append(fg.Fleet(2, 3, rule="none"))
    with pytest.raises(fg.InvalidInput, match="the dtype of its fleet"):
        fleet.append(fg.Fleet(2, 3, dtype="float32"))
    with pytest.raises(MemoryError):
        fleet.append(2**60)
    assert fleet._states() == before


def test_tables_that_hold_no_fleet():
    pa = pytest.importorskip("pyarrow")
    state, other = fg.RLS(3).to_bytes(), fg.RLS(3, rule="none").to_bytes()
    for table, message in [
        (3, "table is of type int, allowed: a pyarrow.Table"),
        (pa.table({"theta": [1.0]}), "no column state"),
        (pa.table({"state": [1.0]}), "as bytes"),
        (pa.Table.from_arrays([[state], [state]], ["state", "state"]), "once each"),
        (pa.Table.from_arrays([[0], [1], [state]], ["stream", "stream", "state"]), "once each"),
        (pa.table({"state": pa.array([], pa.binary())}), "one stream or more"),
        (pa.table({"state": [state, state[:-1]]}), "stream 1: state: "),
        (pa.table({"state": [state, other]}), "the rule of its fleet"),
        (pa.table({"state": [state, None]}), "as bytes"),
    ]:
        with pytest.raises(fg.InvalidInput, match=message):
            fg.Fleet.from_arrow(table)


def test_without_pyarrow_the_error_names_the_extra(monkeypatch):
    monkeypatch.setitem(__import__("sys").modules, "pyarrow", None)
    with pytest.raises(ImportError, match=r"forgetting\[cli\]"):
        fg.Fleet(2, 2).to_arrow()
