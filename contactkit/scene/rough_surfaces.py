"""Rough surfaces: random roughness by its spectrum, height maps, and sums of surfaces.

All but `Heights` are recipes, made into heights on a grid when a contact is planned.
"""

from __future__ import annotations

import hashlib
from typing import TYPE_CHECKING, Any, ClassVar, Literal

from attrs import Attribute, field, frozen

from ..errors import DescriptionError
from ..frozen import SAME_NUMBERS
from ..reading.named_files import Contents
from ..units import si
from ..validators import (
    as_pair,
    as_path,
    as_tuple,
    choice,
    file_name,
    optional,
    part,
    positive,
    positive_or_pair,
    refuse,
)
from .surfaces import OwnGrid, ShortWave, Surface, realise, union_of
from .window import Grid

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray

    Map = NDArray[np.float64]
    Mask = NDArray[np.bool_]

__all__ = [
    "CombinedSurface",
    "GaussianRoughness",
    "Heights",
    "Measured",
    "SelfAffineRoughness",
]


def _seed(owner: object, attribute: Attribute[Any], value: Any) -> None:
    if isinstance(value, bool) or not isinstance(value, int) or value < 0:
        raise refuse(owner, attribute, value, "be a whole number of at least 0")


@frozen(kw_only=True)
class GaussianRoughness(Surface):
    """Gaussian heights with the exponential autocorrelation of Eq. (2.42).

    Parameters
    ----------
    rms : float
        Standard deviation of the heights [m], of the waves longer than `cutoff`.
    correlation_length : float or (float, float)
        Length beta* at which the autocorrelation has fallen to 10 % [m]; a pair is (along y,
        along x). The decay length is beta*/2.3.
    cutoff : float
        Shortest wavelength the surface has [m]. This autocorrelation has no finite slope: without
        a cut-off, area, pressure and stress are properties of the grid.
    seed : int
        Which surface of this kind.
    """

    kind: ClassVar[str] = "gaussian-roughness"
    source: ClassVar[str] = "exponential autocorrelation, Eq. (2.42) of Cai 2008"

    rms: float = field(validator=positive, metadata=si("m"))
    correlation_length: float | tuple[float, float] = field(
        converter=as_pair, validator=positive_or_pair, metadata=si("m")
    )
    cutoff: float = field(validator=positive, metadata=si("m"))
    seed: int = field(default=1, validator=_seed, metadata=si("-"))

    def shortest_waves(self, grid: Grid) -> tuple[ShortWave, ...]:
        """See `Surface.shortest_waves`."""
        return (ShortWave("GaussianRoughness.cutoff", self.cutoff, max(grid.pixel_size)),)

    def heights_on(self, grid: Grid) -> Map:
        """See `Surface.heights_on`."""
        from ..roughness.random_surfaces import gaussian_exponential

        numbers = (self.rms, self.correlation_length, self.cutoff, self.seed)
        return gaussian_exponential(grid.shape, grid.pixel_size, *numbers)


@frozen(kw_only=True)
class SelfAffineRoughness(Surface):
    """Gaussian heights with a power-law spectrum between two wavelengths.

    Parameters
    ----------
    rms : float
        Standard deviation of the heights [m].
    hurst : float
        Hurst exponent [-], 0 to 1.
    rolloff : float
        Wavelength above which the spectrum is flat [m].
    cutoff : float
        Shortest wavelength the surface has [m].
    seed : int
        Which surface of this kind.
    """

    kind: ClassVar[str] = "self-affine-roughness"
    source: ClassVar[str] = "spectrum with a roll-off, Persson et al. 2005"

    rms: float = field(validator=positive, metadata=si("m"))
    hurst: float = field(metadata=si("-"))
    rolloff: float = field(validator=positive, metadata=si("m"))
    cutoff: float = field(validator=positive, metadata=si("m"))
    seed: int = field(default=1, validator=_seed, metadata=si("-"))

    @hurst.validator
    def _check_hurst(self, attribute: Attribute[Any], value: Any) -> None:
        positive(self, attribute, value)
        if value > 1.0:
            raise refuse(self, attribute, value, "lie above 0 and not above 1")

    def __attrs_post_init__(self) -> None:
        if self.cutoff >= self.rolloff:
            raise DescriptionError(
                "SelfAffineRoughness.cutoff",
                self.cutoff,
                f"be smaller than rolloff = {self.rolloff:g} m",
                unit="m",
            )

    def shortest_waves(self, grid: Grid) -> tuple[ShortWave, ...]:
        """See `Surface.shortest_waves`."""
        return (ShortWave("SelfAffineRoughness.cutoff", self.cutoff, max(grid.pixel_size)),)

    def heights_on(self, grid: Grid) -> Map:
        """See `Surface.heights_on`."""
        from ..roughness.random_surfaces import SelfAffineSpectrum, self_affine

        spectrum = SelfAffineSpectrum(self.hurst, self.rolloff, self.cutoff)
        return self_affine(grid.shape, grid.pixel_size, self.rms, spectrum, self.seed)


