"""A roller on a rubber sheet that lies on a rigid table: nip width and pressure over thickness.

A line contact: the window repeats along the roller alone. A thick sheet is Hertz's half-space. A
thin one that is bonded to the table hardly gives way, because rubber keeps its volume: the nip
narrows and the pressure grows. One that slides along the table can still escape sideways.
"""

from __future__ import annotations

import math
import sys
from pathlib import Path

import contactkit as ck
from contactkit.plot import style as plot
from contactkit.units import MPa, mm

RADIUS, LINE_LOAD = 50 * mm, 2e3  # [m], [N/m]
RUBBER = ck.Material(name="rubber", young_modulus=5 * MPa, poisson_ratio=0.49)
WIDTH, PIXELS = 16 * mm, (256, 8)  # across the roller; a strip of pixels along it


def pressed(thickness: float, bonded: bool) -> ck.ContactResult:
    """Rigid roller on a sheet; along its axis its curvature is negligible."""
    along = WIDTH * PIXELS[1] / PIXELS[0]
    sheet = ck.Stack(
        layers=(ck.Layer(material=RUBBER, thickness=thickness),),
        substrate=ck.RigidBase(bonded=bonded),
    )
    scene = ck.ContactScene(
        interface=ck.Interface(
            lower=ck.Body(solid=sheet),
            upper=ck.Body(surface=ck.Paraboloid(radius=1e6, radius_y=RADIUS)),
        ),
        window=ck.Window(width=along, height=WIDTH, periodic="x"),
        loading=ck.Pressing(force=LINE_LOAD * along),
        effects=(ck.LayeredHalfSpace(),),
    )
    return ck.solve(ck.plan(scene, ck.Accuracy(grid=PIXELS)))


def main(out: Path) -> float:
    """Draw nip and pressure; return the pressure on a thick sheet over Hertz's [-]."""
    half_width = math.sqrt(4.0 * LINE_LOAD * RADIUS / (math.pi * RUBBER.plane_strain_modulus))
    peak = 2.0 * LINE_LOAD / (math.pi * half_width)
    thicknesses = [1 * mm * 2.0**i for i in range(8)]
    figure, (left, right) = plot.figure(1, 2, size=(11.0, 4.2))
    for bonded, color in ((True, plot.COLORS["gap"]), (False, plot.COLORS["meniscus"])):
        runs = [pressed(h, bonded) for h in thicknesses]
        label = "bonded to the table" if bonded else "sliding on the table"
        nips = [run.contact_fraction * WIDTH / mm for run in runs]
        for ax, values in ((left, nips), (right, [run.max_pressure / MPa for run in runs])):
            ax.plot([h / mm for h in thicknesses], values, "o-", ms=3.5, color=color, label=label)
    for ax, value, name in (
        (left, 2.0 * half_width / mm, "width of the nip [mm]"),
        (right, peak / MPa, "maximum pressure [MPa]"),
    ):
        ax.axhline(value, ls="--", lw=1.0, color="k", label="half-space (Hertz)")
        ax.set(xscale="log", xlabel="thickness of the sheet [mm]", ylabel=name)
        plot.plain_log(ax.xaxis)
    plot.title(left, "Roller of 50 mm, 2 kN/m, on rubber")
    plot.legend(left)
    plot.save(figure, out / "roller_on_sheet")
    return pressed(1.0, True).max_pressure / peak


if __name__ == "__main__":
    sys.stdout.write(f"pressure over Hertz's: {main(Path('out/examples')):.4f} (thick: 1)\n")
