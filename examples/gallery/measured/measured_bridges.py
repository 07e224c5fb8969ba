"""Two spheres drawn apart in a thick oil: against the forces that Pitois measured."""

from __future__ import annotations

import numpy as np

import contactkit as ck
from contactkit.app.gallery.page import Check, Data, Page, Table
from contactkit.app.gallery.run import run_page
from contactkit.gallery.measured.cases import case
from contactkit.lubrication.dimensionless import GRAVITY
from contactkit.plot import gallery as plot

PAGE = Page(
    name="measured-bridges",
    title="Two spheres drawn apart in oil: the forces that Pitois measured",
    claim="Pitois, Moucheront and Chateau (J. Colloid Interface Sci. 231, 2000, 26, Figs. 5 and "
    "6) measured the force on ruby spheres of 4 mm with 1.1 mm3 of silicone oil between "
    "them, opened and closed. Others digitised the points (Leibniz-IWT/ddgclib, MIT) and "
    "disagree: 0.1 Pa.s and 5 um/s, or 100 Pa.s and 10 um/s. With 0.1 Pa.s the viscous "
    "force is a thousandth of what the points need, so that we take 100 Pa.s, and show "
    "both rates.",
    verdict="Does not agree at 5 um/s: 33 % below the points close by, 41 % above them far off. "
    "At 10 um/s, with the liquid that receding lines leave behind, half the weight and "
    "the extensional stress, 11 % below and 16 % above: 15 % rms in place of 27. The film "
    "deposited accounts for most of the excess far off. Close by no rate fits all points. "
    "Closing, the advancing angle is far from 0, so that our attraction is 15 to 95 % too "
    "large.",
    choices="Contact angle 0 on both spheres.",
    grid="27 and 24 points, exact bridges",
)
OPENING, CLOSING = case("pitois_2000_fig5"), case("pitois_2000_fig6")
RADIUS, VOLUME = OPENING["sphere_radius_m"], OPENING["volume_m3"]
RATE = OPENING["gap_rate_m_s"]
WEIGHT = GRAVITY * OPENING["density_kg_m3"] * VOLUME
FILM, LOWER, COLUMN = ck.LandauLevichFilm(), ck.LiquidWeight(body="lower"), ck.TroutonForce()
WETTING = ((), (FILM,), (FILM, LOWER), (FILM, LOWER, COLUMN))
"""What is added to capillary and viscous force, one more in each row of the opening."""


def compute(draft: bool = False) -> dict[str, np.ndarray]:
    """Capillary and viscous force at the distances of both figures, and with dynamic wetting."""
    found = {}
    for name, given in (("opening", OPENING), ("closing", CLOSING)):
        order = np.argsort(given["d_over_r"])
        distance = np.array(given["d_over_r"])[order]
        capillary, viscous = _forces(distance)
        measured = np.array(given["force_N"])[order]
        found[name] = np.array([distance, measured, capillary, viscous])
    distance = found["opening"][0]
    for name, rate in (("quoted", RATE), ("twice", 2.0 * RATE)):
        rows = [_run(distance, rate, *effects) for effects in WETTING]
        found[name] = np.array([np.interp(distance * RADIUS, r.gap, r.pull) for r in rows])
    left = [rows[1]["deposited_volume"][-1]]
    return found | {"lost": np.array(left)}


def _run(distance: np.ndarray, rate: float, *effects: object) -> ck.SeparationResult:
    """Opening over distances over R at a rate [m/s], with effects beside the usual two."""
    oil = ck.Liquid(
        name="silicone oil",
        viscosity=OPENING["viscosity_Pas"],
        surface_tension=OPENING["surface_tension_N_m"],
        density=OPENING["density_kg_m3"],
    )
    ball = ck.Body(surface=ck.Sphere(radius=RADIUS))
    film = ck.Meniscus(liquid=oil, volume=VOLUME, contact_angle_lower=0.0, contact_angle_upper=0.0)
    scene = ck.SeparationScene(
        interface=ck.Interface(lower=ball, upper=ball, meniscus=film),
        loading=ck.ImposedSpeed(
            initial_gap=distance[0] * RADIUS, final_gap=distance[-1] * RADIUS, speed=rate
        ),
        effects=(ck.MeniscusForce(), ck.ViscousForce(), *effects),
    )
    return ck.simulate(ck.plan(scene))


