"""Force curves of atomic force microscopes, by afmformats: in, and out as its HDF5."""

from __future__ import annotations

import logging
from collections.abc import Iterator, Mapping
from contextlib import contextmanager, suppress
from pathlib import Path
from typing import TYPE_CHECKING, Any, Literal

import numpy as np

from ..errors import DescriptionError, nearest
from ..extras import require
from ..files.scenes import write_whole
from ..reading.limits import check_size
from ..reading.named_files import existing
from ..units import parse_quantity, parse_unit
from .data import MeasuredCurve

if TYPE_CHECKING:
    from numpy.typing import NDArray

    Floats = NDArray[np.float64]

__all__ = ["read_force_curve", "write_force_curve"]

_HEIGHTS = ("height (measured)", "height (piezo)")
# What some formats do not state, with the unit that afmformats wants.
_INSTRUMENT = {"spring constant": "N/m", "sensitivity": "m/V"}
# Makers whose files have the deflection as a current, which afmformats takes for a voltage.
_OF_CURRENT, _PER_CURRENT = "NT-MDT", "m/A"


def read_force_curve(
    path: str | Path,
    *,
    over: str = "gap",
    quantity: str = "pull",
    segment: Literal["approach", "retract"] = "retract",
    position: Literal["base", "tip"] = "base",
    instrument: Mapping[str, float | str] | None = None,
    index: int = 0,
    is_load: bool = False,
    **more: Any,
) -> MeasuredCurve:
    r"""Read a force curve of an atomic force microscope (extra ``afm``).

    Formats are those of afmformats: JPK, Igor, NT-MDT, AFM workshop, HDF5 and others. The contact
    point is not known: give ``shift`` as a `Range`.

    Parameters
    ----------
    path : str or Path
        The file.
    over, quantity : str
        As of `MeasuredCurve`; the height rises with the gap, and attraction is positive.
    segment : {"approach", "retract"}
        Which part.
    position : {"base", "tip"}
        What the axis is: the height z of the base of the cantilever, whose spring constant k
        becomes the stiffness of the curve, or that of the tip, :math:`z + F/k` with the force F
        positive in repulsion, which is the gap but for its zero.
    instrument : mapping of str to float or str, optional
        ``"spring constant"`` [N/m] and ``"sensitivity"`` (the inverse optical lever sensitivity)
        [m/V] in place of those of the file, or where it has none. The text files of NT-MDT have a
        deflection in amperes: [m/A] there, such as ``"50 nm/nA"``.
    index : int
        Which curve of a file with several.
    is_load : bool
        Whether the quantity is a load over an approach: both then change their sign.
    **more
        Further fields of the `MeasuredCurve`; ``stiffness`` in place of that of the file.

    Raises
    ------
    MissingExtraError
        If afmformats is not installed: ``pip install contactkit[afm]``.
    DescriptionError
        If the file is none that it reads, lacks force, height or spring constant, or a number of
        the instrument is none that can be given.
    """
    require("afmformats", "a force curve of an AFM")
    check_size(existing(path, "force curve"))
    for name, value, known in (
        ("segment", segment, ("approach", "retract")),
        ("position", position, ("base", "tip")),
    ):
        if value not in known:
            raise DescriptionError(name, value, f"be {' or '.join(map(repr, known))}")
    curves = _curves(Path(path), _given(instrument or {}))
    if not 0 <= index < len(curves):
        raise DescriptionError("index", index, f"be below {len(curves)}, the curves of the file")
    one = curves[index]
    if isinstance(given := (instrument or {}).get("sensitivity"), str):
        parse_quantity(given, _sensitivity_unit(str(one.metadata.get("format"))), "sensitivity")
    part = one.appr if segment == "approach" else one.retr
    height = next((n for n in _HEIGHTS if n in one), None)
    if height is None or "force" not in one:
        hint = f"it has {', '.join(map(str, one.columns))}"
        raise DescriptionError("file", str(path), "hold force and height", hint=hint)
    at, force = (np.asarray(part[n], dtype=np.float64) for n in (height, "force"))
    if at.size == 0:
        raise DescriptionError("segment", segment, f"have readings in {Path(path).name}")
    spring = _spring(one, position, str(path))
    if position == "tip" and spring is not None:
        at = at + force / spring
    elif spring is not None and "stiffness" not in more:
        more["stiffness"] = spring
    sign = -1.0 if is_load else 1.0
    return MeasuredCurve(
        over=over,
        at=sign * at,
        quantity=quantity,
        values=-sign * force,
        units=("m", "N"),
        **({"name": f"{Path(path).stem}, {segment}"} | more),
    )


def _spring(one: Any, position: str, where: str) -> float | None:
    """Spring constant of a cantilever [N/m]; needed for the position of the tip."""
    found = one.metadata.get("spring constant")
    if position == "base":
        return None if found is None else float(found)
    if found is None or not 0.0 < float(found) < np.inf:
        raise DescriptionError(
            "spring constant",
            found,
            f"be positive in {where} for the position of the tip",
            unit="N/m",
            hint="give instrument={'spring constant': ...}, or take position='base'",
        )
    return float(found)


def _sensitivity_unit(maker: str) -> str:
    return _PER_CURRENT if maker.startswith(_OF_CURRENT) else _INSTRUMENT["sensitivity"]


