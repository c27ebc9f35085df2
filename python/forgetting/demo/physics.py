"""From regression parameters to mass, rolling resistance and drag, with propagated errors."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from forgetting.record import Identification

Array = NDArray[np.float64]


@dataclass(frozen=True)
class Estimate:
    """A value, its standard error and its unit."""

    value: float
    error: float
    unit: str


@dataclass(frozen=True)
class Rider:
    """Rider and bicycle.

    Attributes
    ----------
    mass : Estimate
        Total mass m, kg.
    rolling : Estimate
        Coefficient of rolling resistance Crr = theta2 / m.
    drag_area : Estimate
        CdA = 2 k / rho, m².
    """

    mass: Estimate
    rolling: Estimate
    drag_area: Estimate


@dataclass(frozen=True)
class Result:
    """One rule's identification and the physics it implies."""

    found: Identification
    rider: Rider


def air_density(altitude: float) -> float:
    """Density of the standard atmosphere (ISO 2533) at an altitude in m, kg/m³.

    Examples
    --------
    >>> round(air_density(0.0), 3), round(air_density(397.0), 3)
    (1.225, 1.179)
    """
    return float(1.225 * (1 - 2.25577e-5 * altitude) ** 4.25588)


def rider(found: Identification, altitude: float) -> Rider:
    """Derive mass, Crr and CdA from theta = (m, Crr m, k) at the end of the ride.

    Standard errors are propagated to first order, f' Sigma f'ᵀ with Sigma = sigma² P, so the
    correlation between mass and rolling resistance counts.
    """
    mass, rolling, drag = (float(value) for value in found.theta[-1, :, 0])
    covariance = found.noise_variance[-1, 0] * found.trace.covariance
    density = air_density(altitude)

    def error(gradient: list[float]) -> float:
        return float(np.sqrt(np.array(gradient) @ covariance @ np.array(gradient)))

    return Rider(
        mass=Estimate(mass, error([1.0, 0.0, 0.0]), "kg"),
        rolling=Estimate(rolling / mass, error([-rolling / mass**2, 1 / mass, 0.0]), "(no unit)"),
        drag_area=Estimate(2 * drag / density, error([0.0, 0.0, 2 / density]), "m²"),
    )