def _forces(distance: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Both forces [N] at distances over R, opening at the quoted rate."""
    found = _run(distance, RATE)
    gaps = distance * RADIUS
    capillary, viscous = (
        np.interp(gaps, found.gap, found.columns[name])
        for name in ("meniscus_force", "viscous_force")
    )
    return capillary, viscous


def draw(data: Data) -> plot.Figure:
    """Forces of both figures."""
    figure, (ax, close) = plot.figure(1, 2, size=(10.5, 4.8))
    distance, measured, capillary, viscous = data["opening"]
    ax.loglog(distance, measured * 1e3, **plot.series(0) | {"ls": ""}, label="measured")
    static = OPENING["static_first_point"]
    ax.loglog(
        static["d_over_r"], static["force_N"] * 1e3, "k*", ms=10, mfc="none", ls="",
        label="measured, static",
    )  # fmt: skip
    lines = (
        ("capillary", capillary, 3),
        ("capillary + viscous, 5 um/s", data["quoted"][0], 1),
        ("capillary + viscous, 10 um/s", data["twice"][0], 2),
        ("10 um/s, film deposited", data["twice"][1], 4),
        ("10 um/s, film, weight, extension", data["twice"][3], 5),
    )
    for label, force, i in lines:
        ax.loglog(distance, force * 1e3, **plot.series(i, marker=""), label=label)
    ax.axhline(WEIGHT * 1e3, color="0.5", lw=0.8)
    ax.text(0.0145, WEIGHT * 1.08e3, "weight of the liquid", fontsize=8, color="0.35")
    ax.set(xlabel="distance / radius [-]", ylabel="force [mN]", ylim=(0.008, 4.0))
    ax.set_xticks([0.02, 0.05, 0.1, 0.2], ["0.02", "0.05", "0.1", "0.2"])
    ax.minorticks_off()
    ax.legend(fontsize=8, loc="upper right")
    distance, measured, capillary, viscous = data["closing"]
    close.plot(distance, measured * 1e3, **plot.series(0) | {"ls": ""}, label="measured (by eye)")
    close.plot(distance, capillary * 1e3, **plot.series(3, marker=""), label="capillary, 0 deg")
    total = (capillary - 2.0 * viscous) * 1e3
    close.plot(distance, total, **plot.series(2, marker=""), label="capillary + viscous, 10 um/s")
    close.axhline(0.0, color="0.4", lw=0.8)
    close.set(xlabel="distance / radius [-]", ylabel="force [mN], attraction positive")
    close.legend(fontsize=8, loc="lower right")
    plot.letters((ax, close), ("drawn apart (Fig. 5)", "pressed together (Fig. 6)"))
    return figure


def _off(force: np.ndarray, measured: np.ndarray, where: np.ndarray) -> float:
    return float(100.0 * (force / measured - 1.0)[where].mean())


def check(data: Data) -> list[Check]:
    """Disagreement, and what each reason accounts for."""
    distance, measured, capillary, viscous = data["opening"]
    near, far = distance < 0.055, distance > 0.11
    slow, fast = (
        [[_off(f, measured, w) for w in (near, far)] for f in data[name]]
        for name in ("quoted", "twice")
    )
    static = capillary[0] / OPENING["static_first_point"]["force_N"] - 1.0
    parts = (viscous / capillary)[far]
    needed = ((measured - capillary) / viscous)[near]
    d, seen, pull, drag = data["closing"]
    ours = pull - 2.0 * drag
    crossing = [float(np.interp(0.0, f[:8], d[:8])) for f in (ours, seen)]
    return [
        Check(
            "at 5 um/s the points are missed",
            bool(abs(slow[0][0] + 33.2) < 1.0 and abs(slow[0][1] - 40.6) < 1.0),
            f"{slow[0][0]:+.0f} % below D/R = 0.055, {slow[0][1]:+.0f} % beyond 0.11",
        ),
        Check(
            "at 10 um/s less than half of that is left close by",
            bool(abs(fast[0][0] + 12.8) < 1.0),
            f"{fast[0][0]:+.0f} %",
        ),
        Check(
            "no rate brings the viscous force to all points close by",
            bool(needed.min() < 2.5 and needed.max() > 3.0),
            f"the factor it needs at 5 um/s goes from {needed.min():.1f} to {needed.max():.1f}",
        ),
        Check(
            "the static point is met",
            bool(abs(static) < 0.1),
            f"{100 * static:+.0f} %, read by eye",
        ),
        Check(
            "far off the viscosity has no part of its own",
            bool(parts.max() < 0.06),
            f"at most {100 * parts.max():.0f} % of the capillary force at 5 um/s",
        ),
        *_wetting(data, slow, fast),
        Check(
            "closing, the force changes sign at the measured distance within 12 %",
            bool(abs(crossing[0] / crossing[1] - 1.0) < 0.12),
            f"D/R = {crossing[0]:.4f}, measured {crossing[1]:.4f}",
        ),
    ]


def _wetting(data: Data, slow: list[list[float]], fast: list[list[float]]) -> list[Check]:
    """Return what film, weight and column account for, of the errors [%] near and far."""
    measured, lost = data["opening"][1], 1e9 * float(data["lost"][0])
    rms = [100.0 * float(np.sqrt(np.mean((f / measured - 1.0) ** 2))) for f in data["twice"]]
    return [
        Check(
            "the liquid left behind takes away most of the excess far off",
            bool(abs(lost - 0.287) < 0.005 and abs(fast[1][1] - 14.3) < 1.0),
            f"{lost:.2f} mm3 at 10 um/s: {fast[0][1]:+.0f} to {fast[1][1]:+.0f} % (at 5 um/s "
            f"{slow[0][1]:+.0f} to {slow[1][1]:+.0f} %)",
        ),
        Check(
            "half the weight, off the lower sphere, takes some more",
            bool(3.0 < fast[1][1] - fast[2][1] < 9.0),
            f"{fast[1][1]:+.0f} to {fast[2][1]:+.0f} %; the whole is "
            f"{100 * WEIGHT / measured[-1]:.0f} % of the last point",
        ),
        Check(
            "the extensional stress adds close by",
            bool(3.0 < fast[3][0] - fast[2][0] < 8.0),
            f"{fast[2][0]:+.0f} to {fast[3][0]:+.0f} %",
        ),
        Check(
            "with all three little more than half of the error is left",
            bool(rms[3] < 0.6 * rms[0]),
            f"{rms[0]:.0f} to {rms[3]:.0f} % rms at 10 um/s; {fast[3][0]:+.0f} % close by, "
            f"{fast[3][1]:+.0f} % far off",
        ),
    ]


def table(data: Data) -> Table:
    """Forces while the spheres are drawn apart, in mN: both rates, and with dynamic wetting."""
    distance, measured, capillary, _ = data["opening"]
    bare, wet = ([data[name][i] for name in ("quoted", "twice")] for i in (0, 3))
    columns = (measured, capillary, *bare, *wet)
    rows = [
        (float(d), *(float(1e3 * column[i]) for column in columns)) for i, d in enumerate(distance)
    ]
    both = ("5 um/s", "10 um/s", "5 um/s, wetting", "10 um/s, wetting")
    return Table(("D/R", "measured", "capillary", *both), rows)


if __name__ == "__main__":
    run_page(__file__)
