"""The libraries of native FMUs for every platform, run on an emulated processor.

Both ziglang, which builds them, and unicorn, which emulates, come with the extra `test`.
"""

from __future__ import annotations

import pytest

pytest.importorskip("ziglang", reason="ziglang is not installed: pip install contactkit[test]")
pytest.importorskip("unicorn", reason="unicorn is not installed: pip install contactkit[test]")
fmpy = pytest.importorskip("fmpy")

from emulated_files import read_library  # noqa: E402
from emulated_host import Host  # noqa: E402
from hosts_fmus import reference  # noqa: E402
from platforms_fmus import LIBRARIES, every_fmu, library_of  # noqa: E402

from contactkit.fmu.framework.instance import Instance  # noqa: E402

pytestmark = pytest.mark.slow


@pytest.fixture(scope="session")
def fmus(shelf):
    return every_fmu(shelf)


STATES = ("h", "v", "F", "F_m", "F_v", "J", "J_m", "W", "F_peak", "t_release")
PULLS = ("F_ext", "F_mag", "F_spring", "F_stop", "i", "u", "flux")
TIPS = ("F", "F_mean", "h", "v", "F_film", "J", "t_break", "t_land", "d_max", "F_max", "W_land")
FORCES = ("F", "F_m", "F_v", "c", "k", "J", "F_mean", "coupling_error", "H_stable")


def release_rows(start, put, step, outputs):
    """States of case A, step by step."""
    start({"F_ext": 40.0})
    rows = []
    for i in range(50):
        step(i * 1e-5, 1e-5)
        rows.append(outputs(STATES))
    return rows


