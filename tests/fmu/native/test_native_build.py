"""Native FMU files: what is in them, hosts without Python, misuse, sanitizers."""

from __future__ import annotations

import hashlib
import re
import shutil
import subprocess
import sys
import zipfile

import attrs
import pytest
from native_scenes import (
    HAS_CC,
    HERE,
    SANITIZED,
    SCENES,
    compile_c,
    sanitized_kernel,
    scene,
    write_sources,
)

pytest.importorskip("pythonfmu")
fmpy = pytest.importorskip("fmpy")
if not HAS_CC:
    pytest.skip("there is no C compiler", allow_module_level=True)

import contactkit as ck  # noqa: E402
from contactkit.errors import ContactkitError, DescriptionError, PlanError  # noqa: E402
from contactkit.fmu.framework.instance import Instance  # noqa: E402
from contactkit.fmu.framework.toolchain import PLATFORMS, compile_kernel, join_macs, local  # noqa: E402
from contactkit.fmu.native.build import build_native, native_scene  # noqa: E402
from contactkit.fmu.python.build import validate  # noqa: E402
from contactkit.fmu.slaves.rheology import RHEOLOGY  # noqa: E402
from contactkit.fmu.slaves.stiction_mass import StictionMass  # noqa: E402

ONE = {"platforms": [local()], "compiler": "cc"}
linux_only = pytest.mark.skipif(not sys.platform.startswith("linux"), reason="dlopen and ASan")


@pytest.fixture(scope="module")
def fmu(shelf):
    return shelf(build_native, SCENES["drop"], **ONE)


@pytest.fixture(scope="module")
def unpacked(fmu, tmp_path_factory):
    folder = tmp_path_factory.mktemp("unpacked")
    with zipfile.ZipFile(fmu) as packed:
        packed.extractall(folder)
    return folder


@pytest.fixture(scope="module")
def unpacked_film(shelf, tmp_path_factory):
    """The film alone, of the same scene."""
    folder = tmp_path_factory.mktemp("film")
    path = shelf(build_native, SCENES["drop"], model="stiction-force", **ONE)
    with zipfile.ZipFile(path) as packed:
        packed.extractall(folder)
    return folder


@pytest.fixture(scope="module")
def host(unpacked, tmp_path_factory):
    """A host in C, called with the words that follow library, folder and GUID."""
    out = tmp_path_factory.mktemp("host") / "host"
    compile_c([HERE / "native_host.c"], out, f"-I{unpacked / 'sources'}")

    def run(*words, library=None, program=out, folder=unpacked):
        library = library or next((folder / "binaries" / PLATFORMS[local()].fmi2).iterdir())
        text = (folder / "modelDescription.xml").read_text()
        guid = re.search('guid="([^"]*)"', text)[1]
        found = subprocess.run(
            [str(program), str(library), (folder / "resources").as_uri(), guid, *words],
            capture_output=True,
            text=True,
            check=False,
            timeout=100,
        )
        assert found.returncode == 0, found.stderr
        return [float(word) for word in found.stdout.split()]

    return run


@pytest.mark.slow
def test_fmpy_finds_no_problems(fmu):
    assert validate(fmu) == []


def test_it_holds_what_it_is_made_of(unpacked):
    assert (unpacked / "sources" / "motion.c").exists()
    assert (unpacked / "sources" / "fmi2Functions.h").exists()
    assert (unpacked / "documentation" / "licenses" / "license.txt").exists()
    page = (unpacked / "documentation" / "index.html").read_text()
    assert "needs nothing else" in page
    assert "Python interpreter" not in page


def digest(path):
    """Of a file: pytest takes minutes to show how megabytes differ."""
    return hashlib.sha256(path.read_bytes()).hexdigest()


@pytest.mark.exhaustive  # by another compiler: `test_a_rebuild_elsewhere_is_the_same`
def test_rebuild_is_byte_identical(fmu, unpacked, tmp_path):
    again = build_native(SCENES["drop"], tmp_path / "again.fmu", **ONE)
    assert digest(again) == digest(fmu)
    compile_kernel(write_sources(tmp_path / "another folder"), local(), tmp_path / "library", "cc")
    library = next(unpacked.glob("binaries/*/*"))
    assert digest(tmp_path / "library") == digest(library)


def release_of(folder):
    """Release under 40 N, of an FMU in a folder."""
    description = fmpy.read_model_description(str(folder))
    found = fmpy.simulate_fmu(
        str(folder),
        model_description=description,
        start_values={"F_ext": 40.0},
        stop_time=0.02,
        output_interval=1e-3,
        output=["t_release", "J"],
    )
    return found["t_release"][-1], found["J"][-1]


