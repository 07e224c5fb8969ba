"""Data into fits and fits into files: tables of others, AFM formats, round trips."""

from __future__ import annotations

import json
import pickle

import numpy as np
import pytest
from refusals import refuses
from spheres import GAP, SOUGHT, closed, curve, measured, readings, sphere

import contactkit as ck
from contactkit.cli import main

ARRAYS = {"gap": GAP, "force": readings()}


def same(found):
    assert found.y == pytest.approx(ARRAYS["force"], rel=1e-12)
    assert found.x == pytest.approx(GAP, rel=1e-12)


@pytest.mark.parametrize("separator", [",", ";", "\t"])
def test_csv_files_with_units_in_their_head(tmp_path, separator):
    rows = [f"{g * 1e6}{separator}{f * 1e6}" for g, f in zip(GAP, readings(), strict=True)]
    head = ["# exported 2026", f"gap [um]{separator}load (uN)"]
    path = tmp_path / "pull 1.csv"
    path.write_text("\n".join([*head, *rows]) + "\n", encoding="utf-8-sig")
    found = ck.read_measured_curve(path, "gap", "force", columns={"force": "load"}, noise="1 %")
    same(found)
    assert (found.units, found.name, found.noise) == (("um", "uN"), "pull 1", "1 %")


@pytest.mark.parametrize(
    "content",
    [
        "gap [µm];force [mN];sd [uN]\r\n1,5;30,25;300\r\n2,5;20,5;400\r\n".encode("cp1252"),
        "gap (µm)\tforce (mN)\tsd (uN)\n1.5\t30.25\t300\n2.5\t20.5\t400\n".encode("utf-16"),
        b"gap / um,force / mN,sd / uN\r1.5,30.25,300\r2.5,20.5,400\r",
        b"# rig 7\n# gap [um] force [mN] sd [uN]\n1.5 30.25 300\n2.5 20.5 400\n",
    ],
)  # fmt: skip
def test_files_as_spreadsheets_instruments_and_numpy_write_them(tmp_path, content):
    path = tmp_path / "földer.csv"
    path.write_bytes(content)
    found = ck.read_measured_curve(path, "gap", "force", columns={"noise": "sd"})
    assert found.x == pytest.approx([1.5e-6, 2.5e-6], rel=1e-14)
    assert found.y == pytest.approx([0.03025, 0.0205], rel=1e-14)
    assert found.deviation("N") == pytest.approx([3e-4, 4e-4], rel=1e-14)


@pytest.mark.parametrize("unit", ["degC", "°C"])
def test_temperatures_are_in_degrees_celsius_if_the_head_states_it(tmp_path, unit):
    path = tmp_path / "a.csv"
    path.write_text(f"temperature [{unit}],release_time [ms]\n20,3\n80,1\n")
    found = ck.read_measured_curve(path, "temperature", "release_time", shift="0.5 K")
    assert found.x.tolist() == [293.15, 353.15]
    assert found.nuisance("shift", ("K", "s")) == 0.5
    wrong = ck.read_measured_curve(path, "temperature", "release_time", shift="0.5 degC")
    refuses(lambda: wrong.nuisance("shift", ("K", "s")), "shift", "a difference", "'0.5 K'")


@pytest.mark.slow
def test_arrays_frames_datasets_and_results():
    pd, xr = pytest.importorskip("pandas"), pytest.importorskip("xarray")
    units = {"gap": "um", "force": "uN"}
    scaled = {name: values * 1e6 for name, values in ARRAYS.items()}
    frame = pd.DataFrame(scaled)
    same(ck.read_measured_curve(scaled, "gap", "force", units=units))
    same(ck.read_measured_curve(frame, "gap", "force", units=units))
    frame.attrs["units"] = units
    same(ck.read_measured_curve(frame, "gap", "force"))
    named = pd.DataFrame({"gap [um]": scaled["gap"], "force [uN]": scaled["force"]})
    same(ck.read_measured_curve(named, "gap", "force"))
    data = xr.Dataset({"force": ("gap", scaled["force"], {"units": "uN"})},
                      coords={"gap": ("gap", scaled["gap"], {"units": "um"})})  # fmt: skip
    same(ck.read_measured_curve(data, "gap", "force"))
    made = curve(gap=(GAP, "m"), force=(ARRAYS["force"], "N"))
    same(ck.read_measured_curve(made, "gap", "force"))
    run = ck.simulate(ck.plan(sphere()))
    found = ck.read_measured_curve(run, "gap", "viscous_force")
    assert (found.y == run["viscous_force"]).all()


def test_a_column_of_noise_is_that_of_each_reading():
    noise = 0.01 * ARRAYS["force"]
    found = ck.read_measured_curve(
        ARRAYS | {"sd": noise}, "gap", "force", columns={"noise": "sd"},
        units={"gap": "m", "force": "N"},
    )  # fmt: skip
    assert found.deviation("N") == pytest.approx(noise)


