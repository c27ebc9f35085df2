"""Runs the example in QEMU on every machine, compares it with Python and prints what it costs.

    OUT=folder python embedded.py

`OUT` holds the archives, a folder for each target. Code is bytes of instructions and constants: of
the functions that an update runs, of all that the library and its arithmetic bring to the program,
and the same where the program saves its state and holds its estimate within bounds. Instructions
are those that QEMU counts, tickwise on ARM, and include the call. Estimates are compared bit for
bit, after every sample, with `RLS(dtype="float32")` in plain arithmetic.
"""

from __future__ import annotations

import os
import shutil
import subprocess
import sys
from pathlib import Path

os.environ["FORGETTING_CPU"] = "baseline"

import numpy as np
from machines import MACHINES, Machine
from numpy.typing import NDArray

import forgetting as fg

HERE = Path(__file__).parent
OUT = Path(os.environ["OUT"])
# of the battery, and of the others, which only add to the table
SAMPLES = {2: 100_000, 4: 10_000, 6: 10_000}
FORGETTING_FACTOR = 0.99609375
# of every parameter, above what the cell has
LEAST_RESISTANCE = 0.078125
# of several estimators at once, in the units of the data
BANK = "bank"
RULES = ["exponential", "subspace", "random_walk", BANK]
# those that use no forgetting factor
WITHOUT_FACTOR = ["random_walk", BANK]
# what the loop that the counter is held against executes: see `machine.c`
LOOP = 300_000


def factor(rule: str) -> float | None:
    """λ, if the rule uses it."""
    return None if rule in WITHOUT_FACTOR else FORGETTING_FACTOR


def run(*command: str, timeout: float = 300) -> str:
    """The output of a program that must succeed."""
    done = subprocess.run(command, capture_output=True, text=True, timeout=timeout, check=False)
    if done.returncode:
        raise SystemExit(f"{' '.join(command)}\n{done.stdout}{done.stderr}")
    return done.stdout + done.stderr


def compiled(machine: Machine, rule: str, n: int, saves: bool = True) -> tuple[Path, int]:
    """The program, and the bytes of code in it that are the library's."""
    folder = OUT / machine.target
    name = f"{rule}_{n}" if saves else f"{rule}_{n}_without_saving"
    options = [*machine.flags, "-std=c11", "-Os", "-ffp-contract=off", "-ffunction-sections"]
    options += ["-ffreestanding", "-Wall", "-Wextra", "-Werror", f"-I{HERE.parent / 'include'}"]
    options += [f"-DKIND=fg_{rule}_f32_{n}", f"-DN={n}", f"-DSAMPLES={SAMPLES[n]}"]
    options += [f"-DFORGETTING_FACTOR={factor(rule) or 0}"]
    options += [f"-DLEAST_RESISTANCE={LEAST_RESISTANCE}f"]
    options += ["-DINITIAL_COVARIANCE=0", "-DROOM=4096"] if rule == BANK else []
    options += [] if saves else ["-DWITHOUT_SAVING"]
    objects = []
    for source in ("battery.c", "machine.c"):
        objects.append(str(folder / f"{name}_{source}.o"))
        run(machine.compiler + "gcc", *options, "-c", str(HERE / source), "-o", objects[-1])
    program = folder / f"{name}.elf"
    places = [("CODE", machine.code), ("RAM", machine.ram), ("RAM_SIZE", machine.ram_size)]
    run(
        machine.compiler + "gcc",
        *machine.flags,
        "-nostdlib",
        "-static",
        "-Wl,--gc-sections,--no-warn-rwx-segments,--no-warn-execstack",
        *(f"-Wl,--defsym={name}={value}" for name, value in places),
        f"-Wl,-T,{HERE / 'machine.ld'}",
        *objects,
        str(folder / "libforgetting.a"),
        "-lgcc",
        "-o",
        str(program),
    )
    own = sum(code_of(machine, path) for path in objects)
    return program, code_of(machine, str(program)) - own


def code_of(machine: Machine, path: str) -> int:
    """The bytes of code and constants."""
    return int(run(machine.compiler + "size", path).splitlines()[1].split()[0])


def update_code(machine: Machine, program: Path) -> int:
    """The bytes of the functions that an update is."""
    lines = run(machine.compiler + "nm", "-S", "-C", str(program)).splitlines()
    parts = [line.split(maxsplit=3) for line in lines if len(line.split(maxsplit=3)) == 4]
    words = ("fg_update_f32", "kind::update", "Compact", "compact::", "bank::", "mixers::")
    left_out = ("visit", "save", "saving", "load", "from_bytes", "read", "covariance", "::of")
    left_out += ("is_sound", "kind::init", "::new", "set_theta")
    return sum(
        int(size, 16)
        for _, size, kind, name in parts
        if kind in "tT" and any(w in name for w in words) and not any(w in name for w in left_out)
    )