@pytest.mark.slow
def test_the_sources_inside_are_all_it_takes(fmu, tmp_path):
    """Those the description names, compiled with nothing but what lies beside them."""
    folder = tmp_path / "x"
    fmpy.extract(str(fmu), str(folder))
    before, library = release_of(folder), next(folder.glob("binaries/*/*"))
    library.unlink()
    text = (folder / "modelDescription.xml").read_text()
    files = [folder / "sources" / name for name in re.findall('File name="([^"]*)"', text)]
    assert len(files) == len([*(folder / "sources").glob("*.c")])
    compile_c(files, library, "-fPIC", "-shared")
    assert release_of(folder) == pytest.approx(before, rel=1e-10)


@pytest.mark.exhaustive
@pytest.mark.skipif(shutil.which("cmake") is None, reason="fmpy compiles with cmake")
def test_fmpy_compiles_it(fmu, tmp_path):
    build = pytest.importorskip("fmpy.build")
    folder = tmp_path / "x"
    fmpy.extract(str(fmu), str(folder))
    library = next(folder.glob("binaries/*/*"))
    library.unlink()
    (tmp_path / "made").mkdir()
    build.build_platform_binary(folder, tmp_path / "made", generator="Unix Makefiles")
    assert library.exists()
    assert release_of(folder)[0] > 0.0


def test_variables_are_those_of_the_python_fmu(fmu):
    """Same names, units and causality; what the tables have fixed is gone."""
    ports = {port.name: port for port in StictionMass.ports}
    found = fmpy.read_model_description(str(fmu)).modelVariables
    of_tables = {"R", "V", "N", "theta1", "theta2", "meniscus_law", "rewet"}
    of_wetting = {"slip", "slip_from", "film_law", "a_break", "n_Ca", "trouton", "weight", "rho"}
    left = {*of_tables, *of_wetting, *RHEOLOGY, "V_left"}
    assert set(ports) - {v.name for v in found} == left
    for variable in found:
        port = ports[variable.name]
        assert (variable.unit or "-", variable.causality) == (port.unit, port.causality)


def test_viscosity_and_surface_tension_are_free(fmu, tmp_path):
    """The FMU of one liquid, set to another, is that of the other."""
    liquid = ck.Liquid(name="other", viscosity=0.02, surface_tension=0.05)
    other = SCENES["drop"]
    meniscus = attrs.evolve(other.interface.meniscus, liquid=liquid)
    other = attrs.evolve(other, interface=attrs.evolve(other.interface, meniscus=meniscus))
    built = build_native(other, tmp_path / "other.fmu", **ONE)
    found = []
    for path, given in ((fmu, {"eta": 0.02, "gamma": 0.05}), (built, {})):
        with Instance(path) as host:
            host.start(given, 1.0)
            host.set(host.references("F_ext"), [40.0])
            host.step(0.0, 0.01)
            found.append(dict(zip(host.names, host.outputs(), strict=True)))
    assert found[0] == pytest.approx(found[1], rel=1e-9)
    assert found[0]["t_release"] > 0.0


@pytest.mark.parametrize(
    ("start", "said"),
    [
        ({"eta": -1.0}, r"^{} refused eta = -1\.0: eta must "),
        ({"h_break": 1e-9}, "cannot start with these values: .*h_break must be 0 or exceed h0 ="),
    ],
)
def test_a_start_value_that_is_refused_says_why(fmu, start, said):
    said = said.format(fmu.stem)
    with Instance(fmu) as host, pytest.raises(ContactkitError, match=said):
        host.start(start, 1.0)


def test_a_rate_of_the_pull_is_that_of_the_python_fmu(fmu):
    """By the variable dF_ext, and by the call of FMI for derivatives of inputs."""
    found = []
    for by_call in (False, True):
        with Instance(fmu) as host:
            host.start({}, 1.0)
            if by_call:
                host._slave.setRealInputDerivatives(host.references("F_ext"), [1], [4e4])
            else:
                host.set(host.references("dF_ext"), [4e4])
            host.step(0.0, 1e-3)
            found.append(host.outputs())
    assert found[0] == found[1]


@linux_only
def test_a_host_in_c_gets_the_same_release(host, fmu):
    release, peak, impulse = host("run", "40", "1e-4", "0.02")
    with Instance(fmu) as here:
        here.start({}, 1.0)
        here.set(here.references("F_ext"), [40.0])
        here.step(0.0, 0.02)
        found = dict(zip(here.names, here.outputs(), strict=True))
    assert release == pytest.approx(found["t_release"], rel=1e-8)
    assert impulse == pytest.approx(found["J"], rel=1e-8)
    assert peak == pytest.approx(40.0, rel=1e-4)


