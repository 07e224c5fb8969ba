"""Arrays of npy and npz files: no pickle, no more than the file holds."""

from __future__ import annotations

import math
import re
from typing import IO, TYPE_CHECKING, Any

import numpy as np

from ..errors import ContactkitError, DescriptionError
from .archives import UNREADABLE, checked_archive
from .limits import check_limit

if TYPE_CHECKING:
    from numpy.typing import NDArray

__all__ = ["read_array", "read_arrays", "read_map"]

_HEADERS = {
    (1, 0): np.lib.format.read_array_header_1_0,
    (2, 0): np.lib.format.read_array_header_2_0,
}
_PLAIN = "biufcU"
_PIECE = 2**20  # bytes of a map that are read at a time


def read_array(file: IO[bytes], size: int, where: str) -> NDArray[Any]:
    """Array of an npy file, or of a member of an npz file; not writeable.

    The header says how many numbers there are; it is compared with the size of the file before
    memory is taken for them.

    Parameters
    ----------
    file : binary file
        At its beginning.
    size : int
        Its size [bytes].
    where : str
        Its name, for messages.

    Raises
    ------
    DescriptionError
        If it is no array of numbers or texts, announces more than it holds, or is too large.
    """
    shape, is_fortran, dtype = _announced(file, size, where)
    try:
        content = file.read(math.prod(shape) * dtype.itemsize)
        return _array(content, shape, dtype, is_fortran)
    except UNREADABLE as error:
        raise _no_array(where, f"{type(error).__name__}: {error}"[:200]) from None


def read_map(file: IO[bytes], size: int, where: str, factor: float = 1.0) -> NDArray[np.float64]:
    """Real numbers of an npy file with two dimensions, times a factor, in double precision.

    Some lines at a time: beside the map itself there is no other one.

    Parameters
    ----------
    file, size, where
        As of `read_array`.
    factor : float
        Such as the unit of the numbers.

    Raises
    ------
    DescriptionError
        As `read_array`, and for numbers that are not real or no map (ny, nx).

    Examples
    --------
    >>> import io
    >>> file = io.BytesIO()
    >>> np.save(file, np.arange(6, dtype=np.int16).reshape(2, 3))
    >>> size = file.tell()
    >>> _ = file.seek(0)
    >>> read_map(file, size, "map.npy", 0.5)
    array([[0. , 0.5, 1. ],
           [1.5, 2. , 2.5]])
    """
    shape, is_fortran, dtype = _announced(file, size, where)
    if dtype.kind not in "fiu":
        raise DescriptionError("HeightMap.heights", str(dtype), "be real numbers")
    if len(shape) != 2 or 0 in shape:
        raise DescriptionError(
            "HeightMap.heights",
            f"shape {shape}",
            f"be a map (ny, nx) of at least 2 x 2 pixels in {where}",
            hint="a profile along a line is not a surface",
        )
    check_limit("PIXELS", math.prod(shape), where)
    made = np.empty(shape)
    lines = made.T if is_fortran else made  # in the order of the file
    count = max(1, _PIECE // (lines.shape[1] * dtype.itemsize))
    for first in range(0, len(lines), count):
        some = lines[first : first + count]
        content = file.read(some.size * dtype.itemsize)
        if len(content) != some.size * dtype.itemsize:
            raise _no_array(where, "it ends too early")
        read = np.frombuffer(content, dtype).reshape(some.shape)
        np.multiply(read, factor, out=some, dtype=np.float64)  # not in the precision of the file
    return made


def _announced(
    file: IO[bytes], size: int, where: str
) -> tuple[tuple[int, ...], bool, np.dtype[Any]]:
    """Shape, order and type that a header announces, within the limits and what the file holds."""
    try:
        version = np.lib.format.read_magic(file)
        if version not in _HEADERS:
            raise _no_array(where, f"version {version} of the format")  # of names beyond Latin-1
        shape, is_fortran, dtype = _HEADERS[version](file)
        n = math.prod(shape)
        if dtype.kind not in _PLAIN or dtype.hasobject:
            text = re.sub(r"\s+", " ", str(dtype))[:80]
            raise _no_array(where, f"it holds {text} arrays, which are records or pickles")
        check_limit("BYTES", n * max(dtype.itemsize, 1), where)
        rest = size - file.tell()
        if min(shape, default=0) < 0 or n * dtype.itemsize > rest:
            announced = f"{' x '.join(map(str, shape)) or 1} of {dtype}"
            raise _no_array(where, f"it announces {announced[:80]}, and holds {rest} bytes")
    except ContactkitError:
        raise
    except UNREADABLE as error:
        raise _no_array(where, f"{type(error).__name__}: {error}"[:200]) from None
    return shape, is_fortran, dtype


def _array(
    content: bytes, shape: tuple[int, ...], dtype: np.dtype[Any], is_fortran: bool
) -> NDArray[Any]:
    if not content:
        made: NDArray[Any] = np.empty(shape, dtype)
        made.flags.writeable = False
        return made
    return np.frombuffer(content, dtype).reshape(shape, order="F" if is_fortran else "C")


def _no_array(where: str, why: str) -> DescriptionError:
    return DescriptionError("file", where, "be a numpy file of numbers", hint=why)


def read_arrays(source: IO[bytes], where: str) -> dict[str, NDArray[Any]]:
    """Arrays of an npz file by their names; not writeable.

    Raises
    ------
    DescriptionError
        If it is no npz file, or `checked_archive` or `read_array` refuses it.

    Examples
    --------
    >>> import io
    >>> file = io.BytesIO()
    >>> np.savez(file, x=np.arange(3.0))
    >>> read_arrays(file, "result.npz")["x"].tolist()
    [0.0, 1.0, 2.0]
    """
    found = dict[str, "NDArray[Any]"]()
    with checked_archive(source, where) as packed:
        for info in packed.infolist():
            key = info.filename.removesuffix(".npy")
            if key == info.filename:
                raise DescriptionError("file", where, f"hold arrays only, not {key[:80]}")
            try:
                with packed.open(info) as member:
                    found[key] = read_array(member, info.file_size, f"{where}, {key}")
                    if member.read(1):
                        raise _no_array(f"{where}, {key}", "something follows the array")
            except ContactkitError:
                raise
            except UNREADABLE as error:
                raise _no_array(f"{where}, {key}", f"{type(error).__name__}: {error}") from None
    return found
