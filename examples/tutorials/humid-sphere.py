"""Sphere in humid air: how hard does it stick?

The tip of an atomic force microscope, or a particle on a wafer, touches a flat in room air.
Water condenses in the narrow gap around the contact and holds the sphere. How large is that
force, at which distance does the water bridge break, and does dry air help?
"""

# %% [markdown]
# [Live page: a larger sphere, without attraction of the solids](../live/humid-sphere.toml)
#
# ## Describe the scene
#
# All numbers are in SI units and radians. This sphere is smaller than what continuum models are
# made for: we silence the warnings here and read them below.

# %%
import warnings

import matplotlib.pyplot as plt
import numpy as np
from attrs import evolve

import contactkit as ck
from contactkit.units import deg, nm, um

warnings.simplefilter("ignore", ck.ValidityWarning)

# %% [markdown]
# The amount of water is not given by a volume but by the relative humidity: liquid condenses
# until its pressure is that of Kelvin's equation. Both faces have a contact angle of 40 degrees.

# %%
water = ck.Meniscus(
    liquid=ck.load_liquid("water"),
    relative_humidity=0.5,
    contact_angle_lower=40 * deg,
    contact_angle_upper=40 * deg,
)
tip = ck.Sphere(radius=100 * nm)

# %% [markdown]
# The sphere is pulled off at 1 µm/s. Two effects are simulated: the force of the meniscus, and
# the van der Waals force of the solids. What is not listed is not computed.

# %%
scene = ck.SeparationScene(
    interface=ck.Interface(upper=tip, meniscus=water),
    loading=ck.ImposedSpeed(initial_gap=0.3 * nm, final_gap=5 * nm, speed=1 * um),
    effects=(ck.MeniscusForce(), ck.VanDerWaalsForce(hamaker_constant=1e-19)),
)

# %% [markdown]
# ## Plan and run
#
# A plan is the checked scene. It already knows where the water bridge loses its stability;
# `plan.cite()` gives the sources of its equations.

# %%
plan = ck.plan(scene)
print(str(plan).splitlines()[-1].strip())

# %%
result = ck.simulate(plan)
print(result.message)
print(f"meniscus at the start      {result['meniscus_force'][0] / 1e-9:6.2f} nN")
print(f"van der Waals at the start {result['van_der_waals_force'][0] / 1e-9:6.2f} nN")
print(f"peak of both together      {result.scalars()['peak_force'][0] / 1e-9:6.2f} nN")

# %% [markdown]
# The meniscus is the larger part of the force, and it acts over a nanometre.

# %%
figure, ax = plt.subplots(figsize=(6.4, 3.6), layout="constrained")
result.plot.forces(ax=ax)
ax.set_title("Sphere of 100 nm at 50 % humidity", loc="left")
plt.show()

# %% [markdown]
# ## Is the model allowed here?
#
# Each model states its range. At 0.3 nm the gap is one molecule wide, so the numbers are an
# estimate of the continuum model, not a truth about single molecules.

# %%
for number in result.validity:
    if "OUT OF RANGE" in str(number):
        print(number)

# %% [markdown]
# ## Does dry air help?
#
# `humidity_curve` computes the same scene for many humidities at its initial gap. The Kelvin
# radius is the size of the meniscus: where it is smaller than the gap, there is no meniscus.

# %%
humidity = np.linspace(0.05, 0.95, 46)
near = ck.humidity_curve(scene, humidity)
for i in range(0, 46, 9):
    print(
        f"{humidity[i]:4.0%}   Kelvin radius {near.kelvin_radius[i] / nm:5.2f} nm"
        f"   force {near.force[i] / 1e-9:5.1f} nN"
    )

# %% [markdown]
# In contact (gap zero) the answer is different: a drier meniscus is smaller, but pulls with a
# larger negative pressure, and the two nearly cancel.

# %%
touching = evolve(scene, loading=evolve(scene.loading, initial_gap=0.0))
contact = ck.humidity_curve(evolve(touching, effects=(ck.MeniscusForce(),)), humidity)

figure, ax = plt.subplots(figsize=(6.4, 3.6), layout="constrained")
ax.plot(100 * humidity, contact.force / 1e-9, "-", label="in contact")
ax.plot(100 * humidity, near.force / 1e-9, "--", label="0.3 nm away")
ax.set(xlabel="relative humidity [%]", ylabel="meniscus force [nN]", ylim=(0, None))
ax.set_title("Meniscus force over humidity", loc="left")
ax.legend(frameon=False, loc="lower right")
plt.show()

# %% [markdown]
# ## Check against the formula
#
# The textbook result for a large sphere in contact is $4\pi R\gamma\cos\theta$.
# `ck.capillary_force` is the same exact bridge in one line, for arrays of radii.

# %%
tension = ck.load_liquid("water").at(293.15).surface_tension
radii = np.array([20 * nm, 100 * nm, 1 * um, 10 * um])
exact = ck.capillary_force(radii, 0.5, contact_angles=40 * deg)
for radius, force in zip(radii, exact, strict=True):
    ratio = force / (4 * np.pi * radius * tension * np.cos(40 * deg))
    print(
        f"R = {radius / nm:7.0f} nm   {force / 1e-9:8.2f} nN   {ratio:.3f} of the formula"
    )

# %% [markdown]
# So drying the air helps only where roughness or particles keep the faces apart; smooth faces in
# contact stick nearly as hard at 20 % as at 80 %.
#
# ## What to change next
#
# - `contact_angle_upper=100 * deg`, a hydrophobic coating of the tip: the force drops.
# - `volume=1e-24` in place of the humidity: a drop of fixed size holds farther out.
# - `AsperityMenisci`: a rough face with many small menisci.
#
# The equations: [liquid bridges](../bridges.md).
