"""The model description of an FMU file, which is checked before it is read."""

from __future__ import annotations

import zipfile
from pathlib import Path
from typing import Any

from ...errors import DescriptionError
from ...reading.archives import checked_archive, member
from ...reading.xml_elements import check_xml

__all__ = ["no_fmu", "read_model"]


def no_fmu(path: Path) -> str:
    """Cure for a file that is no FMU; empty but for a scene."""
    if path.suffix not in (".toml", ".json"):
        return ""
    return f"make one of a scene first: contactkit fmu build {path.name} --out {path.stem}.fmu"


def read_model(path: Path) -> Any:
    """Model description, as fmpy reads it, of an FMU of any version and kind.

    Raises
    ------
    DescriptionError
        If the file is not there, no FMU, or one that leaves its folder when unpacked or whose
        description is no plain XML.
    """
    from fmpy import read_model_description

    if not path.is_file():
        raise DescriptionError("FMU", str(path), "be a file that is there")
    if not zipfile.is_zipfile(path):
        raise DescriptionError(
            "FMU", str(path), "be an FMU, which is a zip archive", hint=no_fmu(path)
        )
    where = str(path)
    with path.open("rb") as file, checked_archive(file, where) as packed:
        text = member(packed, "modelDescription.xml", "TEXT_BYTES", where)
    check_xml(text, f"{where}, modelDescription.xml")
    try:
        with path.open("rb") as file:  # fmpy leaves one of its own open if the text is cut off
            return read_model_description(file)
    except Exception as error:  # fmpy raises no narrower one
        raise DescriptionError(
            "FMU", where, "have a model description that can be read", hint=str(error)[:500]
        ) from error
