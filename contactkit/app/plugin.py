"""Own kinds from a Python file, run once as a module that worker processes find too."""

from __future__ import annotations

import importlib
import importlib.util
import sys
from pathlib import Path

from ..errors import DescriptionError
from ..kinds import KINDS

__all__ = ["LOADED", "load_plugin"]

LOADED: list[str] = []
"""Files of the plugins that were run, by whose names errors in them are known."""

_OPTION = "--plugin"


def load_plugin(path: str | Path) -> tuple[str, ...]:
    """Run a file that registers kinds of its own, and return their names in scene files.

    The folder of the file is put on the path of modules, so that processes of a study, which
    receive scenes by the names of their classes, import it as well.

    Parameters
    ----------
    path : path_like
        A Python file that calls ``ck.register``. It is run: it may do whatever Python can.

    Returns
    -------
    tuple of str
        Names that were registered.

    Raises
    ------
    DescriptionError
        If there is no such file, its name is that of another module, it fails, or it registers
        nothing.
    """
    file = Path(path).resolve()
    if file.suffix != ".py" or not file.is_file():
        cure = "such as magnet.py, which calls ck.register(Magnet)"
        raise DescriptionError(_OPTION, str(path), "be a Python file that exists", hint=cure)
    name, before = file.stem, _own()
    if not name.isidentifier():
        cure = "letters, digits and underscores, not a digit first"
        raise DescriptionError(_OPTION, str(path), "be named as a module can be", hint=cure)
    _refuse_taken(name, file)
    LOADED.append(str(file))
    sys.path.insert(0, str(file.parent))
    try:
        importlib.import_module(name)
    except Exception as error:
        sys.modules.pop(name, None)
        problem = f"{type(error).__name__}: {error}"
        raise DescriptionError(_OPTION, str(path), "run", hint=problem) from error
    if found := tuple(one for one in _own() if one not in before):
        return found
    cure = "call ck.register with the class, or put @ck.register above that of attrs"
    raise DescriptionError(_OPTION, str(path), "register a kind", hint=cure)


def _own() -> list[str]:
    return [name for one in KINDS._registries() for name in one.own]


def _refuse_taken(name: str, file: Path) -> None:
    """Refuse a file that another module, which Python would find or has, shadows."""
    known = sys.modules.get(name)
    spec = known.__spec__ if known is not None else importlib.util.find_spec(name)
    if spec is not None and spec.origin != str(file):
        where = spec.origin or "another module"
        cure = f"{where} has this name: rename the file"
        raise DescriptionError(_OPTION, str(file), "have a name of its own", hint=cure)
