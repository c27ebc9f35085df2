"""Streams are taken out, put back, added, started again and saved."""

import copy
import pickle

import numpy as np
import pytest
from company import assert_follows, assert_same, samples

import forgetting as fg

# one that is kept as blocks of lanes, one that is kept as estimators
RULES = [fg.Exponential(0.95), fg.ExponentialResetting(0.95), fg.Exponential(fg.Fortescue())]
by_rule = pytest.mark.parametrize("rule", RULES, ids=repr)


def started(rule, count=21, **more):
    """A fleet that has seen samples, and the same as single estimators."""
    fleet = fg.Fleet(count, 3, rule=rule, **more)
    given = samples(15, count, 3, fleet.dtype)
    for phi, y, mask in zip(given.phi, given.y, given.mask, strict=True):
        fleet.update(phi, y, mask)
    return fleet, [fleet[i] for i in range(count)]


@by_rule
def test_a_stream_taken_out_goes_on_from_there(rule):
    fleet, singles = started(rule)
    single = fleet[4]
    assert isinstance(single, fg.RLS)
    single.update([1.0, 2.0, 3.0], 4.0)
    assert_same(fleet, singles)  # it was a copy
    assert fleet[-1].to_bytes() == singles[-1].to_bytes()
    assert [stream.samples for stream in fleet] == fleet.samples.tolist()


@by_rule
def test_a_stream_put_back_goes_on_in_the_fleet(rule):
    fleet, singles = started(rule)
    for i in (3, 20):
        other = fg.RLS(
            3, rule=rule, initial_covariance=np.eye(3) * (i + 1), initial_theta=[1, 2, 3]
        )
        other.update([1.0, -1.0, float(i)], 0.5)
        fleet[i], singles[i] = other, copy.copy(other)
    assert_same(fleet, singles)
    assert_follows(fleet, singles, samples(15, 21, 3, seed=1))
    fleet.reset()
    for single in singles:
        single.reset()
    assert_same(fleet, singles)


@by_rule
def test_streams_that_join_later(rule):
    fleet, singles = started(rule, initial_covariance=5.0)
    fleet.append(14)
    singles += [fg.RLS(3, rule=rule, initial_covariance=5.0) for _ in range(14)]
    assert_same(fleet, singles)
    assert_follows(fleet, singles, samples(15, 35, 3, seed=2))
    other, more = started(rule, 6)
    fleet.append(other)
    fleet.append(fleet)
    singles = [copy.copy(single) for single in (singles + more) * 2]
    assert_same(fleet, singles)
    assert_follows(fleet, singles, samples(15, 82, 3, seed=3))


def test_new_streams_start_from_what_was_given_for_all():
    given = {"initial_covariance": np.full((4, 3), 2.0), "forgetting_factor": [0.9, 0.8, 0.7, 0.6]}
    fleet = fg.Fleet(4, 3, rule=fg.Exponential(0.95), initial_theta=[1.0, 2.0, 3.0], **given)
    fleet.append(1)
    last = fg.RLS(3, rule=fg.Exponential(0.95), initial_theta=[1.0, 2.0, 3.0])
    assert fleet[-1].to_bytes() == last.to_bytes()
    assert fleet.forgetting_factor.tolist() == [0.9, 0.8, 0.7, 0.6, 0.95]


@by_rule
def test_some_streams_start_again(rule):
    fleet, singles = started(rule)
    mask = np.arange(21) % 3 == 0
    fleet.reset(mask)
    for single in np.array(singles, object)[mask]:
        single.reset()
    assert_same(fleet, singles)
    assert_follows(fleet, singles, samples(15, 21, 3, seed=4))


def through_arrow(fleet):
    return fg.Fleet.from_arrow(fleet.to_arrow())


COPIES = [copy.copy, copy.deepcopy, lambda fleet: pickle.loads(pickle.dumps(fleet)), through_arrow]


@pytest.mark.parametrize("dtype", ["float64", "float32"])
@pytest.mark.parametrize("duplicate", COPIES)
@by_rule
def test_copies_have_the_same_bits_and_go_their_own_way(rule, duplicate, dtype):
    fleet, singles = started(rule, dtype=dtype)
    again = duplicate(fleet)
    again.append(2)
    fleet.update(np.ones((21, 3)), np.zeros(21))
    singles += [fg.RLS(3, rule=rule, dtype=dtype) for _ in range(2)]
    assert_same(again, singles)
    assert again.dtype == dtype


def test_a_table_through_a_file(tmp_path):
    parquet = pytest.importorskip("pyarrow.parquet")
    fleet, singles = started(fg.Subspace(0.9), forgetting_factor=np.linspace(0.5, 1.0, 21))
    table = fleet.to_arrow()
    assert table.column_names == ["stream", "state"]
    assert table.column("stream").to_pylist() == list(range(21))
    assert table.column("state")[7].as_py() == singles[7].to_bytes()
    parquet.write_table(table, tmp_path / "fleet.parquet")
    again = fg.Fleet.from_arrow(parquet.read_table(tmp_path / "fleet.parquet"))
    again.append(1)
    assert_same(again, [*singles, fg.RLS(3, rule=fg.Subspace(0.9))])
    # rows are streams: a part of a table is a smaller fleet
    assert_same(fg.Fleet.from_arrow(table.slice(5, 3)), singles[5:8])


def test_a_table_of_states_of_single_estimators():
    pa = pytest.importorskip("pyarrow")
    singles = [fg.RLS(2, initial_theta=[i, 0.0]) for i in range(3)]
    table = pa.table({"state": [single.to_bytes() for single in singles]})
    assert_same(fg.Fleet.from_arrow(table), singles)


def test_the_rows_of_a_table_may_come_in_any_order():
    pytest.importorskip("pyarrow")
    fleet = fg.Fleet(5, 2)
    fleet.update(np.arange(10.0).reshape(5, 2), np.arange(5.0))
    table = fleet.to_arrow()
    mixed = fg.Fleet.from_arrow(table.take([3, 1, 4, 0, 2]))
    assert mixed._states() == fleet._states()
    without = fg.Fleet.from_arrow(table.take([3, 1, 4, 0, 2]).drop_columns("stream"))
    assert (without.theta == fleet.theta[[3, 1, 4, 0, 2]]).all()
    with pytest.raises(fg.InvalidInput, match="column stream must hold whole numbers, each"):
        fg.Fleet.from_arrow(table.take([0, 1, 2, 3, 3]))
