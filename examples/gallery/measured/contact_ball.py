"""Ball on a plane on 19 x 19 elements: against Kalker's program CONTACT."""

from __future__ import annotations

from typing import Any

import numpy as np

import contactkit as ck
from contactkit.app.gallery.page import Check, Data, Page
from contactkit.app.gallery.run import run_page
from contactkit.gallery.measured.cases import case
from contactkit.plot import gallery as plot
from contactkit.reference import hertz

PAGE = Page(
    name="contact-ball",
    title="Ball on a plane on 19 x 19 elements, by Kalker's program CONTACT",
    claim="CONTACT (E. Vollebregt, after Kalker 1990, section 5.2.1.1; as stored in "
    "eve70a/CONTACT, Apache-2.0) presses two equal bodies together and prints the "
    "pressure of each element, the approach and which elements touch.",
    verdict="The same 177 elements touch, and every pressure has the digits that CONTACT prints: "
    "both solve the same discrete problem. Against Hertz the coarse grid is 0.05 % off in "
    "the maximum.",
    grid="19 x 19 elements of 0.13333 mm, not periodic; a second solve on 95 x 95",
)
CASE = case("contact_hertz_grid")
COUNT, PIXEL, RADIUS = 19, CASE["element_m"], 0.05  # 10 r^2 = r^2/2R


def compute(draft: bool = False) -> dict[str, np.ndarray]:
    """Pressure on the grid of CONTACT, and on a finer one."""
    same, finer = _pressed(COUNT), _pressed((3 if draft else 5) * COUNT)
    printed = np.full((COUNT, COUNT), np.nan)
    for row, values in CASE["pressure_rows"].items():
        for x, pressure in values:
            printed[int(row) - 1, round(x / PIXEL) + COUNT // 2] = pressure
    middle = finer.pressure.shape[0] // 2
    return {
        "pressure": same.pressure,
        "printed": printed,
        "approach": np.array(same.approach),
        "finer": finer.pressure[middle],
    }


def _pressed(count: int) -> ck.ContactResult:
    shear, poisson = CASE["shear_modulus_Pa"], CASE["poisson_ratio"]
    rubber = ck.Material(young_modulus=2.0 * shear * (1.0 + poisson), poisson_ratio=poisson)
    scene = ck.ContactScene(
        interface=ck.Interface(
            lower=ck.Body(solid=rubber),
            upper=ck.Body(surface=ck.Paraboloid(radius=RADIUS), solid=rubber),
        ),
        window=ck.Window(width=COUNT * PIXEL, height=COUNT * PIXEL, periodic=False),
        loading=ck.Pressing(force=CASE["force_N"]),
        effects=(ck.LayeredHalfSpace(),),
    )
    return ck.solve(ck.plan(scene, ck.Accuracy(grid=count)))


def _hertz() -> hertz.Contact:
    modulus = CASE["shear_modulus_Pa"] / (1.0 - CASE["poisson_ratio"])
    return hertz.sphere(CASE["force_N"], RADIUS, modulus)


def draw(data: Data) -> plot.Figure:
    """Pressure along the middle row, and the elements that touch with what is left."""
    figure, (ax, grid) = plot.figure(1, 2, size=(9.5, 4.2))
    x = (np.arange(COUNT) - COUNT // 2) * PIXEL * 1e3
    middle = COUNT // 2
    exact, fine = _hertz(), np.linspace(-1.3, 1.3, 400)
    curve = hertz.pressure(fine / 1e3, exact.contact_radius, exact.peak_pressure) / 1e6
    ax.plot(fine, curve, **plot.series(0, marker=""), label="Hertz")
    ax.plot(x, data["printed"][middle] / 1e6, ls="", **_mark(2, 8), label="CONTACT, 19 elements")
    ax.plot(
        x, data["pressure"][middle] / 1e6, ls="", **_mark(1, 4), label="contactkit, 19 elements"
    )
    n = len(data["finer"])
    width = COUNT * PIXEL * 1e3
    at = ((np.arange(n) + 0.5) / n - 0.5) * width
    ax.plot(at, data["finer"] / 1e6, **plot.series(3, marker=""), label=f"contactkit, {n} elements")
    ax.set(xlabel="$x$ [mm]", ylabel="pressure [MPa]", ylim=(0.0, 6.2), xlim=(-1.3, 1.3))
    ax.legend(ncols=2, fontsize=8, loc="upper center")
    off = (data["pressure"] - data["printed"]) / 1e3
    edge = 0.5 * width
    image = grid.imshow(
        off, origin="lower", cmap="PuOr", vmin=-6, vmax=6, extent=(-edge, edge, -edge, edge)
    )
    figure.colorbar(image, ax=grid, label="contactkit - CONTACT [kPa]")
    grid.grid(False)
    grid.set(xlabel="$x$ [mm]", ylabel="$y$ [mm]")
    plot.letters((ax, grid), ("middle row", "touching elements: what is left, of 4393 kPa"))
    return figure


def _mark(i: int, size: float) -> dict[str, Any]:
    style = plot.series(i)
    return {"marker": style["marker"], "color": style["color"], "ms": size, "mfc": "none"}


def check(data: Data) -> list[Check]:
    """Elements in contact, pressures, maximum, approach."""
    touching, printed = data["pressure"] > 0.0, np.isfinite(data["printed"])
    off = np.abs(data["pressure"] - data["printed"])[printed]
    digit = np.where(data["printed"][printed] >= 1e6, 1e4, 1e3)
    peak, approach = float(data["pressure"].max()), float(data["approach"])
    exact = _hertz().peak_pressure
    return [
        Check(
            "the same elements touch",
            bool(np.array_equal(touching, printed)),
            f"{touching.sum()} here, {CASE['elements_in_contact']} there",
        ),
        Check(
            "every pressure has the three digits that CONTACT prints, but for its own asymmetry",
            bool(np.all(off < 0.5 * digit + 1e3)),
            f"at most {off.max() / 1e3:.1f} kPa, of {peak / 1e3:.0f} kPa; eight elements in like "
            "places have 901 to 903 kPa there",
        ),
        Check(
            "the maximum pressure has all four digits",
            bool(abs(peak - CASE["largest_pressure_Pa"]) < 500.0),
            f"{peak / 1e6:.4f} MPa; CONTACT: {CASE['largest_pressure_Pa'] / 1e6:.3f} MPa",
        ),
        Check(
            "the approach has all four digits",
            bool(abs(approach - CASE["approach_m"]) < 5e-9),
            f"{approach * 1e6:.4f} um; CONTACT: {CASE['approach_m'] * 1e6:.2f} um",
        ),
        Check(
            "a grid this coarse is within 0.2 % of the maximum of Hertz",
            bool(abs(peak / exact - 1.0) < 2e-3),
            f"{100 * (peak / exact - 1.0):+.2f} %",
        ),
    ]


if __name__ == "__main__":
    run_page(__file__)
