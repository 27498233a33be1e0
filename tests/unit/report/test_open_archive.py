"""An open archive in Python and in notebooks: data frames, datasets, short views."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from plain_tables import plain_table
from unit.report.figure_archive import small_archive

import edesign
from edesign.damper.testing.measured_histories import DamperTest
from edesign.errors import ArchiveError, InputError
from edesign.report.tables.column import col, text
from edesign.report.tables.table import Table
from edesign.report.tables.unit import PERCENT

pytest.importorskip("pandas")
xarray = pytest.importorskip("xarray")


@pytest.fixture(scope="module")
def archive(tmp_path_factory: pytest.TempPathFactory) -> Path:
    return small_archive(tmp_path_factory.mktemp("open"))


def test_cells_of_the_report_are_numbers_that_print_as_the_report_does(archive: Path) -> None:
    with edesign.open_archive(archive) as opened:
        frame = opened.table("governing_response")
        measured = opened.table("analyses_by_storey")
    assert frame.attrs["units"]["drift, largest"] == "%"
    of = measured[(measured.variant == frame.variant[0]) & (measured.status == "completed")]
    largest = max(of.storey_drift_max.max(), -of.storey_drift_min.min())
    assert frame["drift, largest"][0] == pytest.approx(100.0 * largest, rel=1e-15)  # one division by 0.01


def test_an_open_archive_gives_data_frames_and_datasets(archive: Path) -> None:
    with edesign.open_archive(archive) as opened:
        assert {"analyses", "governing_response", "analyses_by_storey"} <= set(opened.tables())
        with pytest.raises(InputError, match="'analyse'.*did you mean.*E-ARCH-07"):
            opened.table("analyse")
        name = opened.names("analyses")[1]
        data = opened.dataset(f"analyses/{name}")
        with pytest.raises(ArchiveError, match="analyses/nothing.*E-ARCH-07"):
            opened.dataset("analyses/nothing")
        curve = opened.history(name)
    other = xarray.open_dataset(archive, group=f"analyses/{name}", engine="h5netcdf")
    assert data.floor_displacement.attrs["units"] == "m" and set(data.variables) == set(other.variables)
    np.testing.assert_array_equal(data.storey_drift_max, other.storey_drift_max)
    np.testing.assert_array_equal(data.storey, other.storey)
    assert curve.attrs["units"]["time"] == "s" and len(curve) == data.sizes["time"]
    other.close()


def test_notebooks_show_archives_groups_and_tables_with_texts_escaped(archive: Path) -> None:
    evil = "<script>alert(1)</script>"
    shown = plain_table(evil, (evil, "n"), [[evil, "1"]], [evil])._repr_html_()
    assert evil not in shown and shown.count("&lt;script&gt;") == 4
    with edesign.open_archive(archive) as opened:
        assert archive.name in repr(opened) and len(repr(opened)) < 100
        opened.attributes["title"] = evil
        assert evil not in opened._repr_html_() and "&lt;script&gt;" in opened._repr_html_()
        group = opened.group(f"analyses/{opened.names('analyses')[1]}")
    assert "floor_displacement" in group._repr_html_() and len(repr(group)) < 300


def test_notebooks_show_projects_in_short(tmp_path: Path) -> None:
    path = edesign.new_project(tmp_path / "new")
    project = edesign.load_project(path)
    assert repr(project).startswith(f"<Project {path.name}: ") and len(repr(project)) < 200
    shown = project._repr_html_()
    assert "frame" in shown and "analyses" in shown and shown.count("data:image/svg+xml") == 2


def test_notebooks_draw_records_and_show_the_tables_of_runs_matches_and_fits(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(tmp_path)
    project = edesign.load_project(edesign.new_project("frame"))
    record = edesign.read_record_file("frame/records/simulated_4.AT2")
    shown = record._repr_html_()
    assert "PGA" in shown and shown.count("data:image/svg+xml") == 1
    done = edesign.run_project(project, only=["gravity"])
    assert "<table>" in done._repr_html_() and str(done.archive) in done._repr_html_()
    target = edesign.elastic_spectrum(edesign.checked_hazard(project))
    matched = edesign.match_records({"a": record}, target, edesign.MatchOptions("scale"), "matched.h5")
    assert "<table>" in matched._repr_html_()
    time = np.linspace(0.0, 2.0, 401)
    u, v = 0.01 * np.sin(np.pi * time), 0.01 * np.pi * np.cos(np.pi * time)
    fit = edesign.fit_law("kelvin_voigt", [DamperTest("sine", time, u, 2e6 * u + 4e4 * v)])
    assert "kelvin_voigt" in fit._repr_html_() and "<table>" in fit._repr_html_()


def test_a_model_that_cannot_be_drawn_says_why(tmp_path: Path) -> None:
    project = edesign.load_project(edesign.new_project(tmp_path / "new", kind="damped"))
    wrong = project.with_values("dampers.laws.elastomer.parameters", "thesis_table_9_9")
    shown = wrong._repr_html_()
    assert "frame" in shown and "thesis_table_9_9" in shown and "data:image/svg+xml" not in shown


def test_tables_of_any_report_are_data_frames() -> None:
    tables = [
        Table("Errors (NRMS)", (text("test"), col("error", PERCENT, digits=2)), [["a", 0.0123]]),
        Table("Empty", notes=["-"]),
    ]
    frames = edesign.data_frames(tables)
    assert list(frames) == ["errors"] and frames["errors"]["error"].tolist() == [0.0123 / 0.01]
