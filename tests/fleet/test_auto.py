"""A fleet of the rule "auto" is the default bank a stream, bit for bit."""

import copy
import pickle

import numpy as np
import pytest
from company import CODES, samples, take

import forgetting as fg

# streams on several cores in unequal parts
COUNT = 19
OUTPUTS = ["error", "leverage", "skipped"]


def pair(n=3, count=COUNT, **more):
    fleet = fg.Fleet(count, n, rule="auto", **more)
    more.pop("threads", None)
    return fleet, [fg.Bank(n, **more) for _ in range(count)]


def follow(fleet, banks, given):
    """Give both the same samples; returns the codes that came up."""
    seen = set()
    for phi, y, mask in zip(given.phi, given.y, given.mask, strict=True):
        update = fleet.update(phi, y, mask=mask, outputs=OUTPUTS)
        told = [take(*each) for each in zip(banks, phi, y, mask, strict=True)]
        error, leverage, code = (np.array(part) for part in zip(*told, strict=True))
        np.testing.assert_array_equal(update.skipped, code)
        np.testing.assert_array_equal(update.error, error)
        np.testing.assert_array_equal(update.leverage, leverage)
        assert update.used == (code == 0).sum()
        seen |= set(code.tolist())
    assert_same(fleet, banks)
    return seen


def assert_same(fleet, banks):
    assert len(fleet) == len(banks)
    for i, bank in enumerate(banks):
        assert fleet[i].to_bytes() == bank.to_bytes(), i
    np.testing.assert_array_equal(fleet.theta, [bank.theta for bank in banks])
    np.testing.assert_array_equal(fleet.samples, [bank.samples for bank in banks])
    variance = [np.diag(bank.covariance) for bank in banks]
    rounding = 1e-5 if fleet.dtype == "float32" else 1e-12  # the same sum in another order
    np.testing.assert_allclose(fleet.variance, variance, rtol=rounding)


@pytest.mark.parametrize("dtype", ["float64", "float32"])
@pytest.mark.parametrize("n", [1, 3, 10, 12])
def test_each_stream_is_a_bank(n, dtype):
    fleet, banks = pair(n, dtype=dtype)
    seen = follow(fleet, banks, samples(90, COUNT, n, dtype))
    assert {0, CODES["missing"], CODES["refused"]} <= seen


@pytest.mark.parametrize("threads", [2, 7, 64])
def test_on_any_number_of_cores(threads):
    fleet, banks = pair(threads=threads)
    follow(fleet, banks, samples(30, COUNT, 3))


@pytest.mark.parametrize(
    "more",
    [
        {"weighting": "huber"},
        {"gate": fg.DeadZone(0.5)},
        {"initial_covariance": 10.0, "initial_theta": [1.0, 2.0, 3.0]},
        {"initial_covariance": np.eye(3) + 0.5},
    ],
    ids=lambda more: " ".join(more),
)
def test_what_a_bank_takes(more):
    fleet, banks = pair(**more)
    follow(fleet, banks, samples(60, COUNT, 3))


@pytest.mark.parametrize("elapsed", [2.5, np.linspace(0.0, 3.0, COUNT)], ids=["all", "each"])
def test_time_between_samples(elapsed):
    fleet, banks = pair()
    given = samples(30, COUNT, 3)
    for phi, y, mask in zip(given.phi, given.y, given.mask, strict=True):
        error = fleet.update(phi, y, mask, "error", elapsed=elapsed).error
        each = zip(banks, phi, y, mask, np.broadcast_to(elapsed, COUNT), error, strict=True)
        for bank, f, target, there, time, told in each:
            if there and np.isfinite(told):
                assert bank.update(f, target, elapsed=time).error == told
    assert_same(fleet, banks)


def test_it_predicts_and_tells_each_covariance():
    fleet, banks = pair()
    follow(fleet, banks, samples(40, COUNT, 3))
    phi = np.random.default_rng(3).normal(size=(COUNT, 3))
    alone = [bank.predict(f) for bank, f in zip(banks, phi, strict=True)]
    np.testing.assert_array_equal(fleet.predict(phi), alone)
    np.testing.assert_array_equal(fleet.covariance(-2), banks[-2].covariance)


def test_health_bounds_the_eigenvalues_of_each_stream():
    fleet, _ = pair()
    random = np.random.default_rng(0)
    for _ in range(40):
        fleet.update(random.normal(size=(COUNT, 3)), random.normal(size=COUNT))
    health = fleet.health()
    for i in range(COUNT):
        values = np.linalg.eigvalsh(fleet.covariance(i))
        assert values[0] <= health.smallest_eigenvalue[i] * (1 + 1e-9)
        assert values[-1] >= health.largest_eigenvalue[i] * (1 - 1e-9)
        assert health.condition[i] <= values[-1] / values[0] * (1 + 1e-9)
    assert set(health.status) == {"ok"}
    assert health.samples.tolist() == [40] * COUNT


