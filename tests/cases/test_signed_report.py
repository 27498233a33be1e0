"""The report for those who sign it: whose it is, what is assumed, the input in numbers, every check; no ids."""

from __future__ import annotations

import re
from dataclasses import dataclass
from html import unescape
from pathlib import Path

import h5py
import numpy as np
import pytest
from cases.conftest import copied_study

from edesign.archive.reader import open_archive
from edesign.project.study.study_loader import load_study
from edesign.report.archive.document import page_text
from edesign.report.archive_view import results
from edesign.report.inputs.damper_schedule import schedule_tables
from edesign.report.inputs.law_parameters import law_tables
from edesign.report.inputs.mass_table import mass_tables
from edesign.report.inputs.variant_frames import VariantFrames
from edesign.report.page.source import Source
from edesign.report.tables.table import Table
from edesign.study.run.run import run_study

DOCUMENT = """\
document:
  client: Municipality of <Chania>
  author: A. Petrou
  checker: B. Ioannou
  revision: "02"
  date: 2026-03-31
"""


@dataclass(frozen=True)
class Made:
    """An archive, its page, and the text of the page without tags and without the files to the letter."""

    archive: Path
    page: str

    @property
    def text(self) -> str:
        page = re.sub(r"<(style|pre)>.*?</\1>", "", self.page, flags=re.DOTALL)
        return unescape(re.sub(r"<[^>]+>", " ", page))


@pytest.fixture(scope="module")
def viscous(tmp_path_factory: pytest.TempPathFactory) -> Made:
    """Oil dampers sized by a study, with a bound on their forces."""
    path = copied_study("viscous_dampers", tmp_path_factory.mktemp("signed"))
    path.write_text(path.read_text(encoding="utf-8") + "\n" + DOCUMENT, encoding="utf-8")
    archive = run_study(load_study(path)).archive
    return Made(archive, page_text(archive))


@pytest.fixture(scope="module")
def isolated(tmp_path_factory: pytest.TempPathFactory) -> Made:
    """An isolated frame with bounds, whose laws are several."""
    archive = run_study(load_study(copied_study("isolated_frame", tmp_path_factory.mktemp("signed")))).archive
    return Made(archive, page_text(archive))


def tables_of(path: Path) -> dict[str, Table]:
    """Tables of the input by their titles."""
    with open_archive(path) as archive:
        source = Source(archive)
        assert source.project is not None
        frames = VariantFrames(archive, source.project, source.study)
        found = [*mass_tables(frames), *law_tables(frames)]
        found += schedule_tables(frames, source.study, source.sets, lambda name: results(archive, name))
        return {table.title: table for table in found}


def rows_of(table: Table) -> list[dict[str, str]]:
    return [dict(zip(table.headers, row, strict=True)) for row in table.texts]


def test_the_cover_says_whose_the_report_is(viscous: Made) -> None:
    cover = viscous.page[viscous.page.index('<header class="cover">') : viscous.page.index("</header>")]
    reported = re.findall(r"<dt>([^<]+)</dt><dd>([^<]+)</dd>", cover)
    assert reported == [
        ("Client", "Municipality of &lt;Chania&gt;"),
        ("Author", "A. Petrou"),
        ("Checked by", "B. Ioannou"),
        ("Revision", "02"),
        ("Date", "2026-03-31"),
    ]


def test_a_report_of_nobody_has_no_empty_lines(isolated: Made) -> None:
    assert '<dl class="document">' not in isolated.page


def test_the_order_is_that_of_a_reader(viscous: Made) -> None:
    anchors = re.findall(r'<section id="([a-z-]+)"', viscous.page)
    assert anchors[:5] == ["summary", "checks", "model", "assumptions", "warnings"]
    assert anchors[-1] == "provenance"
    assert "could not be shown" not in viscous.page


def test_names_of_analyses_are_words(viscous: Made, isolated: Made) -> None:
    """They stand once in full, in the table that is for `edesign show`."""
    for made in (viscous, isolated):
        with h5py.File(made.archive) as file:
            names = [name for name in file["analyses"] if "." in name]
        assert names
        assert {name for name in names if made.text.count(f" {name} ") != 1} == set()


def test_no_word_of_another_work_s_thesis(viscous: Made, isolated: Made) -> None:
    for made in (viscous, isolated):
        assert not re.search(r"thesis|MGMM|viscous_power|friction_pendulum|Eq\. 5\.\d", made.text)


