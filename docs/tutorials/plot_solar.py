"""
A solar array by day and by night
=================================

Five winter days of a measured solar array. Its power is (gain + slope · temperature) · irradiance.
For 14 hours of every day there is no irradiance, so the regressor is zero: the case that
exponential forgetting cannot survive. The record ships inside another
package and is read from there.
"""

import matplotlib.pyplot as plt

from forgetting.demo.solar import identified, solar_record
from forgetting.plot import eigenvalues, styled

# %%
# The bank, which is told nothing, and three rules over the record, two of them with a memory of
# under an hour:
print(solar_record().frame.head(3))
found = identified()
for name, each in found.items():
    rmse = each.scores.model[0]
    print(f"{name:12} one-step RMSE {rmse:8.1f} W, {each.dead_zone} samples held")

# %%
# The eigenvalues of P. With exponential forgetting they grow by 1/λ in every silent sample; with
# the subspace rule they stand still until the sun is back.
with styled():
    figure, axes = plt.subplots(2, 2, figsize=(9, 5), layout="constrained")
    for column, name in enumerate(("exponential", "subspace")):
        eigenvalues(found[name], axes[0, column])
        axes[0, column].set_title(name)
        axes[1, column].plot(found[name].trace.theta[:, 0])
        axes[1, column].set(title="Gain", xlabel="sample")