def _given(instrument: Mapping[str, float | str]) -> dict[str, float]:
    """Numbers of the instrument in SI units, by the names that afmformats has for them."""
    found = {}
    for name, value in instrument.items():
        if name not in _INSTRUMENT:
            hint = nearest(name, _INSTRUMENT)
            raise DescriptionError("instrument", name, "be a number of the instrument", hint=hint)
        unit = _INSTRUMENT[name]
        if name == "sensitivity" and isinstance(value, str):
            with suppress(DescriptionError):
                value, unit = parse_quantity(value, _PER_CURRENT, name), _PER_CURRENT
        number = parse_quantity(value, unit, name) if isinstance(value, str) else value
        if not isinstance(number, int | float) or not 0.0 < number < np.inf:
            raise DescriptionError(name, value, "be positive and finite", unit=unit)
        found[name] = float(number)
    return found


def _curves(path: Path, instrument: dict[str, float]) -> list[Any]:
    """Curves of a file; what its reader raises names no cure of its own."""
    import afmformats

    # Its own errors are not derived from `Exception`.
    own = [one for one in vars(afmformats.errors).values() if isinstance(one, type)]
    unreadable: tuple[type[BaseException], ...] = (Exception, *own)
    try:
        with _silent("afmformats"):
            found = afmformats.load_data(path, modality="force-distance", meta_override=instrument)
        return list(found)
    except afmformats.errors.MissingMetaDataError as error:
        lacking = ", ".join(map(str, error.meta_keys))
        hint = f"give instrument={{{', '.join(f'{key!r}: ...' for key in error.meta_keys)}}}"
        raise DescriptionError("file", str(path), f"state its {lacking}", hint=hint) from None
    except NotImplementedError:
        raise DescriptionError(
            "instrument",
            sorted(instrument),
            f"be left out: {path.name} has its forces in newtons, and its own numbers",
            hint="stiffness='0.05 N/m' replaces the spring of the curve",
        ) from None
    except unreadable as error:
        hint = f"{type(error).__name__}: {error}"[:300]
        raise DescriptionError(
            "file", str(path), "be a force curve that afmformats reads", hint=hint
        ) from None


@contextmanager
def _silent(name: str) -> Iterator[None]:
    """Without what a logger writes: tracebacks of errors that are raised as well."""
    logger = logging.getLogger(name)
    before = logger.level
    logger.setLevel(logging.CRITICAL + 1)
    try:
        yield
    finally:
        logger.setLevel(before)


def write_force_curve(
    path: str | Path,
    retract: MeasuredCurve,
    approach: MeasuredCurve | None = None,
    *,
    spring_constant: float | str | None = None,
) -> Path:
    r"""Write a curve as a force curve of an AFM, in the HDF5 of afmformats (extra ``afm``).

    Programs for force curves read it: afmformats, nanite, PyJibe.

    Parameters
    ----------
    path : str or Path
        The file, with the ending .h5.
    retract, approach : MeasuredCurve
        Attraction over the gap, as `read_force_curve` returns it and `read_measured_curve` takes it
        from a result: ``read_measured_curve(result, "gap", "pull")``.
    spring_constant : float or str, optional
        Spring constant k of the cantilever [N/m]. Of a curve over the gap D the base is then at
        :math:`z = D - F/k`; a curve with a ``stiffness`` is over the base already, and its
        stiffness is that of the cantilever.

    Returns
    -------
    Path
        The file.

    Raises
    ------
    MissingExtraError
        If afmformats is not installed.
    DescriptionError
        If the ending is another, a curve is not over a length in newtons, or the cantilever is
        given twice, with different numbers, or not at all.
    """
    require("afmformats", "writing a force curve")
    from afmformats.mod_force_distance import AFMForceDistance

    target = Path(path)
    if target.suffix != ".h5":
        raise DescriptionError("path", str(path), "end in .h5")
    parts = [one for one in (approach, retract) if one is not None]
    spring = _cantilever(parts, spring_constant)
    force = [-one.y for one in parts]  # repulsion is positive there
    base = [
        one.x if _stiffness(one) < np.inf else one.x - repulsion / spring
        for one, repulsion in zip(parts, force, strict=True)
    ]
    segments = [np.full(one.x.size, one is retract) for one in parts]
    data = {
        "height (measured)": np.concatenate(base),
        "force": np.concatenate(force),
        "segment": np.concatenate(segments),
    }
    stated = {"spring constant": spring, "imaging mode": "force-distance", "enum": 0}
    curve = AFMForceDistance(data, {"path": target} | stated)
    with write_whole(target) as temporary:
        curve.export_data(temporary, fmt="hdf5", metadata=list(stated))
    return target


def _cantilever(parts: list[MeasuredCurve], given: float | str | None) -> float:
    """Spring constant of a cantilever [N/m], of the curves or as given."""
    found = set[float]()
    if given is not None:
        found |= set(_given({"spring constant": given}).values())
    for one in parts:
        if not _is_force(one):
            label = f"MeasuredCurve({one.name}).units"
            raise DescriptionError(label, one.units, "be a length and a force")
        if (own := _stiffness(one)) < np.inf:
            found.add(own)
    if len(found) != 1:
        raise DescriptionError(
            "spring_constant",
            sorted(found) or None,
            "be one number, of the curves or as given",
            unit="N/m",
        )
    return found.pop()


def _stiffness(one: MeasuredCurve) -> float:
    """Stiffness of the instrument of a curve [N/m]; infinite of a curve over the gap."""
    found = one.stiffness
    if isinstance(found, str):
        found = parse_quantity(found, "N/m", f"MeasuredCurve({one.name}).stiffness")
    if not isinstance(found, int | float):
        raise DescriptionError(f"MeasuredCurve({one.name}).stiffness", found, "be a number")
    return float(found)


def _is_force(one: MeasuredCurve) -> bool:
    return [dict(parse_unit(unit).dimension) for unit in one.units] == [
        dict(parse_unit(unit).dimension) for unit in ("m", "N")
    ]