@pytest.mark.errors
def test_tables_that_cannot_be_read_are_refused(tmp_path):
    path = tmp_path / "a.csv"

    def read(text, **more):
        path.write_text(text)
        return lambda: ck.read_measured_curve(path, "gap", "force", **more)

    refuses(read("gap [um],force\n1,2\n"), "units of 'force'", "be stated", "force [um]")
    refuses(read("gap [um],load [N]\n1,2\n"), "column", "be a column of a", "columns={'force'")
    refuses(read('gap [um],force [N]\n"1,5",2\n'), "gap, row 2", "a decimal comma?")
    refuses(read("gap [um];force [N]\n1,5;2.5\n"), "gap, row 2", "a decimal comma?")
    refuses(read("gap [um],gap [nm],force [N]\n1,2,3\n"), "column", "be there once in a", "rename")
    refuses(read("gap,force\num,N\n1,2\n", units={"gap": "m", "force": "N"}), "as 'gap [um]'")
    refuses(read("1,2\n3,4\n"), "have a head", "'gap [um],force [mN]'")
    refuses(
        lambda: ck.read_measured_curve(tmp_path / "b.csv", "gap", "force"), "a file that exists"
    )
    noise = {"columns": {"noise": "sd"}}
    refuses(read("gap [m],force [N],sd [m]\n1,2,3\n", **noise), "units['noise']", "convert to N")
    refuses(read("gap [um],force [N]\n1,2\n3\n"), "have 2 cells", "row 3 has 1")
    refuses(read("gap [um],force [N]\n"), "have a head and at least one row")
    refuses(read("gap [um],force [N]\n1,nan\n"), "values must be finite numbers")
    refuses(read("gap [um],force [N]\n1,2\n", units={"gab": "m"}), "units", "be of gap, force")


def test_force_curves_of_microscopes(tmp_path):
    afmformats = pytest.importorskip("afmformats", reason="afmformats (extra afm) is not installed")
    from afmformats.mod_force_distance import AFMForceDistance

    far = np.linspace(2e-6, 0.0, 50)
    height = np.concatenate([far, far[::-1]])
    force = np.where(height < 1e-7, (1e-7 - height) * 0.05, -1e-10)
    retracts = np.arange(100) >= 50
    data = {"height (measured)": height, "force": force, "segment": retracts,
            "time": 0.01 * np.arange(100)}  # fmt: skip
    meta = {"spring constant": 0.05, "imaging mode": "force-distance", "enum": 0,
            "path": tmp_path / "x"}  # fmt: skip
    path = tmp_path / "tip.tab"
    AFMForceDistance(data, meta).export_data(path, fmt="tab", metadata=["spring constant",
                                             "imaging mode", "enum"])  # fmt: skip
    found = ck.read_force_curve(path, shift=ck.Range("-200 nm", "200 nm"))
    assert found.stiffness == 0.05
    assert found.name == "tip, retract"
    assert found.x == pytest.approx(height[retracts])
    assert found.y == pytest.approx(-force[retracts])
    pressed = ck.read_force_curve(path, segment="approach", is_load=True, quantity="load")
    assert pressed.y == pytest.approx(force[~retracts])
    assert pressed.x == pytest.approx(-height[~retracts])
    refuses(lambda: ck.read_force_curve(path, segment="both"), "be 'approach' or 'retract'")
    refuses(lambda: ck.read_force_curve(path, index=3), "be below 1")
    other = tmp_path / "no.tab"
    other.write_text("nothing")
    refuses(lambda: ck.read_force_curve(other), "a force curve that afmformats reads")
    assert afmformats is not None


def test_a_fit_is_saved_whole(tmp_path):
    data = [measured(shift=(-1e-6, 1e-6), name="a"), measured(values=readings(seed=2), name="b")]
    found = ck.fit(sphere(), data, SOUGHT, solve=closed)
    again = ck.read_fit(found.save(tmp_path / "fit"))
    assert str(again) == str(found)
    assert again.scene == found.scene
    assert again.parameters == found.parameters
    assert again.scalars() == found.scalars()
    assert again.cite() == found.cite()
    for one, other in zip(again.curves, found.curves, strict=True):
        assert (one.residuals == other.residuals).all()
        assert (one.fractions == other.fractions).all()
    refuses(lambda: again.profile("viscosity"), "call ck.fit again", error=ck.NotSimulatedError)
    copied = pickle.loads(pickle.dumps(found))
    assert copied.searched is None
    assert str(copied) == str(found)
    refuses(lambda: ck.load_result(tmp_path / "fit.npz"), "be a result of contactkit")
    refuses(lambda: ck.read_fit(made_curve(tmp_path)), "be a fit of contactkit", "'curve'")
    damaged = tmp_path / "cut.npz"
    damaged.write_bytes((tmp_path / "fit.npz").read_bytes()[:300])
    refuses(lambda: ck.read_fit(damaged), "be a fit of contactkit")


