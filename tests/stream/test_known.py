"""A stream knows of parameters what `identify` knows, bit for bit."""

from __future__ import annotations

import numpy as np
import pytest

import forgetting as fg
from forgetting.record import RecordError, identify
from forgetting.stream import Settings

from .conftest import arx, as_csv, fed, plant, rows

FIELDS = "prediction,error,theta,standard_errors"
KNOWN = {
    "fixed": dict(fixed={"u(k-1)": 0.5}),
    "constant": dict(fixed={"offset": 2.0}),
    "bounds": dict(bounds={"y(k-1)": (0.0, 0.79), "offset": (2.0, None)}),
    "prior": dict(prior={"u(k-1)": (0.4, 0.02)}, noise=0.05),
    "prior of the constant": dict(prior={"offset": (0.0, 5.0)}, noise=0.05),
    "all": dict(
        fixed={"offset": 2.0},
        prior={"u(k-1)": (0.4, 0.02)},
        bounds={"u(k-1)": (None, 0.45)},
        noise=0.05,
    ),
}


@pytest.mark.parametrize("rule", ["auto", fg.Exponential(0.98)])
@pytest.mark.parametrize("known", KNOWN)
def test_same_as_identify(tmp_path, known, rule):
    data = as_csv(plant(300))
    (tmp_path / "record.csv").write_bytes(data)
    settings = arx(rule=rule, **KNOWN[known])
    told = rows(fed(data, settings, FIELDS).lines)
    given = dict(output=["y"], input=["u"], arx=(1, 1, 1), rule=rule)
    found = identify(tmp_path / "record.csv", **given, **KNOWN[known])
    expected = {name: found.theta[:, i, 0] for i, name in enumerate(found.samples.regressors)}
    expected |= {name: np.full(300, value) for name, value in found.known.fixed.items()}
    assert list(told[-1]["theta"]) == ["y(k-1)", "u(k-1)", "offset"]
    for name, course in expected.items():
        assert [each["theta"][name] for each in told[1:]] == course[1:].tolist(), name
    for name in found.known.fixed:
        assert {each["standard_errors"][name] for each in told[50:]} == {0.0}
    assert [each["error"] for each in told[1:]] == found.trace.error[1:, 0].tolist()
    assert [each["prediction"] for each in told[1:]] == found.prediction[1:, 0].tolist()


@pytest.mark.parametrize("known", KNOWN)
def test_a_saved_state_goes_on(known):
    lines = as_csv(plant(200)).splitlines(keepends=True)
    whole = fed(b"".join(lines), arx(**KNOWN[known]), FIELDS).lines
    first = fed(b"".join(lines[:90]), arx(**KNOWN[known]), FIELDS)
    second = fed(lines[0], arx(**KNOWN[known]), FIELDS)
    second.restore(first.state())
    assert first.lines + second.feed(b"".join(lines[90:])).lines == whole


@pytest.mark.parametrize(
    ("known", "words"),
    [
        (dict(prior={"u(k-1)": (0.4, 0.02)}), "give its standard deviation as noise"),
        (dict(bounds={"u": (0, 1)}), "no parameter 'u'"),
        (dict(fixed={"u(k-1)": 1.0, "y(k-1)": 1.0, "offset": 1.0}), "nothing to estimate"),
    ],
)
def test_what_is_refused_is_named(known, words):
    with pytest.raises(RecordError, match=words):
        fed(as_csv(plant(10)), arx(**known))


def test_two_outputs_are_refused():
    settings = Settings(output=("y", "u"), arx=(1, 0, 0), bounds={"y(k-1)": (0, 1)})
    with pytest.raises(RecordError, match="a model with one output; this one has 2"):
        fed(as_csv(plant(10)), settings)
