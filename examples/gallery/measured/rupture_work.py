"""Work of pulling a bridge apart, at constant volume and at constant pressure: de Boer 2008."""

from __future__ import annotations

import math
from collections.abc import Callable

import numpy as np
from numpy.polynomial.legendre import leggauss

from contactkit.app.gallery.page import Check, Data, Page
from contactkit.app.gallery.run import run_page
from contactkit.capillary.exact.bridge import bridge, bridge_at_pressure
from contactkit.capillary.exact.pressure_branch import branch_at_pressure
from contactkit.capillary.exact.result import ExactBridge
from contactkit.capillary.exact.stability import stability_limit
from contactkit.plot import gallery as plot

PAGE = Page(
    name="rupture-work",
    title="Work of rupture with and without evaporation",
    claim="P.C.T. de Boer and M.P. de Boer (Langmuir 24, 2008, 160; abstract read) solve the "
    "bridge between a sphere and a flat exactly and find that evaporation, which keeps the "
    "pressure, lowers the work of rupture by a factor of about 2.",
    verdict="Holds. The factor is 2.00 to 1.95 for liquids that wet, and rises with the contact "
    "angle and the size of the meniscus: 2.28 at 60 degrees and a Kelvin radius of a hundredth of "
    "the sphere.",
    grid="quadrature with 48 gaps from touch to the limit of stability",
)
KELVIN, ANGLES = np.geomspace(1e-5, 1e-2, 10), (0.0, 30.0, 60.0)
SHOWN = 1e-3  # Kelvin radius over that of the sphere, of the force curves


def compute(draft: bool = False) -> dict[str, np.ndarray]:
    """Both works for Kelvin radii and angles, and the forces over the gap of one."""
    kelvin = KELVIN[:: 3 if draft else 1]
    work = np.array([[_works(k, math.radians(a))[0] for k in kelvin] for a in ANGLES])
    curves = {f"curve_{a:g}": _works(SHOWN, math.radians(a))[1] for a in ANGLES}
    return {"kelvin": kelvin, "work": work, **curves}


def _works(kelvin: float, angle: float) -> tuple[list[float], np.ndarray]:
    """Works at constant volume and pressure over R gamma times R, and their force curves."""
    pressure = -1.0 / kelvin
    volume = float(bridge_at_pressure(0.0, pressure, angle, angle, 0.0, 1.0).volume)
    kept = float(stability_limit(volume, angle, angle, 0.0, 1.0).gap)
    dried = float(branch_at_pressure(pressure, angle, angle, 0.0, 1.0).gap[-1])
    first, one = _work(lambda h: bridge(h, volume, angle, angle, 0.0, 1.0), kept)
    second, other = _work(lambda h: bridge_at_pressure(h, pressure, angle, angle, 0.0, 1.0), dried)
    return [first, second], np.array([*one, *other])


def _work(state: Callable[[np.ndarray], ExactBridge], end: float) -> tuple[float, list[np.ndarray]]:
    t, weight = leggauss(48)
    t = 0.5 * (t + 1.0)
    gaps = end * (1.0 - t * t)  # the force has a square root at the limit
    force = state(gaps).force
    return float(np.sum(weight * force * end * t)), [gaps, force]


def draw(data: Data) -> plot.Figure:
    """Forces over the gap, and the ratio of both works."""
    figure, (force, ratio) = plot.figure(1, 2, size=(9.5, 4.2))
    for i, degrees in enumerate(ANGLES):
        kept, pull, dried, less = data[f"curve_{degrees:g}"]
        style = plot.series(i, marker="")
        force.plot(kept / SHOWN, pull, **style | {"ls": "-"}, label=f"volume kept, {degrees:g} deg")
        label = f"pressure kept, {degrees:g} deg"
        force.plot(dried / SHOWN, less, **style | {"ls": "--"}, label=label)
        both = data["work"][i, :, 0] / data["work"][i, :, 1]
        ratio.semilogx(data["kelvin"], both, **plot.series(i), label=f"{degrees:g} deg")
    force.set(xlabel="gap / Kelvin radius [-]", ylabel=r"force / ($R\gamma$) [-]", xlim=(0.0, 10.0))
    force.set_ylim(0.0, None)
    force.legend(fontsize=8)
    ratio.axhspan(1.9, 2.3, color="0.93", zorder=0)
    ratio.set(xlabel="Kelvin radius / sphere radius [-]", ylabel="ratio of both works [-]")
    ratio.set_ylim(1.0, 3.0)
    ratio.legend(title="contact angle", loc="lower left")
    plot.letters((force, ratio), (f"Kelvin radius {SHOWN:g} $R$", 'de Boer: "about 2"'))
    return figure


def check(data: Data) -> list[Check]:
    """The factor of 2."""
    ratio = data["work"][..., 0] / data["work"][..., 1]
    return [
        Check(
            "evaporation lowers the work by a factor of about 2",
            bool(np.all((ratio > 1.9) & (ratio < 2.35))),
            f"{ratio.min():.2f} to {ratio.max():.2f}",
        ),
        Check(
            "a liquid that wets, and a small meniscus: 2",
            bool(abs(ratio[0, 0] - 2.0) < 0.01),
            f"{ratio[0, 0]:.3f} at 0 degrees and a Kelvin radius of {data['kelvin'][0]:g} R",
        ),
        Check(
            "the factor grows with the contact angle",
            bool(np.all(np.diff(ratio, axis=0) > 0.0)),
            ", ".join(f"{r:.2f}" for r in ratio[:, -1]) + f" at {data['kelvin'][-1]:g} R",
        ),
    ]


if __name__ == "__main__":
    run_page(__file__)
