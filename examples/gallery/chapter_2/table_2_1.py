"""Table 2.1: materials of thin-film disks and sliders, as data."""

from __future__ import annotations

import numpy as np

import contactkit as ck
from contactkit.app.gallery.page import Check, Data, Page, Table
from contactkit.app.gallery.run import run_page
from contactkit.plot import gallery as plot

PAGE = Page(
    name="Table 2.1",
    title="Materials of thin-film disks and sliders",
    claim="Modulus, Poisson's ratio and hardness of overcoat, magnetic layer, disk blank and "
    "slider.",
    verdict="They are the materials of the library. Poisson's ratio of Ni-P is printed with a "
    "footnote mark run into it (0.363 for 0.36); what is missing for the magnetic layer "
    "and the substrate is chosen.",
    grid="seven materials",
)
NAMES = ("dlc", "dlc-hard", "co-cr", "ni-p", "al-mg", "glass-ceramic", "al2o3-tic")
PRINTED = {  # modulus, Poisson's ratio, hardness; nan: not printed
    "dlc": (140.0, 0.25, 15.0),
    "dlc-hard": (280.0, 0.25, 24.0),
    "co-cr": (190.0, np.nan, 9.0),
    "ni-p": (130.0, 0.36, 7.0),
    "al-mg": (70.0, np.nan, np.nan),
    "glass-ceramic": (150.0, 0.25, 13.0),
    "al2o3-tic": (450.0, 0.23, 23.0),
}


def compute(draft: bool = False) -> dict[str, np.ndarray]:
    """Modulus [Pa], Poisson's ratio and hardness [Pa] of the library."""
    found = [ck.load_material(name) for name in NAMES]
    rows = [(m.young_modulus, m.poisson_ratio, m.hardness) for m in found]
    return {"values": np.array(rows, dtype=float)}


def draw(data: Data) -> plot.Figure:
    """Hardness over modulus."""
    figure, ax = plot.figure(size=(6.2, 4.0))
    for i, (name, (modulus, _, hardness)) in enumerate(zip(NAMES, data["values"], strict=True)):
        style = plot.series(i) | {"ls": "", "ms": 7}
        ax.plot(modulus / 1e9, hardness / 1e9, label=ck.load_material(name).name, **style)
    modulus = np.linspace(0.0, 480.0, 2)
    ax.plot(modulus, 0.05 * modulus, color="0.6", lw=0.9, label="H = 0.05 E, as in chapter 2")
    ax.set(xlabel="Young's modulus [GPa]", ylabel="hardness [GPa]", xlim=(0, 480), ylim=(0, 30))
    ax.legend(fontsize=8)
    return figure


def check(data: Data) -> list[Check]:
    """Every printed number is that of the library."""
    units = np.array([1e9, 1.0, 1e9])
    printed = np.array([PRINTED[name] for name in NAMES])
    off = np.nanmax(np.abs(data["values"] / units - printed))
    return [
        Check(
            "every printed number is in the library",
            bool(off < 1e-9),
            f"{int(np.isfinite(printed).sum())} numbers, largest difference {off:.0e}",
        )
    ]


def table(data: Data) -> Table:
    """The table, with what is chosen."""
    rows = [
        (
            ck.load_material(name).name,
            float(e / 1e9),
            f"{nu:g}" + ("" if np.isfinite(PRINTED[name][1]) else " (chosen)"),
            f"{h / 1e9:g}" + ("" if np.isfinite(PRINTED[name][2]) else " (chosen)"),
        )
        for name, (e, nu, h) in zip(NAMES, data["values"], strict=True)
    ]
    return Table(("material", "E [GPa]", "nu", "H [GPa]"), rows)


if __name__ == "__main__":
    run_page(__file__)
