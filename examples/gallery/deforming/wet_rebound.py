"""A sphere thrown through a liquid at a plane, where it sticks or rebounds."""

from __future__ import annotations

import math
from typing import Any

import numpy as np

from contactkit.app.gallery.page import Check, Data, Page, Table
from contactkit.app.gallery.run import run_page
from contactkit.gallery.deforming.soft_spheres import (
    GAP,
    RADIUS,
    SPEED,
    VISCOSITY,
    WIDTH,
    half_space,
    modulus_of,
    plan,
    wet_sphere,
)
from contactkit.gallery.second_method.unbounded_film import UnboundedFilm
from contactkit.lubrication.elastohydrodynamic.drive import Driven
from contactkit.lubrication.elastohydrodynamic.follow import Control, begun, follow
from contactkit.lubrication.elastohydrodynamic.mesh import RingMesh, graded_nodes
from contactkit.lubrication.elastohydrodynamic.wet_gap import WetGap, at_rest
from contactkit.plot import gallery as plot

PAGE = Page(
    name="wet-rebound",
    title="A soft sphere that hits a plane in a liquid: it sticks or rebounds",
    claim="Two numbers decide, St = m v/(6 pi eta a^2) and eps = 4 theta eta v a^1.5/x0^2.5: a "
    "sphere without inertia stops in the liquid, one of a greater St is thrown back "
    "without contact, and the softer it is, the less St it needs (Davis, Serayssol and "
    "Hinch 1986; Davis, Rager and Good 2002). With much inertia it is Hertz' collision "
    "(Bertin 2024).",
    verdict="Met, and two methods agree to 2 in 1000 of the speed. Stiff spheres of St = 1 stop "
    "at x0/e. What the liquid takes, (1 - v_rebound/v) St, falls by 0.4 for each e-fold "
    "of eps at St = 100, and by 0.33 at St = 10.",
    choices="R = 5 mm, x0 = 1 um, 0.1 Pa.s, 10 um/s at x0; v_rebound is the largest speed of the "
    "rebound. The second method is Galerkin's in the whole plane; rim at 60 sqrt(R x0). "
    "Abstracts read: no measured number is compared.",
    grid="96 rings; 32 functions",
)
OURS = ((1e-2, 3.0), (1e-2, 10.0), (1e-1, 5.0))  # eps, St
STOKES = (2.0, 3.0, 5.0, 10.0, 30.0, 100.0)
EPS = (1e-3, 1e-2, 1e-1)
RINGS, RIM, FUNCTIONS = 96, 60.0, 32
END = 60.0  # x0/v


def _beta(eps: float) -> float:
    return 0.25 * math.pi * eps


def _ours(eps: float, stokes: float) -> dict[str, Any]:
    """Rigid gap over x0 and its rate over v, of contactkit."""
    film = plan(wet_sphere(half_space(modulus_of(_beta(eps))), RIM)).film
    nodes = graded_nodes(RINGS, RIM)
    pressure = film.viscosity * RADIUS * SPEED / GAP**2
    gap = WetGap(
        RingMesh(nodes),
        0.5 * nodes**2,
        film.compliance(nodes * WIDTH) * (pressure / GAP),
        Driven(lambda _: 0.0, mass=6.0 * math.pi * stokes * VISCOSITY / film.viscosity),
    )
    start = at_rest(gap, 1.0)._replace(speed=-1.0)
    times = (0.0, END)
    track = follow(gap, begun(gap, start), times, Control(1e-4), every_step=True, until=1.5)
    fields = [one.fields for one in track.states]
    return {
        "gap": np.array([one.rigid_gap for one in fields]),
        "speed": np.array([one.speed for one in fields]),
        "axis": np.array([gap.gap(one)[0] for one in fields]),
    }


def _second(eps: float, stokes: float) -> Any:
    """The same by the second method; lengths over sqrt(R x0), E* = eta = 1."""
    beta = _beta(eps)
    mass = 6.0 * math.pi * stokes / beta
    length = max(1.0, math.sqrt(_hertz(eps, stokes)))
    film = UnboundedFilm(FUNCTIONS, length)
    # It is thrown back, and the film holds it again: the largest speed is past.
    speeds = [0.0]

    def is_over(gap: float, speed: float) -> bool:
        speeds[0] = max(speeds[0], speed)
        return gap > 1.5 or (speeds[0] > 1e-3 * beta and speed < 0.7 * speeds[0])

    return film.move(1.0, -beta, END / beta, mass=mass, until=is_over)


def _hertz(eps: float, stokes: float) -> float:
    """Approach of Hertz' collision over x0, (15 m v^2/(16 E* sqrt R))^(2/5)."""
    return float((15.0 * 6.0 * math.pi * stokes * _beta(eps) / 16.0) ** 0.4)


def compute(draft: bool = False) -> dict[str, Any]:
    """Paths by both methods; rebounds and deepest approach over St; a stiff sphere that stops."""
    cases = OURS[2:] if draft else OURS
    all_eps, all_stokes = (EPS[1:], STOKES[-3::2]) if draft else (EPS, STOKES)
    data: dict[str, Any] = {
        "cases": np.array(cases),
        "stokes": np.array(all_stokes),
        "eps": np.array(all_eps),
    }
    for i, case in enumerate(cases):
        ours, other = _ours(*case), _second(*case)
        data |= {f"{name}_{i}": value for name, value in ours.items()}
        data[f"other_gap_{i}"] = other.gap
        data[f"other_speed_{i}"] = other.speed / _beta(case[0])
    found = [[_second(eps, stokes) for stokes in all_stokes] for eps in all_eps]
    data["rebound"] = np.array(
        [
            [float(m.speed.max()) / _beta(e) for m in row]
            for e, row in zip(all_eps, found, strict=True)
        ]
    )
    data["approach"] = np.array(
        [
            [-float(m.gap.min()) / _hertz(e, st) for st, m in zip(all_stokes, row, strict=True)]
            for e, row in zip(all_eps, found, strict=True)
        ]
    )
    data["stopped"] = np.array([_ours(1e-4, 1.0)["gap"].min(), _second(1e-4, 1.0).gap.min()])
    return data


