"""Pages of the API, by topic: public names as users write them, then what else a user calls.

A name of ``contactkit`` belongs to the topic that lists the longest beginning of its home.
"""

from __future__ import annotations

import re
from collections.abc import Mapping, Sequence
from typing import NamedTuple

import contactkit as ck


class Topic(NamedTuple):
    """A page: homes of the public names on it, and what else of the package a user calls."""

    page: str
    title: str
    homes: Sequence[str] = ()
    more: Sequence[str] = ()


def _of(room: str, *names: str) -> tuple[str, ...]:
    return tuple(f"{room}.{name}" for name in names)


TOPICS = (
    Topic("scenes", "Scenes", ("scene",)),
    Topic("loading", "Loading", ("scene.loading",)),
    Topic(
        "bodies",
        "Bodies and materials",
        _of("scene", "materials", "solids", "asperity_population"),
    ),
    Topic(
        "surfaces",
        "Surfaces and faces",
        _of("scene", "surfaces", "planforms", "faces", "rough_surfaces"),
    ),
    Topic(
        "liquids",
        "Liquids",
        ("liquids", "scene.meniscus"),
        _of(
            "liquids",
            *("temperature_laws.LinearSurfaceTension", "temperature_laws.LinearDensity"),
            *("viscosity.WaltherViscosity", "viscosity.VogelViscosity"),
            *("water.IapwsSurfaceTension", "water.KellWaterDensity"),
            *("rheology.pressure.BarusViscosity", "rheology.pressure.RoelandsViscosity"),
            *("rheology.shear.PowerLawViscosity", "rheology.shear.CarreauViscosity"),
            *("rheology.shear.EyringViscosity", "rheology.density.DowsonHigginsonDensity"),
        ),
    ),
    Topic(
        "separation-effects",
        "Effects of separation and sliding",
        (
            *_of("separation", "effects", "sliding.effects", "wetting"),
            *_of("separation.deforming", "effects"),
        ),
    ),
    Topic("contact-effects", "Effects of contact", ("contact.effects", "kinds")),
    Topic("run", "Planning and solving", ("planning", "accuracy", "contact", "separation")),
    Topic(
        "results",
        "Results",
        (
            *("contact.result", "separation.results", "separation.sliding.result"),
            *("separation.motion", "separation.deforming.result", "scene.gradient"),
        ),
    ),
    Topic("one-number", "One number from one call", ("shortcuts",)),
    Topic("curves", "Curves and maxima", ("analyses",)),
    Topic(
        "statistics",
        "Statistics of surfaces and contacts",
        (),
        (
            *_of("analyses", "heights.surface_heights", "area_over_load.area_over_load"),
            *_of("analyses", "load_for.load_for_contact_fraction", "load_for.load_of_first_yield"),
            *_of("analyses", "subsurface.stress_below", "subsurface.maximum_planes"),
            *_of("contact", "patches.contact_patches", "patches.patch_density"),
            *_of("contact", "plastic_history.residual_surface"),
            *_of("roughness.statistics", "surface_statistics", "rms_slope", "rms_curvature"),
            *_of("roughness.statistics", "bearing_curve", "summits", "correlation_length"),
            *_of("roughness.spectra", "radial_spectrum", "plane_spectrum", "profile_spectrum"),
        ),
    ),
    Topic("studies", "Studies and gradients", ("studies", "contact.functionals")),
    Topic("fits", "Fits", ("fitting",)),
    Topic(
        "files",
        "Files and units",
        ("files", "citing"),
        _of("units", "celsius", "parse_quantity", "quantity_text"),
    ),
    Topic(
        "pictures",
        "Pictures",
        ("plot",),
        (
            *_of("plot", "roughness.height_map", "roughness.area_and_theories"),
            *_of("plot.stress", "draw_section"),
        ),
    ),
    Topic("live-pages", "Live pages", (), _of("live_page.page", "write_page")),
    Topic("errors", "Warnings and errors", ("errors",)),
    Topic("published", "Equations as published", ("as_published",)),
    Topic(
        "menisci",
        "Menisci and adhesion, one at a time",
        (),
        (
            *_of("capillary.kelvin", "kelvin_radius", "meniscus_height", "relative_humidity"),
            *_of("capillary.exact", "bridge.bridge", "bridge.bridge_at_pressure"),
            *_of("capillary.exact", "stability.stability_limit", "profile.profile"),
            *_of("capillary", "arc.bridge.arc_bridge", "many_menisci.max_stable_count"),
            *_of("adhesion", "van_der_waals.sphere_force", "parameters.scales"),
            *_of("adhesion.rough_limits", "full_contact_energy", "stickiness_number"),
        ),
    ),
    Topic(
        "faces",
        "Films on faces",
        (),
        _of(
            "lubrication.reynolds",
            *("face.rasterise", "face.face_from_image", "face.face_from_level", "face.Hole"),
            *("face.Pocket", "gaps.gap_map", "film.GridFilm", "film.GridFilmState"),
            *("solve.at_rest", "solve.solve_pressure", "solve.steady_film", "solve.step_film"),
            *("motion.follow_gap", "shape_factor.face_damping", "damping.ring_damping"),
            *("shape_factor.tabulate_damping", "shape_factor.rough_damping"),
            *("rough_flow.flow_factors", "rough_flow.leakage"),
        ),
    ),
    Topic(
        "fmus",
        "FMUs and devices",
        (),
        (
            *_of("fmu", "python.build.build", "python.build.validate"),
            *_of("fmu", "native.build.build_native"),
            *_of("fmu.master.couple", "couple", "Mass", "FixedSteps", "AdaptiveSteps"),
            *("models.injector.monolithic.simulate", "models.micromirror.landing.land"),
        ),
    ),
)

