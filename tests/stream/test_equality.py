"""A stream says of a file what `identify` says of it, bit for bit, however lines are grouped."""

from __future__ import annotations

import json

import numpy as np
import pytest

import forgetting as fg
from forgetting.record import identify
from forgetting.stream import Settings, Stream
from forgetting.words.errors import RecordError

from .conftest import arx, as_csv, fed, objects, plant, rows

FIELDS = "row,time,measured,prediction,error,theta,standard_errors,leverage,skipped"
ROUNDING = 1e-9
"""Of P: its diagonal of a bank is summed in another order than the whole matrix."""

MODELS = {
    "arx": dict(output=("y",), input=("u",), arx=(1, 1, 1)),
    "second order": dict(output=("y",), input=("u",), arx=(2, 2, 0)),
    "regression": dict(output=("y",), input=("u",), arx=(0, 1, 0)),
    "no offset": dict(output=("y",), input=("u",), arx=(1, 1, 1), offset=False),
    "two outputs": dict(output=("y", "u"), arx=(1, 0, 0)),
    "formula": dict(formula="y ~ lag(y) + lag(u, 1) + np.abs(u)"),
    "structure": dict(output=("y",), input=("u",), model="armax:na=1,nb=1,nc=1,nk=1"),
    "output error": dict(output=("y",), input=("u",), model="oe:nb=1,nf=1,nk=1", offset=False),
    "signal alone": dict(output=("y",), model="arma:na=2,nc=1"),
    "no constant": dict(formula="y ~ 0 + lag(y) + u:lag(u, 2)"),
}
RULES = {
    "bank": dict(),
    "subspace": dict(rule=fg.Subspace(0.99)),
    "given prior": dict(rule=fg.Exponential(0.98), initial_covariance=100.0),
    "half-life": dict(rule="exponential", half_life="2s"),
    "rate": dict(rule=fg.Exponential(fg.FTest())),
    "float32": dict(rule=fg.Subspace(0.99), dtype="float32"),
    "gate": dict(gate=fg.gate("dead_zone", width=2)),
}


@pytest.mark.parametrize("rule", RULES)
@pytest.mark.parametrize("model", MODELS)
def test_same_as_identify(tmp_path, model, rule):
    data = with_holes()
    (tmp_path / "record.csv").write_bytes(data)
    settings = MODELS[model] | RULES[rule]
    if rule == "half-life" and model in ("structure", "output error", "signal alone"):
        with pytest.raises(RecordError, match="forgets by samples"):
            Settings(**settings)
        return
    found = identify(tmp_path / "record.csv", gap=0.15, **settings)
    told = rows(fed(data, Settings(gap=0.15, **settings), FIELDS).lines)
    table = found.estimates()
    assert [each["row"] for each in told] == table["row"].tolist()
    assert [each["skipped"] for each in told] == table["skipped"].tolist()
    assert [each["time"] for each in told] == table["time"].tolist()
    # Before the first complete sample there is no origin yet, where identify has one already.
    first = table["skipped"].tolist().index("used")
    equal(told, "error", found.trace.error)
    equal(told, "prediction", found.prediction)
    equal(told, "leverage", found.trace.leverage)
    equal(told[first:], "theta", found.theta[first:])
    close(told, found)


def with_holes() -> bytes:
    """The plant with a gap of time, a missing value, and a step back."""
    table = plant(700)
    table[300:, 0] += 7.0
    table[500:, 0] -= 20.0
    lines = as_csv(table).split(b"\n")
    lines[101] = lines[101].rsplit(b",", 1)[0] + b",NaN"
    return b"\n".join(lines)


def flat(value) -> list[float]:
    """Numbers of a value of JSON, NaN for null."""
    if isinstance(value, dict):
        return [number for each in value.values() for number in flat(each)]
    return [np.nan if value is None else value]


def numbers(told, name) -> np.ndarray:
    return np.array([flat(each[name]) for each in told])


