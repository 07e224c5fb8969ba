"""Pages of the API, by topic: public names as users write them, then functions by module.

A name of ``contactkit`` belongs to the topic that lists the longest beginning of its home.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import NamedTuple

import contactkit as ck


class Topic(NamedTuple):
    """A page: homes of the public names on it, and modules that are shown whole."""

    page: str
    title: str
    homes: Sequence[str] = ()
    modules: Sequence[str] = ()


def _of(room: str, *names: str) -> tuple[str, ...]:
    return tuple(f"{room}.{name}" for name in names)


TOPICS = (
    Topic("scenes", "Scenes", ("scene",)),
    Topic("loading", "Loading", ("scene.loading",)),
    Topic(
        "bodies",
        "Materials and surfaces",
        _of(
            "scene",
            "materials",
            "surfaces",
            "planforms",
            "faces",
            "rough_surfaces",
            "asperity_population",
        ),
    ),
    Topic(
        "liquids",
        "Liquids",
        ("liquids", "scene.meniscus"),
        _of("contactkit.liquids", "temperature_laws", "viscosity", "water"),
    ),
    Topic(
        "separation-effects",
        "Effects of separation and sliding",
        _of("separation", "effects", "sliding.effects"),
    ),
    Topic("contact-effects", "Effects of contact", ("contact.effects", "kinds")),
    Topic("run", "Planning and solving", ("planning", "accuracy", "contact", "separation")),
    Topic(
        "results",
        "Results",
        ("contact.result", "separation.results", "separation.sliding.result", "separation.motion"),
    ),
    Topic("one-number", "One number from one call", ("shortcuts",)),
    Topic(
        "analyses",
        "Analyses and studies",
        ("analyses", "studies", "contact.functionals"),
        (
            *_of("contactkit.analyses", "heights", "area_over_load", "load_for", "subsurface"),
            *_of("contactkit.contact", "patches", "plastic_history", "functionals", "adjoint"),
        ),
    ),
    Topic("fits", "Fits", ("fitting",)),
    Topic("files", "Files", ("files",)),
    Topic(
        "pictures",
        "Pictures",
        ("plot",),
        _of(
            "contactkit.plot",
            "separation",
            "contact",
            "study",
            "stress",
            "roughness",
            "adhesion",
            "slip",
            "film",
            "plastic_history",
        ),
    ),
    Topic("live-pages", "Live pages", (), ("contactkit.live_page.page",)),
    Topic("errors", "Errors and units", ("errors",), ("contactkit.units",)),
    Topic("published", "Equations as published", ("as_published",)),
    Topic(
        "capillarity",
        "Capillarity",
        (),
        _of(
            "contactkit.capillary",
            *("kelvin", "exact.bridge", "exact.at_pressure", "exact.stability", "exact.profile"),
            *("exact.result", "arc.bridge", "contact_radius", "condensed", "many_menisci"),
            *("asperities", "film_islands", "island_bridges"),
        ),
    ),
    Topic(
        "films",
        "Films",
        (),
        (
            *_of("contactkit.lubrication", "squeeze_film", "film_limits", "constant_force"),
            *_of("contactkit.lubrication", "couette_flat", "couette_sphere", "dimensionless"),
        ),
    ),
    Topic(
        "faces",
        "Films on faces",
        (),
        _of(
            "contactkit.lubrication.reynolds",
            *("face", "gaps", "film", "solve", "motion", "damping", "shape_factor"),
            "rough_flow",
        ),
    ),
    Topic(
        "solids",
        "Elasticity and adhesion",
        (),
        (
            *_of("contactkit.elasticity", "layered", "love", "point_load", "hardness_rules"),
            *_of("contactkit.elasticity", "stress.measures"),
            *_of("contactkit.adhesion", "attraction", "van_der_waals", "parameters", "jkr", "dmt"),
            *_of("contactkit.adhesion", "maugis_dugdale", "rough_limits"),
        ),
    ),
    Topic(
        "roughness",
        "Roughness",
        (),
        _of("contactkit.roughness", "random_surfaces", "spectra", "statistics", "contact_theories"),
    ),
    Topic(
        "reference-solutions",
        "Reference solutions",
        (),
        _of(
            "contactkit.reference",
            *("hertz", "flat_punch", "westergaard", "product_wave", "love_patch", "hamilton"),
            *("partial_slip", "layered_wave", "reynolds", "elliptic_bridge", "sphere_bridges"),
            "viscous_films",
        ),
    ),
    Topic(
        "devices",
        "Devices",
        (),
        (
            *_of("contactkit.models.injector", "coil", "valve", "monolithic"),
            *_of("contactkit.models.micromirror", "mirror", "tip", "electrostatics", "landing"),
        ),
    ),
    Topic(
        "fmus",
        "FMUs",
        (),
        (
            "contactkit.fmu.python.build",
            "contactkit.fmu.native.build",
            "contactkit.fmu.framework.ports",
            "contactkit.fmu.framework.slave",
            "contactkit.fmu.master.couple",
        ),
    ),
)


def topic_of(home: str) -> Topic:
    """The topic of a public name, by the longest beginning of its home that one lists."""
    fits = [
        (len(start), topic)
        for topic in TOPICS
        for start in topic.homes
        if home == start or home.startswith(f"{start}.")
    ]
    if not fits:
        raise LookupError(f"no topic in docs/scripts/api_pages.py has {home}")
    return max(fits, key=lambda fit: fit[0])[1]


def public_names() -> dict[str, list[str]]:
    """Public names of each topic, in the order of their homes."""
    found: dict[str, list[str]] = {topic.page: [] for topic in TOPICS}
    first = {"SeparationScene": 0, "ContactScene": 1, "SlidingScene": 2}
    order = sorted(ck._HOMES, key=lambda name: (first.get(name, 9), ck._HOMES[name], name))
    for name, home in ((name, ck._HOMES[name]) for name in order):
        found[topic_of(home).page].append(name)
    return found


def summary(name: str) -> str:
    """First line of the docstring of a public name; tables of things have none."""
    value = getattr(ck, name)
    if not callable(value):
        return f"{type(value).__name__}, {len(value)} entries"
    text = (value.__doc__ or "").strip().partition("\n\n")[0]
    return " ".join(text.split()).replace("``", "`").replace("|", "\\|")


def api_table() -> str:
    """The public names of ``contactkit``, by topic."""
    names = public_names()
    parts = []
    for topic in TOPICS:
        if names[topic.page]:
            rows = "\n".join(f"| `ck.{name}` | {summary(name)} |" for name in names[topic.page])
            parts.append(f"## {topic.title}\n\n| name | is |\n|---|---|\n{rows}")
    return "\n\n".join(parts)


def _block(path: str, **options: str) -> str:
    """What mkdocstrings reads."""
    lines = (f"      {key}: {value}" for key, value in options.items())
    return "\n".join((f"::: {path}", "    options:", *lines))


def pages() -> dict[str, str]:
    """The page of each topic, for mkdocstrings."""
    names = public_names()
    found = {}
    for topic in TOPICS:
        parts = [f"# {topic.title}"]
        parts += [
            _block(f"contactkit.{name}", heading=f"ck.{name}", toc_label=name)
            for name in names[topic.page]
        ]
        parts += [_block(module, toc_label=module.rpartition(".")[2]) for module in topic.modules]
        found[f"api/{topic.page}.md"] = "\n\n".join(parts) + "\n"
    return found
