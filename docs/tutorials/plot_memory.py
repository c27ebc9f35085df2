"""
Which memory fits when
======================

How long should an estimator remember? It depends on what the parameters are doing now, and that
changes. ``fg.Bank`` runs eight estimators side by side, from one that holds the parameters to be
fixed to one that renews them at every sample, and believes each as far as it has predicted well.
The weights over time are a picture of how fast the parameters change.
"""

import matplotlib.pyplot as plt
import numpy as np

import forgetting as fg
from forgetting import plot
from forgetting.demo.solar import solar_record
from forgetting.plot import styled

# %%
# A computed record first, of which the answer is known: the parameters rest, then walk fast, then
# rest again, then walk slowly.
rng = np.random.default_rng(4)
k = np.arange(4000)
step = np.select([k < 1000, k < 2000, k < 3000], [0.0, 0.3, 0.0], 0.03)
theta = np.cumsum(step[:, None] * rng.standard_normal((k.size, 2)), axis=0)
phi = np.column_stack([np.ones(k.size), rng.standard_normal(k.size)])
y = (phi * theta).sum(axis=1) + rng.standard_normal(k.size)

# %%
# A member expects its parameters to walk by √Q, in units of the noise, at each sample; it remembers
# about 1/√Q samples. Beside the default mixer, ``mlpol``, stands one that forgets what the members
# did long ago.
bank = fg.Bank(2, mixer=fg.DynamicModelAveraging())
noise = [member.parameters["process_noise"] for member in bank.members]
labels = [f"{q**-0.5:,.0f} samples" if q < 1 else f"Q = {q:,.0f}" for q in noise]
run = bank.run(phi, y, outputs=["theta", "weights", "memory", "error"])
usual = fg.Bank(2).run(phi, y, outputs=["memory", "error"])
for part, words in enumerate(("resting", "walking fast", "resting", "walking slowly")):
    rows = slice(1000 * part + 500, 1000 * part + 1000)
    lengths = (np.median(each.memory[rows]) for each in (run, usual))
    errors = (np.sqrt(np.mean(each.error[rows] ** 2)) for each in (run, usual))
    print("{:15} memory {:4.0f} and {:4.0f} samples".format(words, *lengths), end=", ")
    print("error {:.3f} and {:.3f}".format(*errors))

# %%
# Dark is a long memory, bright a short one. Both mixers see within a few samples that parameters
# move: an estimate that lags is soon wrong. That they have come to rest shows slowly, as a short
# memory costs little, and ``mlpol``, which adds up all errors since the start, has not believed it
# after a thousand samples. What that costs is printed above.
with styled():
    figure, (above, below) = plt.subplots(
        2, 1, figsize=(8.5, 5), sharex=True, height_ratios=(1, 1.3), layout="constrained"
    )
    above.plot(k, run.theta, label=["estimates", None])
    above.plot(k, theta, "k--", linewidth=0.8, label=["true", None])
    above.set_ylabel("parameters")
    above.legend(ncols=2)
    plot.weights(run, labels, below)

# %%
# A measured record: five winter days of a solar array, its power by irradiance and by irradiance
# times temperature. At night there is nothing to predict and the weights stay as they are; by day
# memories of ten samples and less predict best, for what the model leaves out, such as the angle of
# the sun, changes within hours.
frame = solar_record().frame
sun, warmth = frame["poa"].to_numpy(), frame["t_module"].to_numpy() - 25.0
bank = fg.Bank(2)
run = bank.run(
    np.column_stack([sun, sun * warmth]),
    frame["dc_power"].to_numpy(),
    outputs=["weights", "memory"],
    missing="skip",
)
with styled():
    figure, (above, below) = plt.subplots(
        2, 1, figsize=(8.5, 4.4), sharex=True, height_ratios=(0.6, 1.3), layout="constrained"
    )
    above.plot(sun)
    above.set_ylabel("W/m²")
    above.set_title("Irradiance")
    plot.weights(run, labels, below)
    below.set_xlabel("quarter of an hour")
