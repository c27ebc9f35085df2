"""
Internal resistance of a battery
================================

A cell's terminal voltage falls with the current, V = OCV − R i. Both parameters drift: the open
circuit voltage with the state of charge, the resistance with age and temperature. Between drives
the current is zero, and says nothing about R for hours.
"""

import forgetting as fg
import matplotlib.pyplot as plt
import numpy as np
from forgetting.plot import styled

# %%
# Two drives with a rest between them, one sample a second, 2 mV of noise. The resistance rises from
# 20 to 26 mΩ with the hours of driving. At rest the current sensor reads 20 mA of nothing.
rng = np.random.default_rng(1)
k = np.arange(5400)
driving = (k < 1800) | (k >= 3600)
load = 20 + 15 * np.sin(k / 7) + 10 * rng.standard_normal(k.size)
current = np.where(driving, load, 0.0)
resistance = np.interp(k, [0, 1800, 3600, 5400], [0.020, 0.023, 0.023, 0.026])
open_circuit = 3.9 - 0.2 * np.cumsum(current) / np.sum(np.abs(current))
voltage = open_circuit - resistance * current + 0.002 * rng.standard_normal(k.size)
measured = current + 0.02 * rng.standard_normal(k.size)

# %%
# The regressor is [1, −i]. At rest it is close to [1, 0], which informs about OCV only.
# ``subspace`` forgets OCV and keeps R; ``exponential`` forgets both, and then learns R from the
# noise of the current sensor.
phi = np.column_stack([np.ones(k.size), -measured])
runs = {}
for rule in (fg.Exponential(0.99), fg.Subspace(0.99, threshold=0.1)):
    est = fg.RLS(2, rule=rule, initial_covariance=[1.0, 1e-2], initial_theta=[3.8, 0.03])
    runs[rule.name] = est.run(phi, voltage, outputs=("theta", "variance"))

# %%
# The estimate of R and its variance, in units of the noise. With exponential forgetting the
# variance grows as soon as the cell rests, and the estimate goes wherever the noise leads it.
with styled():
    figure, (above, below) = plt.subplots(2, 1, figsize=(8, 5), sharex=True, layout="constrained")
    for name, run in runs.items():
        above.plot(k / 60, 1e3 * run.theta[:, 1], label=name)
        below.semilogy(k / 60, run.variance[:, 1], label=name)
    above.plot(k / 60, 1e3 * resistance, "k--", linewidth=1, label="true")
    above.set(title="Resistance (mΩ)", ylim=(10, 40))
    below.set(title="Variance of R over that of the noise", xlabel="minutes")
    above.legend(ncols=3)

# %%
# How far off each was. Keeping has its price: a directional rule forgets one direction a sample,
# and follows the second drive more slowly.
for name, run in runs.items():
    error = 1e3 * np.abs(run.theta[:, 1] - resistance)
    resting, driven = error[1800:3600].max(), error[3600:].max()
    print(f"{name}: up to {resting:.1f} mΩ at rest, {driven:.1f} mΩ in the second drive")
