"""Figures count records as tables do: of histories with masses at several places the worst one, place by place."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from unit.report.figure_archive import TEXT, history

from edesign.archive.dataset import Group
from edesign.archive.reader import open_archive
from edesign.archive.writer import ArchiveWriter
from edesign.report.response.axial_figures import axial_figures
from edesign.report.response.frame_figures import frame_figures
from edesign.report.response.mean_profiles import mean_profile_figures
from edesign.report.response.profile_figures import profile_figures

SCALES = {("a", "0"): 1.0, ("a", "+x+y"): 3.0, ("b", "0"): 2.0, ("b", "+x+y"): 1.0}
NOTE = "Of each record the worst of its angles and places of the masses counts, place by place."


@pytest.fixture(scope="module")
def path(tmp_path_factory: pytest.TempPathFactory) -> Path:
    root = Group()
    root.add("project_text", (), TEXT, "", "project")
    with ArchiveWriter(tmp_path_factory.mktemp("motions") / "a.h5", root) as writer:
        for variant, factor in (("bare", 1.0), ("damped", 0.5)):
            for order, ((record, place), scale) in enumerate(SCALES.items()):
                group = history(variant, record, order, factor * scale, eccentricity=place)
                writer.write(f"analyses/{variant}.DBE.{record}.{place}", group)
        return writer.finish()


def test_means_are_of_the_worst_of_each_record(path: Path) -> None:
    """The worst are 3 and 2 times the history of scale 1: drifts 1 %, rotations 30 mrad, forces 600 kN and 200 kN."""
    with open_archive(path) as archive:
        (caption, means), *_ = [(text, figure) for _, text, figure in mean_profile_figures(archive)]
        profiles = {name: (text, figure) for name, text, figure in profile_figures(archive)}
        hinges = {name: text for name, text, _ in frame_figures(archive)}
        ((_, axial, _),) = axial_figures(archive)
    assert "interstorey drift up to bare 2.50, damped 1.25 %" in caption and NOTE in caption
    drifts = means.axes[1].lines
    assert any(np.asarray(line.get_xdata()) == pytest.approx([2.5, 1.25]) for line in drifts)
    text, figure = profiles["profile_storey_drift_DBE"]
    assert "bare: mean of 2 records up to 2.50 %, largest 3.00 % (a, masses +x+y)" in text and NOTE in text
    assert figure.axes[0].get_title(loc="left") == "bare, 2 records"
    assert [text.get_text() for text in figure.legends[0].get_texts()][:2] == [
        "history",
        "history with the largest value",
    ]
    assert (
        "bare, 2 records: 5 of 12 ends rotate by more than 1 mrad, the largest is 75.0 mrad (B_1_1)"
        in hinges["hinges_DBE_mean"]
    )
    assert all(NOTE in text for text in (*hinges.values(), axial))
    assert "bare: largest compression 900 kN (line A, storey 1), mean of 2 records, in one record 1000 kN" in axial
