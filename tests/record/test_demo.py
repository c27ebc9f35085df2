"""The demos: data found without importing their packages, and the numbers they print."""

from __future__ import annotations

import sys
from importlib.metadata import PackageNotFoundError, distribution

import numpy as np
import pandas as pd
import pytest

from forgetting.demo.packaged import locate
from forgetting.demo.ride import WINDOW, energy_balance
from forgetting.demo.tcx import read_tcx
from forgetting.record import RecordError


def missing(package):
    try:
        distribution(package)
    except PackageNotFoundError:
        return True
    return False


def needs(package):
    """Skip without the package that ships the record; it is an extra, not a dependency."""
    return pytest.mark.skipif(missing(package), reason=f"{package} is not installed")


def test_a_package_that_is_not_there():
    with pytest.raises(RecordError, match=r"pip install --no-deps no-such-package==1\.0"):
        locate("no-such-package", "1.0", "a/b.csv")


def test_a_file_that_is_not_there():
    with pytest.raises(RecordError, match=r"has no data/nothing\.csv"):
        locate("numpy", "0", "data/nothing.csv")


def test_the_energy_balance_of_a_known_ride():
    """A ride made from the physics, with 90 kg, Crr 0.012 and k = 0.18, gives them back."""
    seconds = np.arange(3000)
    speed = 8 + 3 * np.sin(seconds / 140) + np.sin(seconds / 61)
    altitude = 200 + 40 * np.sin(seconds / 600)
    energy = speed**2 / 2 + 9.81 * altitude
    power = 90 * np.gradient(energy) + 0.012 * 90 * 9.81 * speed + 0.18 * speed**3
    time = pd.date_range("2024-01-01", periods=3000, freq="s", tz="UTC")
    track = {"time": time, "altitude": altitude, "speed": speed, "power": power}
    balance = energy_balance(pd.DataFrame(track))
    assert balance["power"].notna().all() and len(balance) == 3000 // WINDOW - 1
    x = balance[["energy_rate", "weight_speed", "speed_cubed"]].to_numpy()
    theta = np.linalg.lstsq(x, balance["power"].to_numpy(), rcond=None)[0]
    # Smoothing the altitude costs a little of the mass.
    np.testing.assert_allclose(theta, [90, 1.08, 0.18], rtol=0.03)


@pytest.mark.parametrize("spoil", ["coast", "brake", "stop", "jump", "lost"])
def test_windows_without_the_model_are_left_out(spoil):
    track = pd.DataFrame(
        {
            "time": pd.date_range("2024-01-01", periods=300, freq="s", tz="UTC"),
            "altitude": 100.0,
            "speed": 8.0,
            "power": 200.0,
        }
    )
    if spoil == "coast":
        track.loc[95:110, "power"] = 0.0
    elif spoil == "brake":
        track.loc[100:104, "speed"] = [7.0, 6.0, 5.0, 6.0, 7.0]
    elif spoil == "stop":
        track.loc[100:105, "speed"] = 1.0
    elif spoil == "jump":
        track.loc[105, "altitude"] = 110.0
    else:
        track = track.drop(index=105)
    left_out = np.flatnonzero(energy_balance(track)["power"].isna())
    # A jump of the altimeter spoils what is within 15 s of it, so the windows beside it too.
    assert left_out.tolist() == ([2, 3, 4] if spoil == "jump" else [3])


def test_tcx(tmp_path):
    path = tmp_path / "ride.tcx"
    path.write_text(
        '<T xmlns="a" xmlns:x="b"><Trackpoint><Time>2024-01-01T00:00:00.000Z</Time>'
        "<AltitudeMeters>5.5</AltitudeMeters><Extensions><x:TPX><x:Speed>3</x:Speed>"
        "<x:Watts>150</x:Watts></x:TPX></Extensions></Trackpoint>"
        "<Trackpoint><Time>2024-01-01T00:00:01.000Z</Time></Trackpoint></T>"
    )
    track = read_tcx(path)
    assert track.loc[0, ["altitude", "speed", "power"]].tolist() == [5.5, 3.0, 150.0]
    assert track.loc[1, ["altitude", "speed", "power"]].isna().all()


@pytest.mark.parametrize(("text", "words"), [("<T>", "is not XML"), ("<T/>", "no track points")])
def test_tcx_that_is_none(tmp_path, text, words):
    path = tmp_path / "ride.tcx"
    path.write_text(text)
    with pytest.raises(RecordError, match=words):
        read_tcx(path)


@needs("pvanalytics")
def test_solar(tmp_path):
    from forgetting.demo import solar
    from forgetting.demo.solar import identified

    outcome = solar(tmp_path)
    assert [path.name for path in outcome.files] == [
        "solar.html",
        "solar-bank.html",
        "solar-none.html",
        "solar-exponential.html",
        "solar-subspace.html",
        "windup.png",
    ]
    assert all(path.stat().st_size > 10_000 for path in outcome.files)
    found = identified()
    rmse = {name: each.scores.model[0] for name, each in found.items()}
    assert rmse["bank"] < min(error for name, error in rmse.items() if name != "bank")
    # Independent NumPy recursion: 602.0, 210.6 and 233.5 W.
    assert rmse["none"] == pytest.approx(602.0, abs=0.1)
    assert rmse["exponential"] == pytest.approx(210.6, abs=0.1)
    assert rmse["subspace"] == pytest.approx(233.5, abs=0.1)
    errors = {name: each.standard_error[96:, 0, 0].max() for name, each in found.items()}
    assert errors["exponential"] > 1e4 * errors["subspace"]
    assert "pvanalytics" not in sys.modules


@needs("sweat")
def test_cycling(tmp_path):
    from forgetting.demo import cycling
    from forgetting.demo.cycling import identified

    outcome = cycling(tmp_path)
    assert all(path.stat().st_size > 10_000 for path in outcome.files)
    results, _ = identified()
    for result in results.values():
        # Windowed batch fits of this ride by others: 86-92 kg, 0.011-0.015, 0.28-0.34 m².
        rider = result.rider
        assert 86 < rider.mass.value < 92 and 2 < rider.mass.error < 5
        assert 0.011 < rider.rolling.value < 0.015
        assert 0.26 < rider.drag_area.value < 0.34
    assert "sweat" not in sys.modules
