"""Native FMUs for every platform: what their libraries are, and runs with other systems.

ziglang, which builds them, comes with the extra `test`. With Debian's `qemu-user-static` and
`libc6-arm64-cross`, and `wine`, they run with the library of C of Linux on arm64, and with Wine's
of Windows.
"""

from __future__ import annotations

import importlib.util
import os
import re
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

import pytest
from selection import quick

pytest.importorskip("ziglang", reason="ziglang is not installed: pip install contactkit[test]")
fmpy = pytest.importorskip("fmpy")

from emulated_files import read_library, slices_of  # noqa: E402
from hosts_fmus import reference  # noqa: E402
from native_scenes import HERE  # noqa: E402
from platforms_fmus import LIBRARIES, every_fmu, library_of  # noqa: E402

from contactkit.fmu.framework.toolchain import (  # noqa: E402
    PLATFORMS,
    _more,
    compile_kernel,
    fmi_headers,
)
from contactkit.fmu.native.sources import kernel_sources  # noqa: E402
from contactkit.fmu.python.build import validate  # noqa: E402

pytestmark = pytest.mark.slow


@pytest.fixture(scope="session")
def fmus(shelf):
    return every_fmu(shelf)


def test_they_are_fmus_for_every_platform(fmus):
    for path in fmus.glob("*.fmu"):
        assert validate(path) == []
    for fmi, count in ((2, 4), (3, 5)):  # both kinds of Mac share a file in FMI 2
        for fmu in ("mass-A", "film", "drive"):
            assert len({library_of(fmus, name, fmi, fmu) for name in PLATFORMS}) == count


MATHEMATICS = (
    "acos asin atan atan2 cbrt ceil cos cosh exp expm1 floor fmod hypot log log1p pow sin sinh "
    "sqrt tan tanh"
)
TEXT_AND_MEMORY = "calloc free malloc memcpy memmove memset strcmp strlen strncmp fclose fread"
COMMON = {*MATHEMATICS.split(), *TEXT_AND_MEMORY.split()}
ALLOWED = {
    "linux": ({"libc.so.6", "libm.so.6"}, {"fopen", "snprintf"}),
    "macos": (
        {"/usr/lib/libSystem.B.dylib"},
        {"fopen", "snprintf", "bzero", "__bzero", "memset_pattern16", "dyld_stub_binder"},
    ),
    "windows": (
        {"kernel32.dll"}
        | {
            f"api-ms-win-crt-{part}-l1-1-0.dll"
            for part in ("heap", "math", "private", "stdio", "string")
        },
        {"MultiByteToWideChar", "WideCharToMultiByte", "_wfopen", "__stdio_common_vsprintf"},
    ),
}


@pytest.mark.parametrize(("name", "fmi"), LIBRARIES)
def test_a_library_needs_what_every_such_computer_has(fmus, name, fmi):
    content = library_of(fmus, name, fmi).read_bytes()
    found = read_library(content, name.partition("-")[2])
    assert f"{found.system}-{found.machine}" == name
    libraries, more = ALLOWED[found.system]
    assert set(found.needs) <= libraries
    assert set(found.imports) <= COMMON | more
    assert (
        found.system_version
        <= {"linux": (2, 17), "macos": (11, 0), "windows": (6, 0)}[found.system]
    )
    if name == "macos-aarch64":
        assert found.signed  # it would not be loaded otherwise


@pytest.mark.parametrize(("name", "fmi"), LIBRARIES)
def test_a_library_offers_the_functions_of_fmi(fmus, name, fmi):
    header = fmi_headers(fmi)[f"fmi{fmi}Functions.h"].decode()
    wanted = set(re.findall(rf"FMI{fmi}_Export +(fmi{fmi}\w+)TYPE", header))
    assert len(wanted) in (44, 75)
    found = read_library(library_of(fmus, name, fmi).read_bytes(), name.partition("-")[2])
    of_all_macs = {"_mh_dylib_header", "__dso_handle"} if found.system == "macos" else set()
    assert set(found.exports) == wanted | of_all_macs


