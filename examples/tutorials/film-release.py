"""Film release: how long does an oil film hold a valve?

The spool of a fuel injector rests on its end cap with five micrometres of oil between the faces.
A magnet pulls with 40 N. When is the spool free, how much later is that in the cold, and what
decides: the viscosity, or the tension at which oil cavitates?
"""

# %% [markdown]
# [Live page: the film of this tutorial](../live/oil-film.toml)
#
# ## Describe the scene
#
# The faces are two flats of 3.2 mm radius. The film fills the whole gap at the start, and the
# force of the magnet acts on a mass of 20 g until the gap is 25 µm.

# %%
import math
import warnings

import matplotlib.pyplot as plt
from attrs import evolve

import contactkit as ck
from contactkit.units import celsius, mm, um

warnings.simplefilter("ignore", ck.ValidityWarning)  # read below

face = ck.Flat(radius=3.175 * mm)
oil = ck.load_liquid("engine-oil-15w-40")
film = ck.Meniscus(liquid=oil, volume=math.pi * face.radius**2 * 5 * um)
pull = ck.ImposedForce(initial_gap=5 * um, final_gap=25 * um, force=40.0, mass=0.02)

# %% [markdown]
# Three effects: the capillary force at the rim, the viscous force, and a limit. The oil is
# assumed to cavitate at a tension of 10 bar; a cavity then takes over a part of the face.

# %%
scene = ck.SeparationScene(
    interface=ck.Interface(lower=face, upper=face, meniscus=film),
    loading=pull,
    effects=(ck.MeniscusForce(), ck.ViscousForce(), ck.TensionLimit(strength=1e6)),
    temperature=celsius(20),
)
plan = ck.plan(scene)
print(plan)

# %% [markdown]
# ## Run it
#
# The motion of the mass is integrated with error control; nothing has to be tuned for the thin,
# very stiff film.

# %%
result = ck.simulate(plan)
print(result.message)
print(f"released after  {1e3 * result.state.release_time:.4f} ms")
print(f"peak of film    {result.state.peak_force:.2f} N of 40 N pull")
print(f"work            {1e6 * result.state.dissipated_work:.1f} uJ")

# %% [markdown]
# The force of the film reaches 16 N within the first instant. Then the oil cavitates; what holds the
# spool after that is the pressure of the surroundings on the face, 3.2 N, against a cavity.

# %%
figure, (left, right) = plt.subplots(1, 2, figsize=(9.0, 3.5), layout="constrained")
result.plot.gap(ax=left)
left.set_title("Motion", loc="left")
result.plot.forces(ax=right)
right.set_title("Forces of the film", loc="left")
plt.show()

# %% [markdown]
# ## What if the oil does not cavitate?
#
# Clean, degassed oil can stand a large tension for a short time. Leaving the effect out is the
# other extreme, and it shows what the assumption is worth.

# %%
strong = evolve(scene, effects=(ck.MeniscusForce(), ck.ViscousForce()))
held = ck.simulate(ck.plan(strong))
print(f"cavitates at 10 bar  {1e3 * result.state.release_time:7.3f} ms")
print(f"never cavitates      {1e3 * held.state.release_time:7.3f} ms")

# %% [markdown]
# ## How much later in the cold?
#
# The library knows the viscosity of the oil over temperature. Both extremes are run from
# -20 to 100 degrees.

# %%
degrees = list(range(-20, 101, 20))
late = {"never cavitates": strong, "cavitates at 10 bar": scene}
times = {
    name: [
        ck.simulate(ck.plan(evolve(one, temperature=celsius(t)))).state.release_time
        for t in degrees
    ]
    for name, one in late.items()
}
for i, t in enumerate(degrees):
    viscosity = oil.at(celsius(t)).viscosity
    row = "   ".join(f"{name} {1e3 * times[name][i]:9.3f} ms" for name in late)
    print(f"{t:4d} degC  {viscosity:7.4f} Pa.s   {row}")

# %%
figure, ax = plt.subplots(figsize=(6.4, 3.6), layout="constrained")
for (name, values), style in zip(times.items(), ("s--", "o-"), strict=True):
    ax.semilogy(degrees, [1e3 * t for t in values], style, label=name)
ax.set(xlabel="oil temperature [°C]", ylabel="release time [ms]")
ax.set_title("40 N against a film of 5 µm", loc="left")
ax.legend(frameon=False)
plt.show()

# %% [markdown]
# Temperature decides only if the oil holds together. If it cavitates, 40 N less the force of one
# atmosphere accelerate the mass, and the viscosity does not matter:

# %%
net = 40.0 - 101325.0 * math.pi * face.radius**2
print(f"free mass: {1e3 * math.sqrt(2 * 0.02 * 20 * um / net):.4f} ms")

# %% [markdown]
# ## Is the model allowed here?
#
# Every model of a result states its range of validity.

# %%
for number in result.validity:
    if "OUT OF RANGE" in str(number):
        print(number)

# %% [markdown]
# Both say that the receding rim is not smooth at this speed: the small capillary force is
# uncertain, the viscous force is not.
#
# ## What to change next
#
# - `strength=5e6`: what a better assumption about the oil would change.
# - `rise_time=0.2e-3` in `ImposedForce`: a magnet that needs time.
# - Your own equations with this film: [own ODE with the film](own-ode.md).
#
# The whole injector, with magnet, spring and end stop: [fuel injector](../injector.md).
