"""``contactkit fmu build``, ``fmu check``, ``fmu system``, ``fmu modelica``, ``fmu crosscheck``."""

from __future__ import annotations

from collections.abc import Iterable
from pathlib import Path
from typing import Any

import click

from ..errors import MissingExtraError
from . import options
from .terminal import print_files, say, timed

__all__ = ["fmu"]

_MODELS = ("stiction-mass", "stiction-force", "valve-drive", "tip-contact", "contact-stop")


def _fmu_names() -> Iterable[str]:
    from ..models.library import bundled_scenes

    return sorted({*_MODELS, *bundled_scenes()})


@click.group(cls=options.Group, no_args_is_help=False)
def fmu() -> None:
    """Build and check FMUs."""


@fmu.command(cls=options.Command)
@click.argument("what", type=options.Names(_fmu_names))
@options.settings
@options.file(".fmu", "FMU file to write.", required=True)
@click.option("--native", is_flag=True, help="An FMU in C, which needs no Python to run.")
@click.option(
    "--model",
    type=click.Choice(_MODELS),
    help="Model of a native FMU of a scene: a mass with its film, the film alone, its valve, its "
    "tips, or the stop of its faces.",
)
@click.option("--fmi", type=click.Choice(("2", "3")), default="2", help="Version of FMI.")
@click.option(
    "--wasm", is_flag=True, help="With a WebAssembly component beside the libraries; of FMI 3."
)
@click.option(
    "--reference", is_flag=True, help="With results to check it by, inside; of the film of a scene."
)
@options.overwrite
def build(what: str, settings: tuple[str, ...], out: Path, overwrite: bool, **form: Any) -> None:
    """Write an FMU.

    WHAT is stiction-mass, stiction-force, valve-drive, tip-contact, contact-stop, or a scene, whose
    values become start values. --set takes paths of a scene, or variables of an FMU by its name.
    """
    from ..app.fmu_files import Order, build_fmu, check_order
    from ..app.output import check_file, enter
    from ..fmu.python.build import validate

    order = Order(what, settings, out, **form)
    check_order(order)
    check_file(out, ".fmu", overwrite=overwrite)
    with timed("build"):
        name = build_fmu(order)
    enter(out, "fmu build")
    try:
        verdict = "; ".join(validate(out)) or "valid"
    except MissingExtraError as error:
        verdict = f"not checked: {error}"
    say(f"{out}: {name}, {out.stat().st_size / 1024:.0f} KiB, {verdict}")


@fmu.command(cls=options.Command)
@click.argument("file", type=click.Path(path_type=Path))
def check(file: Path) -> None:
    """Check an FMU, and run it against the results in it.

    FILE is an FMU, of contactkit or not. Fmpy checks it; the results are as FMI-LS-REF has them. It
    is run: take one of people you trust.
    """
    from ..errors import ContactkitError
    from ..fmu.contents.reference_check import check_references
    from ..fmu.python.build import validate

    found = check_references(file)
    problems = validate(file)
    for one in found:
        verdict = "fine" if one.is_fine else "DIFFERS"
        say(
            f"{one.experiment}: {one.variable} differs by {one.error:.1e}, at most "
            f"{one.tolerance:g}: {verdict}"
        )
    wrong = [one.variable for one in found if not one.is_fine]
    if wrong or problems:
        said = [*problems, *([f"results differ: {', '.join(wrong)}"] if wrong else [])]
        raise ContactkitError(f"{file}: {'; '.join(said)}")
    say(f"{file}: valid, as its reference results")


@fmu.command(cls=options.Command)
@click.argument("scene", type=options.Names(_fmu_names), default="fuel-injector")
@options.file(".ssp", "File to write; else SCENE.ssp.")
@click.option("--native", is_flag=True, help="Both FMUs in C, which need no Python to run.")
@options.overwrite
def system(scene: str, out: Path | None, native: bool, overwrite: bool) -> None:
    """Write a valve and its film as a system structure (SSP).

    SCENE is a scene with a valve: fuel-injector if none is given.
    """
    from ..app.output import check_file, enter
    from ..app.system import write_system

    target = out or Path(f"{Path(scene).stem}.ssp")
    check_file(target, ".ssp", overwrite=overwrite)
    path = write_system(scene, target, native=native)
    enter(path, "fmu system")
    kind = "both in C" if native else "both in Python"
    say(f"{path}: drive and mass, {kind}, {path.stat().st_size / 1024:.0f} KiB")


@fmu.command(cls=options.Command)
@click.argument("file", metavar="FILE.fmu", type=click.Path(path_type=Path))
@options.file(".mo", "Modelica file to write; its name is that of the package.", required=True)
@options.overwrite
def modelica(file: Path, out: Path, overwrite: bool) -> None:
    """Write a Modelica wrapper of an FMU, with flanges."""
    from ..app.output import check_file, enter
    from ..fmu.modelica.package import write_modelica

    check_file(out, ".mo", overwrite=overwrite)
    path = write_modelica(file, out)
    enter(path, "fmu modelica")
    say(f"{path}: {path.stem}.Wrapper; redeclare its block Fmu as what your tool imports")


@fmu.command(cls=options.Command)
@click.option("--out", type=click.Path(path_type=Path), required=True, help="Folder to write to.")
@click.option("--no-fmu", is_flag=True, help="The tables only; needs no compiler.")
@options.overwrite
def crosscheck(out: Path, no_fmu: bool, overwrite: bool) -> None:
    """Write native FMUs with reference files of the FMI cross-check."""
    from ..app.crosscheck import write_crosscheck
    from ..app.output import Command, written_to

    with written_to(out, Command("crosscheck", "the FMI cross-check"), overwrite=overwrite):
        print_files("written", write_crosscheck(out, fmus=not no_fmu))