@linux_only
def test_no_misuse_ends_the_host(host, unpacked_film):
    host("misuse")
    host("misuse", folder=unpacked_film)


@pytest.mark.slow
@linux_only
def test_sanitizers_find_nothing(host, unpacked_film, shelf, tmp_path):
    sources = write_sources(tmp_path / "sources")
    library = sanitized_kernel(shelf, sources, 2)
    program = compile_c([HERE / "native_host.c"], tmp_path / "host", f"-I{sources}", *SANITIZED)
    host("misuse", library=library, program=program)
    host("misuse", library=library, program=program, folder=unpacked_film)
    host("run", "40", "1e-4", "0.02", library=library, program=program)


def test_a_damaged_file_is_refused(unpacked, tmp_path):
    """Whatever is wrong with the tables, there is no instance of them."""
    from fmpy import fmi2

    content = (unpacked / "resources" / "film.bin").read_bytes()
    description = fmpy.read_model_description(str(unpacked))
    damaged = [b"", content[:100], content[:-8], content + b"x" * 8, b"x" + content[1:]]
    damaged += [bytearray(content)]
    damaged[-1][5000] ^= 1
    for i, one in enumerate(damaged):
        folder = tmp_path / str(i)
        (folder / "resources").mkdir(parents=True)
        (folder / "binaries").symlink_to(unpacked / "binaries")
        (folder / "resources" / "film.bin").write_bytes(one)
        slave = fmi2.FMU2Slave(
            instanceName="x",
            guid=description.guid,
            unzipDirectory=str(folder),
            modelIdentifier=description.coSimulation.modelIdentifier,
        )
        if one == content + b"x" * 8:
            slave.instantiate()  # what follows the tables is not read
            slave.freeInstance()
            continue
        with pytest.raises(Exception, match="instantiate"):
            slave.instantiate()


def test_what_cannot_be_built_is_refused(tmp_path):
    out = tmp_path / "x.fmu"
    with pytest.raises(DescriptionError, match=r"end in \.fmu"):
        build_native(SCENES["drop"], tmp_path / "x.zip", **ONE)
    with pytest.raises(DescriptionError, match="platform"):
        build_native(SCENES["drop"], out, platforms=["amiga"])
    with pytest.raises(DescriptionError, match="h_rel"):
        build_native(SCENES["drop"], out, start={"h_rel": "1 um"}, **ONE)
    with pytest.raises(DescriptionError, match="is an output"):
        build_native(SCENES["drop"], out, start={"F": 1.0}, **ONE)
    massless = scene(mass=None)
    with pytest.raises(DescriptionError, match=r"m must be given.*loading\.mass"):
        build_native(massless, out, **ONE)
    assert not out.exists()
    with pytest.raises(PlanError, match="valve-drive has no native form"):
        native_scene("valve-drive")


def test_a_mass_can_be_given(tmp_path):
    path = build_native(scene(mass=None), tmp_path / "x.fmu", start={"m": "20 g"}, **ONE)
    read = {v.name: v.start for v in fmpy.read_model_description(str(path)).modelVariables}
    assert float(read["m"]) == 0.02


def test_macs_share_one_file():
    one = bytes.fromhex("cffaedfe0700000103000000") + b"a" * 20
    other = bytes.fromhex("cffaedfe0c00000100000000") + b"b" * 30
    both = join_macs([one, other])
    assert both[:8] == bytes.fromhex("cafebabe00000002")
    assert both[16384 : 16384 + len(one)] == one
    assert both[32768 : 32768 + len(other)] == other
    with pytest.raises(ContactkitError, match="Mac"):
        join_macs([b"\x7fELF" + b"\0" * 20])


def test_without_zig_only_this_platform_is_compiled(tmp_path):
    other = "linux-aarch64" if local() != "linux-aarch64" else "linux-x86_64"
    with pytest.raises(ContactkitError, match="ziglang"):
        compile_kernel(write_sources(tmp_path / "sources"), other, tmp_path / "library", "cc")


@pytest.mark.slow
def test_the_command_line_builds_one(tmp_path, monkeypatch, capsys):
    from contactkit import cli
    from contactkit.fmu.native import build as native_build

    monkeypatch.setattr(native_build, "has_zig", lambda: False)
    out = tmp_path / "injector.fmu"
    assert cli.main(["fmu", "build", "fuel-injector", "--native", "--out", str(out)]) == 0
    assert "stiction-mass, native" in capsys.readouterr().out
    assert "valid" in str(validate(out) or "valid")
    with pytest.raises(SystemExit):
        cli.main(["fmu", "build", "fuel-injector", "--fmi", "4", "--out", str(out)])
