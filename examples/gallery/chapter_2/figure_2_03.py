"""Fig. 2.3: a rough sphere on a layer: pressure, displacement, stress in sections."""

from __future__ import annotations

import numpy as np

import contactkit as ck
from contactkit.analyses.subsurface import MEASURES, stress_below
from contactkit.app.gallery.page import Check, Data, Page
from contactkit.app.gallery.run import run_page
from contactkit.gallery.second_method import contact, layers
from contactkit.gallery.second_method.anchors import agree
from contactkit.plot import gallery as plot
from contactkit.plot.stress import draw_section
from contactkit.reference import hertz

PAGE = Page(
    name="2.3",
    title="A rough sphere on a layer",
    claim="Roughness raises the maximum pressure to 6.37 times that of the smooth sphere. The "
    "greatest stress lies close to the surface; deeper down the influence of roughness "
    "fades. The layer changes the stress little.",
    verdict="Holds. With the printed R = 0.0137 mm the Hertz pressure would be 92 GPa; 13.7 mm is "
    "meant, and the printed E1 and E2 are strengths. The ratio 6.37 is that of the lost "
    "profile: the roughness chosen here has it at an rms height of about 0.1 um.",
    choices="Isotropic roughness, beta* of 40 um, shortest wave of eight pixels, in place of the "
    "lost profile; sections at the height nearest to the printed ratio. Poisson's ratio "
    "0.3.",
    grid="160 x 160 pixels on 260 um, not periodic",
    seeds="1 to 5; maps and sections of seed 1",
)
RADIUS, LOAD, THICKNESS, PRINTED = 13.7e-3, 14.7, 6e-6, 6.37
LAYER, BASE = (ck.Material(young_modulus=2.0 * 1.3 * g, poisson_ratio=0.3) for g in (100e9, 79.2e9))
SMOOTH = hertz.sphere(LOAD, RADIUS, BASE.plane_strain_modulus)
WIDTH = 260e-6
ROWS = (2, 4)  # depths of 3.5 and 7 um: in the layer, below it
HEIGHTS = (0.025e-6, 0.05e-6, 0.1e-6, 0.2e-6, 0.4e-6)  # rms [m]


def pressed(rms: float, seed: int, pixels: int, *, layered: bool) -> ck.ContactResult:
    """Solve the rough sphere on the layer, or on the homogeneous body."""
    surface: ck.scene.surfaces.Surface = ck.Paraboloid(radius=RADIUS)
    if rms > 0.0:
        rough = ck.GaussianRoughness(
            rms=rms, correlation_length=40e-6, cutoff=8.0 * WIDTH / pixels, seed=seed
        )
        surface = ck.CombinedSurface(parts=(surface, rough))
    layers = (ck.Layer(material=LAYER, thickness=THICKNESS),) if layered else ()
    scene = ck.ContactScene(
        interface=ck.Interface(
            lower=ck.Body(solid=ck.Stack(layers=layers, substrate=BASE)),
            upper=ck.Body(surface=surface),
        ),
        window=ck.Window(width=WIDTH, periodic=False),
        loading=ck.Pressing(force=LOAD),
        effects=(ck.LayeredHalfSpace(),),
    )
    return ck.solve(ck.plan(scene, ck.Accuracy(grid=pixels, rtol=1e-5)))


def compute(draft: bool = False) -> dict[str, np.ndarray]:
    """Maximum pressure over the rms height and seeds; maps and sections of one of them."""
    pixels, seeds = (96, (1, 2)) if draft else (160, (1, 2, 3, 4, 5))
    p0, a = SMOOTH.peak_pressure, SMOOTH.contact_radius
    peaks = np.array(
        [
            [pressed(rms, seed, pixels, layered=True).max_pressure / p0 for rms in HEIGHTS]
            for seed in seeds
        ]
    )
    rms = float(np.exp(np.interp(np.log(PRINTED), np.log(np.median(peaks, 0)), np.log(HEIGHTS))))
    depths = tuple(a * z for z in (*np.linspace(0.0, 0.2, 11), *np.linspace(0.25, 1.0, 11)))
    effect = ck.SubsurfaceStress(depths=depths, window=16.0)
    found = {"peaks": peaks, "rms": np.array(rms), "second": np.array(_second(depths))}
    for name, height, layered in (
        ("layered", rms, True),
        ("homogeneous", rms, False),
        ("smooth", 0.0, True),
    ):
        run = pressed(height, seeds[0], pixels, layered=layered)
        part = stress_below(run, effect)
        found[f"{name}_pressure"] = run.pressure[part.row]
        found[f"{name}_displacement"] = run.displacement[part.row]
        found[f"{name}_height"] = run.heights[part.row]
        found[f"{name}_section"] = MEASURES["sqrt_j2"](part.section)
        found[f"{name}_z"], found[f"{name}_layer"] = part.depth, part.layer
        if name == "smooth":
            at = [int(np.argmin(np.abs(part.depth - depths[i]))) for i in ROWS]
            found["smooth_rows"] = found["smooth_section"][at].max(axis=1)
        best = part.maxima["sqrt_j2"]
        found[f"{name}_maximum"] = np.array([best.value, best.z])
    return found