def test_nobody_sees_where_they_were_built(fmus):
    compiler = Path(importlib.util.find_spec("ziglang").origin).parent
    here = map(str, (tempfile.gettempdir(), Path.home(), Path.cwd(), HERE, compiler))
    here = [word.encode() for word in here if len(word) > 3]
    for path in fmus.glob("*/binaries/*/*"):
        content = path.read_bytes()
        assert not [word for word in here if word in content]


@pytest.mark.parametrize("name", quick(PLATFORMS, long=[0, 2]))
def test_a_rebuild_elsewhere_is_the_same(fmus, name, tmp_path):
    """From the sources in the FMU, in another folder, under another name."""
    sources = shutil.copytree(fmus / "mass-A-2" / "sources", tmp_path / "other sources")
    compile_kernel(sources, name, tmp_path / "new", "zig")
    kept = library_of(fmus, name, 2).read_bytes()
    if kept[:4] == bytes.fromhex("cafebabe"):
        assert (tmp_path / "new").read_bytes() in slices_of(kept)
    else:
        assert (tmp_path / "new").read_bytes() == kept


# with the systems they are for ---------------------------------------------------------------

ARM, ARM_LIBRARIES = "qemu-aarch64-static", Path("/usr/aarch64-linux-gnu")
RUNS = {"A": ("40", "1e-5", "5e-4", "0", "1"), "B": ("40", "1e-5", "1.3e-2", "2e-4", "20")}


def host_program(folder, name, fmi):
    """The host in C for a platform."""
    headers = folder / f"headers-{fmi}"
    headers.mkdir(exist_ok=True)
    for file, content in fmi_headers(fmi).items():
        (headers / file).write_bytes(content)
    out, files = folder / f"{name}-{fmi}.exe", [HERE / "host_release.c"]
    flags = ["-std=c99", "-O1", "-Wall", "-Wextra", "-Werror", f"-DFMI={fmi}", f"-I{headers}"]
    more = ["-lm", "-ldl"]
    if name.startswith("windows"):
        (folder / "windows.c").write_bytes(kernel_sources()["windows.c"])
        files += [HERE / "host_windows.c", folder / "windows.c"]
        more = [*_more(name, zig=True), "-D__USE_MINGW_ANSI_STDIO=0"]
        more += ["-Wl,--entry=mainCRTStartup"]
        more += [f"-lapi-ms-win-crt-{part}-l1-1-0" for part in ("runtime", "convert")]
    command = [sys.executable, "-m", "ziglang", "cc", "-target", PLATFORMS[name].target]
    subprocess.run(
        [*command, *flags, *map(str, files), "-o", str(out), *more],
        check=True,
        capture_output=True,
        text=True,
    )
    return out


def run_host(command, library, where, guid, words, **environment):
    """What a host prints: rows of gap, speed, force, then the release."""
    done = subprocess.run(
        [*map(str, command), str(library), str(where), guid, *words],
        capture_output=True,
        check=False,
        timeout=120,
        env=os.environ | environment,
    )
    assert done.returncode == 0, done.stderr
    return [[float(word) for word in line.split()] for line in done.stdout.splitlines()]


def resources_of(fmus, fmu, fmi):
    """Folder of resources and GUID."""
    found = fmpy.read_model_description(str(fmus / f"{fmu}-{fmi}"))
    return fmus / f"{fmu}-{fmi}" / "resources", found.guid or found.instantiationToken


def location(resources, fmi):
    return resources.as_uri() if fmi == 2 else f"{resources}/"


@pytest.fixture(scope="session")
def rows_here(fmus, tmp_path_factory):
    """What the host finds with the library of this computer, by case and version of FMI."""
    folder, found = tmp_path_factory.mktemp("here"), {}
    for fmi in (2, 3):
        program = host_program(folder, "linux-x86_64", fmi)
        for case, words in RUNS.items():
            resources, guid = resources_of(fmus, f"mass-{case}", fmi)
            library = library_of(fmus, "linux-x86_64", fmi)
            where = location(resources, fmi)
            found[case, fmi] = run_host([program], library, where, guid, words)
    return found


