"""Side view of a micromirror: the whole to scale, and one tip with its meniscus."""

from __future__ import annotations

import math
from pathlib import Path
from typing import Any

import numpy as np

from ....plot import style as plot
from ....separation.plan import Plan
from ..mirror import root_height
from ..scene import MicromirrorScene

__all__ = ["sketch"]

_METAL, _SITE, _WATER = "#8aa0b5", "#7a6a58", "#58b4d1"


def sketch(scene: MicromirrorScene, made: Plan, out: Path) -> Path:
    """Draw the side view of a landed mirror and of one of its tips into a folder."""
    figure, (whole, near) = plot.figure(1, 2, (11.0, 4.4), width_ratios=(1.5, 1))
    _mirror(whole, scene)
    _tip(near, scene, made)
    plot.letters((whole, near))
    return plot.save(figure, out / "side-view")


def _mirror(ax: Any, scene: MicromirrorScene) -> None:
    """Draw the mirror, landed under its bias, over its electrodes and sites."""
    mirror, um = scene.mirror, 1e6
    tips, pad = mirror.tips, mirror.electrode
    tilt, _ = scene.start
    site = -tips.arm * math.sin(tips.landing_tilt) * um  # unbent tips hang level with the axis
    floor = -pad.gap * um
    reach = 1.12 * tips.arm * um
    ax.fill_between([-reach, reach], floor - 0.35, floor - 0.12, color="0.85", lw=0)
    for side in (1.0, -1.0):
        edges = [side * pad.inner * um, side * pad.outer * um]
        ax.fill_between(sorted(edges), floor - 0.12, floor, color=plot.COLORS["magnet"], lw=0)
        middle, width = side * tips.arm * um, 0.55
        ax.fill_between([middle - width, middle + width], floor - 0.12, site, color=_SITE, lw=0)
    for angle, color, style in ((0.0, "0.75", "--"), (-tilt, "0.75", "--"), (tilt, _METAL, "-")):
        ends = np.array([-pad.outer, pad.outer]) * um
        ax.plot(
            ends * math.cos(angle),
            -ends * math.sin(angle),
            style,
            color=color,
            lw=5.0 if style == "-" else 1.5,
            solid_capstyle="butt",
        )
    _tips(ax, scene, tilt, site)
    ax.plot(0.0, 0.0, "o", color="k", ms=7)
    ax.annotate("hinge", (0.0, 0.0), xytext=(0, 12), textcoords="offset points", ha="center")
    ax.annotate(
        "spring tip",
        (0.97 * tips.arm * um, site),
        xytext=(-10, 34),
        ha="center",
        textcoords="offset points",
        arrowprops={"arrowstyle": "-"},
    )
    ax.annotate(
        "landing site",
        (tips.arm * um, floor),
        xytext=(0, -26),
        textcoords="offset points",
        ha="center",
    )
    ax.annotate(
        "electrode",
        (-0.5 * (pad.inner + pad.outer) * um, floor),
        xytext=(0, -26),
        textcoords="offset points",
        ha="center",
    )
    ax.set(xlabel="distance from the axis [um]", ylabel="height over the axis [um]")
    ax.set_aspect("equal")
    ax.set_ylim(floor - 1.25, 1.7)
    bend = -root_height(tips, tilt, 1.0) * 1e9
    plot.title(
        ax, f"landed under its bias at {math.degrees(tilt):.2f} deg, tips bent {bend:.0f} nm"
    )


def _tips(ax: Any, scene: MicromirrorScene, tilt: float, site: float) -> None:
    """Draw the spring tips of both sides; a landed one is bent by its site [um]."""
    tips, pad, um = scene.mirror.tips, scene.mirror.electrode, 1e6
    for side in (1.0, -1.0):
        start, end = side * pad.outer * um, side * tips.arm * um
        height = -end * math.sin(tilt)
        apex = max(height, site)
        places = np.linspace(0.0, 1.0, 20)
        run = start + (end - start) * places
        ax.plot(
            run * math.cos(tilt),
            -run * math.sin(tilt) + (apex - height) * places**2,
            color=plot.COLORS["meniscus"],
            lw=2.2,
        )


def _tip(ax: Any, scene: MicromirrorScene, made: Plan) -> None:
    """Draw the apex of a tip over its site, with the condensed meniscus."""
    nm, gap = 1e9, scene.loading.initial_gap
    radius = made.scene.interface.sphere_radius
    contact = _meniscus(ax, made) if made.scene.meniscus.volume else 0.2 * radius
    half = min(2.2 * contact, 0.9 * radius)
    x = np.linspace(-half, half, 400)
    under = gap + radius - np.sqrt(radius * radius - x * x)
    top = 1.15 * float(under.max())
    ax.fill_between(x * nm, under * nm, top * nm, color=plot.COLORS["meniscus"], alpha=0.5, lw=0)
    ax.fill_between(x * nm, -0.25 * top * nm, 0.0, color=_SITE, lw=0)
    ax.set(xlabel="distance from the axis of the tip [nm]", ylabel="height over the site [nm]")
    ax.set_ylim(-0.25 * top * nm, top * nm)
    humidity = 100 * scene.study.humidity
    plot.title(ax, f"apex of a tip at {humidity:g} % humidity (heights stretched)")
    ax.annotate(f"tip, radius {radius * nm:g} nm", (0.0, 0.75 * top * nm), ha="center")
    ax.annotate("landing site", (0.0, -0.16 * top * nm), ha="center", color="w")


def _meniscus(ax: Any, made: Plan) -> float:
    """Fill the meniscus; the radius [m] of its upper contact circle."""
    from ....capillary.exact.bridge import bridge

    interface, meniscus = made.scene.interface, made.scene.meniscus
    gap, curvature = made.scene.loading.initial_gap, interface.curvatures[1]
    angle = meniscus.contact_angle_lower
    found = bridge(
        gap, made.prepared.film.volume, angle, meniscus.contact_angle_upper, 0.0, curvature
    )
    low, high = float(found.radius_lower), float(found.radius_upper)
    sag = 1.0 / curvature - math.sqrt(1.0 / curvature**2 - high * high)
    height = gap + sag
    # Circle through both contact points that meets the site at its contact angle.
    across = high - low
    round_ = (across**2 + height**2) / (2.0 * (across * math.sin(angle) + height * math.cos(angle)))
    z = np.linspace(0.0, height, 200)
    lift = np.clip((z - round_ * math.cos(angle)) / round_, -1.0, 1.0)
    r = low + round_ * math.sin(angle) - round_ * np.sqrt(1.0 - lift**2)
    solid = np.sqrt(np.maximum(1.0 / curvature**2 - (1.0 / curvature - (z - gap)) ** 2, 0.0))
    inner = np.where(z > gap, solid, 0.0)
    # Drawn as an arc, which looks the same as the exact meridian.
    for side in (1.0, -1.0):
        ax.fill_betweenx(z * 1e9, side * inner * 1e9, side * r * 1e9, color=_WATER, lw=0)
    at = 0.5 * height
    ax.annotate(
        "water",
        (0.97 * float(np.interp(at, z, r)) * 1e9, at * 1e9),
        xytext=(30, 10),
        textcoords="offset points",
        arrowprops={"arrowstyle": "-"},
    )
    return high
