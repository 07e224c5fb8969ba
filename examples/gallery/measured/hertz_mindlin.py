"""A sphere pressed and sheared: Hertz, Cattaneo and Mindlin, and a cycle of Mindlin-Deresiewicz."""

from __future__ import annotations

import warnings
from typing import Any

import numpy as np

import contactkit as ck
from contactkit.app.gallery.page import Check, Data, Page, Table
from contactkit.app.gallery.run import run_page
from contactkit.plot import gallery as plot
from contactkit.reference import hertz, partial_slip

PAGE = Page(
    name="hertz-mindlin",
    title="A sphere pressed and sheared: Hertz, Cattaneo, Mindlin and Deresiewicz",
    claim="Pressure, approach and radius of Hertz; tractions, stick circle and tangential "
    "displacement of Cattaneo and Mindlin; the loop and the loss of a cycle of Mindlin and "
    "Deresiewicz. Closed forms, in contactkit.reference.",
    verdict="The solver has them: displacements to some parts in 1e5 of that of full sliding all "
    "around the cycle, the loss of the cycle to 1 in 1000, tractions to 1 % on the mean, "
    "most of it at the edge of the stick circle.",
    choices="Modulus 70 GPa, nu = 0.3, radius 1 mm, 1 N, friction 0.3; the pressure is that "
    "without friction, tractions along the load.",
    grid="64 x 64 and 128 x 128 pixels on 2.4 contact radii, not periodic",
)
E, NU, MU, LOAD, RADIUS = 70e9, 0.3, 0.3, 1.0, 1e-3
CONTACT = hertz.sphere(LOAD, RADIUS, E / (1.0 - NU**2))
SPHERE = partial_slip.Sphere(LOAD, MU, CONTACT.contact_radius, 0.5 * E / (1.0 + NU) / (2.0 - NU))
PATH = (0.3, 0.6, 0.8, 0.4, 0.0, -0.4, -0.8, -0.4, 0.0, 0.4, 0.8)  # of the force of sliding


