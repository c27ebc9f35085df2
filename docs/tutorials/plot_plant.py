"""
A plant under control
=====================

A closed loop that works well excites nothing: the better the control, the less there is to learn.
Here an ARX model of a plant is followed through a change of its gain, with a set point that moves
only now and then.
"""

import matplotlib.pyplot as plt
import numpy as np

import forgetting as fg
from forgetting.plot import styled

# %%
# y(k) = 0.8 y(k−1) + b u(k−1) + noise under proportional control. The gain b falls from 0.5 to 0.3
# at k = 1500; the set point steps every 500 samples.
rng = np.random.default_rng(3)
samples = 3000
gain = np.where(np.arange(samples) < 1500, 0.5, 0.3)
set_point = (np.arange(samples) // 500) % 2
u, y = np.zeros(samples), np.zeros(samples)
for k in range(1, samples):
    y[k] = 0.8 * y[k - 1] + gain[k] * u[k - 1] + 0.002 * rng.standard_normal()
    u[k] = 2.0 * (set_point[k] - y[k])

# %%
# ``ARX`` takes input and output and builds the regressors: na = 1 past output, nb = 1 past input
# after a delay of one.
models = {
    "exponential": fg.ARX(na=1, nb=1, nk=1, rule=fg.Exponential(0.97)),
    "subspace": fg.ARX(na=1, nb=1, nk=1, rule=fg.Subspace(0.97, threshold=0.05)),
}
estimates = {}
for name, model in models.items():
    rows = []
    for start in range(0, samples, 10):
        model.partial_fit(u[start : start + 10], y[start : start + 10])
        rows.append(np.ravel(model.theta_))
    estimates[name] = np.array(rows)
    print(
        name,
        "at the end: a, b =",
        estimates[name][-1, 0].round(3),
        estimates[name][-1, 1].round(3),
    )

# %%
# The estimate of b. Exponential forgetting follows the change at once, and follows the noise
# between the steps of the set point too; subspace forgetting waits for the steps, and takes more of
# them.
with styled():
    figure, ax = plt.subplots(figsize=(8, 3), layout="constrained")
    for name, rows in estimates.items():
        ax.plot(np.arange(len(rows)) * 10, rows[:, 1], label=name)
    ax.plot(gain, "k--", linewidth=1, label="true")
    ax.set(title="Gain b", xlabel="sample", ylim=(0, 0.8))
    ax.legend(ncols=3)
