"""Fit: how viscous is the oil, and does this curve decide it?

A ball is drawn off a plate in a pool of oil and the force is recorded over the gap. The height of
the ball is known only to a micrometre, and the zero of the load drifts. `ck.fit` returns values, how
sure they are, which readings decide them, and what the data leave open.
"""

# %% [markdown]
# ## The scene is the model
#
# The scene is the one that would be simulated. What is sought keeps a first guess in it.

# %%
import matplotlib.pyplot as plt
import numpy as np

import contactkit as ck
from contactkit.units import mm, um

oil = ck.Liquid(name="oil", viscosity=1.0)
scene = ck.SeparationScene(
    interface=ck.Interface(
        upper=ck.Sphere(radius=2 * mm), meniscus=ck.Meniscus(liquid=oil)
    ),
    loading=ck.ImposedSpeed(speed=10 * um, initial_gap=1 * um, final_gap=100 * um),
    effects=(ck.ViscousForce(),),
)

# %% [markdown]
# [Live page: the curve that is fitted](../live/flooded-sphere.toml)
#
# ## Readings
#
# Here they are made by the closed form, so that the answer is known: 0.4 Pa·s, a gap that was zeroed
# 1.5 µm too early, a load that reads 2 µN too much, 1 µN of noise. Yours come from
# `ck.read_measured_curve("pull.csv", over="gap", quantity="pull")`, from a data frame, or, of an
# atomic force microscope, from `ck.read_force_curve("tip.jpk-force")`.

# %%
gap = np.geomspace(5 * um, 80 * um, 30)
force = 6 * np.pi * 0.4 * (2 * mm) ** 2 * 10 * um / gap
force += 2e-6 + 1e-6 * np.random.default_rng(1).standard_normal(gap.size)
curve = ck.MeasuredCurve(
    over="gap",
    at=(gap - 1.5 * um) / um,
    quantity="viscous_force",
    values=force / 1e-6,
    units=("um", "uN"),
    shift=ck.Range("-3 um", "3 um", "first touch, by eye"),
    zero=ck.Range("-20 uN", "20 uN", "drift"),
)

# %% [markdown]
# ## Fit
#
# A parameter is the path of a field of the scene, as in a study, with a range; one of more than a
# decade is fitted by its logarithm. Shift and zero belong to the instrument, and so to the curve.
# The noise is not given: it is estimated.

# %%
viscosity = "interface.meniscus.liquid.viscosity"
sought = {viscosity: ck.Range("10 mPa.s", "100 Pa.s")}
found = ck.fit(scene, curve, sought)
print(found)

# %% [markdown]
# Value, ends of the 68 % interval, a verdict, and the part of the data that decides. The interval is
# of the profile likelihood where chi^2 is no parabola, else of the covariance.

# %%
figure, axes = plt.subplots(3, 1, figsize=(6.4, 7.2), layout="constrained", sharex=True)
found.plot.data(ax=axes[0])
found.plot.residuals(ax=axes[1])
found.plot.information(ax=axes[2])
for ax in axes[:2]:
    ax.set_xlabel("")
axes[0].set_title("Force on a ball, and what decides what", loc="left")
plt.show()

# %% [markdown]
# The nearest readings fix the shift, the far end the zero; more points between the two help least.
#
# ## What the data leave open
#
# Is the radius of the ball in doubt, too? The force has it in a product with the viscosity only:

# %%
radius = "interface.upper.surface.radius"
doubt = ck.fit(scene, curve, sought | {radius: ck.Range("1 mm", "4 mm")})
print(doubt.message)
print(*doubt.undecided, sep="\n")

# %% [markdown]
# No fit can mend that. A micrometer can: what is known from elsewhere is a `ck.Prior`, which counts
# as one more reading.

# %%
known = ck.fit(scene, curve, sought | {radius: ck.Prior("2 mm", "1 %", "micrometer")})
print(known.table())

# %% [markdown]
# ## What to change next
#
# - `found.scene` is the fitted scene: run it, export it, `print(found.to_toml())`.
# - Leave out `shift`: `ck.compare_fits` says whether the data ask for it.
# - `found.profile("viscosity").plot.rise()` draws the profile likelihood.
# - Several curves at once, each with `sets={"loading.speed": "20 µm/s"}`.
#
# All of it: [fit measured curves](../how-to/fit.md).
