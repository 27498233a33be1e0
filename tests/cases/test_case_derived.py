"""`vary`, `values` and `bounds` of a study: each variant is the project that a user would have written by hand."""

from __future__ import annotations

import io
from itertools import product
from pathlib import Path

import numpy as np
import pytest
from cases.conftest import copied_study

from edesign.archive.dataset import Group
from edesign.archive.reader import open_archive
from edesign.frame.project_file import load_study
from edesign.report.archive.study_tables import study_tables
from edesign.report.assessment.vary_figures import vary_figures
from edesign.report.assessment.verdict_data import study_verdicts
from edesign.report.html.section import Picture
from edesign.report.page.sections.derived import derived
from edesign.report.page.source import Source
from edesign.report.tables.table import Table
from edesign.report.tables.text import print_tables
from edesign.study.run.run import run_study

RECORDS, EXTREMES = ("whole", "slow"), ("max", "min")
# the factor of ASCE/SEI 7-16, 18.2.4.5: (1 - 0.75 (1 - ageing)) test specification
LOWER = (1.0 - 0.75 * (1.0 - 0.9)) * 0.8 * 0.95
BY_HAND = f"""\
edesign_study: 1
title: The same by hand
project: project.yaml
variants:
  upper: {{dampers: project, property_factor: 1.3}}
  lower: {{dampers: project, property_factor: {LOWER!r}}}
  as_it_is: {{dampers: project}}
histories: [{{variants: all, levels: DBE, records: slow}}]
outputs: {{archive: by_hand.h5}}
"""


@pytest.fixture(scope="module")
def folder(tmp_path_factory: pytest.TempPathFactory) -> Path:
    folder = copied_study("any_quantity", tmp_path_factory.mktemp("derived")).parent
    (folder / "by_hand.yaml").write_text(BY_HAND, encoding="utf-8")
    return folder


@pytest.fixture(scope="module")
def archive(folder: Path) -> Path:
    return run_study(load_study(folder / "sweep.yaml")).archive


def groups(archive: Path) -> dict[str, Group]:
    with open_archive(archive) as opened:
        return {name: opened.group(f"analyses/{name}") for name in opened.names("analyses")}


def same(one: Group, other: Group) -> None:
    """The same results to the last bit."""
    assert list(one.variables) == list(other.variables)
    for name, variable in one.variables.items():
        if np.asarray(variable.values).dtype.kind == "f":
            assert np.array_equal(variable.values, other.variables[name].values, equal_nan=True), name


def test_each_variant_is_the_one_written_by_hand(folder: Path, archive: Path) -> None:
    found = groups(archive)
    by_hand = groups(run_study(load_study(folder / "by_hand.yaml")).archive)
    text = (folder / "project.yaml").read_text(encoding="utf-8")
    changes = {
        "damped_c_3": ("c: 150 kN*s/m", "c: 600 kN*s/m"),
        "damped_brace_2": ("section: IPE80", "section: IPE120"),
        "softer": ("E: 210 GPa", "E: 200 GPa"),
    }
    for name, (old, new) in changes.items():
        (folder / "project.yaml").write_text(text.replace(old, new), encoding="utf-8")
        study = load_study(folder / "by_hand.yaml")
        other = groups(run_study(study, folder / f"{name}.h5", only=["as_it_is.DBE.slow"]).archive)
        same(found[f"{name}.DBE.slow"], other["as_it_is.DBE.slow"])
    (folder / "project.yaml").write_text(text, encoding="utf-8")
    same(found["damped_c_2.DBE.slow"], found["damped.DBE.slow"])  # the value that the project has
    same(found["damped_upper.DBE.slow"], by_hand["upper.DBE.slow"])
    same(found["damped_lower.DBE.slow"], by_hand["lower.DBE.slow"])


