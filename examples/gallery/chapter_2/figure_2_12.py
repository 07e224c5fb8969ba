"""Fig. 2.12: pressure and stress of structures I to V with thick layers, at two loads."""

from __future__ import annotations

import numpy as np

import contactkit as ck
from contactkit.app.gallery.page import Check, Data, Page, Table
from contactkit.app.gallery.run import run_page
from contactkit.gallery.chapter_2 import rough_contact as rough
from contactkit.gallery.chapter_2.stress_maps import NAMES, map_figure, maps, maxima, stacked
from contactkit.gallery.second_method.anchors import Case, agree, pressed
from contactkit.plot import gallery as plot

PAGE = Page(
    name="2.12",
    title="Pressure and stress of layered structures, layers of 10 rms heights",
    claim="A stiff layer or interlayer raises the maximum stresses, a compliant one lowers "
    "them; the lower load is elastic, the higher one elastic-plastic.",
    verdict="Holds for the stress of von Mises. Not for tension: a compliant interlayer (IV) "
    "raises it, as the layer above it bends. Neither load makes this surface flow at our "
    "shortest wave.",
    choices="Higher load 4e-5 E3, as in the caption. Tension is uncertain by 30 %, its ratios "
    "between structures by 10 to 20 % ([refinement](grid-refinement.md)).",
    grid=rough.WIDE,
    seeds="1 to 5; maps of seed 1 around the highest pressure",
)
LOADS, CROP, HEIGHT = (4e-6, 4e-5), 0.6e-6, 10.0
STRUCTURES = list(rough.STRUCTURES)


def compute(draft: bool = False) -> dict[str, np.ndarray]:
    """Maps (loads, structures, ...) of the first seed, maxima (loads, structures, seeds, 3)."""
    sampling, surface = rough.wide(draft), rough.SURFACES[0]
    shown, best, peak = [], [], []
    for moduli in rough.STRUCTURES.values():
        stack = rough.body(moduli, (1.0, 1.0), HEIGHT * surface.rms)
        for seed in sampling.seeds:
            made = rough.plan(surface, stack, sampling, seed, ck.HardnessLimit())
            for load in LOADS:
                run = ck.solve(made.with_loading(ck.Pressing(pressure=load * rough.MODULUS)))
                best.append(maxima(run, (0.0,))[0])
                peak.append(run.max_pressure)
                if seed == sampling.seeds[0]:
                    shown.append(maps(run, round(CROP / sampling.width * sampling.pixels)))
    shape = (len(STRUCTURES), len(sampling.seeds), len(LOADS))
    found = stacked(shown)
    found = {k: v.reshape(len(STRUCTURES), len(LOADS), *v.shape[1:]) for k, v in found.items()}
    iv = STRUCTURES.index("IV")
    cases = [pressed(sampling, Case(load, "IV")) for load in (4e-6, 4e-5)]
    second = [c.stress(found["depths"][iv, i]) for i, c in enumerate(cases)]
    return found | {
        "second_pressure": np.array([c.max_pressure for c in cases]),
        "second_stress": np.array(second),
        "stress": np.moveaxis(np.array(best).reshape(*shape, len(NAMES)), 2, 0),
        "pressure": np.moveaxis(np.array(peak).reshape(shape), 2, 0),
    }


def draw(data: Data) -> list[plot.Figure]:
    """A figure for each load."""
    titles = [f"{name}:\n{text}" for name, text in rough.MEANING.items()]
    shown = ("maps", "window", "maxima", "depths")
    return [map_figure({k: data[k][:, i] for k in shown}, titles, CROP) for i in range(len(LOADS))]


def check(data: Data) -> list[Check]:
    """Structures against I on the same surface."""
    checks = []
    ii, iii, iv, v = (STRUCTURES.index(name) for name in ("II", "III", "IV", "V"))
    for i, load in enumerate(LOADS):
        mises, tension = (rough.ratios(data["stress"][i][..., k]) for k in (0, 1))
        checks += [
            Check(
                f"von Mises at {load:g} E3: II and IV below I, III and V above, each surface",
                rough.all_below(mises[[ii, iv]]) and rough.all_above(mises[[iii, v]]),
                ", ".join(f"{STRUCTURES[k]} {rough.spread(mises[k])}" for k in (ii, iii, iv, v)),
            ),
            Check(
                f"tension at {load:g} E3: a compliant interlayer raises it in the median (the "
                "source: lowers)",
                bool(np.median(tension[iv]) > 1.05),
                f"IV {rough.spread(tension[iv])} times that of I",
            ),
        ]
    peak = data["pressure"] / rough.HARDNESS
    checks.append(
        Check(
            "at both loads the pressure stays below the hardness in every structure",
            rough.all_below(peak),
            "; ".join(rough.spread(one) for one in peak) + " of the hardness",
        )
    )
    return [
        *checks,
        agree("pressure of IV at both loads", data["pressure"][:, iv, 0], data["second_pressure"]),
        agree("von Mises, tension, s_xz of IV", data["maxima"][iv], data["second_stress"]),
    ]


def table(data: Data) -> Table:
    """Medians of the maxima over those of I."""
    rows = [
        (
            load,
            name,
            *(float(np.median(rough.ratios(data["stress"][i][..., k])[j])) for k in range(3)),
        )
        for i, load in enumerate(LOADS)
        for j, name in enumerate(STRUCTURES)
    ]
    return Table(("p/E3", "structure", "von Mises / I", "tension / I", "sigma_xz / I"), rows)


if __name__ == "__main__":
    run_page(__file__)