def check_rows(found, expected, case):
    """The same states all the way, and the release of the reference."""
    assert len(found) == len(expected) > 30
    for row, there in zip(found, expected, strict=True):
        assert row[:3] == pytest.approx(there[:3], rel=1e-12)
    assert found[-1][0] == pytest.approx(reference(case), rel={"A": 2e-7, "B": 2e-4}[case])


here_is_linux = pytest.mark.skipif(
    sys.platform != "linux" or os.uname().machine != "x86_64",
    reason="compared with a run on Linux on x86-64",
)


@here_is_linux
@pytest.mark.skipif(
    shutil.which(ARM) is None or not ARM_LIBRARIES.is_dir(),
    reason="needs Debian's qemu-user-static and libc6-arm64-cross",
)
@pytest.mark.parametrize("fmi", [2, 3])
def test_linux_on_arm_finds_the_same(fmus, rows_here, tmp_path, fmi):
    name = "linux-aarch64"
    command = [ARM, "-L", ARM_LIBRARIES, host_program(tmp_path, name, fmi)]
    for case, words in RUNS.items():
        resources, guid = resources_of(fmus, f"mass-{case}", fmi)
        where = location(resources, fmi)
        rows = run_host(command, library_of(fmus, name, fmi), where, guid, words)
        check_rows(rows, rows_here[case, fmi], case)


@pytest.fixture(scope="session")
def wine(shelf):
    """Environment of a Windows of Wine, made once."""
    if shutil.which("wine") is None:
        pytest.skip("needs Wine (Debian's wine and wine64)")
    common = {
        "WINEDEBUG": "-all",
        "WINEDLLOVERRIDES": "mscoree=;mshtml=",
        "LC_ALL": "C.UTF-8",
        "DISPLAY": "",
    }

    def start(folder):
        subprocess.run(
            ["wine", "wineboot", "--init"],
            check=True,
            capture_output=True,
            timeout=120,
            env=os.environ | common | {"WINEPREFIX": str(folder)},
        )

    try:
        prefix = shelf.folder("wine", start)
    except (OSError, subprocess.SubprocessError) as error:
        pytest.skip(f"Wine does not start: {error}")
    return common | {"WINEPREFIX": str(prefix)}


@here_is_linux
@pytest.mark.parametrize("fmi", [2, 3])
def test_wine_finds_the_same(fmus, rows_here, wine, tmp_path, fmi):
    command = ["wine", host_program(tmp_path, "windows-x86_64", fmi)]
    for case, words in RUNS.items():
        resources, guid = resources_of(fmus, f"mass-{case}", fmi)
        where = f"file:///Z:{resources}" if fmi == 2 else f"Z:{resources}/".replace("/", "\\")
        library = f"Z:{library_of(fmus, 'windows-x86_64', fmi)}"
        rows = run_host(command, library, where, guid, words, **wine)
        check_rows(rows, rows_here[case, fmi], case)


@here_is_linux
def test_wine_opens_whatever_a_host_calls_the_folder(fmus, wine, tmp_path):
    command = ["wine", host_program(tmp_path, "windows-x86_64", 2)]
    resources, guid = resources_of(fmus, "mass-A", 2)
    folder = tmp_path / "a b ü#"
    shutil.copytree(resources, folder / "resources")
    library = folder / "a name.dll"
    shutil.copyfile(library_of(fmus, "windows-x86_64", 2), library)
    back, uri = str(folder).replace("/", "\\"), folder.as_uri().removeprefix("file://")
    for where in (
        f"file:///Z:{uri}/resources",
        f"file:///z%3A{uri}/resources/",
        f"file://Z:{folder}/resources",
        f"file:///Z:{back}\\resources",
        f"Z:{back}\\resources\\",
        f"FILE://localhost/Z:{uri}/resources",
    ):
        rows = run_host(command, f"Z:{back}\\a name.dll", where, guid, RUNS["A"][:3], **wine)
        assert rows[-1][0] == pytest.approx(reference("A"), rel=2e-7)
