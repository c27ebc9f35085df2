"""
Mass of a vehicle on a slope
============================

A truck's mass is nearly constant, the slope of its road is not, and both are needed for choosing a
gear. Newton says

.. math:: \\dot v = \\frac{1}{m} F - g \\, s

with F the force at the wheels less the drag of the air, and s the slope plus the rolling
resistance. The two parameters, 1/m and s, change at very different speeds. While the truck cruises,
F is nearly constant, and the record cannot tell a heavy truck on a flat road from a light one on a
hill.
"""

import matplotlib.pyplot as plt
import numpy as np

import forgetting as fg
from forgetting.plot import styled

# %%
# Five minutes at 20 samples a second, computed: accelerating through the gears with gaps in the
# force between them, two minutes of cruising, and accelerating again, over a hilly road. The
# accelerometer is off by 0.05 m/s².
rng = np.random.default_rng(5)
time = np.arange(0, 300, 0.05)
cruising = (time > 80) & (time < 220)
shifting = (time % 12 < 1.0) & ~cruising
mass = 21_250.0
slope = 0.006 + 0.03 * np.sin(2 * np.pi * time / 90) * (time > 20)
climbing = mass * 9.81 * slope
force = np.where(shifting, 0.0, climbing + np.where(cruising, 0.0, 14_000 + 3_000 * np.sin(time)))
acceleration = force / mass - 9.81 * slope
measured = acceleration + 0.05 * rng.standard_normal(time.size)

# %%
# Forces in units of 10 kN, so that both parameters are of order 1. A factor a parameter: 1/m is
# forgotten a thousand times more slowly than the slope. ``multiple`` is the rule of the literature
# on this problem, ``component`` does the same and keeps what the parameters know of each other.
phi = np.column_stack([force / 1e4, np.full(time.size, -9.81)])
rules = {
    "exponential": fg.Exponential(0.98),
    "multiple": fg.Multiple(factors=[0.99999, 0.96]),
    "component": fg.Component(factors=[0.99999, 0.96]),
}
runs = {}
for name, rule in rules.items():
    est = fg.RLS(2, rule=rule, initial_covariance=[1.0, 1.0], initial_theta=[0.6, 0.0])
    runs[name] = est.run(phi, measured, outputs=("theta", "variance"))

# %%
# Mass and slope. With one factor for both, the mass is lost while the truck cruises: P grows in the
# direction that the force does not tell, and the estimate of 1/m passes through zero.
with styled():
    figure, (above, below) = plt.subplots(2, 1, figsize=(8.5, 5), sharex=True, layout="constrained")
    for name, run in runs.items():
        above.plot(time, 10 / run.theta[:, 0], label=name)
        below.plot(time, 100 * run.theta[:, 1], label=name)
    above.axhline(mass / 1000, color="k", linestyle="--", linewidth=1)
    below.plot(time, 100 * slope, "k--", linewidth=1, label="true")
    above.set(title="Mass (t)", ylim=(10, 35))
    below.set(title="Slope and rolling resistance (%)", xlabel="seconds", ylim=(-5, 6))
    above.legend(ncols=3)
    below.legend(ncols=4)

# %%
# How far off each is after the first 30 seconds, and in the cruise. ``component`` is off by more
# than ``multiple`` here: it believes what the errors of the slope, which lags, say of the mass.
for name, run in runs.items():
    off = np.abs(run.theta[:, 0] * mass / 1e4 - 1)
    lost = np.abs(run.theta[:, 1] - slope)
    print(f"{name:12} 1/m off by {100 * off[time > 30].max():5.1f} % at most", end=", ")
    print(f"in the cruise by {100 * np.median(off[cruising]):4.1f} % (median)", end=", ")
    print(f"slope by {100 * np.median(lost[time > 30]):.2f} percentage points (median)")
