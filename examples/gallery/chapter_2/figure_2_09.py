"""Fig. 2.9: pressure and stress of the three surfaces at the low load."""

from __future__ import annotations

import numpy as np

import contactkit as ck
from contactkit.app.gallery.page import Check, Data, Page
from contactkit.app.gallery.run import run_page
from contactkit.contact.patches import contact_patches
from contactkit.gallery.chapter_2 import rough_contact as rough
from contactkit.gallery.chapter_2.stress_maps import NAMES, map_figure, maps, maxima, stacked
from contactkit.gallery.second_method.anchors import Case, agree, pressed
from contactkit.plot import gallery as plot

PAGE = Page(
    name="2.9",
    title="Pressure and stress of three surfaces",
    claim="A rougher surface, of larger rms height or shorter beta*, has less contact, higher "
    "pressure and higher stress; tenfold rms height does more than a tenth of beta*.",
    verdict="Holds for each of five surfaces. The third is not the one named: its beta* of 0.05 "
    "um is shorter than the pixels of any grid the source can have used on this window.",
    choices="Pressure bounded by the hardness, 5 GPa; the surface of 10 nm yields at the low load "
    "already. Tension is uncertain by 30 %, its ratios between structures by 10 to 20 % "
    "([refinement](grid-refinement.md)).",
    grid=rough.WIDE,
    seeds="1 to 5; maps of seed 1 around the highest pressure",
)
CROP = 0.8e-6


def compute(draft: bool = False) -> dict[str, np.ndarray]:
    """Maps of the first seed; maximum pressure, area and stress of all."""
    sampling = rough.wide(draft)
    found: dict[str, list[list[float]]] = {"pressure": [], "fraction": [], "spots": []}
    shown, stress = [], []
    for surface in rough.SURFACES:
        stack = rough.body((1.0, 1.0), (1.0, 1.0), 10.0 * surface.rms)
        runs = [
            ck.solve(rough.plan(surface, stack, sampling, seed, ck.HardnessLimit()))
            for seed in sampling.seeds
        ]
        shown.append(maps(runs[0], round(CROP / sampling.width * sampling.pixels)))
        found["pressure"].append([run.max_pressure for run in runs])
        found["fraction"].append([run.contact_fraction for run in runs])
        found["spots"].append([contact_patches(run).number for run in runs])
        stress.append([maxima(run, (0.0,))[0] for run in runs])
    numbers = {name: np.array(values) for name, values in found.items()}
    return (
        stacked(shown)
        | numbers
        | {"stress": np.array(stress)}
        | _second(sampling, shown[0]["depths"])
    )


def _second(sampling: rough.Sampling, depths: np.ndarray) -> dict[str, np.ndarray]:
    """The first seed by the second method: pressure, area; stress of the first surface."""
    cases = [pressed(sampling, Case(4e-6, surface=i)) for i in range(3)]
    return {
        "second_pressure": np.array([one.max_pressure for one in cases]),
        "second_fraction": np.array([one.fraction for one in cases]),
        "second_stress": np.array(cases[0].stress(depths)),
    }


def draw(data: Data) -> plot.Figure:
    """Maps, a column for each surface."""
    titles = [str(surface).replace(", ", ",\n") for surface in rough.SURFACES]
    return map_figure(data, titles, CROP)


def check(data: Data) -> list[Check]:
    """Each against the first surface of the same seed."""
    checks = []
    for what, values, sign in (
        ("maximum pressure", data["pressure"], 1.0),
        ("contact area", data["fraction"], -1.0),
        *(
            (f"maximum of {n.replace('_', ' ')}", data["stress"][..., i], 1.0)
            for i, n in enumerate(NAMES)
        ),
    ):
        over = rough.ratios(values)
        word = "higher" if sign > 0.0 else "smaller"
        checks.append(
            Check(
                f"{what}: {word} for both rougher surfaces, and most so for 10 nm",
                bool(
                    ((over[1:] - 1.0) * sign > 0.0).all() and ((over[1] - over[2]) * sign > 0).all()
                ),
                f"10 nm {rough.spread(over[1])}, 0.05 um {rough.spread(over[2])} times the first",
            )
        )
    spots = data["spots"].astype(float)
    checks.append(
        Check(
            "the surface of 10 nm has fewer contact spots than the others",
            bool((spots[1] < spots[0]).all() and (spots[1] < spots[2]).all()),
            "; ".join(rough.spread(one) for one in spots),
        )
    )
    return [
        *checks,
        agree("largest pressure of each surface", data["pressure"][:, 0], data["second_pressure"]),
        agree("area of each surface", data["fraction"][:, 0], data["second_fraction"]),
        agree("von Mises, tension, s_xz of the first", data["maxima"][0], data["second_stress"]),
    ]


if __name__ == "__main__":
    run_page(__file__)