def measured(machine: Machine, program: Path) -> dict[str, str]:
    """What the program prints."""
    output = run(
        *machine.qemu,
        "-nographic",
        "-monitor",
        "none",
        "-serial",
        "none",
        "-icount",
        "shift=0",
        "-semihosting-config",
        "enable=on,target=native",
        "-kernel",
        str(program),
    )
    lines = (line.split() for line in output.splitlines())
    return {line[0]: line[1] for line in lines if len(line) == 2}


def samples(n: int) -> tuple[NDArray[np.float32], NDArray[np.float32]]:
    """Those of `battery.c`."""
    count = SAMPLES[n]
    state, numbers = 1, np.empty(count * n, dtype=np.float32)
    for k in range(count * n):
        state = (state * 1664525 + 1013904223) % 2**32
        numbers[k] = np.float32((state >> 16) & 1023) / np.float32(256) - np.float32(2)
    numbers = numbers.reshape(count, n)
    phi = np.concatenate([np.ones((count, 1), np.float32), -numbers[:, :-1]], axis=1)
    early = np.arange(count) < count // 2
    resistance = np.where(early, np.float32(0.05), np.float32(0.075)).astype(np.float32)
    voltage = np.full(count, 3.75, np.float32)
    for i in range(1, n):
        voltage = voltage + resistance * phi[:, i]
    return phi, voltage + numbers[:, -1] / np.float32(1024)


def estimator(rule: str, n: int) -> fg.RLS | fg.Bank:
    """That of `battery.c` in Python."""
    if rule == BANK:
        return fg.Bank(n, dtype="float32")
    return fg.RLS(
        n,
        rule=rule,
        forgetting_factor=factor(rule),
        initial_covariance=100.0,
        dtype="float32",
    )


def expected(rule: str, n: int) -> tuple[str, str, NDArray[np.float32]]:
    """The hash of all estimates, the state at the end and its estimate within bounds, of Python."""
    rls = estimator(rule, n)
    phi, y = samples(n)
    thetas = np.empty((len(phi), n), np.float32)
    for k in range(len(phi)):
        rls.update(phi[k], y[k])
        thetas[k] = rls.theta
    value = 2166136261
    for byte in thetas.tobytes():
        value = ((value ^ byte) * 16777619) % 2**32
    wide = (np.asarray(x, dtype=np.float64) for x in (rls.theta, rls.covariance))
    held = fg.bounded(*wide, np.full(n, LEAST_RESISTANCE), np.full(n, np.inf))
    return f"{value:08x}", rls.to_bytes().hex(), held.astype(np.float32)


def row(
    machine: Machine, rule: str, n: int, truth: tuple[str, str, NDArray[np.float32]]
) -> tuple[bool, str]:
    """A line of the table, and whether the bits are Python's."""
    program, code = compiled(machine, rule, n)
    _, without_saving = compiled(machine, rule, n, saves=False)
    found = measured(machine, program)
    held = np.frombuffer(bytes.fromhex(found.get("held", "")), np.float32)
    same = (found.get("hash"), found.get("state")) == truth[:2]
    # P is summed in another order than Python's
    same &= held.shape == truth[2].shape and np.allclose(held, truth[2], rtol=1e-4)
    texts = ("hash", "state", "held")
    number = {key: int(text, 16) for key, text in found.items() if key not in texts}
    instructions = number["ticks"] / number["loop"] * LOOP / SAMPLES[n]
    cells = [
        rule,
        n,
        number["size"],
        number["stack"],
        update_code(machine, program),
        without_saving,
        code,
        round(instructions),
        "yes" if same else "NO",
    ]
    return same, "| " + " | ".join(map(str, cells)) + " |"


def main() -> int:
    """Every machine whose tools are there."""
    right = wrong = skipped = 0
    truths = {(rule, n): expected(rule, n) for rule in RULES for n in SAMPLES}
    for machine in MACHINES:
        missing = [tool for tool in machine.tools if not shutil.which(tool)]
        if missing or not (OUT / machine.target / "libforgetting.a").exists():
            skipped += 1
            print(f"{machine.name}: not run, missing {', '.join(missing) or 'the archive'}")
            continue
        print(f"\n{machine.name}\n")
        print(
            "| rule | n | state, bytes | stack, bytes | code of an update | code of the library | "
            "code with saving and bounds | instructions an update | bits of Python |"
        )
        print("|---|---|---|---|---|---|---|---|---|")
        for (rule, n), truth in truths.items():
            same, line = row(machine, rule, n, truth)
            print(line, flush=True)
            right, wrong = right + same, wrong + (not same)
    print(f"\nembedded: {right} passed, {wrong} failed, {skipped} skipped")
    return int(wrong > 0)


if __name__ == "__main__":
    sys.exit(main())