@frozen(kw_only=True)
class Measured(Surface):
    """A height map from a file: npy, columns of text, ISO 25178-71 as text, formats of instruments.

    Parameters
    ----------
    path : str
        The file; in Python from the working folder, in a scene file from the folder of that file,
        which `load_scene` makes an absolute path. Formats of instruments need the extra
        ``contactkit[maps]``.
    pixel_size : float or (float, float), optional
        Size of a pixel [m], a pair is (along y, along x); for files that do not say it.
    unit : str, optional
        Unit of the heights, for files that do not say it.
    detrend : {"tilt", "none", "mean", "curvature"}
        What is taken off by least squares.
    flipped : bool
        Whether the map shows the counter body as a mould, so that its valleys are the peaks.
    checksum : str, optional
        SHA-256 of the file; a file that differs is refused.
    is_periodic : bool, optional
        Whether the map repeats beyond its edges. None: what the file states, if it does.
    holes : {"refused", "masked", "fill"}
        What pixels without a height are: a mistake, holes that carry no load, or solid of the
        height of the nearest pixel, once the trend is off.
    """

    kind: ClassVar[str] = "measured"

    path: str = field(converter=as_path, validator=file_name)
    pixel_size: float | tuple[float, float] | None = field(
        default=None, converter=as_pair, validator=optional(positive_or_pair), metadata=si("m")
    )
    unit: str | None = None
    detrend: Literal["tilt", "none", "mean", "curvature"] = field(
        default="tilt", validator=choice("tilt", "none", "mean", "curvature")
    )
    flipped: bool = False
    checksum: str | None = None
    is_periodic: bool | None = field(default=None, validator=optional(part(bool)))
    holes: Literal["refused", "masked", "fill"] = field(
        default="refused", validator=choice("refused", "masked", "fill")
    )

    @property
    def void_pixels(self) -> Mask | None:
        """See `Surface.void_pixels`; reads the file if it may have holes."""
        return _FILES.of(self).holes if self.holes == "masked" else None

    @property
    def own_grids(self) -> frozenset[OwnGrid]:
        """See `Surface.own_grids`; reads the file."""
        return _FILES.of(self).own_grids

    @property
    def isolated_maps(self) -> tuple[str, ...]:
        """See `Surface.isolated_maps`; reads the file."""
        return (self.path,) if _FILES.of(self).is_periodic is False else ()

    @property
    def periodic_maps(self) -> tuple[str, ...]:
        """See `Surface.periodic_maps`; reads the file."""
        return (self.path,) if _FILES.of(self).is_periodic else ()

    def heights_on(self, grid: Grid) -> Map:
        """See `Surface.heights_on`; reads the file."""
        return _FILES.of(self).heights_on(grid)

    def as_heights(self) -> Heights:
        """Return the map as an array, without the trend, with its holes; reads the file."""
        return _FILES.of(self)


def _read(surface: Measured) -> Heights:
    import numpy as np

    from ..roughness.height_maps import detrend, filled, read_height_map

    found = read_height_map(
        surface.path,
        pixel_size=surface.pixel_size,
        unit=surface.unit,
        checksum=surface.checksum,
        holes=surface.holes != "refused",
    )
    # In place, and read-only so that `Heights` takes it as it is: a large map is held once.
    heights: Any = detrend(found.heights, surface.detrend)
    if surface.flipped:
        np.negative(heights, out=heights)
    if surface.holes != "refused":
        heights = filled(heights) if surface.holes == "fill" else np.ma.masked_invalid(heights)
    if not np.ma.isMaskedArray(heights):
        heights.flags.writeable = False
    return Heights(
        heights=heights,
        pixel_size=found.pixel_size,
        is_periodic=found.is_periodic if surface.is_periodic is None else surface.is_periodic,
    )


