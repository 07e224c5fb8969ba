"""Own height map: where do two rough faces touch?

You have measured a surface: an array of heights and the size of a pixel. Pressed against a flat
steel face, how much of it really touches, how large is the pressure at the summits, and does the
steel yield?
"""

# %% [markdown]
# ## A map
#
# Yours would come from a file: `heights = np.load("scan.npy")`. Here a ground surface with scratches
# along y is made up, 40 µm wide, with 128 x 128 pixels. Heights are in metres, peaks up, `[y, x]`.

# %%
import warnings

import matplotlib.pyplot as plt
import numpy as np

import contactkit as ck
from contactkit.units import GPa, MPa, nm, um

n, width = 128, 40 * um
pixel = width / n
rng = np.random.default_rng(7)
y, x = np.meshgrid(np.arange(n), np.arange(n), indexing="ij")
heights = np.zeros((n, n))
for kx in range(3, 15):
    for ky in range(-4, 5):
        phase = 2 * np.pi * (rng.uniform() + (kx * x + ky * y) / n)
        heights += np.cos(phase) / (kx**2 + (2 * ky) ** 2) ** 0.8
heights *= 30 * nm / heights.std()
print(f"{heights.shape} pixels of {pixel / nm:.1f} nm, rms {heights.std() / nm:.1f} nm")

# %% [markdown]
# ## Look at the surface first
#
# Statistics tell whether the map is fine enough: the slope is what contact depends on most, and it
# is the number that a coarse or a noisy scan gets wrong.

# %%
from contactkit.roughness.statistics import surface_statistics

numbers = surface_statistics(heights, pixel, periodic=True)
print(f"rms height {numbers.rms / nm:.1f} nm")
print(f"rms slope  {numbers.rms_slope:.4f}")

# %% [markdown]
# ## Press it
#
# `press` takes the array as a rigid rough body against a flat solid. The pressure is the mean one
# over the whole map.

# %%
steel = ck.load_material("bearing-steel")
result = ck.press(heights, pixel, steel, mean_pressure=100 * MPa)
print(result.status)
print(f"real contact   {result.contact_fraction:.1%} of the area")
print(f"peak pressure  {result.max_pressure / GPa:.2f} GPa")

# %% [markdown]
# The summits carry many times the mean pressure. The result draws maps and sections.

# %%
figure, (left, right) = plt.subplots(1, 2, figsize=(9.6, 3.9), layout="constrained")
result.plot.heights(ax=left)
left.set_title("Heights", loc="left")
result.plot.pressure(ax=right)
right.set_title("Pressure at 100 MPa", loc="left")
plt.show()

# %% [markdown]
# ## Does the steel yield?
#
# Bearing steel has a hardness of 7.5 GPa, more than the peak: it stays elastic. Suppose the face was
# annealed to 3 GPa: with `hardness=` the pressure is bounded there, and pixels at the bound are plastic.

# %%
plastic = ck.press(heights, pixel, steel, 100 * MPa, hardness=3 * GPa)
print(f"real contact   {plastic.contact_fraction:.1%} of the area")
print(f"plastic        {plastic.plastic_area / plastic.contact_area:.1%} of the contact")

# %% [markdown]
# ## Over the load
#
# Area in proportion to the load is the classic result for rough surfaces. It holds as long as little
# of the surface touches.

# %%
pressures = np.array([20, 50, 100, 200, 500, 1000]) * MPa
runs = [ck.press(heights, pixel, steel, p) for p in pressures]
area = np.array([one.contact_fraction for one in runs])
for p, fraction in zip(pressures, area, strict=True):
    print(f"{p / MPa:5.0f} MPa  {fraction:6.2%}  {fraction / (p / MPa):.3%} per MPa")

# %%
figure, ax = plt.subplots(figsize=(6.4, 3.6), layout="constrained")
ax.loglog(pressures / MPa, 100 * area, "o-", label="computed")
ax.loglog(
    pressures / MPa,
    100 * area[0] * pressures / pressures[0],
    "k:",
    label="proportional",
)
ax.set(xlabel="mean pressure [MPa]", ylabel="real contact [%]")
ax.set_title("Real area of contact over the load", loc="left")
ax.legend(frameon=False)
plt.show()

# %% [markdown]
# ## Is the map fine enough?
#
# `discretisation_error` solves the contact again on every second and every fourth pixel. From what
# that changes it estimates the error of each number against a finer scan of the same waves: few
# numbers in a hundred are further off than stated, most are several times closer.

# %%
with warnings.catch_warnings():
    warnings.simplefilter("ignore", ck.ValidityWarning)  # the coarse map is coarse
    print(ck.discretisation_error(result))

# %% [markdown]
# ## What to change next
#
# - `periodic=False`: an isolated patch, when the map does not repeat.
# - A coated solid: `ck.Stack(layers=(ck.Layer(material=..., thickness=...),), substrate=steel)`.
# - Files of instruments, tilt and holes: [measured surfaces](../how-to/surfaces.md).
# - Two bodies and friction: [coated sphere](coated-sphere.md).
