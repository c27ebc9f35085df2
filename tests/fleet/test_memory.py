"""What there is no memory for is a MemoryError, not the end of the process."""

from __future__ import annotations

import subprocess
import sys

import pytest

MORE = 8
"""Megabytes that may be taken beyond those of the fleet; every array below takes 24."""

LIMITED = f"""
import numpy as np, forgetting as fg, resource
count = 3_000_000
fleet = fg.Fleet(count, 1, rule="exponential", initial_covariance=1.0)
phi, y = np.ones((count, 1), dtype="f4"), np.ones(count, dtype="f4")
pages = int(open("/proc/self/statm").read().split()[0])
resource.setrlimit(resource.RLIMIT_AS, (pages * resource.getpagesize() + ({MORE} << 20),) * 2)
try:
    TRIED
except MemoryError:
    print("refused")
"""


@pytest.mark.skipif(sys.platform != "linux", reason="limits by the files of Linux")
@pytest.mark.parametrize(
    "tried",
    ["fleet.theta", "fleet.forgetting_factor", "fleet.samples", "fleet.update(phi, y)"],
)
def test_there_is_no_memory_for(tried):
    code = LIMITED.replace("TRIED", tried)
    run = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=False)
    assert (run.returncode, run.stdout) == (0, "refused\n"), run.stderr
