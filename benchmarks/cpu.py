"""The processor: its name, instructions, caches and cores."""

from __future__ import annotations

import os
import platform
import subprocess
from functools import cache
from pathlib import Path

# holds the instructions of `forgetting` down, as of the crate forgetting-cpu
VARIABLE = "FORGETTING_CPU"
# the best first, as that crate asks for them
LEVELS = {"avx512": {"avx512f", "avx512dq", "avx512vl"}, "avx2": {"avx2", "fma"}}
CACHES = Path("/sys/devices/system/cpu/cpu0/cache")


@cache
def processor() -> dict[str, str]:
    """Name and instructions, as Linux or macOS tell them."""
    try:
        lines = Path("/proc/cpuinfo").read_text().splitlines()
    except OSError:
        lines = []
    told: dict[str, str] = {}
    for line in lines:
        name, _, value = line.partition(":")
        told.setdefault(name.strip(), value.strip())
    return told


def model() -> str:
    """The name of the processor."""
    if platform.system() == "Darwin":
        command = ["sysctl", "-n", "machdep.cpu.brand_string"]
        return subprocess.run(command, capture_output=True, text=True, check=False).stdout.strip()
    told = processor()
    numbers = [f"{name} {told[name]}" for name in ("cpu family", "model") if name in told]
    return " ".join([told.get("model name", platform.processor() or "unknown"), *numbers])


def levels() -> list[str]:
    """The sets of instructions that `forgetting` has for this machine, the best first."""
    if platform.machine() in ("arm64", "aarch64"):
        return ["neon"]
    flags = set(processor().get("flags", "").split())
    return [*(name for name, needed in LEVELS.items() if needed <= flags), "baseline"]


def level() -> str:
    """The instructions that `forgetting` uses."""
    order, wanted = [*LEVELS, "baseline"], os.environ.get(VARIABLE, "")
    best = levels()[0]
    return max(best, wanted, key=order.index) if wanted in order and best in order else best


@cache
def caches() -> dict[str, int]:
    """Bytes of each data cache of the first core: L1, L2, L3; empty where Linux does not tell."""
    found = {}
    for index in sorted(CACHES.glob("index*")):
        told = {name: (index / name).read_text().strip() for name in ("type", "level", "size")}
        if told["type"] != "Instruction":
            found[f"L{told['level']}"] = int(told["size"].rstrip("K")) * 1024
    return found


def cores() -> int:
    """Cores that this process may use."""
    return len(os.sched_getaffinity(0)) if hasattr(os, "sched_getaffinity") else os.cpu_count() or 1