# Members that a user calls; other members of a class serve the engine, or are fields above.
MEMBERS: Mapping[str, Sequence[str]] = {
    "DugdaleAttraction": ("from_meniscus",),
    "AsperityPopulation": ("split",),
    "Liquid": ("at",),
    "Meniscus": ("from_coverage", "from_radius"),
    "Material": ("plane_strain_modulus",),
    "TransverselyIsotropicMaterial": ("from_stiffness", "plane_strain_modulus"),
    "ViscoelasticMaterial": ("from_series", "from_table", "instantaneous", "equilibrium"),
    "FineRoughness": ("patch",),
    "Plan": ("force", "validity"),
    "ContactPlan": ("heights", "memory", "rigid_approach", "with_loading"),
    "ContactResult": (
        *("contact", "holes", "contact_area", "corrected_contact_area", "contact_fraction"),
        *("load", "mean_pressure", "max_pressure", "max_displacement", "approach"),
        *("plastic_area", "of", "scalars"),
    ),
    "SeparationResult": (
        *("gap", "pull", "viscous_impulse", "mean_viscous_force", "errata", "of", "scalars"),
    ),
    "SlidingResult": ("travel", "duration", "errata", "of", "total", "scalars"),
    "DeformingResult": ("gap", "pull", "error", "section", "maps", "of", "scalars"),
    "Gradient": ("relative", "table"),
    "StudyFile": ("status", "column", "failed", "forget_failed", "save_csv"),
    "Fit": ("correlations", "table", "profile", "sample", "to_toml", "save", "cite"),
    "SavedCurve": ("table", "scalars"),
    "GridFilmState": (
        *("force", "torque", "centre_of_pressure", "liquid_volume", "void_volume"),
        *("cavity_area", "dissipation", "shear_force", "shear_traction", "validity"),
    ),
}


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


def api_table() -> str:
    """The public names of ``contactkit``, by topic."""
    names = public_names()
    rows = []
    for topic in TOPICS:
        shown = [f"`ck.{name}`" for name in names[topic.page]]
        shown += [f"`{path.rpartition('.')[2]}`" for path in topic.more]
        rows.append(f"| {topic.title} | {', '.join(shown)} |")
    return "\n".join(("| page | names |", "|---|---|", *rows))


def _block(path: str, heading: str, label: str) -> str:
    """What mkdocstrings reads."""
    members = ", ".join(MEMBERS.get(label, ()))
    options = (f"heading: {heading}", f"toc_label: {label}", f"members: [{members}]")
    return "\n".join((f"::: {path}", "    options:", *(f"      {line}" for line in options)))


def pages() -> dict[str, str]:
    """The page of each topic, for mkdocstrings."""
    names = public_names()
    found = {}
    for topic in TOPICS:
        parts = [f"# {topic.title}"]
        parts += [_block(f"contactkit.{n}", f"ck.{n}", n) for n in names[topic.page]]
        parts += [_block(f"contactkit.{p}", p, p.rpartition(".")[2]) for p in topic.more]
        found[f"api/{topic.page}.md"] = "\n\n".join(parts) + "\n"
    return found


ENTRY = re.compile(r'(?=<div class="doc doc-object doc-\w+">\s*<h2 )')
PARTS = re.compile(
    r"(?P<head>.*?</h2>)(?P<signature>.*?)(?P<open><div class=\"doc doc-contents first\">)"
    r"\s*<p>(?P<summary>.*?)</p>(?P<rest>.*)</div>(?P<after>[^<]*)\Z",
    re.DOTALL,
)


def folded(html: str) -> str:
    """A page as an index: each entry shows its name and one sentence, and opens to the rest."""

    def fold(entry: str) -> str:
        found = PARTS.match(entry)
        if found is None:
            return entry
        part = found.groupdict()
        return (
            f"{part['head']}<details><summary>{part['summary']}</summary>"
            f"{part['signature']}{part['open']}{part['rest']}</details></div>{part['after']}"
        )

    before, *entries = ENTRY.split(html)
    return before + "".join(fold(entry) for entry in entries)
