"""Zip archives whose bytes depend on their content alone."""

from __future__ import annotations

import zipfile
from collections.abc import Mapping
from pathlib import Path

from ...errors import ContactkitError
from ...files.scenes import write_whole

__all__ = ["no_file", "write_archive"]


def no_file(path: Path, error: OSError) -> ContactkitError:
    """Say that a file cannot be written, and why."""
    why = error.strerror or str(error)
    return ContactkitError(f"{path} cannot be written ({why}); give a file in a folder of yours")


def write_archive(files: Mapping[str, bytes], target: Path) -> Path:
    """Write a zip archive: equal content gives equal bytes, and no half file is ever left.

    Parameters
    ----------
    files : mapping of str to bytes
        Content by path, with forward slashes.
    target : Path
        The file; its folder is made.

    Returns
    -------
    Path
        The file.

    Raises
    ------
    ContactkitError
        If it cannot be written there.
    """
    try:
        return _write(files, target)
    except OSError as error:
        raise no_file(target, error) from error


def _write(files: Mapping[str, bytes], target: Path) -> Path:
    with (
        write_whole(target) as partial,
        zipfile.ZipFile(partial, "w", zipfile.ZIP_DEFLATED, compresslevel=9) as packed,
    ):
        for path in sorted(files):
            info = zipfile.ZipInfo(path, date_time=(1980, 1, 1, 0, 0, 0))
            info.compress_type, info.create_system = zipfile.ZIP_DEFLATED, 3
            info.external_attr = 0o100644 << 16
            packed.writestr(info, files[path])
    return target
