"""The command line: ``contactkit run | study | plan | cost | gallery | fmu`` and helpers."""

from __future__ import annotations

import argparse
import json
import math
import sys
import warnings
from collections.abc import Callable, Iterator, Mapping, Sequence
from contextlib import contextmanager
from pathlib import Path
from typing import Any, Literal

from .errors import ContactkitError, DescriptionError, MissingExtraError, PlanError
from .extras import missing_extra

__all__ = ["main"]

Progress = Callable[[float], None]


_NOT_OURS, _INTERRUPTED, _BUG = 2, 130, 70  # exit statuses; 70 as in sysexits.h


def main(arguments: list[str] | None = None) -> int:
    """Run the command line and return its exit status.

    Whatever goes wrong is reported in one line: 2 for what the user can mend, 70 for a defect of
    contactkit, whose traceback ``--traceback`` shows.
    """
    parsed = _parser().parse_args(arguments)
    try:
        with warnings.catch_warnings():
            warnings.showwarning = _show_warning
            return int(parsed.command(parsed) or 0)
    except BrokenPipeError:  # the reader of a pipe, such as head, has closed it
        sys.stderr.close()
        return 0
    except KeyboardInterrupt:
        _report("interrupted; no incomplete files are left")
        return _INTERRUPTED
    except Exception as error:
        if parsed.traceback:
            raise
        return _reported(error)


def _reported(error: Exception) -> int:
    """Report an error in one line; return the exit status."""
    if isinstance(error, ImportError):
        error = missing_extra(error, "this command") or error
    if isinstance(error, ContactkitError):
        _report(str(error))
        return _NOT_OURS
    if isinstance(error, OSError):  # no space, no permission, a folder in place of a file
        _report(f"{error.strerror or error}: {error.filename or 'a file'}")
        return _NOT_OURS
    if isinstance(error, MemoryError):
        _report("out of memory; take a coarser grid or fewer planes")
        return _NOT_OURS
    _report(
        f"a defect of contactkit, {type(error).__name__}: {error}; please report it with what "
        "the same command prints with --traceback"
    )
    return _BUG


def _report(text: str) -> None:
    print(f"contactkit: {text}", file=sys.stderr)


def _show_warning(message: Warning | str, *_: object, **__: object) -> None:
    """A warning in one line, without the line of code that issued it."""
    _report(f"warning: {message}")


def _parser() -> argparse.ArgumentParser:
    parser = argparse.ArgumentParser(
        prog="contactkit",
        description="Contact of rough layered surfaces, and the forces that resist separating "
        "wetted ones.",
    )
    parser.add_argument("--version", action="store_true", help="print the version and exit")
    parser.set_defaults(command=_version, traceback=False)
    commands = parser.add_subparsers(title="commands", metavar="COMMAND")
    for name, command, text in (
        ("run", _run, "run a scene, print its numbers, write its curves and figures"),
        ("study", _study, "run the study of a scene file, write its columns and a figure"),
        ("plan", _plan, "print the effects of a scene, on and off, and their sources"),
        ("cost", _cost, "measure error against computing time for a scene"),
    ):
        one = commands.add_parser(name, help=text, description=text)
        one.add_argument("scene", help="a scene file, or the name of a scene of contactkit")
        _set_command(one, command)
        _add_settings(one)
        if name != "plan":
            one.add_argument("--out", type=Path, help="folder to write curves and figures to")
            text = "replace files in the folder that this scene did not write"
            one.add_argument("--overwrite", action="store_true", help=text)
            one.add_argument("--json", action="store_true", help="print only the numbers, as JSON")
        if name == "run":
            text = "write report.html, one page about the result, to the folder"
            one.add_argument("--report", action="store_true", help=text)
        if name == "study":
            _add_study_options(one)
        if name == "cost":
            one.add_argument(
                "--error",
                type=float,
                default=1e-6,
                help="relative error to recommend a setting for",
            )
    _add_help(commands)
    _add_gallery(commands)
    fmu = commands.add_parser("fmu", help="build FMUs").add_subparsers(
        metavar="COMMAND", required=True
    )
    _add_build(fmu)
    _add_system(fmu)
    return parser


def _add_settings(parser: argparse.ArgumentParser) -> None:
    """Options that change a scene."""
    parser.add_argument(
        "--set",
        action="append",
        default=[],
        dest="settings",
        metavar="PATH=VALUE",
        help="set a value of the scene: loading.force='60 N'; may be given again",
    )


def _add_study_options(study: argparse.ArgumentParser) -> None:
    """Options of a study."""
    study.add_argument("--workers", type=int, default=1, help="processes to run points in")
    study.add_argument("--store", type=Path, help="folder of finished points, to continue from")
    study.add_argument(
        "--dimensionless",
        action="store_true",
        help="in units of the reference scales, such as E* A, in place of SI units",
    )


