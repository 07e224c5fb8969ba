"""What to cite: of effects, methods and data in use, and of no others."""

from __future__ import annotations

import itertools
import re

import attrs
import pytest
from refusals import refuses

import contactkit as ck
from contactkit.analyses.area_over_load import _SOURCES
from contactkit.analyses.division_laws import SOURCES
from contactkit.citing.citations import citations_of
from contactkit.citing.stated import data_sources
from contactkit.contact.plan import _METHODS
from contactkit.data.bibliography import bibliography, references_in
from contactkit.files.structure import library_names
from contactkit.kinds import ATTRACTION_LAWS, EFFECTS, HARDNESS_RULES, SURFACES

pytestmark = pytest.mark.filterwarnings("ignore::contactkit.errors.ValidityWarning")

# Names and a year, as in "Orr, Scriven and Rivas 1975"; a source that names a work names one of
# the bibliography.
NAMED = re.compile(r"[A-Z][\w-]{2,}(?: et al\.| and [A-Z][\w-]+)? (?:18|19|20)\d\d[a-z]?\b")
OWN = re.compile(r"\bown (?:choice|derivation|formulation)\b|\bgiven with the scene\b")
SOLID = ck.Material(name="solid", young_modulus=1e9, poisson_ratio=0.3)
FACE = ck.Flat(radius=1e-3)
MENISCUS, ELASTIC = (ck.MeniscusForce(),), (ck.HalfSpace(),)


def film(effects=MENISCUS, liquid="water", **loading):
    given = loading or {"speed": 1e-3}
    kind = ck.ImposedSpeed if "speed" in given else ck.ImposedForce
    return ck.SeparationScene(
        interface=ck.Interface(
            lower=FACE,
            upper=FACE,
            meniscus=ck.Meniscus(liquid=ck.load_liquid(liquid), volume=1e-11),
        ),
        loading=kind(initial_gap=4e-6, final_gap=6e-6, **given),
        effects=effects,
    )


def contact(solid=SOLID, surface=None, effects=ELASTIC):
    surface = surface or ck.Wave(amplitude=1e-9, wavelength=1e-6)
    return ck.ContactScene(
        interface=ck.Interface(lower=ck.Body(solid=solid), upper=surface),
        window=ck.Window(width=1e-6),
        loading=ck.Pressing(pressure=1e6),
        effects=effects,
    )


# Every source names a work of the bibliography, or says that it is contactkit's own --------------


def _choices(kind):
    """Every form of an effect: its choices, laws and rules in all combinations."""
    fields = {one.name: one for one in attrs.fields(kind)}
    several = {n: _texts(one) for n, one in fields.items()}
    several = {n: texts for n, texts in several.items() if texts}
    if "law" in fields and not several.get("law"):
        several["law"] = list(ATTRACTION_LAWS)
    if "rule" in fields:
        several["rule"] = list(HARDNESS_RULES)
    for choice in itertools.product(*several.values()):
        made = object.__new__(kind)  # whatever else its fields want
        for name, value in (
            {n: one.default for n, one in fields.items()} | dict(zip(several, choice, strict=True))
        ).items():
            object.__setattr__(made, name, value)
        yield made


def _texts(attribute):
    """Texts that a field may have."""
    annotation = str(attribute.type)
    return re.findall(r"'([\w-]+)'", annotation) if "Literal" in annotation else ()


def _sources(kind):
    found = vars(kind).get("sources")
    if not isinstance(found, property):
        return set(kind.sources)
    return {text for made in _choices(kind) for text in made.sources}


@pytest.mark.parametrize("kind", list(EFFECTS), ids=lambda kind: kind.name)
def test_every_choice_of_an_effect_rests_on_a_work_or_is_our_own(kind):
    texts = _sources(kind)
    assert texts
    for text in texts:
        _check(text)
    named = {one.key for text in texts for one in references_in(text)}
    assert named or all(OWN.search(text) for text in texts), texts


def _check(text):
    names = NAMED.findall(text)
    known = " ".join(one.label for one in references_in(text))
    assert all(name.split()[-1] in known for name in names), (text, known)


@pytest.mark.parametrize("kind", [*ATTRACTION_LAWS, *HARDNESS_RULES], ids=lambda kind: kind.kind)
def test_laws_and_rules_name_a_work_or_are_given(kind):
    _check(kind.source)
    own = OWN.search(kind.source) or "topmost material" in kind.source
    assert references_in(kind.source) or own


@pytest.mark.parametrize(
    "text", [*_METHODS.values(), *SOURCES.values(), *_SOURCES.values()], ids=lambda text: text[:30]
)
def test_methods_and_analyses_name_a_work_or_are_our_own(text):
    _check(text)
    assert references_in(text) or OWN.search(text)


