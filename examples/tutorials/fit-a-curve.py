"""Fit: what does a pull-off curve tell about the oil?

A ball of 2 mm is drawn off a wet plate and the force is recorded over the gap. How much oil is
there, how viscous is it, and does this curve decide that at all? `ck.fit` answers with values, how
sure they are, and what the data leave open.
"""

# %% [markdown]
# ## The scene is the model
#
# The scene is the one that would be simulated. What is sought keeps a first guess in it.

# %%
import matplotlib.pyplot as plt
import numpy as np

import contactkit as ck
from contactkit.units import deg, mm, um

oil = ck.Liquid(name="oil", viscosity=1.0, surface_tension=0.02, density=970.0)
film = ck.Meniscus(
    liquid=oil,
    volume=0.02 * mm**3,
    contact_angle_lower=20 * deg,
    contact_angle_upper=20 * deg,
)
scene = ck.SeparationScene(
    interface=ck.Interface(upper=ck.Sphere(radius=1 * mm), meniscus=film),
    loading=ck.ImposedSpeed(speed=1 * um, initial_gap=1 * um, final_gap=120 * um),
    effects=(ck.MeniscusForce(profile="arc"), ck.ViscousForce()),
)

# %% [markdown]
# ## Readings
#
# Here they are made, so that the answer is known: 0.4 Pa.s, 0.012 mm3, and a gap that was zeroed
# 1.5 um too early, at two speeds and with 2 % of noise. Yours come from
# `ck.read_measured_curve("pull.csv", over="gap", quantity="pull")`, from a data frame, or, of an
# atomic force microscope, from `ck.read_force_curve("tip.jpk-force")`.

# %%
viscosity = "interface.meniscus.liquid.viscosity"
volume = "interface.meniscus.volume"


def reading(speed, seed):
    """Force over the gap as the instrument has it."""
    liquid = ck.Liquid(name="oil", viscosity=0.4, surface_tension=0.02, density=970.0)
    wet = ck.Meniscus(
        liquid=liquid,
        volume=0.012 * mm**3,
        contact_angle_lower=20 * deg,
        contact_angle_upper=20 * deg,
    )
    truth = ck.SeparationScene(
        interface=ck.Interface(upper=ck.Sphere(radius=1 * mm), meniscus=wet),
        loading=ck.ImposedSpeed(speed=speed, initial_gap=1 * um, final_gap=120 * um),
        effects=scene.effects,
    )
    run = ck.simulate(ck.plan(truth))
    gap = np.geomspace(5 * um, 100 * um, 25)
    noise = 1.0 + 0.02 * np.random.default_rng(seed).standard_normal(gap.size)
    return ck.MeasuredCurve(
        over="gap",
        at=(gap - 1.5 * um) / um,
        quantity="pull",
        values=1e3 * np.interp(gap, run.gap, run.pull) * noise,
        units=("um", "mN"),
        noise="2 %",
        sets={"loading.speed": speed},
        name=f"{speed / um:g} um/s",
    )


slow, fast = reading(1 * um, 1), reading(20 * um, 2)

# %% [markdown]
# ## One slow curve
#
# A parameter is the path of a field of the scene, as in a study, with a range. Ranges of more than a
# decade are fitted by their logarithm. The zero of the gap is a nuisance: it belongs to the
# instrument.

# %%
sought = {
    viscosity: ck.Range("10 mPa.s", "100 Pa.s"),
    volume: ck.Range("0.001 mm3", "0.1 mm3"),
}
zero = {"shift": ck.Range("-3 um", "3 um", "first touch, by eye")}
one = ck.fit(scene, slow, sought, nuisance=zero)
print(one)

# %% [markdown]
# The volume is decided. The viscosity is not: at 1 um/s the film pulls with a few per cent of the
# force, and what it adds a wrong zero of the gap takes away. The verdict states it, and what would
# help: a `ck.Prior("0.4 Pa.s", "5 %", "rheometer")` in place of the range, or another curve.
#
# ## Both speeds
#
# A second curve sets its own speed and shares everything else.

# %%
both = ck.fit(scene, [slow, fast], sought, nuisance=zero)
print(both)

# %%
figure, (ax, below) = plt.subplots(2, 1, figsize=(6.4, 5.6), layout="constrained", sharex=True)
both.plot.data(ax=ax)
ax.set_xlabel("")
both.plot.information(ax=below)
ax.set_title("Two pull-off curves, and what decides what", loc="left")
plt.show()

# %% [markdown]
# The lower figure shows where the information is: the viscosity comes from the first micrometres of
# the fast curve, the volume from the far end, where the bridge thins. Measure more points there.
#
# ## Is it the right model?
#
# Two scenes, the same data: the criterion compares them, and `Fit.status` is `misfit` where even the
# better one misses more than noise.

# %%
dry = ck.SeparationScene(
    interface=scene.interface, loading=scene.loading, effects=(ck.MeniscusForce(profile="arc"),)
)
static = ck.fit(
    dry,
    [slow, fast],
    {key: one for key, one in sought.items() if key != viscosity},
    nuisance=zero,
    intervals="linear",
)
print(static.status)
print(ck.compare_fits({"bridge and film": both, "bridge alone": static}))

# %% [markdown]
# ## What to change next
#
# - `both.scene` is the fitted scene: run it, export it, `print(both.to_toml())`.
# - `both.profile("viscosity").plot.rise()` draws the profile likelihood, `both.sample()` a posterior.
# - `stiffness=` of a curve puts the spring of a cantilever in between, which jumps as a cantilever does.
# - `both.save("fit.npz")`, `ck.read_fit("fit.npz")`; `contactkit fit SCENE --data pull.csv ...` from a
#   shell.
#
# All of it: [fit measured curves](../how-to/fit.md).
