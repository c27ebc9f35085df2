"""How much is measured."""

from __future__ import annotations

from dataclasses import dataclass

SIZES = (2, 4, 6, 10, 16, 32, 64, 128, 256, 512)


@dataclass(frozen=True)
class Plan:
    """What the command line asked for."""

    quick: bool = False
    sizes: tuple[int, ...] = SIZES

    @property
    def seconds(self) -> float:
        """Of one race."""
        return 1.5 if self.quick else 4.0

    def of(self, *sizes: int) -> list[int]:
        """Those of `sizes` that were asked for."""
        return [n for n in sizes if n in self.sizes]