def test_surfaces_and_data_that_name_a_year_name_a_work_of_the_bibliography():
    random = [kind for kind in SURFACES if getattr(kind, "source", "")]
    assert {kind.kind for kind in random} == {"gaussian-roughness", "self-affine-roughness"}
    assert all(references_in(kind.source) for kind in random)
    of_table = [ck.load_material(n).source for n in library_names("materials.toml")]
    of_table = [text for text in of_table if "Table 2.1" in text]
    assert len(of_table) == 7
    assert all(references_in(text)[0].key == "cai2008" for text in of_table)


# What is cited is what is in use ------------------------------------------------------------------


def test_a_scene_cites_its_effects_and_the_properties_they_read():
    found = ck.cite(film())
    assert found.keys == ("contactkit", "cai2008", "orr1975", "iapws2014")
    assert found.works[0].cited_for == ()
    viscous = ck.cite(film((ck.ViscousForce(),)))
    assert viscous.keys == ("contactkit", "stefan1874", "cai2007a")
    assert any("origin was not traced" in text for text in viscous.others)
    assert not any("surface_tension" in str(one) for one in (*viscous, *viscous.others))


def test_a_choice_cites_its_own_work():
    arc = ck.cite(film((ck.MeniscusForce(profile="arc"),)))
    assert "cai2008a" in arc.keys
    assert "orr1975" not in arc.keys


def test_a_motion_cites_its_integrator_and_an_imposed_speed_does_not():
    pulled = ck.cite(film((ck.ViscousForce(),), force=1.0, mass=1e-3))
    assert "hairer1996" in pulled.keys
    assert "hairer1996" not in ck.cite(film((ck.ViscousForce(),))).keys


def test_a_contact_cites_solver_material_and_roughness():
    rough = ck.SelfAffineRoughness(rms=1e-9, hurst=0.8, rolloff=1e-6, cutoff=1e-7)
    scene = contact(ck.load_material("dlc"), rough)
    found = ck.cite(scene)
    assert found.keys == ("contactkit", "cai2008", "hintermueller2002", "bornemann1996",
                          "persson2005")  # fmt: skip
    cai = next(one for one in found if one.key == "cai2008")
    assert [text.split(":")[0] for text in cai.cited_for] == ["half-space", "diamond-like carbon"]
    newton = ck.cite(ck.plan(scene, ck.Accuracy(method="quasi-newton")))
    assert "byrd1995" in newton.keys
    assert "bornemann1996" not in newton.keys


def test_layers_cite_each_material_once():
    carbon, steel = ck.load_material("dlc"), ck.load_material("ni-p")
    stack = ck.Stack(layers=(ck.Layer(material=carbon, thickness=1e-8),), substrate=steel)
    stated = data_sources(contact(stack, effects=(ck.LayeredHalfSpace(),)))
    assert [text.split(":")[0] for text in stated] == ["diamond-like carbon", "Ni-P"]


def test_a_result_a_saved_result_and_its_plan_cite_the_same(tmp_path):
    result = ck.solve(ck.plan(contact(ck.load_material("dlc")), ck.Accuracy(grid=16)))
    ck.save_result(result, tmp_path / "result.npz")
    again = ck.load_result(tmp_path / "result.npz")
    assert ck.cite(again) == ck.cite(result) == ck.cite(result.plan)


def test_a_study_and_what_is_read_of_it_cite_equations_and_methods(tmp_path):
    made = ck.study(contact(), {"loading.pressure": [1e6, 2e6]}, ck.Accuracy(grid=16))
    keys = ck.cite(made).keys
    assert keys == ("contactkit", "cai2008", "hintermueller2002", "bornemann1996")
    assert ck.cite(ck.read_curve(made.save(tmp_path / "study.npz"))).keys == keys


def test_an_effect_of_ones_own_without_a_work_is_listed_as_such():
    found = citations_of(["my-force: plate capacitor, F = eps_0 A U^2/(2 h^2)"])
    assert found.keys == ("contactkit",)
    assert found.others == ("my-force: plate capacitor, F = eps_0 A U^2/(2 h^2)",)
    assert "without a published work" in str(found)


# Texts --------------------------------------------------------------------------------------------


def test_bibtex_has_an_entry_for_each_work_as_in_the_bibliography():
    found = ck.cite(film())
    entries = re.findall(r"^@\w+\{([\w-]+),$", found.bibtex(), re.MULTILINE)
    assert tuple(entries) == found.keys
    assert bibliography()["orr1975"].bibtex() in found.bibtex()
    assert len(found) == len(entries) == len(list(found))
    assert "Pendular rings between solids" in str(found)
    assert "for meniscus-force: Young-Laplace" in str(found)


@pytest.mark.errors
@pytest.mark.parametrize("given", [None, 3.0, "scene.toml", ck.SeparationScene])
def test_what_has_no_sources_is_refused(given):
    refuses(lambda: ck.cite(given), "be a scene, a plan, a result", "load_scene")