def draw(data: Data) -> plot.Figure:
    """Paths, rebounds, deepest approach."""
    figure, (left, middle, right) = plot.figure(1, 3, size=(12.4, 4.2))
    for i, (eps, stokes) in enumerate(data["cases"]):
        line, points = plot.series(i, marker="", lw=1.2), plot.series(i, ls="", ms=4)
        left.plot(data[f"other_gap_{i}"], data[f"other_speed_{i}"], **line)
        label = f"eps = {eps:g}, St = {stokes:g}"
        some = slice(None, None, 4)
        left.plot(data[f"gap_{i}"][some], data[f"speed_{i}"][some], **points, label=label)
    left.set(xlabel="gap of the undeformed bodies over $x_0$ [-]", ylabel="speed over v [-]")
    left.set_ylim(-1.1, 1.2)
    left.legend(
        title="points: contactkit\nlines: second method",
        fontsize=8,
        title_fontsize=8,
        loc="upper right",
    )
    for i, eps in enumerate(data["eps"]):
        look = plot.series(i)
        middle.semilogx(data["stokes"], data["rebound"][i], **look, label=f"eps = {eps:g}")
        right.semilogx(data["stokes"], data["approach"][i], **look, label=f"eps = {eps:g}")
    middle.set(xlabel="St [-]", ylabel="largest speed of the rebound over v [-]", ylim=(0.0, 1.0))
    middle.legend(fontsize=8)
    right.axhline(1.0, color="0.5", lw=0.8)
    right.set(xlabel="St [-]", ylabel="deepest approach over that of Hertz [-]", ylim=(-0.6, 1.1))
    right.legend(fontsize=8)
    plot.letters((left, middle, right), ("paths", "rebound", "approach"))
    return figure


def _losses(data: Data, stokes: float) -> Any:
    """Fall of (1 - rebound) St for each e-fold of eps."""
    column = data["rebound"][:, data["stokes"].tolist().index(stokes)]
    return -np.diff((1.0 - column) * stokes) / np.diff(np.log(data["eps"]))


def check(data: Data) -> list[Check]:
    """Agreement, the stop of a stiff sphere, loss over eps, limit of Hertz."""
    off, deep = [], []
    for i in range(len(data["cases"])):
        ours, other = data[f"speed_{i}"].max(), data[f"other_speed_{i}"].max()
        off.append((float(ours), float(other)))
        deep.append((float(data[f"gap_{i}"].min()), float(data[f"other_gap_{i}"].min())))
    stopped = data["stopped"] * math.e - 1.0
    slow, fast = _losses(data, 10.0), _losses(data, 100.0)
    rebound, approach = data["rebound"], data["approach"][:, -1]
    return [
        Check(
            "rebounds are those of the second method to 1 in 100 of the speed",
            bool(max(abs(a - b) for a, b in off) < 1e-2),
            ", ".join(f"{a:.4f} and {b:.4f}" for a, b in off),
        ),
        Check(
            "and so is the deepest approach, to 1 in 100 of x0",
            bool(max(abs(a - b) for a, b in deep) < 1e-2),
            ", ".join(f"{a:.4f} and {b:.4f}" for a, b in deep),
        ),
        Check(
            "a stiff sphere of St = 1 stops at x0/e to 5 in 1000, by both methods",
            bool(np.abs(stopped).max() < 5e-3),
            ", ".join(f"{100.0 * one:+.2f} %" for one in stopped),
        ),
        Check(
            "at St = 5 and eps = 0.1 it is thrown back at 0.469 of its speed, to 1 %",
            bool(abs(off[-1][0] / 0.469 - 1.0) < 1e-2),
            f"{off[-1][0]:.4f}",
        ),
        Check(
            "it rebounds the faster the more St and the softer it is",
            bool((np.diff(rebound, axis=0) > 0.0).all() and (np.diff(rebound, axis=1) > 0.0).all()),
            f"{rebound[0, 0]:.3f} to {rebound[-1, -1]:.3f}",
        ),
        Check(
            "at St = 100 (1 - v_rebound/v) St falls by 0.4 an e-fold of eps, to 5 %",
            bool(np.abs(fast / 0.4 - 1.0).max() < 0.05),
            ", ".join(f"{one:.3f}" for one in fast)
            + "; at St = 10 "
            + ", ".join(f"{one:.3f}" for one in slow),
        ),
        Check(
            "and the approach comes to that of Hertz, within 10 % at St = 100",
            bool((np.abs(approach - 1.0) < 0.1).all()),
            ", ".join(f"{one:.3f}" for one in approach),
        ),
    ]


def table(data: Data) -> Table:
    """Largest speed of the rebound over that before it."""
    rows = [(float(st), *map(float, data["rebound"][:, i])) for i, st in enumerate(data["stokes"])]
    return Table(("St", *(f"eps = {one:g}" for one in data["eps"])), rows)


if __name__ == "__main__":
    run_page(__file__)