def test_streams_leave_return_join_and_start_again():
    fleet, banks = pair()
    follow(fleet, banks, samples(20, COUNT, 3))
    fleet[4].update([1.0, 2.0, 3.0], 4.0)  # a copy
    other = fg.Bank(3)
    other.update([1.0, -1.0, 2.0], 0.5)
    fleet[-1], banks[-1] = other, copy.copy(other)
    fleet.append(5)
    banks += [fg.Bank(3) for _ in range(5)]
    fleet.append(fleet)
    banks += [copy.copy(bank) for bank in banks]
    mask = np.arange(len(banks)) % 3 == 0
    fleet.reset(mask)
    for bank in np.array(banks, object)[mask]:
        bank.reset()
    assert_same(fleet, banks)
    follow(fleet, banks, samples(30, len(banks), 3, seed=1))
    fleet.reset()
    assert_same(fleet, [fg.Bank(3)] * len(banks))


def through_arrow(fleet):
    return fg.Fleet.from_arrow(fleet.to_arrow())


COPIES = [copy.copy, copy.deepcopy, lambda fleet: pickle.loads(pickle.dumps(fleet)), through_arrow]


@pytest.mark.parametrize("dtype", ["float64", "float32"])
@pytest.mark.parametrize("duplicate", COPIES)
def test_copies_have_the_same_bits_and_go_their_own_way(duplicate, dtype):
    fleet, banks = pair(dtype=dtype)
    follow(fleet, banks, samples(20, COUNT, 3, dtype))
    again = duplicate(fleet)
    fleet.update(np.ones((COUNT, 3)), np.zeros(COUNT))
    assert_same(again, banks)
    again.append(1)
    banks.append(fg.Bank(3, dtype=dtype))
    follow(again, banks, samples(20, COUNT + 1, 3, dtype, seed=1))


def test_what_it_says_of_itself():
    fleet, _ = pair(4)
    assert (fleet.rule, fleet.forgetting_factor) == ("auto", None)
    assert repr(fleet) == f"Fleet({COUNT}, 4, rule='auto')"
    assert isinstance(fleet[0], fg.Bank)
    assert fg.Fleet(0, 4, rule="auto").theta.shape == (0, 4)


REFUSED = [
    ({"forgetting_factor": 0.9}, r"forgetting_factor is given, but the rule auto uses none"),
    ({"initial_covariance": np.ones((4, 3))}, r"initial_covariance has shape \(4, 3\), expected"),
    ({"initial_theta": [1.0, 2.0, 3.0]}, r"initial_theta goes with initial_covariance"),
    ({"gate": print}, r"takes no function of yours"),
    ({"count": -1}, r"count = -1, allowed: whole numbers from 0"),
    ({"parameters": 0}, r"parameters = 0, allowed: whole numbers"),
    ({"weighting": "nonsense"}, r'weighting = "nonsense" is not known'),
]


@pytest.mark.parametrize(("arguments", "message"), REFUSED, ids=lambda a: str(a)[:40])
def test_what_it_refuses(arguments, message):
    with pytest.raises(fg.InvalidInput, match=message):
        fg.Fleet(**{"count": 4, "parameters": 3, "rule": "auto", **arguments})
    with pytest.raises(MemoryError):
        fg.Fleet(2**50, 3, rule="auto")


STRANGERS = [
    (fg.RLS(3), "a stream of this fleet is a bank, not one estimator"),
    (fg.Bank(4), "as many parameters as its fleet"),
    (fg.Bank(3, rows=2), "one row and one target"),
    (fg.Bank(3, targets=2), "one row and one target"),
    (fg.Bank(3, ["none", "subspace"]), "a bank of the same members, mixer and prior"),
    (fg.Bank(3, mixer="best"), "a bank of the same members, mixer and prior"),
    (fg.Bank(3, weighting="huber"), "a bank of the same members, mixer and prior"),
    (fg.Bank(3, initial_covariance=1e5), "a bank of the same members, mixer and prior"),
    (fg.Bank(3, dtype="float32"), "the dtype of its fleet"),
]


@pytest.mark.parametrize(("stranger", "message"), STRANGERS, ids=lambda a: str(a)[:60])
def test_a_stream_of_another_kind(stranger, message):
    fleet, _ = pair()
    fleet.update(np.ones((COUNT, 3)), np.ones(COUNT))
    before = fleet._states()
    with pytest.raises(fg.InvalidInput, match=message):
        fleet[1] = stranger
    with pytest.raises(TypeError, match="a stream is an RLS or a Bank, not int"):
        fleet[1] = 3
    with pytest.raises(fg.InvalidInput, match="is a bank, not one estimator"):
        fleet.append(fg.Fleet(1, 3))
    with pytest.raises(fg.InvalidInput, match="is one estimator, not a bank"):
        fg.Fleet(1, 3)[0] = fleet[0]
    assert fleet._states() == before


@pytest.mark.parametrize(
    "bad", [{"phi": np.ones((COUNT, 2))}, {"y": np.ones(3)}, {"mask": [True]}, {"elapsed": -1.0}]
)
def test_a_wrong_argument_changes_nothing(bad):
    fleet, _ = pair()
    before = fleet._states()
    with pytest.raises(fg.InvalidInput, match=next(iter(bad))):
        fleet.update(**{"phi": np.ones((COUNT, 3)), "y": np.ones(COUNT), **bad})
    assert fleet._states() == before
