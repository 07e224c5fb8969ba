"""Fig. 2.14: homogeneous bodies of three hardnesses: maps and load curves."""

from __future__ import annotations

import numpy as np

import contactkit as ck
from contactkit.app.gallery.page import Check, Data, Page, Table
from contactkit.app.gallery.run import run_page
from contactkit.gallery.chapter_2 import rough_contact as rough
from contactkit.gallery.chapter_2.curve_figure import draw_panel
from contactkit.gallery.chapter_2.stress_maps import map_figure, maps, stacked
from contactkit.gallery.second_method.anchors import Case, agree, pressed
from contactkit.plot import gallery as plot

PAGE = Page(
    name="2.14",
    title="Homogeneous bodies of three hardnesses",
    claim="The harder the body, the higher the load at which it yields first; a soft one yields "
    "early and its plastic area grows faster.",
    verdict="Holds. First yield comes where the elastic contact reaches the hardness; a hardness "
    "twice as large takes a load many times as large.",
    choices="A shorter wave than in the pages on stiffness, so that the bodies flow; maps at 1e-3 "
    "E3.",
    grid=rough.FINE,
    seeds="1 to 5; maps of seed 1 around the highest pressure",
)
HARDNESSES = (0.5, 1.0, 2.0)  # over 0.05 E3
LOADS, MAP_LOAD, CROP = (4e-6, 1e-5, 4e-5, 1e-4, 4e-4, 1e-3, 2e-3, 4e-3), 1e-3, 0.5e-6
COLUMNS = ("max_pressure", "contact_fraction", "plastic_fraction")
LABELS = [f"$H/E_3$ = {0.05 * h:g}" for h in HARDNESSES]


def bound(hardness: float) -> ck.HardnessLimit:
    """Pressure bound of a hardness over 0.05 E3."""
    return ck.HardnessLimit(rule=ck.ConstantHardness(hardness=hardness * rough.HARDNESS))


def compute(draft: bool = False) -> dict[str, np.ndarray]:
    """Curves of each hardness, maps of the first seed, loads of first yield."""
    sampling, surface = rough.fine(draft), rough.SURFACES[0]
    stack = rough.body((1.0, 1.0), (1.0, 1.0), surface.rms)
    elastic = rough.curves([(surface, stack)], sampling, LOADS, ("max_pressure",))
    runs = [
        rough.curves([(surface, stack)], sampling, LOADS, COLUMNS, bound(h)) for h in HARDNESSES
    ]
    shown = []
    for h in HARDNESSES:
        made = rough.plan(surface, stack, sampling, sampling.seeds[0], bound(h))
        run = ck.solve(made.with_loading(ck.Pressing(pressure=MAP_LOAD * rough.MODULUS)))
        shown.append(maps(run, round(CROP / sampling.width * sampling.pixels)))
    curves = {name: np.concatenate([run[name] for run in runs]) for name in COLUMNS}
    case = Case(1e-3, thickness=1e-9)
    flows = [pressed(sampling, case._replace(hardness=h)) for h in (2.5e9, 5e9)]
    second = {
        "second_elastic": np.array(
            pressed(sampling, case._replace(load=1e-5, hardness=np.inf)).max_pressure
        ),
        "second_area": np.array([one.fraction for one in flows]),
        "second_plastic": np.array(flows[0].plastic_fraction(2.5e9)),
    }
    return stacked(shown) | curves | {"elastic_pressure": elastic["max_pressure"][0]} | second


def first_yield(data: Data) -> np.ndarray:
    """Loads over E3 at which the elastic contacts reach the hardnesses, (hardness, seeds)."""
    peaks = data["elastic_pressure"] / rough.HARDNESS
    found = [
        [np.exp(np.interp(np.log(h), np.log(one), np.log(LOADS))) for one in peaks]
        for h in HARDNESSES
    ]
    return np.array(found)


def draw(data: Data) -> tuple[plot.Figure, plot.Figure]:
    """Maps; load curves with the loads of first yield."""
    figure, axes = plot.figure(1, 3, size=(8.6, 3.6))
    for ax, name in zip(axes, COLUMNS, strict=True):
        draw_panel(ax, LOADS, name, data[name], LABELS, range(len(LABELS)))
    for i, loads in enumerate(first_yield(data)[:2]):
        colour = plot.series(i)["color"]
        axes[0].axvline(np.median(loads), color=colour, lw=0.9, ls=":")
    axes[0].plot([], [], color="0.3", lw=0.9, ls=":", label="load of first yield, median")
    plot.shared(figure, axes[0], columns=4)
    return map_figure(data, [f"{one}\n(at $10^{{-3}} E_3$)" for one in LABELS], CROP), figure


def check(data: Data) -> list[Check]:
    """Order of first yield, growth of the plastic area, the bound, the printed load."""
    loads, plastic = first_yield(data), data["plastic_fraction"]
    apart = loads[1] / loads[0]
    bounds = data["max_pressure"] / rough.HARDNESS
    over = max(float((bounds[i] / h).max()) for i, h in enumerate(HARDNESSES))
    area = data["contact_fraction"][..., -1]
    return [
        Check(
            "a hardness twice as large takes a load of first yield more than 5 times as large",
            rough.all_above(apart, 5.0),
            f"{rough.spread(loads[0])} and {rough.spread(loads[1])} E3",
        ),
        Check(
            "plastic area at each load from 1e-3 on: the softer, the larger",
            bool(
                (np.diff(plastic[..., 5:], axis=0) <= 0.0).all()
                and (plastic[0, :, 5:] > plastic[1, :, 5:]).all()
            ),
            "at 4e-3 E3: "
            + ", ".join(rough.spread(100.0 * one) for one in plastic[..., -1])
            + " %",
        ),
        Check(
            "no pressure exceeds the hardness",
            bool(over < 1.0 + 1e-6),
            f"largest pressure over hardness {over:.7f}",
        ),
        Check(
            "at the printed load of 1e-5 E3 the plastic area is below 0.1 % of the window",
            rough.all_below(plastic[..., 1], 1e-3),
            f"at most {100.0 * plastic[..., 1].max():.3f} %",
        ),
        Check(
            "the softer, the larger the contact area at 4e-3 E3",
            bool((np.diff(area, axis=0) < 0.0).all()),
            ", ".join(rough.spread(100.0 * one) for one in area) + " %",
        ),
        agree(
            "elastic pressure at 1e-5 E3", data["elastic_pressure"][0, 1], data["second_elastic"]
        ),
        agree("area at 1e-3 E3", data["contact_fraction"][:2, 0, 5], data["second_area"]),
        agree(
            "plastic area at 1e-3 E3, the softest", plastic[0, 0, 5], data["second_plastic"], 0.02
        ),
    ]


def table(data: Data) -> Table:
    """Load of first yield of each hardness."""
    rows = [
        (0.05 * h, *map(float, (np.median(one), one.min(), one.max())))
        for h, one in zip(HARDNESSES[:2], first_yield(data), strict=False)
    ]
    return Table(("H/E3", "first yield p/E3, median", "least", "greatest"), rows)


if __name__ == "__main__":
    run_page(__file__)
