"""Force curves of AFMs: position of the tip, numbers of the instrument, and HDF5 out and back."""

from __future__ import annotations

import numpy as np
import pytest
from refusals import refuses

import contactkit as ck

afmformats = pytest.importorskip("afmformats", reason="afmformats (extra afm) is not installed")

K = 0.05  # [N/m]
GAP = np.linspace(0.0, 5e-7, 40)
PULL = 2e-9 * np.exp(-GAP / 1e-7) - 5e-9 * np.maximum(0.0, 1e-7 - GAP) / 1e-7
UNITS = ("m", "N")


def curve(x=GAP, y=PULL, **more):
    return ck.MeasuredCurve(
        **{"over": "gap", "at": x, "quantity": "pull", "values": y, "units": UNITS} | more
    )


def test_a_curve_over_the_gap_comes_back_over_gap_and_base(tmp_path):
    file = ck.write_force_curve(tmp_path / "a.h5", curve(), spring_constant="0.05 N/m")
    tip = ck.read_force_curve(file, position="tip")
    np.testing.assert_allclose(tip.x, GAP, rtol=0.0, atol=1e-22)
    np.testing.assert_array_equal(tip.y, PULL)
    assert tip.stiffness == np.inf
    base = ck.read_force_curve(file)
    np.testing.assert_allclose(base.x, GAP + PULL / K, rtol=1e-14, atol=1e-22)
    assert base.stiffness == K
    assert np.ptp(base.x - tip.x) > 1e-8  # the spring bends
    again = ck.write_force_curve(tmp_path / "b.h5", base)
    np.testing.assert_array_equal(ck.read_force_curve(again).x, base.x)


def test_both_segments_are_kept_apart(tmp_path):
    pressed = curve(GAP[::-1], 0.5 * PULL[::-1], units=("nm", "nN"))
    file = ck.write_force_curve(tmp_path / "a.h5", curve(), pressed, spring_constant=K)
    found = ck.read_force_curve(file, segment="approach", position="tip")
    np.testing.assert_allclose(found.x, 1e-9 * GAP[::-1], rtol=0.0, atol=1e-16)
    np.testing.assert_allclose(found.y, 0.5e-9 * PULL[::-1], rtol=1e-12)
    np.testing.assert_array_equal(ck.read_force_curve(file).y, PULL)
    load = ck.read_force_curve(file, position="tip", is_load=True, quantity="load")
    np.testing.assert_array_equal(load.y, -PULL)
    refuses(
        lambda: ck.read_force_curve(ck.write_force_curve(tmp_path / "b.h5", curve(),
                                    spring_constant=K), segment="approach"),
        "segment", "have readings in b.h5",
    )  # fmt: skip


def test_a_result_becomes_a_force_curve(tmp_path):
    ball = ck.Interface(
        lower=ck.Sphere(radius=1e-5),
        upper=ck.Flat(),
        meniscus=ck.Meniscus(liquid=ck.load_liquid("water"), volume=1e-18),
    )
    scene = ck.SeparationScene(
        interface=ball,
        loading=ck.ImposedSpeed(speed=1e-6, initial_gap=1e-8, final_gap=1e-6),
        effects=(ck.MeniscusForce(),),
    )
    result = ck.simulate(ck.plan(scene))
    given = ck.read_measured_curve(result, "gap", "meniscus_force")
    file = ck.write_force_curve(tmp_path / "a.h5", given, spring_constant=1.0)
    found = ck.read_force_curve(file, position="tip", quantity="meniscus_force")
    np.testing.assert_allclose(found.x, result["gap"], rtol=1e-9)
    np.testing.assert_array_equal(found.y, result["meniscus_force"])
    raw = afmformats.load_data(file)[0]
    assert raw.metadata["spring constant"] == 1.0
    assert raw["force"].min() == -result["meniscus_force"].max()  # attraction is negative there


