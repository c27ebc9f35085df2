"""The dense simulator and the measured records, for every test of the analysis."""

import sys
from pathlib import Path

import numpy as np
import pytest

sys.path.insert(0, str(Path(__file__).parent))

DATA = Path(__file__).resolve().parents[3] / "shared" / "data"


def _columns(name):
    path = DATA / name
    if not path.exists():
        pytest.skip(f"measured record {name} is not beside this repository")
    return np.genfromtxt(path, delimiter=",", names=True)


def _lagged(outputs, inputs, na, nb, first_input):
    """Regressors [-y(k-1) ..., u(k-first) ...] for k >= the longest lag."""
    longest = max(na, first_input + nb - 1)
    k = np.arange(longest, len(outputs))
    past = [-outputs[k - i] for i in range(1, na + 1)]
    drive = [inputs[k - first_input - i] for i in range(nb)]
    return np.stack(past + drive, axis=1)


@pytest.fixture(params=["battery", "exchanger", "robot_arm"])
def measured(request):
    """Regressors (T, n) of a measured record."""
    if request.param == "battery":
        rows = _columns("battery_nmc_drive_cycle.csv")
        return _lagged(rows["voltage_V"], rows["current_A"], 1, 2, 0)[:1200]
    if request.param == "exchanger":
        rows = _columns("exchanger.csv")
        return _lagged(rows["temperature"], rows["flow"], 2, 2, 1)[:1200]
    rows = _columns("robot_arm.csv")
    return _lagged(rows["acceleration"], rows["torque"], 3, 3, 1)


@pytest.fixture
def battery():
    """Voltage and current of a cell under a drive cycle, the first part."""
    rows = _columns("battery_nmc_drive_cycle.csv")
    return rows["voltage_V"][:3000], rows["current_A"][:3000]