def test_tables_show_each_value_and_the_bound_that_governs(archive: Path) -> None:
    found = groups(archive)

    def mean(variant: str, name: str) -> float:
        peaks = [
            max(np.abs(found[f"{variant}.DBE.{record}"].variables[f"{name}_{end}"].values).max() for end in EXTREMES)
            for record in RECORDS
        ]
        return float(np.mean(peaks))

    with open_archive(archive) as opened:
        tables = {table.title: table for table in study_tables(opened)}
        verdicts = {verdict.variant: verdict for verdict in study_verdicts(opened)}
    sweep = tables["Mean response by c of fluid, damped at DBE"]
    assert [row[0] for row in sweep.texts] == ["40 kN*s/m", "150 kN*s/m", "600 kN*s/m"]
    drifts = [float(row[1]) for row in sweep.texts]
    assert drifts == pytest.approx([100.0 * mean(f"damped_c_{i}", "storey_drift") for i in (1, 2, 3)], rel=1e-3)
    bounds = tables["Mean response of damped at DBE with bounds of its dampers"]
    forces = {
        side: mean(name, "damper_force")
        for side, name in (("lower", "damped_lower"), ("nominal", "damped"), ("upper", "damped_upper"))
    }
    row = next(cells for cells in bounds.texts if cells[0] == "damper force [kN]")
    assert [float(cell) for cell in row[1:4]] == pytest.approx([force / 1e3 for force in forces.values()], rel=1e-3)
    assert (row[4], row[5]) == (row[3], "upper") and max(forces, key=forces.__getitem__) == "upper"
    # the means of other tables leave the sweep out, and criteria on a variant are on what is made of it
    assert not any("_c_" in header for header in tables["Mean response"].headers)
    assert set(verdicts) == {name.partition(".")[0] for name in found} - {"softer"}
    assert verdicts["damped_c_1"].value == pytest.approx(mean("damped_c_1", "storey_drift"), rel=1e-12)


def test_tables_and_figures_reach_the_report(archive: Path) -> None:
    stream = io.StringIO()
    with open_archive(archive) as opened:
        source = Source(opened)
        parts = derived(source).parts
    tables = [part for part in parts if isinstance(part, Table)]
    print_tables(tables, stream)
    assert len(tables) == 3 and max(map(len, stream.getvalue().splitlines())) <= 80
    names = [part.name for part in parts if isinstance(part, Picture)]
    assert names == ["figure-vary_c_damped_DBE", "figure-vary_brace_damped_DBE"] and not source.left_out


def test_a_grid_has_a_row_for_each_combination_and_a_curve_for_each_other_value(folder: Path) -> None:
    places = {
        "dampers.laws.fluid.parameters.c": ["40 kN*s/m", "600 kN*s/m"],
        "materials.S275.E": ["200 GPa", "210 GPa"],
    }
    study = load_study(folder / "sweep.yaml").with_values(
        {
            "vary": [
                {"name": "g", "variants": "damped", "grid": places, "measures": ["interstorey_drift", "damper_force"]}
            ],
            "histories": [{"variants": "all", "levels": "DBE", "records": ["whole", "slow"]}],
        }
    )
    path = run_study(study, folder / "grid.h5").archive
    single = groups(
        run_study(load_study(folder / "sweep.yaml"), folder / "single.h5", only=["damped_c_3.DBE.slow"]).archive
    )
    same(groups(path)["damped_g_2_2.DBE.slow"], single["damped_c_3.DBE.slow"])  # 600 kN*s/m with the E of the project
    with open_archive(path) as opened:
        parts = derived(Source(opened)).parts
    table = next(part for part in parts if isinstance(part, Table) and part.title.startswith("Mean response by c"))
    assert table.title == "Mean response by c of fluid and E of S275, damped at DBE"
    assert table.headers[:3] == ["c of fluid", "E of S275", "storey drift [%]"]
    assert [tuple(row[:2]) for row in table.texts] == list(product(*places.values()))
    with open_archive(path) as opened:
        name, _, figure = next(vary_figures(opened))
    lines = figure.axes[0].get_lines()
    assert [line.get_label() for line in lines] == ["200 GPa", "210 GPa"]
    assert [list(line.get_xdata()) for line in lines] == [[40.0, 600.0], [40.0, 600.0]] and name == "vary_g_damped_DBE"