@pytest.mark.slow
def test_a_fit_that_was_read_draws_and_becomes_a_dataset(tmp_path):
    found = ck.fit(sphere(), measured(), SOUGHT, solve=closed)
    again = ck.read_fit(found.save(tmp_path / "fit"))
    assert again.to_xarray().equals(found.to_xarray())
    assert again.plot.available == ("data", "residuals", "information", "correlation")
    (line,) = [one for one in again.plot.data().lines if one.get_label() == "fitted"]
    assert line.get_ydata() * 1e-6 == pytest.approx(found.curves[0].model)
    (line,) = again.plot.information().lines
    assert line.get_ydata().sum() == pytest.approx(100.0)
    assert again.plot.residuals().get_ylabel() == "residual / noise"
    assert again.plot.correlation().texts[0].get_text() == "+1.00"


def made_curve(folder):
    return curve(gap=(GAP, "m")).save(folder / "curve")


def test_the_fitted_scene_is_a_scene_file(tmp_path):
    found = ck.fit(sphere(), measured(), SOUGHT, solve=closed)
    path = tmp_path / "fitted.toml"
    path.write_text(found.to_toml())
    assert ck.load_scene(path) == found.scene
    assert "# interface.meniscus.liquid.viscosity = 200 mPa.s (199.7 to" in path.read_text()


def test_tables_of_a_fit():
    found = ck.fit(sphere(), measured(), SOUGHT, solve=closed)
    frame = found.to_dataframe()
    assert frame["value"].tolist() == [found["viscosity"].value]
    data = found.to_xarray()
    assert data["residual"].sizes == {"gap": 40}
    assert data["measured"].attrs["units"] == "N"
    assert found.unit("viscosity_low") == "Pa.s"
    assert "<pre>" in found._repr_html_()
    assert dir(found.plot)


@pytest.mark.slow
def test_the_command_line_fits_a_scene_file(tmp_path, capsys):
    ck.save_scene(sphere(), tmp_path / "film.toml")
    rows = "".join(f"{1e6 * g},{1e6 * f}\n" for g, f in zip(GAP, readings(), strict=True))
    (tmp_path / "pull.csv").write_text(f"gap [um],force [uN]\n{rows}")
    given = ["fit", str(tmp_path / "film.toml"), "--data", str(tmp_path / "pull.csv"),
             "--over", "gap", "--quantity", "viscous_force=force", "--noise", "1 %",
             "--parameter", "interface.meniscus.liquid.viscosity=10 mPa.s..10 Pa.s"]  # fmt: skip
    assert main([*given, "--json"]) == 0
    numbers = json.loads(capsys.readouterr().out)
    assert numbers["status"]["value"] == "decided"
    assert numbers["viscosity"]["value"] == pytest.approx(0.2, rel=0.01)
    out = tmp_path / "out"
    assert main([*given, "--out", str(out)]) == 0
    assert "decided by gap" in capsys.readouterr().out
    assert {one.name for one in out.iterdir()} >= {"fit.npz", "fitted.toml", "fit-data.png"}
    assert ck.load_scene(out / "fitted.toml").interface.meniscus.liquid.viscosity > 0.1
    assert main([*given[:-1], "loading.speed:1..2"]) == 2
    assert "be a path and a range" in capsys.readouterr().err


@pytest.mark.parametrize(
    ("given", "used"),
    [
        (ck.Accuracy(), None),
        (ck.Accuracy(curve_rtol=1e-3), 1e-3),  # the usual one, and asked for all the same
        (ck.Accuracy.draft, 1e-2),
    ],
)
def test_a_scene_file_says_how_exact_its_runs_are(tmp_path, monkeypatch, given, used):
    from contactkit.app import fit

    def taken(scene, data, parameters, accuracy, **more):
        asked.append(accuracy and accuracy.curve_rtol)
        return ck.fit(scene, data, parameters, solve=closed)

    asked = []
    monkeypatch.setattr(fit, "fit", taken)
    (tmp_path / "pull.csv").write_text("gap [um],force [uN]\n2,90\n3,60\n4,45\n")
    sought = ("interface.meniscus.liquid.viscosity=10 mPa.s..10 Pa.s",)
    options = fit.FitOptions(tmp_path / "pull.csv", "gap", "force", sought, "1 %")
    fit.fit_scene(sphere(), given, None, lambda done: None, options)
    assert asked == [used]
