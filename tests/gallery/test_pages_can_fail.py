"""Every page notices an input that is wrong by 30 %.

The numbers that enter the solver are changed, those of the captions in the second method are not.
The samplings are small, so that whole pages take seconds: checks of trends may fail on them, the
checks against the second method may not.
"""

from __future__ import annotations

import importlib

import attrs
import pytest

import contactkit as ck
from contactkit.gallery.chapter_2 import rough_contact as rough
from contactkit.gallery.chapter_3 import films

WRONG = 1.3


def small(monkeypatch):
    """Window of half the width, 128 pixels, one seed."""
    whole = rough.Sampling
    monkeypatch.setattr(rough, "Sampling", lambda width, pixels, seeds: whole(width / 2, 128, (1,)))


def stiffer(patch, page):
    made = rough.body
    patch.setattr(rough, "body", lambda m, h, t: _stiffer(made(m, h, t)))


def _stiffer(stack):
    def solid(one):
        return attrs.evolve(one, young_modulus=WRONG * one.young_modulus)

    layers = tuple(attrs.evolve(one, material=solid(one.material)) for one in stack.layers)
    return attrs.evolve(stack, layers=layers, substrate=solid(stack.substrate))


def thicker(patch, page):
    made = rough.body
    patch.setattr(rough, "body", lambda m, h, t: made(m, h, WRONG * t))


def harder(patch, page):
    patch.setattr(rough, "HARDNESS", WRONG * rough.HARDNESS)


def rougher(patch, page):
    patch.setattr(rough, "SURFACES", tuple(s._replace(rms=WRONG * s.rms) for s in rough.SURFACES))


def heavier(patch, page):
    pressing, curve, study = ck.Pressing, ck.load_curve, ck.study
    patch.setattr(ck, "Pressing", lambda pressure: pressing(pressure=WRONG * pressure))

    def of_curve(plan, pressures):
        return curve(plan, pressures=[WRONG * p for p in pressures])

    def of_study(scene, values, *more):
        return study(scene, {k: [WRONG * p for p in v] for k, v in values.items()}, *more)

    patch.setattr(ck, "load_curve", of_curve)
    patch.setattr(ck, "study", of_study)


def tenser(patch, page):
    liquid = attrs.evolve(rough.WATER.liquid, surface_tension=WRONG * 0.07275)
    patch.setattr(rough, "WATER", attrs.evolve(rough.WATER, liquid=liquid))


def rubbed(patch, page):
    patch.setattr(page, "FRICTIONS", tuple(WRONG * mu for mu in page.FRICTIONS))


ENTERS = {
    "figure_2_09": (stiffer, heavier, harder, rougher),
    "figure_2_10": (stiffer, heavier, harder, rougher, thicker),
    "figure_2_12": (stiffer, heavier, rougher, thicker),
    "figure_2_13": (stiffer, heavier, rougher, thicker),
    "figure_2_14": (stiffer, heavier, harder, rougher),
    "figure_2_15": (stiffer, heavier, harder, rougher),
    "figure_2_16": (stiffer, heavier, rougher, thicker, rubbed),
    "figure_2_19": (stiffer, heavier, harder, rougher, rubbed),
    "figure_2_23": (stiffer, heavier, rougher, thicker, tenser),
    "figure_2_24": (stiffer, heavier, harder, rougher, tenser),
    "figure_2_25": (stiffer, heavier, rougher, tenser),
    "table_2_2": (stiffer, heavier, harder, rougher, thicker, tenser),
    "grid_refinement": (stiffer, rougher, thicker, rubbed),
}


def anchors(page):
    return [one for one in page.check(page.compute(True)) if "second method" in one.statement]


@pytest.mark.parametrize(
    "name",
    [
        pytest.param(
            name, marks=pytest.mark.slow if name == "figure_2_09" else pytest.mark.exhaustive
        )
        for name in ENTERS
    ],
)
@pytest.mark.filterwarnings("ignore")
def test_a_page_of_rough_contacts_notices_what_enters_it(name, monkeypatch):
    page = importlib.import_module(f"contactkit.gallery.chapter_2.{name}")
    small(monkeypatch)
    found = anchors(page)
    assert found
    assert not [one for one in found if not one.holds]
    unseen = []
    for wrong in ENTERS[name]:
        with monkeypatch.context() as patch:
            wrong(patch, page)
            found = page.compute(True)
        seen = [c for c in page.check(found) if "second method" in c.statement and not c.holds]
        unseen += [] if seen else [wrong.__name__]
    assert not unseen


