"""Sweep: how thick must a coating be for a rough face?

A rough slider touches a carbon-coated disk. One run answers one question, but the design needs
the contact over load and thickness, and it must not hang on the random surface that was chosen. A
study runs all combinations and keeps the results in order.
"""

# %% [markdown]
# ## One point first
#
# A sweep begins with a scene that works. The roughness is a description: a seed and a spectrum, the
# same surface on any grid.

# %%
import matplotlib.pyplot as plt

import contactkit as ck
from contactkit.units import GPa, MPa, nm, um

rough = ck.SelfAffineRoughness(
    rms=1 * nm, hurst=0.8, rolloff=0.5 * um, cutoff=0.26 * um, seed=1
)
disk = ck.Stack(
    layers=(ck.Layer(material=ck.load_material("dlc"), thickness=40 * nm),),
    substrate=ck.load_material("bearing-steel"),
)
scene = ck.ContactScene(
    interface=ck.Interface(lower=ck.Body(solid=disk), upper=ck.Body(surface=rough)),
    window=ck.Window(width=2 * um),
    loading=ck.Pressing(pressure=100 * MPa),
    effects=(ck.LayeredHalfSpace(),),
)
accuracy = ck.Accuracy(grid=64)
one = ck.solve(ck.plan(scene, accuracy))
print(f"{one.status}: {one.contact_fraction:.1%} in contact")
print(f"peak pressure {one.max_pressure / GPa:.2f} GPa")

# %% [markdown]
# ## Name what varies
#
# Each key is the path of a field in the scene, as in a scene file. Values may carry units. The last
# key varies fastest; make it the load, because each contact starts from the one before.

# %%
varied = {
    "interface.lower.solid.layers.0.thickness": ["40 nm", "160 nm", "640 nm"],
    "loading.pressure": ["50 MPa", "100 MPa", "200 MPa", "400 MPa"],
}
study = ck.study(scene, varied, accuracy)
print(study.table("contact_fraction", "max_pressure"))

# %% [markdown]
# ## Numbers as arrays
#
# `column` is one number over all points; `shape` gives it the axes of the study. The carbon is softer
# than steel, so a thicker layer lets more of the face touch; from 160 nm on it hardly matters.

# %%
fraction = study.column("contact_fraction").reshape(study.shape)
pressures = [50, 100, 200, 400]
for name, row in zip(("40 nm", "160 nm", "640 nm"), fraction, strict=True):
    print(f"{name:>7s}  " + "  ".join(f"{value:6.2%}" for value in row))

# %%
figure, ax = plt.subplots(figsize=(6.4, 3.6), layout="constrained")
for name, row, style in zip(
    varied[next(iter(varied))], fraction, ("o-", "s--", "^:"), strict=True
):
    ax.plot(pressures, 100 * row, style, label=name)
ax.set(xlabel="mean pressure [MPa]", ylabel="real contact [%]", ylim=(0, None))
ax.set_title("Rough slider on carbon-coated steel", loc="left")
ax.legend(frameon=False, title="thickness")
plt.show()

# %% [markdown]
# ## Is it the surface or the seed?
#
# A random surface is one of many. The seed is a field like any other, and `bands` turns it into
# median, least and greatest.

# %%
seeds = ck.study(
    scene,
    {
        "interface.upper.surface.seed": [1, 2, 3, 4, 5],
        "loading.pressure": varied["loading.pressure"],
    },
    accuracy,
)
bands = seeds.bands()
print(bands.table("contact_fraction", "contact_fraction_low", "contact_fraction_high"))

# %%
figure, ax = plt.subplots(figsize=(6.4, 3.6), layout="constrained")
low, middle, high = (
    100 * bands.column(f"contact_fraction{end}") for end in ("_low", "", "_high")
)
ax.fill_between(pressures, low, high, color="0.85", label="five seeds")
ax.plot(pressures, middle, "o-", label="median")
ax.set(xlabel="mean pressure [MPa]", ylabel="real contact [%]", ylim=(0, None))
ax.set_title("Coating of 40 nm: the scatter of the surface", loc="left")
ax.legend(frameon=False, loc="upper left")
plt.show()

# %% [markdown]
# ## What to change next
#
# - `workers=4`: points on four processes of this machine.
# - `store="points"`: an interrupted study goes on where it was.
# - The same from a file: `contactkit study SCENE --out DIR`.
#
# All of it: [studies](../how-to/studies.md).
