"""Own effect: residual magnetism beside the oil film.

A solenoid valve opens late although its film is thin. Besides the film, the iron keeps some
magnetism after the current is off, and holds the armature. contactkit has no such force. How do
you add yours so that plans, results, curves and files know it?
"""

# %% [markdown]
# ## The force as a function
#
# Physics first: a plain function of the gap. A magnetic circuit with a fixed reluctance attracts with
# a force that falls with the square of the air gap plus an equivalent gap of the iron.

# %%
import math
import tempfile
from pathlib import Path
from typing import ClassVar

import matplotlib.pyplot as plt
from attrs import evolve, field, frozen

import contactkit as ck
from contactkit.scene.column import Column
from contactkit.separation.effects.base import ForceLaw, SeparationForce
from contactkit.units import celsius, mm, si, um
from contactkit.validators import positive


def magnetic_force(gap, closed_force, iron_gap):
    """Force of a magnetic circuit [N] over its air gap [m]."""
    return closed_force / (1.0 + gap / iron_gap) ** 2


print(f"{magnetic_force(50 * um, 8.0, 50 * um):.2f} N at 50 um")

# %% [markdown]
# ## The force as an effect
#
# The class says everything else once: its name in files, its curve with unit and colour, its source, and
# its parameters with units. `prepare` gives the law that is called in every step.


# %%
@frozen(kw_only=True)
class ResidualMagnetism(SeparationForce):
    """Attraction by the residual magnetism of a solenoid.

    Parameters
    ----------
    closed_force : float
        Force of the closed circuit [N].
    iron_gap : float
        Air gap with the reluctance of the iron [m].
    """

    name: ClassVar[str] = "residual-magnetism"
    summary: ClassVar[str] = "attraction by residual magnetism"
    column: ClassVar[Column] = Column("magnetic_force", "N", "magnetic force", "#e69f00")
    needs_film: ClassVar[bool] = False
    takes_pressure: ClassVar[bool] = True
    sources = ("magnetic circuit of constant reluctance, F ~ 1/(h + h_iron)^2",)

    closed_force: float = field(validator=positive, metadata=si("N"))
    iron_gap: float = field(validator=positive, metadata=si("m"))

    def prepare(self, prepared):
        """Law of the force over gap and speed."""
        return ForceLaw(
            lambda gap, speed: magnetic_force(gap, self.closed_force, self.iron_gap)
        )


ck.register(ResidualMagnetism)

# %% [markdown]
# `needs_film = False` says that the force stays when the film has broken. After `register` it is an
# effect as any other.
#
# ## Use it
#
# An armature of 5 g, 10 µm of oil at room temperature, a spring that opens with 12 N.

# %%
face = ck.Flat(radius=2 * mm)
film = ck.Meniscus(
    liquid=ck.load_liquid("iso-vg-46"), volume=math.pi * face.radius**2 * 10 * um
)
scene = ck.SeparationScene(
    interface=ck.Interface(lower=face, upper=face, meniscus=film),
    loading=ck.ImposedForce(initial_gap=10e-6, final_gap=100e-6, force=12.0, mass=5e-3),
    effects=(ck.ViscousForce(), ResidualMagnetism(closed_force=8.0, iron_gap=50e-6)),
    temperature=celsius(20),
)
plan = ck.plan(scene)
print(*[line for line in str(plan).splitlines() if "  on " in line], sep="\n")

# %% [markdown]
# The result has its curve and its impulse, by the class and by the name of the column.

# %%
result = ck.simulate(plan)
print(result.message)
own = result.of(ResidualMagnetism)
print(f"magnetic force {own.force[0]:.2f} N at the start, {own.force[-1]:.2f} N at the end")
print(f"impulse        {1e3 * own.impulse:.3f} mN.s")

# %% [markdown]
# ## What does it cost?
#
# Leaving the effect out answers the engineer's question: which part of the delay is oil, which is magnetism?

# %%
without = ck.simulate(ck.plan(evolve(scene, effects=(ck.ViscousForce(),))))
only = ck.simulate(ck.plan(evolve(scene, effects=scene.effects[1:])))
for name, run in (("both", result), ("oil only", without), ("magnetism only", only)):
    print(f"{name:15s} released after {1e3 * run.state.release_time:.4f} ms")

# %%
figure, (left, right) = plt.subplots(1, 2, figsize=(9.0, 3.5), layout="constrained")
for run, style, label in ((result, "-", "oil and magnetism"), (without, "--", "oil only")):
    left.plot(1e3 * run.time, run.gap / um, style, label=label)
left.set(xlabel="time [ms]", ylabel="gap [µm]")
left.set_title("Motion", loc="left")
left.legend(frameon=False)
result.plot.forces(ax=right)
right.set_title("Forces", loc="left")
plt.show()

# %% [markdown]
# The own force is in the figure like the others.
#
# ## In files
#
# Scenes with the effect are saved and loaded. A program that has not registered it gets an error that names it.

# %%
with tempfile.TemporaryDirectory() as folder:
    path = Path(folder) / "valve.toml"
    ck.save_scene(scene, path)
    print(*path.read_text().splitlines()[-4:], sep="\n")
    print("the same scene:", ck.load_scene(path) == scene)

# %% [markdown]
# ## What to change next
#
# - A wrong value, `closed_force=-8.0`: the message names field, value and unit.
# - `lacks(self, scene)`: what a scene must have for your force.
# - An entry point of your package, and no one has to call `register`:
#   [own effect](../how-to/own-effect.md).
