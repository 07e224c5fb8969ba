"""Widgets: what each field takes, read off its class, and texts that are read back exactly."""

from __future__ import annotations

import math

import attrs
import pytest

from contactkit.files.structure import field_value
from contactkit.kinds import KINDS
from contactkit.local_app.widgets import exact_text, is_complete, value_of_text, widgets_of
from contactkit.scene.loading import ImposedForce
from contactkit.scene.materials import Material
from contactkit.scene.meniscus import Meniscus
from contactkit.scene.rough_surfaces import Measured, SelfAffineRoughness
from contactkit.scene.window import Window
from contactkit.separation.effects.rupture import Rupture
from contactkit.separation.effects.viscous import TensionLimit, ViscousForce
from contactkit.units import parse_unit


def widget(kind, name, value=None):
    return next(one for one in widgets_of(kind, "", value) if one.path == name)


@pytest.mark.parametrize(
    ("kind", "name", "takes", "unit", "expected"),
    [
        (ImposedForce, "force", "quantity", "N", "be a finite number"),
        (ImposedForce, "mass", "quantity", "kg", "be positive and finite"),
        (ImposedForce, "stiffness", "quantity", "N/m", "be zero or positive, and finite"),
        (Meniscus, "contact_angle_lower", "quantity", "rad", "lie between 0 and pi"),
        (Meniscus, "pressure", "quantity", "Pa", "be negative and finite"),
        (Meniscus, "count", "whole", "-", "be a whole number of at least 1"),
        (SelfAffineRoughness, "hurst", "number", "-", "lie above 0 and not above 1"),
        (Material, "poisson_ratio", "number", "-", "lie above -1 and not above 0.5"),
        (Rupture, "gap", "quantity", "m", "be positive and finite, 'limit' or 'zero-neck'"),
        (TensionLimit, "strength", "quantity", "Pa", "be positive and finite, or 'vapour'"),
    ],
)
def test_kind_unit_and_range_are_those_of_the_field(kind, name, takes, unit, expected):
    found = widget(kind, name)
    assert (found.takes, found.unit, found.expected) == (takes, unit, expected)


@pytest.mark.parametrize(
    ("kind", "name", "options"),
    [
        (ViscousForce, "closure", ("volume-conserving", "flooded", "as-published")),
        (Measured, "holes", ("refused", "masked", "fill")),
        (Measured, "is_periodic", ("", "yes", "no")),
        (Window, "periodic", ("", "yes", "no", "x", "y")),
    ],
)
def test_choices_are_those_of_the_type(kind, name, options):
    assert widget(kind, name).options == options


def test_every_kind_that_scenes_may_hold_has_widgets_with_units_and_help():
    seen = 0
    for kind in KINDS.by_name.values():
        for one in widgets_of(kind, "it"):
            seen += 1
            assert one.path.startswith("it.")
            if one.takes == "quantity":
                assert parse_unit(one.unit).dimension, one
            if one.takes == "choice":
                assert one.value in one.options or one.is_required, one
            assert one.help, (kind, one.path)
    assert seen > 100


def test_help_is_what_the_class_says_of_the_field():
    assert widget(ImposedForce, "force").help == "Pull [N]."
    assert widget(ImposedForce, "final_gap").help.startswith("Gap at the start and gap at which")


def test_a_class_with_a_field_that_no_widget_takes_is_not_complete():
    by_name = KINDS.by_name
    assert is_complete(by_name["tension-limit"])
    assert is_complete(by_name["adhesion"])  # a law with the two fields that every law has
    assert not is_complete(by_name["heights"])  # an array
    assert not is_complete(by_name["partial-slip"])  # a path of steps


def test_a_law_is_a_choice_with_the_fields_that_all_laws_have():
    found = {one.path: one for one in widgets_of(KINDS.by_name["adhesion"], "effects.adhesion")}
    assert found["effects.adhesion.law"].options == ("exponential", "dugdale", "lennard-jones")
    assert found["effects.adhesion.law.range"].unit == "m"
    assert "effects.adhesion.law.end_width" not in found  # of one law only


@pytest.mark.parametrize("value", [1.0, 5e-6, 0.1 + 0.2, 1 / 3, 1e-19, 293.15, 7.3e11, 2e-300])
@pytest.mark.parametrize("unit", ["m", "Pa", "K", "m3", "rad", "-", "N.s/m", "kg"])
def test_a_text_is_read_back_as_the_same_number(value, unit):
    text = exact_text(value, unit)
    number = float(text) if unit == "-" else None
    owner = attrs.make_class("Owner", {"it": attrs.field(type=float, metadata={"unit": unit})})
    assert (number if unit == "-" else field_value(owner, "it", text)) == value


def test_texts_read_well():
    assert exact_text(2.5e-5, "m") == "25 um"
    assert exact_text(293.15, "K") == "20 degC"
    assert exact_text(math.radians(20.0), "rad") == "20 deg"
    assert exact_text(math.inf, "m") == "inf"


@pytest.mark.parametrize(
    ("takes", "text", "value"),
    [
        ("quantity", " 5 um ", "5 um"),
        ("quantity", "", None),
        ("quantity", "2 nm, 4 nm", ["2 nm", "4 nm"]),
        ("number", "0.5", 0.5),
        ("number", "50 %", "50 %"),
        ("number", "half", "half"),
        ("whole", "12", 12),
        ("whole", "1.5", "1.5"),
        ("choice", "yes", True),
        ("choice", "4", 4),
        ("choice", "x", "x"),
        ("flag", False, False),
        ("text", "nm", "nm"),
    ],
)
def test_a_text_becomes_what_a_scene_file_has(takes, text, value):
    found = value_of_text(attrs.evolve(widget(ImposedForce, "force"), takes=takes), text)
    assert found == value
    assert type(found) is type(value)
