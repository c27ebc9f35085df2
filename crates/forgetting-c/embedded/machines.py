"""The processors that the example runs on, and where QEMU has each."""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True)
class Machine:
    """A processor, and where QEMU has one."""

    name: str
    target: str
    compiler: str
    flags: tuple[str, ...]
    qemu: tuple[str, ...]
    code: int
    ram: int
    ram_size: int

    @property
    def tools(self) -> tuple[str, str]:
        """The programs that it needs."""
        return self.compiler + "gcc", self.qemu[0]


ARM = "arm-none-eabi-"
RISCV = "riscv64-unknown-elf-"
MACHINES = [
    Machine(
        "Cortex-M0+ (run on a Cortex-M0: microbit)",
        "thumbv6m-none-eabi",
        ARM,
        ("-mcpu=cortex-m0plus", "-mthumb", "-mfloat-abi=soft"),
        ("qemu-system-arm", "-M", "microbit"),
        0,
        0x20000000,
        0x4000,
    ),
    Machine(
        "Cortex-M4F (mps2-an386)",
        "thumbv7em-none-eabihf",
        ARM,
        ("-mcpu=cortex-m4", "-mthumb", "-mfloat-abi=hard", "-mfpu=fpv4-sp-d16"),
        ("qemu-system-arm", "-M", "mps2-an386"),
        0,
        0x20000000,
        0x10000,
    ),
    Machine(
        "Cortex-M33 without FPU (mps2-an505)",
        "thumbv8m.main-none-eabi",
        ARM,
        ("-mcpu=cortex-m33", "-mthumb", "-mfloat-abi=soft"),
        ("qemu-system-arm", "-M", "mps2-an505"),
        0x10000000,
        0x38000000,
        0x10000,
    ),
    Machine(
        "Cortex-M33 with FPU (mps2-an505)",
        "thumbv8m.main-none-eabihf",
        ARM,
        ("-mcpu=cortex-m33", "-mthumb", "-mfloat-abi=hard", "-mfpu=fpv5-sp-d16"),
        ("qemu-system-arm", "-M", "mps2-an505"),
        0x10000000,
        0x38000000,
        0x10000,
    ),
    Machine(
        "RISC-V rv32imc (virt)",
        "riscv32imc-unknown-none-elf",
        RISCV,
        ("-march=rv32imc", "-misa-spec=2.2", "-mabi=ilp32", "-mcmodel=medany"),
        ("qemu-system-riscv32", "-M", "virt", "-bios", "none"),
        0x80000000,
        0x80400000,
        0x10000,
    ),
]
