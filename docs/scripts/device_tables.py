"""Tables of devices: the numbers of a scene file with the reasons it gives for them."""

from __future__ import annotations

from validation_tables import grid

from contactkit.models.library import bundled_scene
from contactkit.plot.axis_units import in_prose


def assumption_table(name: str) -> str:
    """Numbers of a device with the reasons their file gives for them."""
    text = bundled_scene(name).read_text("utf-8")
    rows: list[list[str]] = []
    section, open_row = "", False
    for line in text.partition('\ndevice = "')[2].splitlines()[1:]:
        code, _, comment = line.partition("#")
        code, comment = code.strip(), comment.strip()
        if not line.strip():  # a comment on its own is about the file
            open_row = False
        if code.startswith("["):
            section, open_row = code.strip("[]"), False
        elif code:
            key, _, value = (part.strip() for part in code.partition("="))
            open_row = bool(comment) and key not in ("name", "shape")
            if key == "effect":
                section = value.strip('"')
            label = f"{section}.{key}" if section else key
            if open_row:
                rows.append([f"`{label}`", value.strip('"'), comment])
        elif comment and open_row:
            rows[-1][2] += f" {comment}"
    return in_prose(grid(("key", "value", "where it comes from"), rows))
