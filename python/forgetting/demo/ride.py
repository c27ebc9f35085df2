"""From a cyclist's track to an energy balance in windows.

Over a window of length T the work at the pedals goes into kinetic and potential energy, rolling and
air resistance:

    mean(P) = m (E(end) - E(start)) / T  +  Crr m mean(g v)  +  k mean(v³)      E = v²/2 + g h

which is the time integral of P = m d(v²/2 + g h)/dt + Crr m g v + k v³. Differences over windows
take the place of derivatives of noisy signals.

Choices, each with its physical ground; they were compared on this ride, so that the agreement of
the estimates with windowed batch fits of the same ride is no independent evidence:

* Altitude is barometric, in steps of 0.2 m, with single glitches: running median of 31 s, then a
  mean of 11 s. Speed at the window's ends: mean of 5 s.
* Windows of 30 s. Shorter ones drown in altitude noise (and noise in a regressor shrinks its
  parameter: 10 s windows give a mass near 75 kg), longer ones leave few samples of the descents.
* The model has no brakes. A window is left out (missing) when the rider coasts in more than a
  quarter of it, or decelerates by more than 0.4 m/s² anywhere, since braking cannot be told from
  coasting; or is slower than 1.5 m/s; or the altimeter jumps by 2.5 m/s or more within 15 s of it.
"""

from __future__ import annotations

import numpy as np
import pandas as pd
from numpy.typing import NDArray

Array = NDArray[np.float64]

GRAVITY = 9.81
WINDOW = 30
COASTING_SHARE, BRAKING, SLOWEST = 0.25, 0.4, 1.5
GLITCH, GLITCH_REACH = 2.5, 15


def energy_balance(track: pd.DataFrame) -> pd.DataFrame:
    """Turn a 1 Hz track into one row per window.

    Returns
    -------
    DataFrame
        time (start of window), power (W), energy_rate (W/kg), weight_speed (g v, m²/s³) and
        speed_cubed (m³/s³); NaN in power where the window is left out.
    """
    track = every_second(track)
    windows = len(track) // WINDOW - 1
    raw, power = track["speed"].to_numpy(), track["power"].to_numpy()
    energy = mean(raw, 2) ** 2 / 2 + GRAVITY * smooth_altitude(track["altitude"])
    edges = np.arange(windows + 1) * WINDOW
    balance = pd.DataFrame(
        {
            "time": track.index[edges[:-1]],
            "power": per_window(power, windows).mean(axis=1),
            "energy_rate": np.diff(energy[edges]) / WINDOW,
            "weight_speed": GRAVITY * per_window(raw, windows).mean(axis=1),
            "speed_cubed": (per_window(raw, windows) ** 3).mean(axis=1),
        }
    )
    balance.loc[~usable(track, windows), "power"] = np.nan
    return balance


def every_second(track: pd.DataFrame) -> pd.DataFrame:
    """Index the track by time with one row per second; seconds not recorded are NaN."""
    indexed = track.drop_duplicates("time").set_index("time")
    return indexed.asfreq("s")


def usable(track: pd.DataFrame, windows: int) -> NDArray[np.bool_]:
    """Windows in which the model holds, (windows,)."""
    speed = track["speed"].to_numpy()
    acceleration = np.gradient(mean(speed, 1))
    jump = np.abs(np.gradient(track["altitude"].to_numpy())) > GLITCH
    near_jump = mean(jump.astype(np.float64), GLITCH_REACH) > 0
    coasting = per_window(track["power"].to_numpy() < 1.0, windows).mean(axis=1)
    ok: NDArray[np.bool_] = (
        (coasting <= COASTING_SHARE)
        & (per_window(acceleration, windows).min(axis=1) >= -BRAKING)
        & (per_window(speed, windows).min(axis=1) >= SLOWEST)
        & ~per_window(near_jump, windows).any(axis=1)
    )
    return ok


def smooth_altitude(altitude: pd.Series) -> Array:
    """Running median against glitches, then a mean against the 0.2 m steps."""
    median = altitude.rolling(31, center=True, min_periods=1).median()
    return mean(median.to_numpy(), 5)


def mean(values: Array, reach: int) -> Array:
    """Centred moving mean over 2 reach + 1 seconds; the ends repeat their last value."""
    width = 2 * reach + 1
    return np.convolve(np.pad(values, reach, mode="edge"), np.full(width, 1 / width), "valid")


def per_window(values: NDArray[np.generic], windows: int) -> Array:
    """Cut into windows, (windows, WINDOW)."""
    return np.asarray(values[: windows * WINDOW], dtype=np.float64).reshape(windows, WINDOW)
