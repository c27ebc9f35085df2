"""
Echo path of a telephone line
=============================

An echo canceller learns the impulse response between loudspeaker and microphone: many parameters,
and an input, speech, that comes in bursts. The question is what it does when the far end speaks
again after a silence, just as somebody coughs into the microphone.
"""

import forgetting as fg
import matplotlib.pyplot as plt
import numpy as np
from forgetting.plot import styled

# %%
# A stand-in for speech: two narrow-band talk spurts with a silence between them, an echo path of 32
# taps, and a cough of 40 samples when the second spurt begins.
rng = np.random.default_rng(2)
taps, samples = 32, 6000
k = np.arange(samples)
speaking = (k < 2000) | (k >= 4000)
voice = np.convolve(rng.standard_normal(samples), np.hanning(12) / 3, mode="same")
far_end = np.where(speaking, voice, 0.0)
path = np.exp(-np.arange(taps) / 6) * rng.standard_normal(taps)
padded = np.concatenate([np.zeros(taps - 1), far_end])
phi = np.lib.stride_tricks.sliding_window_view(padded, taps)[:, ::-1].copy()
cough = np.where((k >= 4000) & (k < 4040), 0.5, 0.0) * rng.standard_normal(samples)
microphone = phi @ path + cough + 0.01 * rng.standard_normal(samples)

# %%
# Two rules. A directional rule forgets one direction a sample, so with many parameters its factor
# is smaller for the same memory.
rules = {
    "exponential": fg.Exponential(0.995),
    "subspace": fg.Subspace(0.97, threshold=1e-2),
}
runs = {}
for name, rule in rules.items():
    est = fg.RLS(taps, rule=rule, initial_covariance=10.0)
    runs[name] = est.run(phi, microphone, outputs=("theta", "variance"))

# %%
# Misalignment is the distance of the taps from the true path, relative to the path. In the silence
# the covariance of exponential forgetting grows by four orders of magnitude; it then believes the
# cough.
off = {
    name: np.linalg.norm(run.theta - path, axis=1) / np.linalg.norm(path)
    for name, run in runs.items()
}
with styled():
    _, (above, below) = plt.subplots(2, 1, figsize=(8, 5), sharex=True, layout="constrained")
    for name, run in runs.items():
        above.semilogy(k, off[name], label=name)
        below.semilogy(k, run.variance.max(axis=1), label=name)
    above.set(title="Misalignment")
    below.set(title="Largest variance of a tap over that of the noise", xlabel="sample")
    above.legend(ncols=2)

# %%
# In numbers:
for name, run in runs.items():
    largest = run.variance.max(axis=1)
    grown = largest[3990] / largest[2000 + taps]
    before, after = off[name][3990], off[name][4000:].max()
    print(f"{name}: variance × {grown:.3g} in the silence")
    print(f"    misalignment {before:.2g} before the cough, up to {after:.2g} after it")
