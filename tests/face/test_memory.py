"""What there is no memory for is a MemoryError, and changes nothing; a crafted state costs no more
than its length."""

from __future__ import annotations

import resource
import struct
import subprocess
import sys
import time
import zlib

import numpy as np
import pytest

import forgetting as fg


def limited(program: str, gigabytes: int) -> str:
    """What the program prints under a limit of its address space."""
    limit = f"import resource; resource.setrlimit(resource.RLIMIT_AS, ({gigabytes} << 30,) * 2)\n"
    found = subprocess.run(
        [sys.executable, "-c", "import numpy as np, forgetting as fg\n" + limit + program],
        capture_output=True,
        text=True,
        check=False,
        env={"OPENBLAS_NUM_THREADS": "1", "PATH": ""},
    )
    assert found.returncode == 0, (found.returncode, found.stderr)
    return found.stdout


REFUSED = [
    "fg.RLS(32768)",
    "fg.RLS(20000, rule='variable_direction')",
    "fg.RLS(9000, rule=fg.CovarianceResetting('matrix_forgetting'))",
    "fg.RLS(1, rows=32768)",
    "fg.Fleet(10**6, 40, rule='random_walk')",
    "fg.ExcitationMeter(1000, 10**6)",
    "fg.ExcitationMeter(2**20, 2**20, rows=2**20)",
    "est.run(phi, y, outputs=('covariance',))",
    "est.run(phi, y, outputs=('prior_covariance',))",
    "fg.Bank(400).run(phi, y, outputs=('covariance',))",
]


@pytest.mark.skipif(sys.platform != "linux", reason="limits of the address space are Linux's")
@pytest.mark.parametrize("call", REFUSED)
def test_what_does_not_fit_is_a_memory_error(call: str) -> None:
    program = f"""
est = fg.RLS(400)
phi, y = np.zeros((20000, 400), np.float32), np.zeros(20000)
before = est.to_bytes()
try:
    {call}
except MemoryError as error:
    print("refused", error)
assert est.to_bytes() == before
"""
    assert limited(program, 3).startswith("refused")


def crafted(n: int, rows: int = 1, targets: int = 1, rule: bytes = b"exponential") -> bytes:
    """A state of these sizes without its numbers, with a right check."""
    word = lambda text: struct.pack("<H", len(text)) + text  # noqa: E731
    body = b"FGRLS" + bytes([2, 8]) + struct.pack("<III", n, rows, targets) + bytes([0, 0])
    body += word(rule) + b"\\0" + word(b"constant") + b"\\1" + word(b"forgetting_factor")
    body += b"\\0" + struct.pack("<d", 0.99) + word(b"equal") + b"\\0" + word(b"open") + b"\\0"
    body += struct.pack("<dd", 0.0, 1.0)
    return body + struct.pack("<I", zlib.crc32(body))


@pytest.mark.parametrize("rule", [b"exponential", b"covariance_resetting", b"matrix_forgetting"])
@pytest.mark.parametrize(
    "sizes", [(8192,), (32768,), (2048,), (2, 32768), (2, 1, 32768), (32768, 32768, 32768)]
)
def test_a_crafted_state_costs_nothing(rule: bytes, sizes: tuple[int, ...]) -> None:
    state = crafted(*sizes, rule=rule)
    before, start = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss, time.process_time()
    with pytest.raises(fg.InvalidInput, match=r"truncated|too many rows"):
        fg.RLS.from_bytes(state)
    with pytest.raises(fg.InvalidInput, match=r"truncated|too many rows"):
        fg.Fleet._of_states(state, [state] * 100)
    assert resource.getrusage(resource.RUSAGE_SELF).ru_maxrss - before < 50_000  # kB
    assert time.process_time() - start < 1.0


def test_short_states_of_a_large_fleet_cost_nothing() -> None:
    fresh = fg.RLS(500).to_bytes()
    before = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss
    with pytest.raises(fg.InvalidInput, match="stream 0: state: it is truncated"):
        fg.Fleet._of_states(fresh, [b"FGRLS"] * 10_000)
    assert resource.getrusage(resource.RUSAGE_SELF).ru_maxrss - before < 100_000  # kB


def test_a_fleet_whose_new_streams_would_be_no_streams_is_refused() -> None:
    good = fg.RLS(2).to_bytes()
    for fresh in (fg.RLS(2, targets=2), fg.RLS(2, rows=2)):
        with pytest.raises(fg.InvalidInput, match="one row and one target"):
            fg.Fleet._of_states(fresh.to_bytes(), [good])
    with pytest.raises(fg.InvalidInput, match="not monitored"):
        fg.Fleet._of_states(fg.RLS(2, monitor=True).to_bytes(), [good])


def test_rows_beyond_what_a_state_can_tell_of_are_said_when_it_is_saved() -> None:
    est = fg.RLS(1, rows=3000)
    with pytest.raises(fg.InvalidInput, match="too many rows to be saved"):
        est.to_bytes()
    wide = fg.RLS(1, rows=1500, targets=2)
    wide.update(np.ones((1500, 1)), np.ones((1500, 2)))
    again = fg.RLS.from_bytes(wide.to_bytes())
    assert (again.theta == wide.theta).all()
