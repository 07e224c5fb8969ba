"""Adhesion of a sphere from DMT to JKR, against the fits of Carpick, Ogletree and Salmeron."""

from __future__ import annotations

from typing import Any

import numpy as np
from scipy.optimize import minimize_scalar

from contactkit.adhesion.contact_models import contact_model
from contactkit.app.gallery.page import Check, Data, Page, Table
from contactkit.app.gallery.run import run_page
from contactkit.plot import gallery as plot

PAGE = Page(
    name="sphere-adhesion",
    title="Adhesion of a sphere: JKR, DMT and what lies between",
    claim="Pull-off of 3/2 pi w R of soft, large spheres (JKR) and 2 pi w R of stiff, small "
    "ones (DMT); between them Maugis' solution, with the fits of Carpick, Ogletree and "
    "Salmeron (1999): pull-off -7/4 + (4.04 l^1.4 - 1)/(4 (4.04 l^1.4 + 1)) in pi w R, "
    "contact radius a/a0 = ((alpha + sqrt(1 - L/Lc))/(1 + alpha))^(2/3).",
    verdict="Both limits are met, and the fit of the pull-off within 2 %. The form of the contact "
    "radius, with alpha fitted to our curves, is good to half a per cent down to nine "
    "tenths of the pull-off.",
    choices="Loads over pi w R, radii over (pi w R^2/K)^(1/3), K = 4 E*/3, without the ring in "
    "which the bodies attract. The coefficients of the fit could not be read again.",
    grid="60 values of lambda, 80 loads",
)
LAMBDAS = (0.1, 0.3, 1.0, 3.0)


def _fit(transition: Any) -> Any:
    """Pull-off of the fit over pi w R."""
    power = 4.04 * np.asarray(transition) ** 1.4
    return 1.75 - 0.25 * (power - 1.0) / (power + 1.0)


def compute(draft: bool = False) -> dict[str, Any]:
    """Pull-off over lambda, and contact radius over the load."""
    transitions = np.geomspace(0.01, 30.0, 15 if draft else 60)
    pull = [contact_model("maugis-dugdale", t).pull_off_force for t in transitions.tolist()]
    data: dict[str, Any] = {"transitions": transitions, "pull_off": np.array(pull)}
    n = 20 if draft else 80
    for name in ("jkr", "dmt"):
        data[name] = _radii(name, 1.0, n)
    for i, transition in enumerate(LAMBDAS):
        data[f"curve_{i}"] = _radii("maugis-dugdale", transition, n)
    return data


def _radii(name: str, transition: float, n: int) -> Any:
    """Loads and contact radii from pull-off on."""
    model = contact_model(name, transition)
    pull = float(model.pull_off_force)
    loads = -pull + (3.0 + pull) * np.linspace(1e-6, 1.0, n) ** 2
    return np.array([loads, [model.at_load(load).contact_radius for load in loads.tolist()]])


def _form(alpha: float, loads: Any, pull: float) -> Any:
    """Contact radius of the fit over that at no load."""
    return ((alpha + np.sqrt(1.0 + loads / pull)) / (1.0 + alpha)) ** (2.0 / 3.0)


def _fitted(curve: Any, pull: float) -> tuple[float, Any]:
    """Exponent alpha that fits a curve best, and the relative errors of the fit."""
    loads, radii = curve
    free = float(np.interp(0.0, loads, radii))

    def errors(alpha: float) -> Any:
        return _form(alpha, loads, pull) * free / radii - 1.0

    inside = loads > -0.9 * pull
    best = minimize_scalar(
        lambda alpha: float((errors(alpha)[inside] ** 2).sum()), bounds=(0.0, 1.2), method="bounded"
    )
    return float(best.x), np.where(inside, errors(float(best.x)), np.nan)