def _second(depths: tuple[float, ...]) -> list[float]:
    """Largest pressure, root of J2 in the layer and below it [Pa] of the smooth sphere.

    By the second method on a wide periodic window: images six contact diameters away change the
    pressure by less than 1e-3, pixels of 4 um by as much.
    """
    pixels, width = 256, 1.04e-3
    x = (np.arange(pixels) / pixels - 0.5) * width
    heights = -(x**2 + x[:, None] ** 2) / (2.0 * 13.7e-3)
    solid = layers.Layers((260e9, 2.6 * 79.2e9), 0.3, (6e-6,))
    symbol = layers.compliance(pixels, width, solid)
    pressure = contact.pressed(heights, symbol, 14.7 / width**2)[0]
    planes = [layers.stress(pressure, width, solid, depths[i], 0.0) for i in ROWS]
    return [float(pressure.max()), *(layers.maxima(one)[0] / 3.0**0.5 for one in planes)]


def draw(data: Data) -> tuple[plot.Figure, plot.Figure]:
    """Profiles and the maximum over the rms height; sections."""
    n = len(data["layered_pressure"])
    x = WIDTH * ((np.arange(n) + 0.5) / n - 0.5) * 1e6
    first, ((top, over), (middle, bottom)) = plot.figure(2, 2, size=(8.2, 5.4))
    for i, name in enumerate(("smooth", "layered")):
        label = {"smooth": "smooth", "layered": f"rms {float(data['rms']) * 1e6:.2f} um"}[name]
        style = plot.series(i, marker="", lw=1.1)
        top.plot(x, -data[f"{name}_height"] * 1e6, label=label, **style)
        middle.plot(x, data[f"{name}_pressure"] / 1e9, label=label, **style)
        bottom.plot(x, data[f"{name}_displacement"] * 1e6, label=label, **style)
    top.set(ylabel="height of the sphere [um]")
    middle.set(ylabel="pressure [GPa]")
    bottom.set(ylabel="displacement [um]")
    bottom.invert_yaxis()
    for ax in (top, middle, bottom):
        ax.set(xlabel="x [um]")
        ax.legend(fontsize=8)
    plot.band(over, np.array(HEIGHTS) * 1e6, data["peaks"], 1, f"{len(data['peaks'])} seeds")
    over.axhline(PRINTED, color="k", lw=1.0, label=f"printed: {PRINTED}")
    over.set(xscale="log", yscale="log", xlabel="rms height [um]")
    over.set_ylabel("maximum pressure / $p_0$ [-]")
    over.legend(fontsize=8)
    plot.plain_log(over.xaxis)
    plot.plain_log(over.yaxis)
    names = ("the sphere", "maximum pressure", "pressure", "displacement")
    plot.letters((top, over, middle, bottom), names)
    second, axes = plot.figure(3, 1, size=(7.4, 6.8), sharex=True)
    levels = [0.1 * i for i in range(11)]
    titles = {
        "smooth": "smooth sphere on the layer",
        "homogeneous": "rough sphere, homogeneous body",
        "layered": "rough sphere on the layer",
    }
    for ax, (name, title) in zip(axes, titles.items(), strict=True):
        z, layer = data[f"{name}_z"] * 1e6, data[f"{name}_layer"]
        draw_section(x, z, layer, data[f"{name}_section"] / 1e9, ax, levels=levels)
        ax.set(ylabel="z [um]", xlim=(-110.0, 110.0))
        best, depth = data[f"{name}_maximum"]
        ax.set_title(
            f"{title}: {best / 1e9:.2f} GPa, {depth * 1e6:.1f} um deep", fontsize=9, loc="left"
        )
    axes[-1].set_xlabel("x [um]")
    plot.colour_bar(second, axes, levels, r"$\sqrt{J_2}$ [GPa]; circle: maximum of the section")
    return first, second


def check(data: Data) -> list[Check]:
    """The printed ratio, the place of the maximum, depth and layer."""
    a, median = SMOOTH.contact_radius, np.median(data["peaks"], axis=0)
    rough, smooth = data["layered_section"], data["smooth_section"]
    deep = data["layered_z"] > 0.6 * a
    off = np.abs(rough[deep] - smooth[deep]).max() / smooth[deep].max()
    near = np.abs(rough[:3] - smooth[:3]).max() / smooth[:3].max()
    best, plain = data["layered_maximum"], data["homogeneous_maximum"]
    change = best[0] / plain[0] - 1.0
    return [
        Check(
            "the rougher the sphere, the higher the maximum pressure",
            bool((np.diff(data["peaks"], axis=1) > 0.0).all()),
            ", ".join(f"{p:.2f}" for p in median) + " times that of the smooth sphere",
        ),
        Check(
            f"the printed ratio {PRINTED} is reached by an rms height inside the range",
            bool(median[0] < PRINTED < median[-1]),
            f"at {float(data['rms']) * 1e9:.0f} nm",
        ),
        Check(
            "the greatest stress lies within a tenth of the contact radius of the surface",
            bool(best[1] < 0.1 * a),
            f"{best[1] * 1e6:.1f} um deep, contact radius {a * 1e6:.0f} um",
        ),
        Check(
            "deeper than 0.6 contact radii the stress is that of the smooth sphere to 40 %",
            bool(off < 0.4),
            f"{100.0 * off:.0f} % of the maximum there; near the surface {100.0 * near:.0f} %",
        ),
        Check(
            "the layer changes the greatest stress by less than its modulus, 26 %",
            bool(abs(change) < 0.26),
            f"{100.0 * change:+.0f} %",
        ),
        agree("smooth sphere: pressure", data["smooth_pressure"].max(), data["second"][0]),
        agree(  # greatest at the edge of contact, where pixels of 1.6, 2.7 and 4 um differ by 3 %
            "smooth sphere: root of J2 in the layer and below it",
            data["smooth_rows"],
            data["second"][1:],
            0.05,
        ),
    ]


if __name__ == "__main__":
    run_page(__file__)
