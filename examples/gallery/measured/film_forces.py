"""Films between a sphere and a flat: lubrication theory against the exact flow."""

from __future__ import annotations

import math

import numpy as np

import contactkit as ck
from contactkit.app.gallery.page import Check, Data, Page, Table
from contactkit.app.gallery.run import run_page
from contactkit.lubrication import squeeze_film
from contactkit.lubrication.couette_reynolds import lubrication_factor
from contactkit.plot import gallery as plot
from contactkit.reference import viscous_films as films

PAGE = Page(
    name="film-forces",
    title="Viscous films: Stefan, Reynolds, Brenner, and Goldman, Cox and Brenner",
    claim="Stefan (1874) and Reynolds (1886) give the force on a disc and on a sphere that "
    "leave a flat. Brenner (Chem. Eng. Sci. 16, 1961, 242, Eq. 2.19) solves the Stokes "
    "flow around a sphere near a wall; Goldman, Cox and Brenner (ibid. 22, 1967, 637, Eq. "
    "2.65) a sphere that slides along it. Both as in public programs; the papers were not "
    "read.",
    verdict="A flooded disc follows Stefan's law, a flooded sphere Reynolds; lubrication theory "
    "lacks 0.2 % of the exact flow at a gap of a thousandth of the radius, 2 % at a "
    "hundredth and 13 % at a tenth. The drag of sliding has Goldman's slope, -8/15 of a "
    "logarithm; its constant is smaller, since no liquid lies beyond the rim.",
    grid="81 gaps; one motion of 0.24 s",
)
RATIO = np.geomspace(1e-6, 1.0, 81)
ETA, RADIUS = 0.1, 1e-3
START, END, FORCE = 1e-6, 1e-4, 1.0


def compute(draft: bool = False) -> dict[str, np.ndarray]:
    """Factors over 6 pi eta R v, and the motion of a disc under a constant force."""
    gap = RATIO * RADIUS
    normal = squeeze_film.sphere_force(RADIUS, gap, math.inf, 1.0, ETA)
    scale = 6.0 * math.pi * ETA * RADIUS
    found = {
        "normal": normal / scale,
        "brenner": np.array([films.brenner_factor(ratio) for ratio in RATIO]),
        "sliding": np.array([lubrication_factor(RATIO, rim) / 3.0 for rim in RIMS]),
        "goldman": np.array([films.goldman_factor(ratio) for ratio in RATIO]),
    }
    run = ck.simulate(ck.plan(_disc()))
    return found | {"gap": run.gap, "time": run.time}


NARROW = 0.03  # gap over radius, of sliding
RIMS = (1.001, 0.1)  # film thickness at the rim over the radius


def _disc() -> ck.SeparationScene:
    oil = ck.Liquid(name="oil", viscosity=ETA)
    face = ck.Body(surface=ck.Flat(radius=RADIUS))
    return ck.SeparationScene(
        interface=ck.Interface(lower=face, upper=face, meniscus=ck.Meniscus(liquid=oil)),
        loading=ck.ImposedForce(initial_gap=START, final_gap=END, force=FORCE, mass=1e-9),
        effects=(ck.ViscousForce(),),
    )


def draw(data: Data) -> plot.Figure:
    """Disc under a constant force; sphere that leaves, and that slides along a wall."""
    figure, axes = plot.figure(1, 3, size=(11.5, 4.3))
    disc, normal, sliding = axes
    at = np.geomspace(1.001 * START, END, 200)
    exact = [films.stefan_time(ETA, RADIUS, START, h, FORCE) for h in at]
    disc.semilogx(at * 1e6, exact, **plot.series(0, marker=""), label="Stefan")
    dots = plot.series(1) | {"ls": "", "mfc": "none", "ms": 6}
    disc.semilogx(data["gap"] * 1e6, data["time"], **dots, label="contactkit, steps")
    disc.set(xlabel="gap [um]", ylabel="time [s]", ylim=(0.0, 0.27))
    disc.legend(loc="lower right")
    lack = 100.0 * (1.0 - data["normal"] / data["brenner"])
    line = plot.series(0, marker="")
    normal.loglog(RATIO, lack, **line, label="1 - Reynolds / Brenner")
    guess = 100.0 * RATIO * (0.9712 - 0.2 * np.log(RATIO))
    label = r"$(D/R)\,[0.971 - \frac{1}{5} \ln(D/R)]$"
    normal.loglog(RATIO, guess, **plot.series(2, marker=""), label=label)
    normal.set(xlabel="gap / radius [-]", ylabel="lacking of the exact force [%]", ylim=(1e-4, 300))
    normal.legend(fontsize=8, loc="upper left")
    narrow = RATIO < NARROW
    at = RATIO[narrow]
    sliding.semilogx(at, data["goldman"][narrow], **line, label="Goldman, flooded")
    for i, rim in enumerate(RIMS):
        label = f"contactkit, round film to $s = {rim:.1f} R$"
        sliding.semilogx(
            at, data["sliding"][i][narrow], **plot.series(i + 1, marker=""), label=label
        )
    sliding.set(xlabel="gap / radius [-]", ylabel=r"drag / $(6\pi\eta R v)$ [-]", ylim=(0.0, 11.0))
    sliding.legend(fontsize=8, loc="upper right")
    titles = ("disc drawn off by a constant force", "sphere that leaves", "sphere that slides")
    plot.letters(axes, titles)
    return figure


def check(data: Data) -> list[Check]:
    """Time of Stefan, error of lubrication theory, slope of Goldman."""
    expected = films.stefan_time(ETA, RADIUS, START, END, FORCE)
    late = float(data["time"][-1]) / expected - 1.0
    lack = 1.0 - data["normal"] / data["brenner"]
    at = [float(np.interp(np.log(r), np.log(RATIO), lack)) for r in (1e-3, 1e-2, 0.1)]
    slope = np.diff(data["sliding"][0][:20]) / np.diff(np.log(RATIO[:20]))
    return [
        Check(
            "a constant force takes Stefan's time",
            bool(abs(late) < 1e-6),
            f"{expected:.6f} s, off by {late:.1e}",
        ),
        Check(
            "Reynolds' force is below Brenner's at every gap, by less than 3 % up to 0.01 R",
            bool(np.all(lack[RATIO > 1e-5] > 0.0) and at[1] < 0.03),
            ", ".join(f"{100 * x:.2f} %" for x in at) + " at 0.001, 0.01 and 0.1 R",
        ),
        Check(
            "a sphere that slides has Goldman's slope, -8/15 for each factor e of the gap",
            bool(np.all(np.abs(slope * 15.0 / 8.0 + 1.0) < 1e-3)),
            f"{slope.mean():.5f}; -8/15 = {-8.0 / 15.0:.5f}",
        ),
        Check(
            "a film that ends drags less than a flooded gap",
            bool(np.all((data["sliding"] < data["goldman"])[:, RATIO < NARROW])),
            f"{data['goldman'][0] - data['sliding'][0][0]:.2f} less of {data['goldman'][0]:.1f} at "
            "a gap of 1e-6 R",
        ),
    ]


def table(data: Data) -> Table:
    """Part of the force on a flooded sphere that lubrication theory lacks."""
    lack = 100.0 * (1.0 - data["normal"] / data["brenner"])
    rows = [
        (ratio, float(np.interp(np.log(ratio), np.log(RATIO), lack)))
        for ratio in (1e-4, 1e-3, 1e-2, 3e-2, 0.1, 0.3, 1.0)
    ]
    return Table(("gap / radius", "lacking [%]"), rows)


if __name__ == "__main__":
    run_page(__file__)
