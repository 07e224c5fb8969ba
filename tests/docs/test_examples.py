"""Every example runs, draws its figure, and gives its number."""

import importlib.util
from pathlib import Path

import pytest

EXAMPLES = Path(__file__).parents[2] / "examples"

# Thin-film impulses of a film opened tenfold, 2 gamma V (1/h0 - 1/h1)/v and 3 eta V^2/(8 pi h0^4).
EQUAL_VISCOSITY = 4.8 * 0.03 * (10e-6 / 1e-3) ** 2 / 1e-3  # [Pa.s]

NUMBERS = {
    # Persson's theory is exact at full contact.
    "area_and_theories": pytest.approx(1.0, abs=5e-3),
    # Hertz, nu = 0.3: 0.6200 at 0.4809 contact radii; the planes come within 0.01 of that depth.
    "coated_sphere": pytest.approx(0.6200, rel=2e-3),
    # Contact in proportion to the load, less on few summits: between Hertz's 2/3 and 1.
    "head_disk_load_curve": pytest.approx(0.83, abs=0.12),
    # Reference bridge of pressure -100 gamma/R at touch, 0/0 degrees.
    "humid_tip": pytest.approx(0.96032, abs=1e-5),
    # Sphere at a hardness of 0.6 of Hertz's maximum: work of a dense solution, P a2/R.
    "loading_history": pytest.approx(0.1078, rel=4e-3),
    # A layer of no thickness and one without end are no layers.
    "press_a_map": pytest.approx(0.0, abs=1e-4),
    # A sheet a hundred nips thick is a half-space.
    "roller_on_sheet": pytest.approx(1.0, abs=1e-3),
    # The closed form leaves out the mass: 4 % at 80 degC, where the spool is released in 2.4 ms.
    "spool_sticks": pytest.approx(0.0, abs=0.05),
    # Maugis and Dugdale, on 64 pixels and with few levels.
    "sphere_pull_off": pytest.approx(1.0, abs=0.02),
    # The source prints four digits.
    "sphere_on_flat": pytest.approx(0.0, abs=1e-4),
    # The picture of the first page is inside every range of validity.
    "rough_coating": 0.0,
    # Mindlin and Deresiewicz, on 96 pixels.
    "rubbed_sphere": pytest.approx(1.0, abs=2e-3),
    # 600 straight lines for the exponential rise of the pull.
    "step_the_fmu": pytest.approx(0.0, abs=1e-5),
    # Ting's load of a press and release, of 32 steps each.
    "viscoelastic_sphere": pytest.approx(0.0149, rel=0.1),
    # What a vented ring of x = 1/3.175 lacks: x^4 + (1 - x^2)^2/ln(1/x).
    "vented_end_face": pytest.approx(0.7121993, abs=1e-7),
    # The line tension at the rim adds a per cent to the thin film.
    "which_force_holds": pytest.approx(EQUAL_VISCOSITY, rel=0.03),
}


# five seconds to half a minute
LONG = ("area_and_theories", "coated_sphere", "roller_on_sheet", "sphere_pull_off")
LONG += ("step_the_fmu", "viscoelastic_sphere")


def load(name):
    spec = importlib.util.spec_from_file_location(f"example_{name}", EXAMPLES / f"{name}.py")
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


def test_each_example_has_its_number():
    assert {path.stem for path in EXAMPLES.glob("*.py")} == set(NUMBERS)


@pytest.mark.filterwarnings("ignore::contactkit.ValidityWarning")  # the examples say which
@pytest.mark.parametrize(
    "name",
    [
        pytest.param(name, marks=pytest.mark.exhaustive if name in LONG else pytest.mark.slow)
        for name in NUMBERS
    ],
)
def test_example(name, tmp_path):
    if "fmu" in name:
        pytest.importorskip("pythonfmu")
        pytest.importorskip("fmpy")
    found = load(name).main(tmp_path)
    assert found == NUMBERS[name]
    assert (tmp_path / f"{name}.png").stat().st_size > 10_000