def draw(data: Data) -> plot.Figure:
    """Pull-off over lambda, radius over load, errors of the fits."""
    figure, (left, middle, right) = plot.figure(1, 3, size=(12.4, 4.3))
    transitions = data["transitions"]
    left.semilogx(transitions, data["pull_off"], **plot.series(0, marker=""), label="Maugis")
    left.semilogx(transitions, _fit(transitions), **plot.series(1, marker=""), label="fit of 1999")
    for level, name in ((2.0, "DMT"), (1.5, "JKR")):
        left.axhline(level, color="0.5", lw=0.8)
        left.annotate(name, (0.012 if level == 2.0 else 18.0, level), va="bottom", fontsize=8)
    left.set(xlabel="lambda [-]", ylabel="pull-off over pi w R [-]", ylim=(1.4, 2.1))
    left.legend(fontsize=8, loc="center left")
    for i, name in enumerate(("dmt", "jkr")):
        middle.plot(*data[name], **plot.series(5 * i, marker="", lw=2.0), label=name.upper())
    for i, transition in enumerate(LAMBDAS):
        look = plot.series(i + 1, marker="", lw=1.2)
        middle.plot(*data[f"curve_{i}"], **look, label=f"lambda = {transition:g}")
        _, errors = _fitted(data[f"curve_{i}"], -float(data[f"curve_{i}"][0, 0]))
        right.plot(data[f"curve_{i}"][0], 100.0 * errors, **look, label=f"lambda = {transition:g}")
    middle.set(xlabel="load over pi w R [-]", ylabel="contact radius [-]", ylim=(0.0, None))
    middle.legend(fontsize=8, loc="lower right")
    right.set(xlabel="load over pi w R [-]", ylabel="fit of the radius, error [%]")
    right.legend(fontsize=8)
    plot.letters((left, middle, right), ("pull-off", "contact radius", "form of the radius"))
    return figure


def check(data: Data) -> list[Check]:
    """Limits, fits, and order of the curves."""
    transitions, pull = data["transitions"], data["pull_off"]
    off = pull / _fit(transitions) - 1.0
    fits = [_fitted(data[f"curve_{i}"], -float(data[f"curve_{i}"][0, 0])) for i in range(4)]
    alphas = [alpha for alpha, _ in fits]
    worst = [100.0 * float(np.nanmax(np.abs(errors))) for _, errors in fits]
    free = [float(np.interp(0.0, *data[f"curve_{i}"])) for i in range(4)]
    ends = float(np.interp(0.0, *data["dmt"])), float(np.interp(0.0, *data["jkr"]))
    return [
        Check(
            "pull-off falls from 2 (DMT) to 3/2 (JKR) as lambda grows",
            bool(np.all(np.diff(pull) < 0.0) and pull[0] > 1.995 and pull[-1] < 1.502),
            f"{pull[0]:.4f} to {pull[-1]:.4f}",
        ),
        Check(
            "the fit of the pull-off of Carpick, Ogletree and Salmeron is within 2 %",
            bool(np.abs(off).max() < 0.02),
            f"largest {100 * np.abs(off).max():.2f} %",
        ),
        Check(
            "contact radii at no load lie between those of DMT and JKR, in order",
            bool(ends[0] < free[0] and np.all(np.diff(free) > 0.0) and free[-1] < ends[1] * 1.0001),
            f"{ends[0]:.3f}; {', '.join(f'{a:.3f}' for a in free)}; {ends[1]:.3f}",
        ),
        Check(
            "the form of the contact radius fits within 0.5 % down to nine tenths of the pull-off",
            max(worst) < 0.5,
            ", ".join(f"{w:.1f}" for w in worst) + " %",
        ),
        Check(
            "its alpha grows from that of DMT, 0, to that of JKR, 1",
            bool(np.all(np.diff(alphas) > 0.0) and alphas[0] < 0.3 and 0.9 < alphas[-1] < 1.1),
            ", ".join(f"{a:.2f}" for a in alphas),
        ),
    ]


def table(data: Data) -> Table:
    """Pull-off and fit at some lambda."""
    rows = [
        (float(t), float(p), float(_fit(t)))
        for t, p in list(zip(data["transitions"], data["pull_off"], strict=True))[::7]
    ]
    return Table(("lambda", "pull-off", "fit"), rows)


if __name__ == "__main__":
    run_page(__file__)