BY_NAME = {  # constants of a page that enter it, read anew by `compute`
    "chapter_3.figure_3_07": ("GAP",),
    "chapter_3.figure_3_08": ("HEIGHT",),
    "chapter_3.figure_3_09": ("GAMMA", "HEIGHTS"),
    "chapter_3.figure_3_10": ("VISCOSITY", "TIME", "RADIUS", "HEIGHTS"),
    "chapter_3.figure_3_11": ("VISCOSITY", "TIME", "RADIUS", "HEIGHTS"),
    "chapter_3.figure_3_12": ("GAMMA", "VISCOSITY", "TIME", "RADIUS", "HEIGHTS"),
    "chapter_3.figure_3_13": ("VISCOSITY", "RADIUS", "HEIGHTS", "GAP"),
    "chapter_3.figure_3_14": ("GAMMA", "VISCOSITY", "TIME", "HEIGHTS", "AREAS"),
    "chapter_3.figure_3_15": ("GAMMA", "VISCOSITY", "TIME", "HEIGHTS", "AREA"),
    "chapter_3.figure_3_16": ("GAMMA", "VISCOSITY", "TIME", "START", "HEIGHT", "LARGE"),
    "chapter_3.figure_3_18": ("VISCOSITY", "TIME", "RADIUS", "HEIGHTS", "GAP"),
    "chapter_3.figure_3_20": ("VISCOSITY", "RADIUS", "HEIGHTS"),
    "chapter_3.figure_3_21": ("VISCOSITY", "TIME", "HEIGHTS", "LARGE"),
    "chapter_3.section_3_2_3": ("VISCOSITY", "TIME", "RADIUS", "HEIGHTS", "START"),
    "chapter_3.tables_3_1_3_2": ("GAMMA", "VISCOSITY", "TIME", "RADIUS", "HEIGHTS"),
    "measured.contact_challenge": ("MODULUS", "LOAD", "SLOPE", "WORK", "RANGE"),
    "measured.full_contact": ("MODULUS", "GRADIENT", "HARDNESS"),
    "measured.laser_bumps": ("MODULUS", "LOAD", "RADIUS", "GAMMA", "WET"),
    "measured.bridge_rupture": ("VISCOSITY", "TENSION", "RADIUS", "VOLUME"),
}
ONLY_RATIOS = {  # inputs that are not changed above, and why
    "chapter_3.figure_3_08": "RADIUS: bound to the helpers of films.py when these are imported",
    "chapter_3.figure_3_09": "RADIUS: the same; it is in the volumes of the films",
    "chapter_3.figure_3_13": "TIME: times at which forces are equal are what it computes",
    "chapter_3.figure_3_20": "TIME: its impulses do not depend on it, which is its statement",
    "chapter_3.figure_3_21": "GAP: its asperities are compared by powers of their number",
}
COSTS_SECONDS = {
    *(f"chapter_3.figure_3_{n}" for n in (11, 12, 14, 16)),
    "chapter_3.tables_3_1_3_2",
    *(name for name in BY_NAME if name.startswith("measured.")),
}


@pytest.mark.parametrize(
    "name",
    [
        pytest.param(n, marks=pytest.mark.exhaustive if n in COSTS_SECONDS else pytest.mark.slow)
        for n in BY_NAME
    ],
)
def test_a_page_notices_a_constant_of_its_caption(name, monkeypatch):
    page = importlib.import_module(f"contactkit.gallery.{name}")
    assert all(one.holds for one in page.check(page.compute(True)))
    unseen = []
    for constant in BY_NAME[name]:
        with monkeypatch.context() as patch:
            wrong = WRONG * getattr(page, constant)
            patch.setattr(page, constant, wrong)
            if hasattr(films, constant):
                patch.setattr(films, constant, wrong)
            found = page.compute(True)
        if all(one.holds for one in page.check(found)):
            unseen.append(constant)
    assert not unseen


def test_the_second_method_notices_other_moduli(monkeypatch):
    page = importlib.import_module("contactkit.gallery.chapter_2.layered_equations")
    solid = page.CASES["IV"]
    monkeypatch.setitem(page.CASES, "IV", solid._replace(G=tuple(WRONG * g for g in solid.G)))
    assert not all(one.holds for one in page.check(page.compute(True)))