# A plan looks at a map several times. One of 4096 x 4096 pixels takes 134 MB: it goes with the last
# scene that has the surface.
_FILES: Contents[Measured, Heights] = Contents(_read)


def _as_map(value: Any) -> Map:
    import numpy as np

    try:
        given = np.asarray(value)
    except ValueError:  # numpy's words speak of its own dimensions
        raise DescriptionError(
            "Heights.heights",
            "rows of different lengths",
            "be an array [y, x]",
            unit="m",
            hint="give each row as many heights; mark what was not measured by nan",
        ) from None
    if given.dtype.kind not in "fiu":
        raise DescriptionError(
            "Heights.heights",
            value if given.ndim == 0 else f"an array of {given.dtype}",
            "be an array of real numbers",
            unit="m",
            hint="for a file use Measured(path=...)",
        )
    if given.dtype == np.float16:  # 50 nm is a multiple of 60 nm there
        raise DescriptionError(
            "Heights.heights",
            "an array of float16",
            "be of float32 or float64: float16 has 3 digits, and none below 6e-8",
            unit="m",
            hint="convert to float64 where the heights still have the unit of the file, then to m",
        )
    holes = np.ma.getmaskarray(value) if np.ma.is_masked(value) else None
    if holes is not None:  # kept until `Heights` takes the mask
        return np.ma.MaskedArray(np.array(np.ma.getdata(value), dtype=float, order="C"), holes)
    is_fixed = given.flags.owndata and not given.flags.writeable
    if is_fixed and given.dtype == np.float64 and given.flags.c_contiguous:
        return given  # nobody writes into it: a large map is held once
    made = np.array(given, dtype=float, order="C")
    made.flags.writeable = False
    return made


def _as_holes(value: Any) -> Mask | None:
    import numpy as np

    if value is None:
        return None
    made = np.array(value, dtype=bool, order="C")
    made.flags.writeable = False
    return made


