"""
Forecast of an electric load
============================

A utility forecasts the load of the next day, hour by hour, from the time of day, the day of the
week and the temperature. The shape changes with the season, with new customers, with every heat
pump that is installed: coefficients of last year do not fit, and those of last week are noisy.
"""

import matplotlib.pyplot as plt
import numpy as np

import forgetting as fg
from forgetting.plot import styled

# %%
# A computed year of hours. The load has a daily and a weekly shape; heating adds to it below 15 °C,
# and gains half as much again over the year; a factory closes for three weeks in summer. The noise
# has memory, as weather that the thermometer does not show has.
rng = np.random.default_rng(6)
hours = np.arange(365 * 24)
day, hour = hours // 24, hours % 24
weekend = (day % 7 >= 5).astype(float)
temperature = 9 - 11 * np.cos(2 * np.pi * day / 365) + 4 * np.sin(2 * np.pi * (hour - 9) / 24)
slow = np.zeros(hours.size)
for i in range(1, hours.size):
    slow[i] = 0.98 * slow[i - 1] + 0.5 * rng.standard_normal()
temperature += slow
heating = np.maximum(15 - temperature, 0)
shape = 60 + 14 * np.sin(2 * np.pi * (hour - 8) / 24) + 7 * np.sin(4 * np.pi * (hour - 5) / 24)
closed = (day >= 200) & (day < 221)
noise = np.zeros(hours.size)
for i in range(1, hours.size):
    noise[i] = 0.8 * noise[i - 1] + 0.6 * rng.standard_normal()
load = shape - (8 + 3 * np.sin(2 * np.pi * hour / 24)) * weekend - 6 * closed
load = load + (0.9 + 0.45 * day / 365) * heating + noise

# %%
# The regressors: a constant, two harmonics of the day, the weekend and its first harmonic, heating.
angle = 2 * np.pi * hour / 24
daily = [np.sin(angle), np.cos(angle), np.sin(2 * angle), np.cos(2 * angle)]
phi = np.column_stack(
    [np.ones(hours.size), *daily, weekend, weekend * np.sin(angle), heating],
)

# %%
# Every midnight the 24 hours to come are forecast with what is known then. The temperature is taken
# from the record, as if its forecast were right: that flatters all but the naive one alike.
estimators = {
    "bank": fg.Bank(phi.shape[1]),
    "no forgetting": fg.RLS(phi.shape[1], rule="none"),
    "exponential, a week": fg.RLS(phi.shape[1], rule=fg.Exponential(half_life=5 * 24)),
}
forecast = {name: np.full(hours.size, np.nan) for name in estimators}
for start in range(0, hours.size, 24):
    rows = slice(start, start + 24)
    for name, est in estimators.items():
        forecast[name][rows] = phi[rows] @ est.theta
        est.run(phi[rows], load[rows], outputs=())
forecast["same hour, a week ago"] = np.concatenate([np.full(7 * 24, np.nan), load[: -7 * 24]])

# %%
# Errors after the first four weeks. A week is too short to know the heating in summer, and a year
# too long to follow its growth.
later = day >= 28
scale = load[later].mean()
for name, made in forecast.items():
    off = made[later] - load[later]
    print(
        f"{name:22} RMSE {np.sqrt(np.mean(off**2)) / scale * 100:5.2f} % of the mean load", end=""
    )
    print(f", in the weeks of the closure {np.sqrt(np.mean((made - load)[closed] ** 2)):5.2f} MW")

# %%
# How far will the load be from the forecast? At midnight the errors of the day before are known: a
# tracker for each hour of the day learns from them how wide its interval must be. It supposes
# nothing of the noise, and the share inside is the level, in the weeks of the closure, too.
half_width = np.full(hours.size, np.nan)
error = load - forecast["bank"]
for each in range(24):
    half_width[each::24] = fg.Intervals(0.9, skip=28).run(error[each::24])
inside = np.abs(error) <= half_width
print(f"within the intervals of 90 %: {inside[later].mean():.1%}", end="")
print(f", in the weeks of the closure {inside[closed].mean():.1%}")

# %%
# Whoever trades within the day forecasts every hour anew. With the load of the hour before among
# the regressors the memory of the noise is used, and the next hours are known better than those of
# tomorrow. `forgetting.forecasts` makes all of these forecasts, with a tracker for each horizon,
# and says what the intervals held beside those that take the noise for white, normal and of one
# size.
hourly = fg.ARX(na=1, nb=1, nk=0, offset=True)
print(fg.forecasts(hourly, phi[:, 1:], load, horizons=[1, 6, 24], level=0.9))

# %%
# A week of it, in October, with the intervals about the forecasts of the bank.
with styled():
    figure, ax = plt.subplots(figsize=(8.5, 3.2), layout="constrained")
    week = slice(285 * 24, 292 * 24)
    ax.plot(hours[week] / 24, load[week], "k--", linewidth=1, label="measured")
    for name in ("bank", "no forgetting", "same hour, a week ago"):
        (line,) = ax.plot(hours[week] / 24, forecast[name][week], label=name)
        if name == "bank":
            ends = [(forecast[name] + side * half_width)[week] for side in (-1, 1)]
            ax.fill_between(hours[week] / 24, *ends, color=line.get_color(), alpha=0.2)
    ax.set(title="Load (MW), forecast a day ahead", xlabel="day of the year")
    ax.legend(ncols=4)
