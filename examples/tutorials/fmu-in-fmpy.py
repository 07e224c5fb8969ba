"""FMU in fmpy: the film as a component of a system simulation.

A systems engineer wants the sticking spool as a block: pull in, motion out, without a word about
films. An FMU is that block. This page builds one, looks into it, runs it and measures what the
communication step costs in accuracy.
"""

# %% [markdown]
# [Live page: what the block will do](../live/film-of-the-fmu.toml)
#
# ## Build it from a scene
#
# A mass of 20 g held by 20 µm of oil, pulled by 10 N. Its values become the start values of the FMU,
# so that it runs as it is. This needs the extra `fmu`.

# %%
import math
from pathlib import Path

import fmpy
import matplotlib.pyplot as plt
import numpy as np

import contactkit as ck
from contactkit.fmu.python.build import build, validate
from contactkit.fmu.slaves.stiction_mass import mass_values
from contactkit.units import mm, um

face = ck.Flat(radius=3 * mm)
oil = ck.Liquid(name="oil", viscosity=0.1, surface_tension=0.03)
scene = ck.SeparationScene(
    interface=ck.Interface(
        lower=face,
        upper=face,
        meniscus=ck.Meniscus(liquid=oil, volume=math.pi * face.radius**2 * 20 * um),
    ),
    loading=ck.ImposedForce(initial_gap=20 * um, final_gap=100 * um, force=10.0, mass=0.02),
    effects=(ck.ViscousForce(),),
)
fmu = build("stiction-mass", Path("."), start=mass_values(scene))
print(fmu.name, "findings of the check:", validate(fmu))

# %% [markdown]
# On the command line the same is `contactkit fmu build film.toml --out film.fmu`; with `--native` it
# needs no Python on the host.
#
# ## Run it alone
#
# fmpy sets the pull and steps the FMU. It does not raise when a step is discarded, so compare its
# last time with the stop time.

# %%
stop = 10e-3
output = ["h", "F", "t_release"]
alone = fmpy.simulate_fmu(
    str(fmu),
    start_values={"F_ext": 10.0},
    stop_time=stop,
    output=output,
    output_interval=1e-4,
)
assert abs(alone["time"][-1] - stop) < 1e-9
print(f"released after {1e3 * alone['t_release'][-1]:.4f} ms")

# %% [markdown]
# The film is integrated inside the FMU with error control. One step or a hundred: a constant pull
# gives the result of `ck.simulate`.

# %%
result = ck.simulate(ck.plan(scene))
error = alone["t_release"][-1] / result.state.release_time - 1
print(f"ck.simulate     {1e3 * result.state.release_time:.4f} ms")
print("same to 1e-7:", abs(error) < 1e-7)

# %%
figure, ax = plt.subplots(figsize=(6.4, 3.6), layout="constrained")
ax.plot(
    1e3 * np.asarray(result.time), np.asarray(result.gap) / um, "-", label="ck.simulate"
)
until = alone["time"] <= alone["t_release"][-1]
ax.plot(
    1e3 * alone["time"][until], alone["h"][until] / um, "o", ms=3, label="FMU, every 0.1 ms"
)
ax.set(xlabel="time [ms]", ylabel="gap [µm]")
ax.set_title("Spool of 20 g, 20 µm of oil, 10 N", loc="left")
ax.legend(frameon=False)
plt.show()

# %% [markdown]
# ## A pull that varies
#
# A real magnet rises. Within a step the FMU takes the pull to be `F_ext + dF_ext * t`; a host that
# leaves the rate `dF_ext` at 0 holds the pull constant, and pays with accuracy. First the exact answer.

# %%
rise = 1e-3
exact = ck.simulate(
    ck.plan(
        ck.SeparationScene(
            interface=scene.interface,
            loading=ck.ImposedForce(
                initial_gap=20 * um,
                final_gap=100 * um,
                force=10.0,
                mass=0.02,
                rise_time=rise,
            ),
            effects=scene.effects,
        )
    )
).state.release_time
print(f"exact {1e3 * exact:.4f} ms")


# %% [markdown]
# fmpy reads inputs from an array over time. A table of the pull, with and without its rate, at three
# communication steps:


# %%
def release(step, with_rate):
    """Release time [s] with a communication step [s]."""
    t = np.arange(0.0, stop + step / 2, step)
    pull = -10.0 * np.expm1(-t / rise)
    rate = np.append(np.diff(pull) / step, 0.0) if with_rate else np.zeros_like(t)
    kind = [("time", float), ("F_ext", float), ("dF_ext", float)]
    table = np.array(list(zip(t, pull, rate, strict=True)), dtype=kind)
    found = fmpy.simulate_fmu(
        str(fmu),
        input=table,
        stop_time=stop,
        output=["t_release"],
        output_interval=step,
        step_size=step,
    )
    return found["t_release"][-1]


steps = np.array([4e-4, 2e-4, 1e-4, 5e-5])
errors = {
    name: np.abs([release(step, rate) / exact - 1 for step in steps])
    for name, rate in (("pull held", False), ("pull with rate", True))
}
for name, values in errors.items():
    print(f"{name:15s}" + "".join(f"  {value:.1e}" for value in values))

# %%
figure, ax = plt.subplots(figsize=(6.4, 3.6), layout="constrained")
for (name, values), style in zip(errors.items(), ("s--", "o-"), strict=True):
    ax.loglog(1e6 * steps, values, style, label=name)
ax.set_xticks(1e6 * steps, [f"{1e6 * step:.0f}" for step in steps])
ax.minorticks_off()
ax.set(xlabel="communication step [µs]", ylabel="relative error of the release time")
ax.set_title("What the communication step costs", loc="left")
ax.legend(frameon=False)
plt.show()

# %% [markdown]
# Held, the error falls with the step; with the rate it falls with its square. If your tool can give the
# rate of an input, connect it.
#
# ## What to change next
#
# - `stiction-force`, if the other tool must own the mass: read [coupling](../coupling.md) first.
# - Put it into another tool: [export to other tools](../how-to/export-fmu.md).
#
# All variables: [FMUs and their variables](../fmu-models.md).