def _add_help(commands: Any) -> None:
    """Commands that help to write a scene file."""
    text = "list what scene files may name"
    known = commands.add_parser("list", help=text, description=text)
    known.add_argument("what", help="scenes, liquids, materials or effects")
    _set_command(known, _list)
    text = "print a commented scene file to begin with: contactkit new separation > my.toml"
    new = commands.add_parser("new", help=text, description=text)
    new.add_argument("kind", help="contact, separation or sliding")
    _set_command(new, _new)
    text = "report all mistakes of a scene file, with their lines, without running it"
    check = commands.add_parser("check", help=text, description=text)
    check.add_argument("scene", help="a scene file")
    _add_settings(check)
    _set_command(check, _check)
    text = "write one page of HTML about a result: figures, numbers, validity, plan, sources"
    page = commands.add_parser("report", help=text, description=text)
    page.add_argument("result", type=Path, help="a result file, or a folder written by run")
    page.add_argument("--out", type=Path, help="file to write, FILE.html; else beside the result")
    page.add_argument("--overwrite", action="store_true", help="replace a file of others")
    _set_command(page, _report_page)


def _add_gallery(commands: Any) -> None:
    """Command that makes the figures and tables of the source."""
    text = "compute every figure and table of the source again, and judge it"
    gallery = commands.add_parser("gallery", help=text, description=text)
    gallery.add_argument(
        "names",
        nargs="*",
        metavar="NAME",
        help="pages such as 2.9, chapters such as chapter_2, or files of scripts; else all",
    )
    gallery.add_argument(
        "--out", type=Path, default=Path("out/gallery"), help="folder to write to, and continue in"
    )
    gallery.add_argument("--quick", action="store_true", help="small sizes: a draft")
    gallery.add_argument("--list", action="store_true", help="list the pages and exit")
    _set_command(gallery, _gallery)


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
    _set_command(build, _build)


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
    _set_command(system, _system)
    text = "write reference files for native FMUs in the format of the FMI cross-check"
    check = fmu.add_parser("crosscheck", help=text, description=text)
    check.add_argument("--out", type=Path, required=True, help="folder to write to")
    check.add_argument("--no-fmu", action="store_true", help="the tables only; needs no compiler")
    _set_command(check, _crosscheck)


def _set_command(parser: argparse.ArgumentParser, command: Callable[..., int | None]) -> None:
    """What a parser runs, with the option that all commands have."""
    text = "show the traceback of an error, for a report of a defect"
    parser.add_argument("--traceback", action="store_true", help=text)
    parser.set_defaults(command=command)


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


def _load(name: str, settings: Sequence[str] = ()) -> Any:
    """Open a scene; its modules are imported here, so that --help is fast."""
    from .app.scenes import open_scene
    from .app.settings import with_settings

    return with_settings(open_scene(name), settings)


def _check_folder(folder: Path | None) -> None:
    """Refuse a folder that cannot be written to before the work, not after it."""
    from .app.output import check_folder

    if folder is not None:
        check_folder(folder)


@contextmanager
def _output(parsed: argparse.Namespace, command: str) -> Iterator[Any]:
    """Folder that a command writes to, if one is given."""
    from .app.output import Command, written_to

    if parsed.out is None:
        yield None
        return
    who = Command(command, parsed.scene, tuple(parsed.settings))
    with written_to(parsed.out, who, overwrite=parsed.overwrite) as folder:
        yield folder


def _run(parsed: argparse.Namespace) -> None:
    from .app.report_page import PAGE, folder_page, write_page

    if parsed.report and parsed.out is None:
        raise DescriptionError("--report", "", "come with --out, the folder to write to")
    with _output(parsed, "run") as folder:
        device = _load(parsed.scene, parsed.settings)
        with _progress(f"run {device.name}") as progress:
            report = device.run(parsed.out, progress)
        _show(report, parsed.json)
        if folder is not None:
            folder.keep(device.name, report.text, report.scalars)
        if parsed.report:
            path = write_page(folder_page(parsed.out, folder.record), parsed.out / PAGE)
            if not parsed.json:
                _print_files("written", [path])


def _study(parsed: argparse.Namespace) -> None:
    from .app.run.study import StudyOptions

    options = StudyOptions(parsed.workers, parsed.store, parsed.dimensionless)
    with _output(parsed, "study") as folder:
        device = _load(parsed.scene, parsed.settings)
        with _progress(f"study of {device.name}") as progress:
            report = device.study(parsed.out, progress, options)
        _show(report, parsed.json)
        if folder is not None:
            folder.keep(device.name, report.text, report.scalars)


def _plan(parsed: argparse.Namespace) -> None:
    print(_load(parsed.scene, parsed.settings).plan_text())


def _report_page(parsed: argparse.Namespace) -> None:
    from .app.output import enter
    from .app.report_page import PAGE, check_page, report_page, write_page

    source = parsed.result
    path = parsed.out or (source / PAGE if source.is_dir() else source.with_suffix(".html"))
    check_page(path, overwrite=parsed.overwrite)
    print(write_page(report_page(source), path))
    enter(path, "report")


def _list(parsed: argparse.Namespace) -> None:
    from .app.listing import listing

    print(listing(parsed.what))


