"""Own ODE with the film: the force of the film in your equations of motion.

You already have a model of your valve or shutter: masses, springs, a magnet, in your own code
and your own integrator. Only the oil film is missing. How does it get in, and which integrator
survives it?
"""

# %% [markdown]
# [Live page: the force of this film over its gap](../live/film-at-a-speed.toml)
#
# ## The film alone
#
# A plan is enough: `plan.force(gap, speed)` is the sum of all listed forces, positive when it
# resists opening. The loading of the scene only states the range of gaps.

# %%
import math

import matplotlib.pyplot as plt
import numpy as np
from attrs import evolve
from scipy.integrate import solve_ivp

import contactkit as ck
from contactkit.units import celsius, mm, um

face = ck.Flat(radius=3 * mm)
film = ck.Meniscus(
    liquid=ck.load_liquid("iso-vg-46"), volume=math.pi * face.radius**2 * 10 * um
)
scene = ck.SeparationScene(
    interface=ck.Interface(lower=face, upper=face, meniscus=film),
    loading=ck.ImposedSpeed(initial_gap=10 * um, final_gap=100 * um, speed=1e-3),
    effects=(ck.ViscousForce(),),
    temperature=celsius(20),
)
plan = ck.plan(scene)
print(f"{plan.force(10 * um, 1e-3):.3f} N at 10 um and 1 mm/s")

# %% [markdown]
# ## Your equations
#
# Here: a mass of 20 g on a spring of 5 N/mm, pulled by a magnet whose force rises with a time
# constant of 0.5 ms. The film is one term of the sum.

# %%
mass, stiffness = 0.02, 5e3


def magnet(t):
    """Force of the magnet [N] over time [s]."""
    return -10.0 * math.expm1(-t / 0.5e-3)


def right_side(t, state):
    """Speed [m/s] and acceleration [m/s2]."""
    gap, speed = state
    spring = stiffness * (gap - 10 * um)
    return [speed, (magnet(t) - spring - float(plan.force(gap, speed))) / mass]


# %% [markdown]
# The run ends at a gap of 100 µm. An event finds the instant.


# %%
def released(t, state):
    """Gap beyond that of the release [m]: zero there."""
    return state[0] - 100 * um


released.terminal = True

# %% [markdown]
# ## Choose an implicit integrator
#
# A thin film is a strong damper on a small mass: the equations are stiff. An explicit method has to
# take steps of m/c, the mass over the damping coefficient.

# %%
damping = plan.force(10 * um, 1.0)
print(f"damping at 10 um  {damping:.3g} N.s/m,  m/c = {1e6 * mass / damping:.3g} us")

runs = {}
for method in ("RK45", "Radau"):
    runs[method] = solve_ivp(
        right_side,
        (0, 0.1),
        [10 * um, 0.0],
        method=method,
        events=released,
        rtol=1e-8,
        atol=[1e-14, 1e-10],
        dense_output=True,
    )
    found = runs[method]
    print(f"{method:5s} released after {1e3 * found.t_events[0][0]:.4f} ms")

# %% [markdown]
# Radau needs fewer evaluations than RK45.
#
# ## Check it against contactkit's own motion
#
# A scene with an imposed force has mass, spring and rise time too. Its integrator was made for thin
# films; both must give the same release time.

# %%
pull = ck.ImposedForce(
    initial_gap=10 * um,
    final_gap=100 * um,
    force=10.0,
    mass=mass,
    stiffness=stiffness,
    rise_time=0.5e-3,
)
own = ck.simulate(ck.plan(evolve(scene, loading=pull)))
theirs = runs["Radau"].t_events[0][0]
print(f"contactkit {1e3 * own.state.release_time:.4f} ms")
print(f"agree to 1e-6: {abs(theirs / own.state.release_time - 1) < 1e-6}")

# %%
t = np.linspace(0, theirs, 200)
gap, speed = runs["Radau"].sol(t)
figure, (left, right) = plt.subplots(1, 2, figsize=(9.0, 3.5), layout="constrained")
left.plot(1e3 * np.asarray(own.time), np.asarray(own.gap) / um, "-", label="contactkit")
left.plot(1e3 * t[::10], gap[::10] / um, "o", ms=4, label="solve_ivp")
left.set(xlabel="time [ms]", ylabel="gap [µm]")
left.set_title("Motion", loc="left")
left.legend(frameon=False)
right.plot(1e3 * t, [magnet(one) for one in t], "--", label="magnet")
right.plot(1e3 * t, plan.force(gap, speed), "-", label="film")
right.plot(1e3 * t, stiffness * (gap - 10 * um), ":", label="spring")
right.set(xlabel="time [ms]", ylabel="force [N]")
right.set_title("Forces", loc="left")
right.legend(frameon=False)
plt.show()

# %% [markdown]
# ## Where this ends
#
# `plan.force` is a function of gap and speed. A film that cavitates is not: it remembers its cavity, and
# contactkit refuses rather than guess.

# %%
cavitated = evolve(scene, effects=(ck.ViscousForce(), ck.TensionLimit(strength=1e5)))
try:
    ck.plan(cavitated).force(10 * um, 1e-3)
except ck.PlanError as error:
    print(str(error).partition(";")[0])

# %% [markdown]
# For thinner films exchange impulses or hand the mass over: forces exchanged between two programs
# can be silently wrong ([coupling](../coupling.md)).
#
# ## What to change next
#
# - `ck.MeniscusForce()` in the effects: the capillary force pulls also at rest.
# - `TensionLimit(strength=1e6, cavity="truncated")` has no memory and works here.
# - Your model is in another tool: [FMU in fmpy](fmu-in-fmpy.md).
