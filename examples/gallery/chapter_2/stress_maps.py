"""Maps of pressure and stress around the spot of highest pressure, and maxima over seeds."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np
from scipy.ndimage import label

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
LABEL = {
    "fontsize": 7.5,
    "va": "top",
    "color": "w",
    "bbox": {"fc": "#00204d", "ec": "none", "pad": 1.0, "alpha": 0.8},
}
NAMES: tuple[MeasureName, ...] = ("von_mises", "tension", "sigma_xz")


def cropped(values: np.ndarray, pressure: np.ndarray, pixels: int) -> np.ndarray:
    """Square of a periodic map around the maximum of the pressure."""
    place = np.unravel_index(int(np.argmax(pressure)), pressure.shape)
    for axis, centre in enumerate(place):
        values = np.roll(values, pixels // 2 - int(centre), axis=axis)
    return values[:pixels, :pixels].astype(np.float32)


def maps(result: ck.ContactResult, pixels: int, friction: float = 0.0) -> dict[str, np.ndarray]:
    """Maps (5, n, n) [Pa] in the order of `ROWS`; maxima (3,) [Pa] and their depths (3,) [m].

    `window` is the pressure in the whole window, with its maximum in the middle.
    """
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

    The first row is the whole window with a square around the highest pressure. The others show
    the square, as wide as the contact in it is seen, with the edge of that contact. `width` is that
    of the maps [m].
    """
    values, window = data["maps"] / 1e9, data["window"] / 1e9  # [GPa]
    pixel = 1e6 * width / values.shape[-1]  # [um]
    near = _near(values[:, 0] > 0.0)
    values = values[..., near, near]
    figure, axes = plot.figure(
        1 + len(ROWS), len(titles), size=(1.55 * len(titles) + 1.5, 10.0), squeeze=False
    )
    for column, ax in enumerate(axes[0]):
        _whole(ax, window[column] > 0.0, values.shape[-1], pixel)
        ax.set_title(titles[column], fontsize=9, loc="left")
    for row in range(len(ROWS)):
        top = float(values[:, row].max())
        for column, ax in enumerate(axes[1 + row]):
            shown = values[column, row]
            image = _square(ax, shown, top, values[column, 0] > 0.0, pixel)
            text = f"max {shown.max():.3g} GPa"
            if row >= 2:
                best, depth = (data[name][column, row - 2] for name in ("maxima", "depths"))
                if shown.max() < 0.99e-9 * best:
                    text += f"\n{best / 1e9:.3g} in the window"
                text += f"\n{depth * 1e9:.0f} nm deep"
            ax.text(0.04, 0.96, text, transform=ax.transAxes, **LABEL)
        bar = figure.colorbar(image, ax=axes[1 + row], shrink=0.9, aspect=14)
        bar.set_label("GPa", fontsize=9)
    for row, name in zip(axes, ("contact,\nwhole window", *ROWS), strict=True):
        row[0].set_ylabel(f"{name}\ny [um]", fontsize=9)
        for ax in row[1:]:
            ax.tick_params(labelleft=False)
    for row in (axes[0], axes[-1]):
        for ax in row:
            ax.set_xlabel("x [um]", fontsize=9)
            ax.tick_params(labelbottom=True)
    return figure


def _near(contact: np.ndarray) -> slice:
    """Rows and columns of maps that hold the spots in their middle, and as much around them."""
    n = contact.shape[-1]
    reach = max(_reach(one) for one in contact)
    half = min(3 * reach, n // 2)
    return slice(n // 2 - half, n // 2 + half + 1)


def _reach(contact: np.ndarray) -> int:
    """How many pixels the spot in the middle of a map reaches from there."""
    n = len(contact)
    spots, _ = label(contact)
    place = np.argwhere(spots == spots[n // 2, n // 2])
    return int(np.abs(place - n // 2).max())


def _whole(ax: plot.Axes, contact: np.ndarray, shown: int, pixel: float) -> None:
    """Contact in the window as dots, which are seen where pixels are not, and the square."""
    half, edge = 0.5 * len(contact) * pixel, 0.5 * shown * pixel
    rows, columns = np.nonzero(contact)
    ax.plot(
        (columns + 0.5) * pixel - half,
        (rows + 0.5) * pixel - half,
        "s",
        color="#0072b2",
        ms=0.9,
        mew=0.0,
    )
    x, y = (-edge, edge, edge, -edge, -edge), (-edge, -edge, edge, edge, -edge)
    ax.plot(x, y, color="#d55e00", lw=1.2)
    ax.set(aspect="equal", xlim=(-half, half), ylim=(-half, half))
    ax.tick_params(labelsize=8)
    ax.grid(visible=False)


def _square(
    ax: plot.Axes, values: np.ndarray, top: float, contact: np.ndarray, pixel: float
) -> Any:
    """A map around the highest pressure, and the edge of the contact."""
    edge = 0.5 * len(values) * pixel
    around = (-edge, edge, -edge, edge)
    look: dict[str, Any] = {"origin": "lower", "extent": around}
    image = ax.imshow(values, cmap="cividis", vmin=0.0, vmax=top, interpolation="nearest", **look)
    ax.contour(contact, levels=[0.5], colors="#ff9d5c", linewidths=0.7, **look)
    ax.tick_params(labelsize=8, labelbottom=False)
    ax.grid(visible=False)
    return image