def equal(told, name, expected):
    """Every bit; parameters (T, n, m) are told output by output."""
    if expected.ndim == 3:
        expected = expected.transpose(0, 2, 1)
    np.testing.assert_array_equal(numbers(told, name), expected.reshape(len(told), -1))


def close(told, found):
    """Standard errors; that of a constant at the last row, where `identify` has it exactly."""
    errors = numbers(told, "standard_errors").reshape(len(told), -1, found.theta.shape[1])
    expected = found.claimed_standard_error.transpose(0, 2, 1)
    names = found.samples.regressors
    constant = [name in ("offset", "Intercept") for name in names]
    others = ~np.array(constant)
    # A record without a constant is measured from zero by both.
    np.testing.assert_allclose(errors[:, :, others], expected[:, :, others], rtol=ROUNDING)
    np.testing.assert_allclose(errors[-1], expected[-1], rtol=ROUNDING)


@pytest.mark.parametrize("to", ["json", "csv"])
@pytest.mark.parametrize("model", MODELS)
def test_grouping_of_lines_changes_nothing(model, to):
    data = with_holes()
    whole = fed(data, Settings(**MODELS[model]), FIELDS, to).lines
    rng = np.random.default_rng(3)
    stream = Stream(Settings(**MODELS[model]), to, FIELDS)
    lines, parts = [], data.splitlines(keepends=True)
    while parts:
        many = int(rng.integers(1, 60))
        lines += stream.feed(b"".join(parts[:many])).lines
        parts = parts[many:]
    assert lines == whole


def test_line_by_line_is_update():
    """Each line of a regression is one `update` of the estimator."""
    table = plant(60)
    stream = Stream(Settings(output=("y",), input=("u",), offset=False), fields="error,theta")
    stream.feed(b"t_s,u,y\n")
    bank = fg.Bank(1)
    for line, (_, u, y) in zip(as_csv(table).splitlines(keepends=True)[1:], table, strict=True):
        (told,) = objects(stream.feed(line).lines)
        update = bank.update([u], y)
        assert told["error"] == update.error
        assert told["theta"] == {"u(k)": bank.theta[0]}


def test_csv_has_the_columns_of_estimates(tmp_path):
    """`--to csv` writes what `identify --estimates` writes, as far as both have it."""
    data = as_csv(plant(200))
    (tmp_path / "record.csv").write_bytes(data)
    table = identify(tmp_path / "record.csv", output="y", input="u", arx=(1, 1, 1)).estimates()
    fields = "row,time,measured,prediction,error,forgetting_factor,leverage,skipped,theta"
    header, *lines = fed(data, arx(), fields, "csv").lines
    names = header.decode().strip().split(",")
    assert [name for name in table.columns if not name.startswith("standard")] == [
        *names[: names.index("skipped") + 1],
        *names[names.index("skipped") + 1 :],
    ]
    last = lines[-1].decode().strip().split(",")
    assert [float(cell) for cell in last[-3:]] == [
        table[name].iloc[-1] for name in table.columns if name.startswith("estimate")
    ]


def test_several_outputs_are_objects_by_name():
    told = rows(fed(as_csv(plant(20)), Settings(**MODELS["two outputs"]), "error,theta").lines)[-1]
    assert list(told["error"]) == ["y", "u"]
    names = ["y(k-1)", "u(k-1)", "offset"]
    assert {output: list(own) for output, own in told["theta"].items()} == {"y": names, "u": names}


def test_a_bank_tells_its_memory_and_weights():
    told = rows(fed(as_csv(plant(400)), arx(), "memory,weights").lines)[-1]
    assert len(told["weights"]) == len(fg.Bank(3).members)
    assert sum(told["weights"]) == pytest.approx(1.0)
    assert told["memory"] > 10


def test_numbers_keep_every_digit():
    table = plant(50)
    told = objects(fed(as_csv(table), arx(), "time,measured").lines)
    assert [each["measured"] for each in told] == table[:, 2].tolist()
    assert json.dumps(told[3]["time"]) == "0.3"
