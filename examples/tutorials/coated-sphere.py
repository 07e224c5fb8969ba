"""Coated sphere with friction: does the coating or the steel fail first?

A hard carbon coating shall protect steel from a ball that is pressed on it and slides. How large
are the stresses in the coating and in the steel below it, and what does friction change? The
answer decides between a thicker coating and a better lubricant.
"""

# %% [markdown]
# ## Start from what is known
#
# On uncoated steel the answer is Hertz's. It gives the scale of everything that follows: the
# contact radius and the maximum pressure.

# %%
import matplotlib.pyplot as plt
import numpy as np
from attrs import evolve

import contactkit as ck
from contactkit.reference import hertz
from contactkit.units import GPa, mm, um

steel, carbon = ck.load_material("bearing-steel"), ck.load_material("dlc-hard")
radius, load = 3 * mm, 5.0
dry = hertz.sphere(load, radius, steel.plane_strain_modulus)
print(f"contact radius   {dry.contact_radius / um:.1f} um")
print(f"maximum pressure {dry.peak_pressure / GPa:.3f} GPa")

# %% [markdown]
# ## Describe the scene
#
# The lower body is a stack: 8 µm of carbon on steel. The upper one is a rigid ball; a paraboloid
# is the shape for which Hertz's result is exact.

# %%
coated = ck.Stack(
    layers=(ck.Layer(material=carbon, thickness=8 * um),), substrate=steel, name="coated"
)
ball = ck.Body(surface=ck.Paraboloid(radius=radius))

# %% [markdown]
# Stress is computed on planes at given depths, down to two contact radii. The exact layered
# half-space is one effect, friction another: full sliding along x with a coefficient of 0.4.

# %%
depths = tuple(np.r_[0, 2, 4, 6, 8, 11, 15, 20, 27, 36, 47, 60, 73] * um)
scene = ck.ContactScene(
    interface=ck.Interface(lower=ck.Body(solid=coated), upper=ball),
    window=ck.Window(width=2.4 * dry.contact_radius, periodic=False),
    loading=ck.Pressing(force=load),
    effects=(
        ck.LayeredHalfSpace(),
        ck.FrictionTraction(coefficient=0.4),
        ck.SubsurfaceStress(depths=depths, window=16.0),
    ),
)

# %% [markdown]
# ## Solve it
#
# 36 x 36 pixels are enough for a smooth ball. The result says where the maximum of the von Mises
# stress is: at the surface of the coating, because of the friction.

# %%
result = ck.solve(ck.plan(scene, ck.Accuracy(grid=36)))
worst = result.of(ck.SubsurfaceStress).maxima["von_mises"]
print(result.status)
print(f"maximum pressure   {result.max_pressure / GPa:.3f} GPa")
print(f"maximum von Mises  {worst.value / GPa:.3f} GPa in layer {worst.layer}")
print(f"at a depth of      {worst.z / um:.2f} um")

# %%
figure, ax = plt.subplots(figsize=(5.8, 3.9), layout="constrained")
result.plot.stress(ax=ax)
ax.set_title("Von Mises stress below the ball", loc="left")
plt.show()

# %% [markdown]
# The coating is stiffer than the steel and bends with it: stress jumps at the interface, and each
# material has to be looked at by itself. Layer 0 is the coating, layer 1 the steel.


# %%
def maxima(run):
    """Maximum von Mises stress [GPa] in coating and steel."""
    part = run.of(ck.SubsurfaceStress)
    stress = np.asarray(part.largest_von_mises) / GPa
    return stress[part.layer == 0].max(), stress[part.layer == 1].max()


print("coating {:.2f} GPa, steel {:.2f} GPa".format(*maxima(result)))

# %% [markdown]
# Which one is closer to failure? By Tabor's rule a material yields at about a third of its hardness.

# %%
for part, stress in zip((carbon, steel), maxima(result), strict=True):
    limit = part.hardness / 3 / GPa
    print(f"{part.name}: {stress:.2f} of {limit:.1f} GPa, {stress / limit:.0%}")

# %% [markdown]
# ## What does friction change?
#
# The pressure of a contact does not depend on this friction, so only the stress is evaluated again.

# %%
for coefficient in (0.0, 0.1, 0.2, 0.4):
    sliding = tuple(
        evolve(one, coefficient=coefficient)
        if isinstance(one, ck.FrictionTraction)
        else one
        for one in scene.effects
        if coefficient or not isinstance(one, ck.FrictionTraction)
    )
    run = ck.solve(ck.plan(evolve(scene, effects=sliding), ck.Accuracy(grid=36)))
    print(
        "mu = {:.1f}   coating {:.2f} GPa   steel {:.2f} GPa".format(
            coefficient, *maxima(run)
        )
    )

# %% [markdown]
# Friction raises the stress in the coating a lot and that in the steel little. The next question is
# the thickness.

# %%
thicknesses = np.array([4, 8, 16, 32, 64]) * um
found = []
for thickness in thicknesses:
    layer = ck.Layer(material=carbon, thickness=thickness)
    lower = ck.Body(solid=evolve(coated, layers=(layer,)))
    one = evolve(scene, interface=evolve(scene.interface, lower=lower))
    found.append(maxima(ck.solve(ck.plan(one, ck.Accuracy(grid=36)))))
found = np.array(found)
for thickness, (top, below) in zip(thicknesses, found, strict=True):
    print(f"{thickness / um:4.0f} um   coating {top:.2f} GPa   steel {below:.2f} GPa")

# %%
figure, ax = plt.subplots(figsize=(6.4, 3.6), layout="constrained")
ax.semilogx(thicknesses / um, found[:, 0], "o-", label="coating")
ax.semilogx(thicknesses / um, found[:, 1], "s--", label="steel")
ax.set_xticks(thicknesses / um, [f"{t / um:.0f}" for t in thicknesses])
ax.minorticks_off()
ax.axvline(dry.contact_radius / um, color="0.5", ls=":", lw=1)
ax.annotate(" contact radius", (dry.contact_radius / um, 0.1), color="0.35", fontsize=9)
ax.set(xlabel="thickness of the coating [µm]", ylabel="maximum von Mises stress [GPa]")
ax.set(ylim=(0, None))
ax.set_title("Ball of 3 mm, 5 N, sliding with a friction of 0.4", loc="left")
ax.legend(frameon=False)
plt.show()

# %% [markdown]
# The larger stress is in the coating, but the steel is closer to its limit. Only a coating about as
# thick as the contact radius unloads it. For the coating itself the lubricant counts more than the
# thickness.
#
# ## What to change next
#
# - Measures other than von Mises: `maxima` also has the largest tension, which cracks a coating.
# - A soft interlayer: a second `ck.Layer` between carbon and steel.
# - A rough surface in place of the ball: [own height map](height-map.md).