def test_numbers_that_a_file_lacks_are_asked_for_and_given(tmp_path, monkeypatch):
    file = ck.write_force_curve(tmp_path / "a.h5", curve(), spring_constant=K)
    asked = []

    def load(path, modality, meta_override):
        asked.append(meta_override)
        if "spring constant" not in meta_override:
            raise afmformats.errors.MissingMetaDataError(["spring constant"], "missing")
        return real(path, modality=modality)

    real = afmformats.load_data
    monkeypatch.setattr(afmformats, "load_data", load)
    refuses(
        lambda: ck.read_force_curve(file), "state its spring constant",
        "instrument={'spring constant': ...}",
    )  # fmt: skip
    given = {"spring constant": "50 mN/m", "sensitivity": "60 nm/V"}
    ck.read_force_curve(file, instrument=given)
    assert asked[-1] == pytest.approx({"spring constant": 0.05, "sensitivity": 6e-8})


@pytest.mark.errors
@pytest.mark.parametrize(
    ("given", "parts"),
    [
        ({"position": "sample"}, ("be 'base' or 'tip'",)),
        ({"instrument": {"spring": 1.0}}, ("be a number of the instrument", "spring constant")),
        ({"instrument": {"sensitivity": 0.0}}, ("be positive and finite",)),
        ({"instrument": {"spring constant": "1 N"}}, ("spring constant", "N/m")),
    ],
)
def test_what_no_instrument_has_is_refused(tmp_path, given, parts):
    file = ck.write_force_curve(tmp_path / "a.h5", curve(), spring_constant=K)
    refuses(lambda: ck.read_force_curve(file, **given), *parts)


@pytest.mark.errors
def test_curves_that_are_none_of_a_cantilever_are_not_written(tmp_path):
    path = tmp_path / "a.h5"
    refuses(lambda: ck.write_force_curve(path, curve()), "spring_constant", "be one number")
    refuses(
        lambda: ck.write_force_curve(path, curve(stiffness=0.1), spring_constant=K),
        "be one number", "[0.05, 0.1]",
    )  # fmt: skip
    refuses(
        lambda: ck.write_force_curve(path, curve(units=("s", "N")), spring_constant=K),
        "be a length and a force",
    )
    refuses(
        lambda: ck.write_force_curve(tmp_path / "a.tab", curve(), spring_constant=K), "end in .h5"
    )
    sought = curve(stiffness=ck.Range(0.01, 1.0))
    refuses(lambda: ck.write_force_curve(path, sought), "stiffness", "be a number")
    assert not list(tmp_path.iterdir())


def test_a_deflection_in_amperes_needs_its_own_unit(tmp_path, caplog):
    """Text of NT-MDT: height [nm] and deflections [nA], with decimal commas."""
    heights, currents = (-24.0, -16.0, -8.0, 0.0), (1.0, 1.5, 2.0, 3.0)
    file = tmp_path / "fd.txt"
    rows = [f"{z}\t{i}\t{2 * i}" for z, i in zip(heights, currents, strict=True)]
    file.write_text("\n".join(rows).replace(".", ",") + "\n")
    k = {"spring constant": "0.05 N/m"}
    found = ck.read_force_curve(file, instrument=k | {"sensitivity": "20 nm/nA"})
    assert found.y == pytest.approx([-0.05 * 20e-9 * 2 * i for i in currents])
    refuses(
        lambda: ck.read_force_curve(file, instrument=k | {"sensitivity": "20 nm/V"}),
        "sensitivity", "converts to m/A",
    )  # fmt: skip
    refuses(lambda: ck.read_force_curve(file), "state its sensitivity, spring constant")
    assert not caplog.records


@pytest.mark.errors
def test_what_cannot_be_read_is_named_without_a_traceback(tmp_path, caplog):
    file = ck.write_force_curve(tmp_path / "a.h5", curve(), spring_constant=K)
    refuses(lambda: ck.read_force_curve(tmp_path / "b.jpk-force"), "force curve", "exists")
    refuses(
        lambda: ck.read_force_curve(file, instrument={"spring constant": 0.1}),
        "instrument", "be left out", "stiffness=",
    )  # fmt: skip
    (tmp_path / "c.csv").write_text("gap [um],force [mN]\n1,2\n")
    refuses(lambda: ck.read_force_curve(tmp_path / "c.csv"), "that afmformats reads")
    assert not caplog.records
    with pytest.raises(TypeError, match="'sements'; did you mean"):
        ck.read_force_curve(file, sements="approach")
