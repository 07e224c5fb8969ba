"""Optional packages, and the extra of contactkit that installs each."""

from __future__ import annotations

import importlib.util

from .errors import MissingExtraError

__all__ = ["missing_extra", "require"]

_EXTRAS = {
    "PIL": "plot",
    "SurfaceTopography": "maps",
    "afmformats": "afm",
    "array_api_compat": "arrays",
    "distributed": "dask",
    "ducc0": "fast",
    "emcee": "posterior",
    "fmpy": "fmu",
    "marimo": "app",
    "matplotlib": "plot",
    "mpl_toolkits": "plot",
    "numba": "fast",
    "pandas": "data",
    "pyamg": "films",
    "pythonfmu": "fmu",
    "pyvista": "view3d",
    "wasmtime": "wasm",
    "xarray": "data",
    "yaml": "maps",
    "ziglang": "native",
}


def missing_extra(error: ImportError, purpose: str = "this") -> MissingExtraError | None:
    """Name the cure of an import that failed; None if the package is not an optional one.

    Examples
    --------
    >>> print(missing_extra(ModuleNotFoundError(name="matplotlib.figure"), "drawing"))
    drawing needs matplotlib, which is not installed: pip install contactkit[plot]
    """
    package = (error.name or "").partition(".")[0]
    if package not in _EXTRAS:
        return None
    return MissingExtraError(
        f"{purpose} needs {package}, which is not installed: "
        f"pip install contactkit[{_EXTRAS[package]}]",
        name=package,
    )


def require(package: str, purpose: str) -> None:
    """Refuse to go on without an optional package, before any work is done.

    Raises
    ------
    MissingExtraError
        If it is not installed.
    """
    if importlib.util.find_spec(package) is None:
        found = missing_extra(ModuleNotFoundError(name=package), purpose)
        raise found or MissingExtraError(f"{purpose} needs {package}", name=package)