def test_masses_are_those_of_the_modal_analysis(viscous: Made, isolated: Made) -> None:
    """`mass_kg` comes from the model of the core; the weight is that of the reactions under gravity."""
    (table,) = (t for name, t in tables_of(viscous.archive).items() if name.startswith("Masses"))
    with h5py.File(viscous.archive) as file:
        mass = float(file["analyses/bare.modes"].attrs["mass_kg"])
        weight = float(np.sum(file["analyses/bare.gravity/reaction_y_final"]))
    total = rows_of(table)[-1]
    assert float(total["mass [t]"]) == pytest.approx(mass / 1e3, rel=5e-4)  # four digits are printed
    assert float(total["weight [kN]"]) == pytest.approx(weight / 1e3, rel=5e-4)
    base = [rows_of(t) for name, t in tables_of(isolated.archive).items() if name.startswith("Masses")]
    assert [rows[-2]["floor"] for rows in base] == ["1", "base"]  # on its supports, and on isolators


def test_the_schedule_is_that_of_the_design(viscous: Made) -> None:
    """Against the group of the design, and forces and strokes against the extremes of the history."""
    tables = tables_of(viscous.archive)
    with h5py.File(viscous.archive) as file:
        coefficient = file["designs/oil/device_coefficient"][()]
        brace = file["designs/oil/brace_stiffness"][()]
        history = file["analyses/damped.DBE.motion"]
        force = np.maximum(history["damper_force_max"], -history["damper_force_min"][()])
        stroke = np.maximum(history["damper_deformation_max"], -history["damper_deformation_min"][()])
        alpha = float(file["designs/oil"].attrs["alpha"])
    placed = rows_of(tables["Dampers, damped"])
    assert [row["storey"] for row in placed] == ["1", "2", "3", "total"] and placed[-1]["number"] == "3"
    sizes = [float(row["size of one"].split()[2]) for row in placed[:-1]]
    np.testing.assert_allclose(sizes, coefficient / 1e3, rtol=5e-4)  # four digits are printed
    braces = [float(row["brace"].split()[0]) for row in placed[:-1]]
    np.testing.assert_allclose(braces, brace / 1e6, rtol=5e-4)
    required = rows_of(tables["Required of one damper, damped"])
    np.testing.assert_allclose([float(row["F [kN]"]) for row in required], force / 1e3, rtol=5e-4)
    np.testing.assert_allclose([float(row["stroke [mm]"]) for row in required], stroke / 1e-3, rtol=5e-4)
    speed = (force / coefficient) ** (1.0 / alpha)  # F = c v^alpha
    np.testing.assert_allclose([float(row["v [m/s]"]) for row in required], speed, rtol=5e-4)


def test_bounds_ask_of_the_same_dampers_and_one_governs(isolated: Made) -> None:
    tables = tables_of(isolated.archive)
    rows = [row for row in rows_of(tables["Required of one damper, isolated"]) if row["law"] == "oil"]
    assert {row["level"] for row in rows} == {
        f"{level}{bound}" for level in ("DBE", "MCE") for bound in ("", ", lower bound", ", upper bound")
    }
    (most,) = (row["level"] for row in rows if "force" in row["governs"])
    assert most == max(rows, key=lambda row: float(row["F [kN]"]))["level"] == "MCE, upper bound"
    speeds = [float(row["v [m/s]"]) for row in rows if row["level"].startswith("MCE")]
    assert max(speeds) < 1.01 * min(speeds)  # the same motion of the base: each force is over its own bound of c


def test_laws_have_all_their_parameters(isolated: Made) -> None:
    tables = tables_of(isolated.archive)
    oil = next(table for name, table in tables.items() if name.startswith("Law oil"))
    assert [row[0] for row in oil.texts] == ["c", "alpha"]
    assert any("property factor 0.8 in isolated_lower" in note for note in oil.notes)


def test_checks_have_their_source_and_numbers(viscous: Made, tmp_path: Path) -> None:
    checks = viscous.page[viscous.page.index('id="checks"') :]
    for header in ("requirement", "source", "demand", "capacity", "D/C", "verdict", "governs"):
        assert f">{header}</th>" in checks
    assert "FEMA 356 performance levels" in checks
