"""Fig. 3.8: meridians of a meniscus under a rising sphere, with and without a gap at the start."""

from __future__ import annotations

from typing import Any

import numpy as np

from contactkit.app.gallery.page import Check, Page
from contactkit.app.gallery.run import run_page
from contactkit.capillary.arc.profile import arc_profile
from contactkit.capillary.exact.bridge import bridge
from contactkit.capillary.exact.profile import profile
from contactkit.gallery.chapter_3.films import RADIUS, angles, sphere_break_gaps, sphere_volume
from contactkit.gallery.second_method.anchors import agree
from contactkit.plot import style as plot
from contactkit.plot.gallery import Figure, letters
from contactkit.units import nm

PAGE = Page(
    name="3.8",
    title="Menisci under a rising sphere",
    claim="A meniscus of 2 nm height under a sphere of 100 nm (60/60 degrees) breaks earlier if "
    "there is a gap of 1 nm at the start than if the sphere touches the flat.",
    verdict="It holds: of the same height at the rim the film with a gap has three quarters of "
    "the liquid. The exact bridge breaks at less than a third of the gap at which the "
    "neck of the arc closes.",
    grid="101 points along each meridian",
    choices="Volume of the revolved arc; limit of stability on the sphere, closed neck on the "
    "paraboloid of Eq. (3.37).",
)

HEIGHT, PAIR = 2 * nm, (60, 60)
STARTS = (0.0, 1 * nm)
STEPS = (0.0, 0.25, 0.6, 1.0)
COLORS = ("#440154", "#3b528b", "#21918c", "#d9a400")


def compute(draft: bool = False) -> dict[str, Any]:
    """Meridians at some gaps up to the exact limit, heights from the flat."""
    count = 41 if draft else 101
    data: dict[str, Any] = {"volumes": np.array([sphere_volume(d, HEIGHT) for d in STARTS])}
    film = (*angles(PAIR), 0.0, 1.0 / RADIUS)
    for i, (start, liquid) in enumerate(zip(STARTS, data["volumes"].tolist(), strict=True)):
        limit, closed = sphere_break_gaps(liquid)
        gaps = [start + (limit * (1.0 - 1e-7) - start) * step for step in STEPS]
        curves = []
        for gap in gaps:
            exact = profile(bridge(gap, liquid, *film), count)
            curves.append([*exact, *arc_profile(gap, liquid, *film, count=count)])
        data |= {
            f"limits_{i}": np.array([limit, closed]),
            f"gaps_{i}": np.array(gaps),
            f"curves_{i}": np.array(curves),
        }
    return data


def draw(data: dict[str, Any]) -> Figure:
    """One panel for each gap at the start, both to the same scale."""
    figure, panels = plot.figure(1, 2, size=(9.6, 3.9), sharex=True, sharey=True)
    for i, ax in enumerate(panels):
        limit = data[f"limits_{i}"][0]
        for gap, curve, color in zip(data[f"gaps_{i}"], data[f"curves_{i}"], COLORS, strict=True):
            r, z, r_arc, z_arc = curve / nm
            label = f"{gap / nm:.3g} nm" + (", limit" if gap > 0.99 * limit else "")
            ax.plot(*_both(r, z), color=color, label=label)
            ax.plot(*_both(r_arc, z_arc), "--", color=color, lw=1.2)
            x = np.linspace(-27.0, 27.0, 61)
            body = gap / nm + x**2 / (RADIUS / nm + np.sqrt((RADIUS / nm) ** 2 - x**2))
            ax.plot(x, body, color=color, lw=0.7, alpha=0.6)
        ax.set(aspect="equal", xlim=(-27.0, 27.0), ylim=(0.0, 27.0), xlabel="radius [nm]")
        plot.legend(
            ax, fontsize=8, loc="upper center", ncols=2, title="gap: exact solid, arc dashed"
        )
    panels[0].set_ylabel("height [nm]")
    letters(list(panels), [f"gap of {start / nm:g} nm at the start" for start in STARTS])
    return figure


def _both(r: Any, z: Any) -> tuple[Any, Any]:
    """Both sides of a meridian as one line."""
    return np.concatenate((r, [np.nan], -r)), np.concatenate((z, [np.nan], z))


def check(data: dict[str, Any]) -> list[Check]:
    """Order of the rupture gaps, and how far the two criteria are apart."""
    (touching, touching_arc), (apart, apart_arc) = (data[f"limits_{i}"] / nm for i in (0, 1))
    liquid = data["volumes"] / nm**3
    return [
        Check(
            "with a gap at the start the meniscus breaks earlier, by either criterion",
            apart < touching and apart_arc < touching_arc,
            f"exact {apart:.2f} against {touching:.2f} nm, "
            f"arc {apart_arc:.1f} against {touching_arc:.1f} nm",
        ),
        Check(
            "it has less liquid, in proportion to the difference of squares of Eq. (3.23)",
            abs(liquid[1] / liquid[0] - 0.75) < 0.01,
            f"{liquid[1]:.1f} against {liquid[0]:.1f} nm3",
        ),
        Check(
            "the neck of the arc closes at more than three times the exact limit",
            min(apart_arc / apart, touching_arc / touching) > 3.0,
            f"{apart_arc / apart:.2f} and {touching_arc / touching:.2f} times",
        ),
        agree(
            "gap at which the neck of the arc closes, 1 nm at the start (section 3.2.3)",
            data["limits_1"][1],
            45.204e-9,
            1e-3,
        ),
    ]


if __name__ == "__main__":
    run_page(__file__)
