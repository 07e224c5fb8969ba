"""The command line: ``contactkit run | plan | cost | fmu build``."""

from __future__ import annotations

import argparse
import json
import math
import sys
from collections.abc import Callable, Iterator, Mapping
from contextlib import contextmanager
from pathlib import Path
from typing import Any, Literal

from .errors import ContactkitError

__all__ = ["main"]

Progress = Callable[[float], None]


def main(arguments: list[str] | None = None) -> int:
    """Run the command line and return its exit status."""
    parsed = _parser().parse_args(arguments)
    try:
        return int(parsed.command(parsed) or 0)
    except ContactkitError as error:
        print(f"contactkit: {error}", file=sys.stderr)
        return 2
    except BrokenPipeError:  # the reader of a pipe, such as head, has closed it
        sys.stderr.close()
        return 0
    except KeyboardInterrupt:
        print("contactkit: interrupted; no incomplete files are left", file=sys.stderr)
        return 130


def _parser() -> argparse.ArgumentParser:
    parser = argparse.ArgumentParser(
        prog="contactkit",
        description="Contact of rough layered surfaces, and the forces that resist separating "
        "wetted ones.",
    )
    parser.add_argument("--version", action="store_true", help="print the version and exit")
    parser.set_defaults(command=_version)
    commands = parser.add_subparsers(title="commands", metavar="COMMAND")
    for name, command, text in (
        ("run", _run, "run a scene, print its numbers, write its curves and figures"),
        ("plan", _plan, "print the effects of a scene, on and off, and their sources"),
        ("cost", _cost, "measure error against computing time for a scene"),
    ):
        one = commands.add_parser(name, help=text, description=text)
        one.add_argument("scene", help="a scene file, or the name of a scene of contactkit")
        one.set_defaults(command=command)
        if name != "plan":
            one.add_argument("--out", type=Path, help="folder to write curves and figures to")
            one.add_argument("--json", action="store_true", help="print only the numbers, as JSON")
        if name == "cost":
            one.add_argument(
                "--error",
                type=float,
                default=1e-6,
                help="relative error to recommend a setting for",
            )
    fmu = commands.add_parser("fmu", help="build FMUs").add_subparsers(
        metavar="COMMAND", required=True
    )
    _add_build(fmu)
    _add_system(fmu)
    return parser


def _add_build(fmu: Any) -> None:
    """Command that writes one FMU."""
    build = fmu.add_parser("build", help="write an FMU", description="write an FMU")
    build.add_argument(
        "what",
        help="stiction-mass, stiction-force, valve-drive, tip-contact, contact-stop, or a scene, "
        "whose values become start values",
    )
    build.add_argument("--out", type=Path, required=True, help="FMU file to write, FILE.fmu")
    build.add_argument(
        "--native", action="store_true", help="an FMU in C, which needs no Python to run"
    )
    build.add_argument(
        "--model",
        choices=("stiction-mass", "stiction-force", "valve-drive"),
        help="model of a native FMU: a mass with its film, the film alone, or the valve",
    )
    build.add_argument("--fmi", choices=("2", "3"), default="2", help="version of FMI")
    build.set_defaults(command=_build)


def _add_system(fmu: Any) -> None:
    """Commands that write several FMUs: system structures, cross-check files."""
    text = "write a valve and its film as a system structure (SSP)"
    system = fmu.add_parser("system", help=text, description=text)
    system.add_argument(
        "scene", nargs="?", default="fuel-injector", help="a scene with a valve: fuel-injector"
    )
    system.add_argument("--out", type=Path, help="file to write, FILE.ssp; else SCENE.ssp")
    system.add_argument(
        "--native", action="store_true", help="both FMUs in C, which need no Python to run"
    )
    system.set_defaults(command=_system)
    text = "write reference files for native FMUs in the format of the FMI cross-check"
    check = fmu.add_parser("crosscheck", help=text, description=text)
    check.add_argument("--out", type=Path, required=True, help="folder to write to")
    check.add_argument("--no-fmu", action="store_true", help="the tables only; needs no compiler")
    check.set_defaults(command=_crosscheck)


def _version(parsed: argparse.Namespace) -> int:
    if parsed.version:
        from . import __version__

        print(__version__)
        return 0
    _parser().print_help()
    return 2


@contextmanager
def _progress(text: str) -> Iterator[Progress]:
    """Show progress on stderr for whatever takes longer than a second."""
    from tqdm import tqdm

    # A terminal shows a moving bar, a log file a line every ten seconds.
    pause = 0.1 if sys.stderr.isatty() else 10.0
    with tqdm(
        total=100,
        mininterval=pause,
        maxinterval=pause,
        desc=text,
        delay=1.0,
        leave=False,
        bar_format="{desc} {bar} {n:.0f} % {elapsed}",
    ) as bar:

        def show(fraction: float) -> None:
            bar.n = min(100.0 * fraction, 100.0)
            bar.update(0)

        yield show


def _load(name: str) -> Any:
    """Open a scene; its modules are imported here, so that --help is fast."""
    from .app.scenes import open_scene

    return open_scene(name)


