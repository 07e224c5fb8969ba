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


# A load of 4e-6 E3 on one of 64 x 64 pixels is 1.6 GPa: what flows at it needs more of them.
PIXELS = {"figure_2_09": 128}


def small(monkeypatch, pixels):
    """Window cut down with its pixels, one seed: the shortest wave stays eight of them."""
    whole = rough.Sampling
    monkeypatch.setattr(
        rough, "Sampling", lambda width, full, seeds: whole(width * pixels / full, pixels, (1,))
    )


def stiffer(patch, page):
    made = rough.body
    patch.setattr(rough, "body", lambda m, h, t: _stiffer(made(m, h, t)))


def _stiffer(stack):
    layers = tuple(attrs.evolve(one, material=_stiff(one.material)) for one in stack.layers)
    return attrs.evolve(stack, layers=layers, substrate=_stiff(stack.substrate))


def _stiff(solid):
    return attrs.evolve(solid, young_modulus=WRONG * solid.young_modulus)


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
    "figure_2_15": (stiffer, heavier, harder, rougher, thicker),
    "figure_2_16": (stiffer, heavier, rougher, thicker, rubbed),
    "figure_2_19": (stiffer, heavier, harder, rougher, thicker, rubbed),
    "figure_2_23": (stiffer, heavier, rougher, thicker, tenser),
    "figure_2_24": (stiffer, heavier, harder, rougher, tenser),
    "figure_2_25": (stiffer, heavier, rougher, tenser),
    "table_2_2": (stiffer, heavier, harder, rougher, thicker, tenser),
    "grid_refinement": (stiffer, rougher, thicker, rubbed),
}


HARDLY = {  # inputs that are not changed above, and why
    "figure_2_24": "thickness: it enters by the hardness of layers, which changes the force by 1 %",
    "figure_2_25": "thickness: layers of 1 nm change the force by 1 % in all (Fig. 2.23)",
}
CHEAP = ("figure_2_24",)  # 4 s: all but thickness and friction enter it


def anchors(page):
    return [one for one in page.check(page.compute(True)) if "second method" in one.statement]


@pytest.mark.parametrize(
    "name",
    [
        pytest.param(name, marks=pytest.mark.slow if name in CHEAP else pytest.mark.exhaustive)
        for name in ENTERS
    ],
)
@pytest.mark.filterwarnings("ignore")
def test_a_page_of_rough_contacts_notices_what_enters_it(name, monkeypatch):
    page = importlib.import_module(f"contactkit.gallery.chapter_2.{name}")
    small(monkeypatch, PIXELS.get(name, 64))
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
    "chapter_3.figure_1_02": ("RADIUS",),
    "chapter_3.figure_1_03": ("RADIUS", "KNOWN"),
    "chapter_3.figure_1_04": ("RADII", "HAMAKER"),
    "chapter_3.figure_3_07": ("GAP",),
    "chapter_3.figure_3_08": ("HEIGHT",),
    "chapter_3.figure_3_09": ("GAMMA", "HEIGHTS"),
    "chapter_3.figure_3_10": ("VISCOSITY", "TIME", "RADIUS", "HEIGHTS"),
    "chapter_3.figure_3_11": ("GAMMA", "VISCOSITY", "TIME", "RADIUS", "HEIGHTS"),
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
    *(f"chapter_3.figure_{n}" for n in ("1_02", "1_04", "3_11", "3_12", "3_14", "3_16")),
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


@pytest.mark.parametrize(
    "name",
    [
        pytest.param(name, marks=pytest.mark.slow if name == "LAYER" else pytest.mark.exhaustive)
        for name in ("RADIUS", "LOAD", "LAYER", "BASE", "THICKNESS")
    ],
)
@pytest.mark.filterwarnings("ignore")  # of a contact that is too wide for its window
def test_the_sphere_on_a_layer_notices_what_enters_it(name, monkeypatch):
    page = importlib.import_module("contactkit.gallery.chapter_2.figure_2_03")
    value = getattr(page, name)
    if isinstance(value, ck.Material):
        monkeypatch.setattr(page, name, _stiff(value))
    else:
        monkeypatch.setattr(page, name, WRONG * value)
    assert not all(one.holds for one in page.check(page.compute(True)))


def test_the_second_method_notices_other_moduli(monkeypatch):
    page = importlib.import_module("contactkit.gallery.chapter_2.layered_equations")
    solid = page.CASES["IV"]
    monkeypatch.setitem(page.CASES, "IV", solid._replace(G=tuple(WRONG * g for g in solid.G)))
    assert not all(one.holds for one in page.check(page.compute(True)))