def film_rows(start, put, step, outputs):
    """Forces of a film that is pulled, pressed, and pulled until it breaks."""
    start({})
    rows, gap, length = [], 5e-6, 1e-5
    for i in range(60):
        speed = (0.05, -0.03, 4.0)[i // 20] * (1.0 + 0.1 * (i % 20))
        gap += speed * length
        put({"h": gap, "v": speed})
        step(i * length, length)
        rows.append(outputs(FORCES))
    return rows


def drive_rows(start, put, step, outputs):
    """Forces of a valve drive that is switched on, up to its stop."""
    start({})
    rows, length = [], 2e-5
    for i in range(60):
        put({"h": 5e-6 + 1e-6 * i, "v": 1e-6 / length})
        step(i * length, length)
        rows.append(outputs(PULLS))
    return rows


def tip_rows(start, put, step, outputs):
    """Forces of tips that are pulled off, fall back and rebound."""
    start({"z": -1e-8})
    rows, length = [], 2e-8
    for i in range(60):
        up = i < 30
        height = -1e-8 + 0.2 * length * i if up else 1.1e-7 - 0.2 * length * (i - 30)
        put({"z": height, "vz": 0.2 if up else -0.2, "az": 0.0})
        step(i * length, length)
        rows.append(outputs(TIPS))
    return rows


RUNS = {"mass-A": release_rows, "film": film_rows, "drive": drive_rows, "tip": tip_rows}
_HERE: dict[str, list] = {}


def rows_here(fmus, fmu):
    """What this computer finds, in fmpy."""
    if fmu not in _HERE:
        with Instance(fmus / f"{fmu}-2.fmu") as host:

            def outputs(names):
                values = dict(zip(host.names, host.outputs(), strict=True))
                return [values[name] for name in names]

            def put(given):
                host.set(host.references(*given), list(given.values()))

            def start(given):
                host.start({}, 1.0)
                put(given)

            _HERE[fmu] = RUNS[fmu](start, put, host.step, outputs)
    return _HERE[fmu]


def emulated(fmus, name, fmi, fmu="mass-A", folder="/x"):
    """A host of one library on an emulated processor."""
    description = fmpy.read_model_description(str(fmus / f"{fmu}-{fmi}"))
    film = (fmus / f"{fmu}-{fmi}" / "resources" / "film.bin").read_bytes()
    library = read_library(library_of(fmus, name, fmi, fmu).read_bytes(), name.partition("-")[2])
    references = {v.name: v.valueReference for v in description.modelVariables}
    guid = description.guid or description.instantiationToken
    return Host(library, fmi, guid, {f"{folder}/film.bin": film}), references


def location(fmi):
    return "file:///x" if fmi == 2 else "/x/"


def start_of(host, references):
    """Bring it to steps, with start values by name."""

    def start(given):
        host.start(location(host.fmi), **{f"_{references[key]}": x for key, x in given.items()})

    return start


@pytest.mark.parametrize("fmu", RUNS)
@pytest.mark.parametrize(("name", "fmi"), LIBRARIES)
def test_every_platform_finds_the_same(fmus, name, fmi, fmu):
    """All outputs in every step, of a release, a film that breaks, a drive, and tips."""
    host, references = emulated(fmus, name, fmi, fmu)

    def step(time, length):
        assert host.step(time, length) == 0, host.heard

    def put(given):
        host.set({references[key]: value for key, value in given.items()})

    def outputs(names):
        return host.get([references[key] for key in names])

    found = RUNS[fmu](start_of(host, references), put, step, outputs)
    host.free()
    assert len(host.machine.opened) == 1
    for row, here in zip(found, rows_here(fmus, fmu), strict=True):
        assert row == pytest.approx(here, rel=1e-12, abs=1e-300)
    if fmu == "mass-A":
        assert found[-1][-1] == pytest.approx(reference("A"), rel=2e-7)
        assert any("released at t = 0.00038989" in message for _, message in host.heard)
    elif fmu == "film":
        assert found[-1][0] == 0.0  # it broke on the way
        assert found[-21][0] != 0.0
    elif fmu == "tip":
        assert 0.0 < found[30][-5] < found[-1][-4]  # it broke, then landed
        assert found[-1][-3] > 0.0


FOLDERS = [
    ("file:///C:/a%20b/%C3%BC", "C:/a b/ü"),
    ("file:///C:/a b/", "C:/a b"),
    ("file:///c%3A/a%20b", "c:/a b"),  # .NET and some editors escape the colon
    ("file://C:/a b", "C:/a b"),
    ("file:/C:/a", "C:/a"),
    ("file:C:/a", "C:/a"),
    ("FILE://localhost/C:/a", "C:/a"),
    ("file:///C:\\a b\\", "C:\\a b"),
    ("C:\\a b\\resources\\", "C:\\a b\\resources"),
    ("C:/a%20b", "C:/a%20b"),  # no URI
    ("file://server/share/a", "//server/share/a"),
    ("file:////server/share/a", "//server/share/a"),
    ("file:///C:/ü".encode("cp1252"), "C:/ü"),  # no UTF-8: the code page of the computer
    ("C:\\\N{EURO SIGN}\\".encode("cp1252"), "C:\\\N{EURO SIGN}"),
]
ELSEWHERE = [
    ("file:///a%20b/%c3%bc%23/", "/a b/ü#"),
    ("FILE://localhost/a", "/a"),
    ("file:/a b", "/a b"),
    ("/a%20b//", "/a%20b"),
    ("file:///C%3A/a", "/C:/a"),
]


@pytest.mark.parametrize(("name", "fmi"), LIBRARIES)
def test_the_folder_is_found_whatever_a_host_calls_it(fmus, name, fmi):
    for given, folder in FOLDERS if name.startswith("windows") else ELSEWHERE:
        host, _ = emulated(fmus, name, fmi, folder=folder)
        assert host.instantiate(given), (given, host.machine.opened)
        assert host.machine.opened == [f"{folder}/film.bin"]
        host.free()


ERROR = 3


@pytest.mark.parametrize(("name", "fmi"), LIBRARIES)
def test_misuse_ends_in_an_error(fmus, name, fmi):
    """On no platform it ends the host, keeps memory, or goes on as if nothing was."""
    host, references = emulated(fmus, name, fmi)
    assert not host.instantiate("file:///nowhere")
    assert "cannot be opened" in host.heard[-1][1]
    host.guid, right = "{none}", host.guid
    assert not host.instantiate(location(fmi))
    host.guid = right
    assert not host.machine.sizes  # nothing was kept
    host.start(location(fmi), **{f"_{references['F_ext']}": 40.0})
    assert host.step(0.0, 1e-5) == 0
    assert host.step(-1e-5, 1e-5) != 0  # back in time
    assert "go forward" in host.heard[-1][1]
    host.free()
    assert host.step(0.0, 1e-5) == ERROR  # it is no more
    host.free()


@pytest.mark.parametrize(("name", "fmi"), LIBRARIES)
def test_a_state_is_saved_and_restored(fmus, name, fmi):
    host, references = emulated(fmus, name, fmi)
    host.start(location(fmi), **{f"_{references['F_ext']}": 40.0})
    wanted = [references[key] for key in STATES]
    found, cell = [], host.machine.place(bytes(8))
    for again in (False, True):
        for i in range(20 * again, 50):
            if i == 20 and not again:
                assert host.call(host.state_call("Get"), cell) == 0
            assert host.step(i * 1e-5, 1e-5) == 0, host.heard
        found.append(host.get(wanted))
        assert host.call(host.state_call("Set"), *host.machine.read(cell, "<Q")) == 0
    assert found[0] == found[1]
    assert host.call(host.state_call("Free"), cell) == 0
    host.free()