def _new(parsed: argparse.Namespace) -> None:
    from .app.templates import template

    print(template(parsed.kind), end="")


def _check(parsed: argparse.Namespace) -> None:
    device = _load(parsed.scene, parsed.settings)
    with warnings.catch_warnings(record=True) as remarks:
        warnings.simplefilter("always")
        title = device.plan_text().splitlines()[0]
    for one in remarks:
        _show_warning(one.message)
    print(f"{parsed.scene}: no mistakes; {title}")


def _cost(parsed: argparse.Namespace) -> None:
    with _output(parsed, "cost") as folder:
        device = _load(parsed.scene, parsed.settings)
        with _progress(f"cost of {device.name}") as progress:
            report = device.cost(parsed.out, progress, parsed.error)
        _show(report, parsed.json)
        if folder is not None:
            folder.keep(device.name, report.text, report.scalars)


def _gallery(parsed: argparse.Namespace) -> int:
    """Make pages of the gallery; the exit status is 1 if a check does not hold."""
    from .app.gallery.run import Outcome, run_gallery
    from .app.gallery.scripts import chosen

    pages = chosen(parsed.names)
    if parsed.list:
        for one in pages:
            print(f"{one.page.name:<12} {one.chapter:<10} {one.page.title}")
        return 0
    _check_folder(parsed.out)
    ended: list[Outcome] = []

    def report(outcome: Outcome) -> None:
        ended.append(outcome)
        print(f"[{len(ended)}/{len(pages)}] {outcome}", flush=True)

    made = run_gallery(pages, parsed.out, draft=parsed.quick, report=report)
    bad = sum(not one.is_good for one in made)
    found = f"{bad} with a check that does not hold" if bad else "all checks hold"
    print(f"{parsed.out / 'index.md'}: {len(made)} pages, {found}")
    return 1 if bad else 0


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
    print(f"{path}: {name}, {path.stat().st_size / 1024:.0f} KiB, ", end="", flush=True)
    try:
        print("; ".join(validate(path)) or "valid")
    except MissingExtraError as error:
        print(f"not checked: {error}")


def _build_native(parsed: argparse.Namespace) -> tuple[str, Path]:
    """Write a native FMU; return its description and the file."""
    from .fmu.native.build import build_native, native_scene
    from .fmu.native.drive import build_native_drive, build_native_stop
    from .fmu.native.tip import build_native_tip
    from .fmu.python.build import FMUS
    from .models.micromirror.scene import MicromirrorScene
    from .scene.scenes import ContactScene

    fmi: Literal[2, 3] = 3 if parsed.fmi == "3" else 2
    if "valve-drive" in (parsed.what, parsed.model):
        path = build_native_drive(parsed.out, start=_drive_start(parsed.what), fmi=fmi)
        return f"valve-drive, native, FMI {fmi}.0", path
    what = parsed.what if parsed.what in FMUS else _load(parsed.what)
    if what == "contact-stop" or isinstance(getattr(what, "scene", None), ContactScene):
        values = {} if isinstance(what, str) else what.fmu_start().values
        path = build_native_stop(parsed.out, start=values, fmi=fmi)
        return f"contact-stop, native, FMI {fmi}.0", path
    is_mirror = isinstance(getattr(what, "scene", None), MicromirrorScene)
    if parsed.model is None and (what == "tip-contact" or is_mirror):
        values = {} if isinstance(what, str) else what.fmu_start().values
        path = build_native_tip(parsed.out, start=values, fmi=fmi)
        return f"tip-contact, native, FMI {fmi}.0", path
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
    _check_folder(parsed.out.parent)


def _system(parsed: argparse.Namespace) -> None:
    from .app.system import write_system

    out = parsed.out or Path(f"{Path(parsed.scene).stem}.ssp")
    _check_folder(out.parent)
    path = write_system(parsed.scene, out, native=parsed.native)
    kind = "both in C" if parsed.native else "both in Python"
    print(f"{path}: drive and mass, {kind}, {path.stat().st_size / 1024:.0f} KiB")


def _crosscheck(parsed: argparse.Namespace) -> None:
    from .app.crosscheck import write_crosscheck

    _check_folder(parsed.out)
    paths = write_crosscheck(parsed.out, fmus=not parsed.no_fmu)
    print("written: " + ", ".join(str(path) for path in paths))


def _show(report: Any, as_json: bool) -> None:
    """Print the numbers and the files that are there, then draw the pictures."""
    if as_json:
        print(json.dumps(_scalars(report.scalars), indent=2), flush=True)
    else:
        print(report.text)
        _print_files("written", report.files)
    if report.draw is None:
        return
    try:
        drawn = report.draw()
    except ImportError as error:
        missing = missing_extra(error, "drawing the pictures")
        if missing is None:
            raise
        _report(str(missing))
        return
    if not as_json:
        _print_files("drawn", drawn)


def _print_files(what: str, files: Sequence[Path]) -> None:
    if files:
        print(f"{what}: " + ", ".join(map(str, files)), flush=True)


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
