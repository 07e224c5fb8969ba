"""Images of planforms: the fraction of each pixel that a shape covers, from npy and PNG files."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

from ..errors import DescriptionError
from ..extras import missing_extra
from .arrays import read_array
from .limits import check_limit, check_size
from .named_files import check_digest, digest_of, existing

if TYPE_CHECKING:
    from numpy.typing import NDArray

    Map = NDArray[np.float64]

__all__ = ["read_coverage"]

_WHITE = 255  # of a grey image of 8 bits


def read_coverage(path: str, checksum: str | None = None) -> Map:
    """Fraction of each pixel that a shape covers (ny, nx) [-], the lowest row first.

    Parameters
    ----------
    path : str
        An npy file of numbers from 0 to 1, of truth values, or of greys from 0 to 255 (uint8), its
        rows as in memory; or a PNG file (extra ``contactkit[plot]``), in which white is covered and
        the last row is the lowest.
    checksum : str, optional
        SHA-256 that the file must have.

    Raises
    ------
    DescriptionError
        If the file does not exist, is another one, or is no such image.
    MissingExtraError
        If it is a PNG file and Pillow is not installed.

    Examples
    --------
    >>> import tempfile
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     np.save(Path(folder, "bar.npy"), np.array([[0, 255, 51]], np.uint8))
    ...     read_coverage(f"{folder}/bar.npy")
    array([[0. , 1. , 0.2]])
    """
    file = existing(path, "ImageFile.path")
    size = check_size(file)
    if checksum is not None:
        check_digest(file, digest_of(file), checksum, "ImageFile.checksum")
    if file.suffix.lower() == ".npy":
        with file.open("rb") as content:
            return _fractions(read_array(content, size, str(file)), file)
    if file.suffix.lower() == ".png":
        return _fractions(_greys(file)[::-1], file)
    raise DescriptionError("ImageFile.path", path, "end in .npy or .png")


def _greys(file: Path) -> NDArray[np.uint8]:
    """Greys of a PNG file, the upper row first; its header is checked before it is unpacked."""
    try:
        from PIL import Image
    except ImportError as error:
        raise missing_extra(error, f"reading {file.name}") or error from None
    try:
        with Image.open(file, formats=("PNG",)) as image:
            check_limit("PIXELS", image.width * image.height, str(file))
            return np.asarray(image.convert("L"))
    except (OSError, ValueError, SyntaxError, Image.DecompressionBombError) as error:
        hint = f"{type(error).__name__}: {error}"[:200]
        raise DescriptionError("ImageFile.path", str(file), "be a PNG image", hint=hint) from None


def _fractions(values: NDArray[np.generic], file: Path) -> Map:
    if values.ndim != 2 or values.size == 0 or values.dtype.kind not in "bfiu":
        found = f"an array of shape {values.shape} and {values.dtype}"
        raise DescriptionError("ImageFile.path", found, f"be a map of numbers in {file.name}")
    check_limit("PIXELS", values.size, str(file))
    made = values.astype(np.float64) / (_WHITE if values.dtype == np.uint8 else 1.0)
    if not ((made >= 0.0) & (made <= 1.0)).all():
        bad = float(made[~((made >= 0.0) & (made <= 1.0))][0])
        hint = "divide greys of other types than uint8 by their white"
        expected = f"lie between 0 and 1 in {file.name}"
        raise DescriptionError("ImageFile.path", bad, expected, hint=hint)
    return made