def _run(parsed: argparse.Namespace) -> None:
    device = _load(parsed.scene)
    with _progress(f"run {device.name}") as progress:
        report = device.run(parsed.out, progress)
    _show(report, parsed.json)


def _plan(parsed: argparse.Namespace) -> None:
    print(_load(parsed.scene).plan_text())


def _cost(parsed: argparse.Namespace) -> None:
    device = _load(parsed.scene)
    with _progress(f"cost of {device.name}") as progress:
        report = device.cost(parsed.out, progress, parsed.error)
    _show(report, parsed.json)


def _build(parsed: argparse.Namespace) -> None:
    from .fmu.python.build import FMUS, build, validate

    _check_build(parsed)
    if parsed.native:
        name, path = _build_native(parsed)
    else:
        from .app.scenes import FmuStart

        what = parsed.what
        start = FmuStart(what, {}) if what in FMUS else _load(what).fmu_start()
        name, path = start.name, build(start.name, parsed.out, start=start.values)
    problems = validate(path)
    print(
        f"{path}: {name}, {path.stat().st_size / 1024:.0f} KiB, " + ("; ".join(problems) or "valid")
    )


def _build_native(parsed: argparse.Namespace) -> tuple[str, Path]:
    """Write a native FMU; return its description and the file."""
    from .fmu.native.build import build_native, native_scene
    from .fmu.native.drive import build_native_drive
    from .fmu.python.build import FMUS

    fmi: Literal[2, 3] = 3 if parsed.fmi == "3" else 2
    if "valve-drive" in (parsed.what, parsed.model):
        path = build_native_drive(parsed.out, start=_drive_start(parsed.what), fmi=fmi)
        return f"valve-drive, native, FMI {fmi}.0", path
    what = parsed.what if parsed.what in FMUS else _load(parsed.what)
    scene, start = native_scene(what, parsed.model)
    film_alone = "stiction-force" in (parsed.what, parsed.model)
    model: Literal["stiction-mass", "stiction-force"] = (
        "stiction-force" if film_alone else "stiction-mass"
    )
    path = build_native(scene, parsed.out, model=model, start=start, fmi=fmi)
    return f"{model}, native, FMI {fmi}.0", path


def _drive_start(what: str) -> Mapping[str, Any]:
    """Start values of the drive of a scene; none for a drive built by its name."""
    from .app.run.injector.cosimulation import drive_start
    from .errors import PlanError
    from .fmu.python.build import FMUS

    if what == "valve-drive":
        return {}
    valve = None if what in FMUS else getattr(getattr(_load(what), "scene", None), "valve", None)
    if valve is None:
        raise PlanError(
            f"{what} has no valve; a valve-drive needs a scene with one, such as fuel-injector"
        )
    return drive_start(valve)


def _check_build(parsed: argparse.Namespace) -> None:
    """Refuse contradictory options before anything is built."""
    from .errors import DescriptionError, PlanError

    if parsed.fmi != "2" and not parsed.native:
        raise PlanError(
            "without --native only FMUs of FMI 2.0 can be built; add --native, or leave out --fmi 3"
        )
    if parsed.model is not None and not parsed.native:
        raise PlanError(
            f"--model chooses the model of a native FMU; add --native, or build {parsed.model} by "
            f"its name"
        )
    if (parsed.what, parsed.model) == ("stiction-force", "stiction-mass"):
        raise PlanError(
            "stiction-force has no mass, so it cannot be built with --model stiction-mass; build "
            "stiction-mass"
        )
    if parsed.what == "valve-drive" and parsed.model not in (None, "valve-drive"):
        raise PlanError(
            f"valve-drive has no film, so it cannot be built with --model {parsed.model}; leave "
            f"out --model, or give a scene"
        )
    if parsed.out.suffix != ".fmu":
        raise DescriptionError("--out", str(parsed.out), "end in .fmu")


def _system(parsed: argparse.Namespace) -> None:
    from .app.system import write_system

    out = parsed.out or Path(f"{Path(parsed.scene).stem}.ssp")
    path = write_system(parsed.scene, out, native=parsed.native)
    kind = "both in C" if parsed.native else "both in Python"
    print(f"{path}: drive and mass, {kind}, {path.stat().st_size / 1024:.0f} KiB")


def _crosscheck(parsed: argparse.Namespace) -> None:
    from .app.crosscheck import write_crosscheck

    paths = write_crosscheck(parsed.out, fmus=not parsed.no_fmu)
    print("written: " + ", ".join(str(path) for path in paths))


def _show(report: Any, as_json: bool) -> None:
    if as_json:
        print(json.dumps(_scalars(report.scalars), indent=2))
        return
    print(report.text)
    if report.files:
        print("written: " + ", ".join(str(path) for path in report.files))


def _scalars(scalars: Mapping[str, tuple[Any, str]]) -> dict[str, dict[str, Any]]:
    """Numbers for JSON, which has no nan and no infinity: these become null."""
    return {
        name: {
            "value": None if isinstance(value, float) and not math.isfinite(value) else value,
            "unit": unit,
        }
        for name, (value, unit) in scalars.items()
    }


if __name__ == "__main__":
    sys.exit(main())