@frozen(kw_only=True)
class Heights(Surface):
    """Heights given as an array.

    Masked pixels (`numpy.ma`) are holes: what the instrument did not measure, or a pore. They carry
    no load. There `heights` has that of the nearest pixel measured, so that no number is missing;
    neither it nor the gap over it means anything.

    Parameters
    ----------
    heights : array_like (ny, nx)
        Heights out of the body [m], peaks positive; may be masked. They are copied, unless they
        are a read-only array of doubles that owns its memory, as of a large map.
    pixel_size : float or (float, float)
        Size of a pixel [m]; a pair is (dy, dx).
    is_periodic : bool, optional
        Whether they repeat beyond their edges. None: not known; the window decides.
    holes : ndarray (ny, nx) of bool, optional
        Pixels that carry no load. None: those that are masked in `heights`, if any.

    Examples
    --------
    >>> import numpy as np
    >>> spike = np.ma.masked_greater([[0.0, 1e-9, 0.0], [0.0, 1.0, 0.0]], 1e-6)
    >>> surface = Heights(heights=spike, pixel_size=1e-8)
    >>> int(surface.holes.sum()), float(surface.heights.max())
    (1, 1e-09)
    """

    kind: ClassVar[str] = "heights"

    heights: Map = field(
        converter=_as_map,
        repr=False,
        eq=SAME_NUMBERS,
        hash=False,
        metadata=si("m")
        | {
            "in_file": "save the array as .npy and use Measured(path=..., pixel_size=..., "
            "unit='m', detrend='none'), in a file shape = 'measured'"
        },
    )
    pixel_size: float | tuple[float, float] = field(
        converter=as_pair, validator=positive_or_pair, metadata=si("m")
    )
    is_periodic: bool | None = field(default=None, validator=optional(part(bool)))
    holes: Mask | None = field(
        default=None,
        converter=_as_holes,
        repr=False,
        eq=SAME_NUMBERS,
        hash=False,
        metadata={
            "in_file": "save the array as .npy, with nan in the holes, and use Measured(path=..., "
            "holes='masked')"
        },
    )

    @heights.validator
    def _check_heights(self, attribute: Attribute[Any], value: Map) -> None:
        import numpy as np

        if value.ndim != 2 or min(value.shape) < 2:
            raise DescriptionError(
                "Heights.heights",
                f"an array of shape {value.shape}",
                "have two dimensions (ny, nx) of at least 2 pixels each",
                unit="m",
            )
        unknown = np.ma.filled(~np.isfinite(value), False)
        if unknown.any():
            first = tuple(int(i) for i in np.argwhere(unknown)[0])
            n = int(unknown.sum())
            raise DescriptionError(
                "Heights.heights",
                float(value[first]),
                f"be finite everywhere; at [y, x] = "
                f"{list(first)} and {n - 1} more pixels they are not",
                unit="m",
                hint="mask the holes of the measurement to carry no load, "
                "heights=np.ma.masked_invalid(heights), or fill them before",
            )

    @holes.validator
    def _check_holes(self, attribute: Attribute[Any], value: Mask | None) -> None:
        if value is not None and value.shape != self.heights.shape:
            raise DescriptionError(
                "Heights.holes",
                f"an array of shape {value.shape}",
                f"have the {self.heights.shape} pixels of the heights",
            )

    def __attrs_post_init__(self) -> None:
        """Take the mask of the heights, and fill the holes."""
        import numpy as np

        holes = self.holes
        if isinstance(self.heights, np.ma.MaskedArray):
            masked = np.ma.getmaskarray(self.heights)
            holes = _as_holes(masked if holes is None else masked | holes)
            if not masked.all():
                from ..roughness.height_maps import filled

                made = filled(np.ma.filled(self.heights, np.nan))
                made.flags.writeable = False
                object.__setattr__(self, "heights", made)
        if holes is not None and holes.all():
            raise DescriptionError(
                "Heights.holes",
                "every pixel",
                "leave pixels that carry load",
                hint="check the mask",
            )
        object.__setattr__(self, "holes", holes)

    @property
    def checksum(self) -> str:
        """SHA-256 of the heights."""
        return hashlib.sha256(self.heights.tobytes()).hexdigest()

    @property
    def void_pixels(self) -> Mask | None:
        """See `Surface.void_pixels`."""
        return self.holes

    @property
    def own_grids(self) -> frozenset[OwnGrid]:
        """See `Surface.own_grids`."""
        size, (ny, nx) = self.pixel_size, self.heights.shape
        return frozenset({((ny, nx), size if isinstance(size, tuple) else (size, size))})

    @property
    def isolated_maps(self) -> tuple[str, ...]:
        """See `Surface.isolated_maps`."""
        return ("Heights",) if self.is_periodic is False else ()

    @property
    def periodic_maps(self) -> tuple[str, ...]:
        """See `Surface.periodic_maps`."""
        return ("Heights",) if self.is_periodic else ()

    def heights_on(self, grid: Grid) -> Map:
        """See `Surface.heights_on`."""
        return self.heights


@frozen(kw_only=True)
class CombinedSurface(Surface):
    """A sum of surfaces, such as a rough sphere.

    Parameters
    ----------
    parts : tuple of Surface
        The surfaces whose heights are added.
    """

    kind: ClassVar[str] = "combined"

    parts: tuple[Surface, ...] = field(converter=as_tuple)

    @parts.validator
    def _check_parts(self, attribute: Attribute[Any], value: tuple[Any, ...]) -> None:
        for item in value:
            if not isinstance(item, Surface):
                raise refuse(self, attribute, item, "hold surfaces only")

    @property
    def body_curvature(self) -> float:
        """See `Surface.body_curvature`."""
        return sum(part.body_curvature for part in self.parts)

    @property
    def own_grids(self) -> frozenset[OwnGrid]:
        """See `Surface.own_grids`."""
        return frozenset().union(*(part.own_grids for part in self.parts))

    @property
    def isolated_maps(self) -> tuple[str, ...]:
        """See `Surface.isolated_maps`."""
        return tuple(name for part in self.parts for name in part.isolated_maps)

    @property
    def periodic_maps(self) -> tuple[str, ...]:
        """See `Surface.periodic_maps`."""
        return tuple(name for part in self.parts for name in part.periodic_maps)

    @property
    def void_pixels(self) -> Mask | None:
        """See `Surface.void_pixels`."""
        return union_of(part.void_pixels for part in self.parts)

    def shortest_waves(self, grid: Grid) -> tuple[ShortWave, ...]:
        """See `Surface.shortest_waves`."""
        return tuple(wave for part in self.parts for wave in part.shortest_waves(grid))

    def heights_on(self, grid: Grid) -> Map:
        """See `Surface.heights_on`."""
        import numpy as np

        total: Map = np.zeros(grid.shape)
        for surface in self.parts:
            total += realise(surface, grid)
        return total