def compute(draft: bool = False) -> dict[str, Any]:
    """Pressure, tractions, displacements and loss on two grids."""
    grids = (32, 64) if draft else (64, 128)
    data: dict[str, Any] = {"grids": np.array(grids)}
    for i, n in enumerate(grids):
        result = _solved(n)
        part = result.of(ck.PartialSlip)
        pixel = result.plan.grid.pixel_size[0]
        x = (np.arange(n) - n // 2) * pixel
        r = np.hypot(x[:, None], x)
        q = partial_slip.traction(r, SPHERE, 0.6 * SPHERE.friction)
        p = hertz.pressure(r, CONTACT.contact_radius, CONTACT.peak_pressure)
        loss = part.energy_loss(2, len(PATH) - 1)
        data |= {
            f"x_{i}": x,
            f"pressure_{i}": result.pressure[n // 2],
            f"traction_{i}": part.traction_x[1][n // 2],
            f"displacement_{i}": part.displacement[1:],
            f"norms_{i}": np.array(
                [
                    np.linalg.norm(result.pressure - p) / np.linalg.norm(p),
                    np.linalg.norm(part.traction_x[1] - q) / np.linalg.norm(q),
                    loss / partial_slip.cycle_loss(SPHERE, 0.8 * SPHERE.friction) - 1.0,
                    result.max_pressure / CONTACT.peak_pressure - 1.0,
                ]
            ),
        }
    return data


def _solved(n: int) -> Any:
    scene = ck.ContactScene(
        interface=ck.Interface(
            lower=ck.Body(solid=ck.Material(young_modulus=E, poisson_ratio=NU)),
            upper=ck.Body(surface=ck.Paraboloid(radius=RADIUS)),
        ),
        window=ck.Window(width=2.4 * CONTACT.contact_radius, periodic=False),
        loading=ck.Pressing(force=LOAD),
        effects=(
            ck.HalfSpace(),
            ck.PartialSlip(
                coefficient=MU, path=tuple(ck.TangentialStep(ratio=s, steps=1) for s in PATH)
            ),
        ),
    )
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", ck.ValidityWarning)  # one body: friction left out of p
        return ck.solve(ck.plan(scene, ck.Accuracy(grid=n)))


def _closed(forces: Any) -> Any:
    """Displacement [m] over a path of forces over mu P: up to 0.8, down to -0.8 and up again."""
    full = SPHERE.friction
    found: list[float] = []
    last, turn, at_turn = 0.0, 0.0, 0.0  # force before, force and displacement at the last turn
    for force in forces:
        rises = force > last
        if last and (force - last) * (last - turn) < 0.0:
            at_turn, turn = found[-1], last
        if turn:
            half = partial_slip.displacement(SPHERE, 0.5 * full * abs(force - turn))
            found.append(at_turn + (2.0 if rises else -2.0) * half)
        else:
            found.append(partial_slip.displacement(SPHERE, full * force))
        last = force
    return np.array(found)


def draw(data: Data) -> plot.Figure:
    """Pressure and traction along a diameter, and the loop."""
    figure, (left, middle, right) = plot.figure(1, 3, size=(12.4, 4.2))
    fine = np.linspace(-1.2, 1.2, 601)
    r = np.abs(fine) * CONTACT.contact_radius
    exact = plot.series(0, marker="")
    left.plot(fine, hertz.pressure(r, CONTACT.contact_radius, CONTACT.peak_pressure) / 1e9, **exact)
    middle.plot(fine, partial_slip.traction(r, SPHERE, 0.6 * SPHERE.friction) / 1e9, **exact)
    x = data["x_1"] / CONTACT.contact_radius
    left.plot(x, data["pressure_1"] / 1e9, **plot.series(1, ls=""))
    middle.plot(x, data["traction_1"] / 1e9, **plot.series(1, ls=""))
    for ax, name in ((left, "pressure [GPa]"), (middle, "traction [GPa]")):
        ax.set(xlabel="x/a [-]", ylabel=name)
    # The closed form of the whole cycle: up, down and up again.
    ways = np.concatenate(
        [np.linspace(0.0, 0.8, 41), np.linspace(0.8, -0.8, 81)[1:], np.linspace(-0.8, 0.8, 81)[1:]]
    )
    scale = SPHERE.sliding_displacement
    right.plot(_closed(ways.tolist()) / scale, ways, **exact, label="closed forms")
    right.plot(data["displacement_1"] / scale, PATH, **plot.series(1, ls=""), label="contactkit")
    right.set(xlabel="displacement over that of sliding [-]", ylabel="force over mu P [-]")
    right.legend(fontsize=9, loc="upper left")
    plot.letters((left, middle, right), ("Hertz", "Cattaneo, 0.6 mu P", "a cycle of 0.8 mu P"))
    return figure


def check(data: Data) -> list[Check]:
    """Distance of the solver from the closed forms."""
    exact, scale = _closed(PATH), SPHERE.sliding_displacement
    off = [float(np.abs(data[f"displacement_{i}"] - exact).max()) / scale for i in (0, 1)]
    norms = [data[f"norms_{i}"] for i in (0, 1)]
    return [
        Check(
            "the maximum pressure is that of Hertz to 1 in 1000",
            bool(abs(norms[1][3]) < 1e-3),
            f"{100 * norms[1][3]:+.3f} %",
        ),
        Check(
            "displacements on the path are those of Mindlin and Deresiewicz to 1e-4 of sliding",
            off[1] < 1e-4,
            f"{off[0]:.1e} and {off[1]:.1e} on two grids",
        ),
        Check(
            "the loss of the cycle is that of the closed form to 1 in 1000",
            bool(abs(norms[1][2]) < 1e-3),
            f"{100 * norms[0][2]:+.4f} and {100 * norms[1][2]:+.4f} % on two grids",
        ),
        Check(
            "tractions are those of Cattaneo and Mindlin to 1 % on the mean, pressures too",
            bool(norms[1][1] < 0.012 and norms[1][0] < 0.01),
            f"tractions {100 * norms[0][1]:.2f} and {100 * norms[1][1]:.2f} %, pressures "
            f"{100 * norms[0][0]:.2f} and {100 * norms[1][0]:.2f} %",
        ),
        Check(
            "a finer grid is nearer in tractions and displacements",
            bool(norms[1][1] < norms[0][1] and off[1] < off[0]),
            f"by factors of {norms[0][1] / norms[1][1]:.1f} and {off[0] / off[1]:.1f}",
        ),
    ]


def table(data: Data) -> Table:
    """Displacements along the path over that of full sliding."""
    scale = SPHERE.sliding_displacement
    rows = zip(PATH, _closed(PATH) / scale, data["displacement_1"] / scale, strict=True)
    return Table(
        ("force/(mu P)", "closed form", "contactkit"), [tuple(map(float, r)) for r in rows]
    )


if __name__ == "__main__":
    run_page(__file__)
