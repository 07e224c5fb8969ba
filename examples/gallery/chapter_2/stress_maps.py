"""Maps of pressure and stress around the spot of highest pressure, and maxima over seeds."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

import contactkit as ck
from contactkit.analyses.subsurface import MEASURES, MeasureName, maximum_planes, stress_below
from contactkit.app.gallery.page import Data
from contactkit.plot import gallery as plot

ROWS = (
    "pressure",
    "von Mises,\nsurface",
    "von Mises,\nits plane",
    "tension,\nits plane",
    r"$|\sigma_{xz}|$," + "\nits plane",
)
LABEL = {"fontsize": 7, "va": "top", "bbox": {"fc": "#00204d", "ec": "none", "pad": 1.0}}
NAMES: tuple[MeasureName, ...] = ("von_mises", "tension", "sigma_xz")


def cropped(values: np.ndarray, pressure: np.ndarray, pixels: int) -> np.ndarray:
    """Square of a periodic map around the maximum of the pressure."""
    place = np.unravel_index(int(np.argmax(pressure)), pressure.shape)
    for axis, centre in enumerate(place):
        values = np.roll(values, pixels // 2 - int(centre), axis=axis)
    return values[:pixels, :pixels].astype(np.float32)


def maps(result: ck.ContactResult, pixels: int, friction: float = 0.0) -> dict[str, np.ndarray]:
    """Maps (5, n, n) [Pa] in the order of `ROWS`, the pressure in the whole window with its maximum
    in the middle, maxima (3,) [Pa] and their depths (3,) [m]."""
    traction = ck.FrictionTraction(coefficient=friction) if friction else None
    worst = maximum_planes(result, NAMES, friction=traction)
    top = stress_below(result, ck.SubsurfaceStress(depths=(0.0,), keep="planes"), traction)
    assert top.planes is not None
    surface = MEASURES["von_mises"](top.planes[:, 0])
    shown = [result.pressure, surface, *(worst[name].values for name in NAMES)]
    return {
        "maps": np.array([cropped(one, result.pressure, pixels) for one in shown]),
        "window": cropped(result.pressure, result.pressure, len(result.pressure)),
        "maxima": np.array([worst[name].maximum.value for name in NAMES]),
        "depths": np.array([worst[name].maximum.z for name in NAMES]),
    }


def stacked(runs: Sequence[dict[str, np.ndarray]]) -> dict[str, np.ndarray]:
    """Maps of several cases: each array with an axis of cases in front."""
    return {name: np.array([run[name] for run in runs]) for name in runs[0]}


def maxima(result: ck.ContactResult, coefficients: Sequence[float]) -> np.ndarray:
    """Maxima of `NAMES` [Pa], (coefficients, 3), for the coefficients of friction."""
    effect = ck.SubsurfaceStress(coefficients=tuple(coefficients[1:]))
    part = stress_below(result, effect, ck.FrictionTraction(coefficient=coefficients[0]))
    every = [part.maxima, *(one.maxima for one in part.by_friction)]
    return np.array([[one[name].value for name in NAMES] for one in every])


def map_figure(data: Data, titles: Sequence[str], width: float) -> plot.Figure:
    """Draw maps of several cases: one column each, a colour scale for each row.

    `width` is that of the squares [m]. Stress is on a logarithmic scale, as in the source.
    """
    values = data["maps"] / 1e6  # [MPa]
    figure, axes = plot.figure(
        5, len(titles), size=(1.25 * len(titles) + 1.9, 7.0), sharex=True, sharey=True
    )
    extent = (0.0, width * 1e6, 0.0, width * 1e6)
    for row, name in enumerate(ROWS):
        top = float(values[:, row].max())
        style = {"vmin": 0.0, "vmax": top} if row == 0 else {"norm": plot.log_norm(top)}
        for column, ax in enumerate(axes[row]):
            image = ax.imshow(
                values[column, row], origin="lower", extent=extent, cmap="cividis", **style
            )
            ax.grid(visible=False)
            best = data["maxima"][column, row - 2] / 1e6 if row >= 2 else values[column, row].max()
            text = f"{best:.0f}"
            if row >= 2:
                text += f"; {data['depths'][column, row - 2] * 1e9:.0f} nm"
            ax.text(0.04, 0.94, text, transform=ax.transAxes, color="w", **LABEL)
        axes[row, 0].set_ylabel(name, fontsize=8)
        figure.colorbar(image, ax=axes[row], shrink=0.85, aspect=12).set_label("MPa", fontsize=8)
    for ax, title in zip(axes[0], titles, strict=True):
        ax.set_title(title, fontsize=8, loc="left")
    for ax in axes[-1]:
        ax.set_xlabel("x [um]", fontsize=8)
        ax.set_xticks([0.0, 0.5 * width * 1e6])
    return figure
