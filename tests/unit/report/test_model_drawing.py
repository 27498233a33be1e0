"""The model drawn: what stands on the sheets, that no texts overlap, and the files of `edesign check --figure`."""

from __future__ import annotations

import math
from functools import cache
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import yaml
from building_examples import DAMPED, SMALL
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.path import Path as Outline
from matplotlib.text import Text
from support.messages import says

from edesign.cli.main import main
from edesign.file_kinds.kinds import BUILDING, PROJECT, STUDY
from edesign.file_kinds.recognise import kind_of
from edesign.frame.building_file import load_building
from edesign.frame.project_file import load_project, load_study
from edesign.project.reading.file_model import FileModel
from edesign.report.drawing.symbols import in_parts
from edesign.report.drawing.text_size import wrapped
from edesign.report.inputs.designed_dampers import designed_dampers
from edesign.report.model.boxes import Boxes, Spot, corners_of
from edesign.report.model.loads import loads_of
from edesign.report.model.sheet import Sheet, on_sheet
from edesign.report.model.study import study_figures
from edesign.report.model.words import law_words
from edesign.report.model_drawings import drawings_of
from tools import doc_pages

ROOT = Path(__file__).parents[3]
FILES = sorted([*ROOT.glob("projects/*/*.yaml"), *ROOT.glob("tests/cases/*/*.yaml")])
LOADERS = {PROJECT: load_project, STUDY: load_study, BUILDING: load_building}
ALIKE = ("causes", "corrected", "incremental", "study_records", "table_5_2")  # others of their folders draw the same
MODELS = [path for path in FILES if kind_of(path) in LOADERS and path.stem not in ALIKE]
TOUCH = 0.01  # inches that boxes may share: renderers round the places of letters to pixels, 1/100 of an inch


def loaded(path: Path) -> FileModel:
    return LOADERS[kind_of(path)](path)  # type: ignore[index, operator]


def texts(figure: Any) -> list[str]:
    return [text.get_text() for text in figure.axes[0].texts]


@cache
def drawings(path: Path) -> dict[str, list[str]]:
    """The texts of each drawing of a file by its name."""
    return {name: texts(figure) for name, _, figure in drawings_of(loaded(path))}


def test_laws_in_words_have_titles_and_symbols() -> None:
    cases = Path(__file__).parents[2] / "cases"
    projects = [load_project(cases / name / "project.yaml") for name in ("any_quantity", "devices_of_practice")]
    laws = {name: law for project in projects if project.dampers for name, law in project.dampers.laws.items()}
    said = law_words("rubber", laws["rubber"])
    assert said.startswith("rubber: modified generalised Maxwell model (MGMM), parameters of thesis Table 4.2, ")
    assert "F_y = 70 kN, b = 0.04" in law_words("flag", laws["flag"])
    found = list(in_parts(law_words("one_way", laws["one_way"])))
    assert {("c", "plus"), ("c", "minus"), ("α", "")} <= {(before[-1:], index) for before, index in found}
    assert not any(index for _, index in in_parts("columns c_1, k_1"))  # names of users, without values


def test_the_value_of_a_symbol_stands_on_its_line() -> None:
    """A symbol has its index where its value follows it; all blanks but those about `=` break lines."""
    said = "F_ysc = 235 MPa, E = 210 GPa, L_wp = 5 m, L_y = 3.5 m, KF = 1.3"
    for room in np.linspace(0.6, 3.0, 25):
        lines = wrapped(said, room, 6.0)
        assert " ".join(lines) == said
        assert not any(line.startswith("=") or line.endswith("=") for line in lines)


def outline(text: Text, renderer: Any, dpi: float) -> np.ndarray:
    """Corners of a drawn text, a little within its edges, inches: its extent when it is not turned, turned about."""
    angle = math.radians(text.get_rotation())
    anchor = text.get_transform().transform(text.get_position()) / dpi
    text.set_rotation(0.0)
    low, high = text.get_window_extent(renderer).get_points() / dpi
    text.set_rotation(math.degrees(angle))
    low, high = np.minimum(low + TOUCH, high), np.maximum(high - TOUCH, low)
    corners = np.array([low, (high[0], low[1]), high, (low[0], high[1]), low])
    c, s = math.cos(angle), math.sin(angle)
    return np.asarray((corners - anchor) @ np.array([[c, s], [-s, c]]) + anchor)


@pytest.mark.parametrize("path", MODELS, ids=lambda path: f"{path.parent.name}/{path.stem}")
def test_no_texts_of_any_model_overlap(path: Path) -> None:
    """Measured by another renderer than that which placed them."""
    drawn = list(drawings_of(loaded(path), ("A title", "a file")))
    assert drawn
    for _, _, figure in drawn:
        renderer = FigureCanvasAgg(figure).get_renderer()
        words = figure.axes[0].texts
        outlines = np.array([outline(text, renderer, figure.dpi) for text in words]).reshape(-1, 5, 2)
        low, high = outlines.min(axis=1), outlines.max(axis=1)
        near = np.triu(np.all(low[:, None] < high[None], axis=2) & np.all(low[None] < high[:, None], axis=2), 1)
        for i, j in np.argwhere(near):
            mine, its = (Outline(outlines[k], closed=True) for k in (i, j))
            assert not mine.intersects_path(its), (words[i].get_text(), words[j].get_text())


def test_what_stands_on_the_thesis_frame() -> None:
    """Spans and sections of Table 5.2; 2 x 29.5 t + 2 x 19.35 t a floor, 21.6 m x (23 + 0.3 x 9.6) kN/m = 559 kN."""
    found = drawings(ROOT / "projects/thesis_10_storey/project.yaml")
    model, loads = found["model"], found["model_loads"]
    assert (model.count("7.20"), model.count("3.50"), "21.60" in model, "+35.00" in model) == (3, 10, True, True)
    assert [model.count(name) for name in ("HEB450", "HEB360", "HEB320")] == [4, 4, 4]  # once for each line of columns
    assert [model.count(name) for name in ("IPE450", "IPE400", "IPE360")] == [4, 3, 3]  # once for each floor
    assert loads.count("G 23, Q 9.6") == 10
    assert (loads.count("97.7"), loads.count("559"), "977" in loads, "5590" in loads) == (10, 10, True, True)


def test_loads_inside_members_are_those_of_the_file() -> None:
    """3 and 2 kN/m2 on a strip of 2.5 m; forces at thirds; a wall that grows; earth pressure on a column."""
    path = ROOT / "tests/cases/loads_inside_members/project.yaml"
    loads = drawings(path)["model_loads"]
    for words in ("G 7.5, Q 5", "G 60,\nQ 20 each", "G 40", "G 6 to G 12", "G 4 to G 8", "G 5", "G 30"):
        assert words in loads, words
    found = loads_of(load_project(path))
    assert found.uniform[1, 1] == (7500.0, 5000.0) and found.columns["A", 1] == (5000.0, 0.0)
    assert sorted(at for bay, floor, at, _ in found.points if (bay, floor) == (1, 1)) == pytest.approx([2.0, 4.0])


@pytest.mark.parametrize(
    ("case", "words"),
    [
        (
            "deteriorating_hinges",
            "vertical fixed, rotation 120 MN m/rad, yields at 500 kN m (B)",
        ),
        ("deteriorating_hinges", "plastic hinge of beams, M_y = 400 kN m, θ_p = 0.03 rad, hogging M_y = 330 kN m"),
        ("deteriorating_hinges", "panel zone that shears, doubler plates 6 mm"),
        ("deteriorating_hinges", "semi-rigid joint, S_j = 90 MN m/rad, M_j,Rd = 300 kN m"),
        ("footings_on_soil", "S2: footing 1.8 m × 3.6 m on clay (B)"),
        ("footings_on_soil", "lifts off, bearing resistance 400 kPa (C)"),
        ("isolated_frame", "isolator pendulum, vertical 1500 MN/m, lifts off (A-D)"),
        ("isolated_frame", "grid: elastic, A = 6000 cm², I = 7200000 cm⁴"),
        ("isolated_frame", "moat: contact with a gap, k = 80 kN/mm, gap = 300 mm"),
        ("buckling_braces", "brace that buckles in the analysis"),
        ("leaning_column", "leaning column: struts between hinges, tied to the floors"),
        ("rigid_ends", "rigid ends to scale, at most 0.2 m"),
        ("irregular_setback", "hinge: released moment"),
        ("bouc_wen_tuned_mass", "4 t, 1.3 Hz, 10 %"),
        ("brb_frame", "brb, bay 1: core of 1700 mm²"),
        ("devices_of_practice", "play 0.5 mm"),
        ("braced_truss", "rod_1"),
    ],
)
def test_the_drawing_says_what_the_file_has(case: str, words: str) -> None:
    said = " ".join(drawings(ROOT / "tests/cases" / case / "project.yaml")["model"])
    assert words in said


def test_variants_of_a_study_show_what_each_adds(tmp_path: Path) -> None:
    """Of dampers that are to be designed the places, and after the run the sizes that the archive holds."""
    study = load_study(ROOT / "projects/thesis_10_storey/study.yaml")
    before = {name: (caption, texts(figure)) for name, caption, figure in study_figures(study, {})}
    assert list(before) == ["model", "model_loads", "model_damped"]
    assert "the places of the design thesis" in before["model_damped"][0]
    assert any("sizes by the design thesis" in text for text in before["model_damped"][1])
    areas = [f"{0.1 * (11 - storey):g} m^2" for storey in range(1, 11)]
    device = {"kind": "chevron", "bays": [1, 3], "storeys": "all", "law": "elastomer", "layers": 2, "layer_area": areas}
    attributes = {
        "status": "completed",
        "devices": yaml.safe_dump({"devices": [{**device, "layer_thickness": "70 mm"}]}),
    }
    assert not designed_dampers(study, {"thesis": {**attributes, "status": "failed"}})  # no variant has its last sizes
    assert not designed_dampers(study, {"thesis": {**attributes, "devices": "devices: [{kind: unknown}]"}})
    designed = designed_dampers(study, {"thesis": attributes})
    after = {name: texts(figure) for name, _, figure in study_figures(study, designed)}["model_damped"]
    assert "2 layers of 0.1 m² × 70 mm" in after and "2 layers of 1 m² × 70 mm" in after
    assert any("at 20 °C" in text for text in after)  # the temperature of the design


def test_variants_that_look_alike_are_drawn_once() -> None:
    study = load_study(ROOT / "tests/cases/any_quantity/sweep.yaml")
    captions = {name: caption for name, caption, _ in study_figures(study, {})}
    assert list(captions) == ["model", "model_loads", "model_damped", "model_variant-softer"]
    assert "damped_upper: upper bound of the properties" in captions["model_damped"]
    assert "softer: materials.S275.E = 200 GPa" in captions["model_variant-softer"]


def test_texts_find_room_or_are_listed() -> None:
    """A second text of the same place goes to its next spot, a third one nowhere."""

    def draw(sheet: Sheet) -> None:
        spots = [Spot(0.0, 0.0), Spot(0.0, 1.0)]
        placed.extend(sheet.place(spots, "HEB300") for _ in range(3))
        sheet.block(2.0, 0.0, 1.0, 0.3)
        placed.append(sheet.place([Spot(2.0, 0.0), Spot(2.0, 1.0)], "beside the sign"))
        placed.append(sheet.place([Spot(2.0, 0.0)], "over it"))

    placed: list[bool] = []
    figure = on_sheet(draw)
    assert placed == [True, True, False, True, True]
    assert [text.get_position() for text in figure.axes[0].texts] == [(0.0, 0.0), (0.0, 1.0), (2.0, 1.0), (2.0, 0.0)]


def test_turned_boxes_meet_where_they_have_an_area_in_common() -> None:
    """A bar of 2 x 0.2 turned by 45 degrees passes beside a point that lies within its upright bounds."""
    boxes = Boxes()
    boxes.add(corners_of(Spot(0.0, 0.0, turned=45.0), 2.0, 0.2))
    assert boxes.meet(corners_of(Spot(0.5, 0.5), 0.1, 0.1))
    assert not boxes.meet(corners_of(Spot(0.5, -0.5), 0.1, 0.1))


def test_a_building_is_drawn_as_its_report_draws_it(tmp_path: Path) -> None:
    (tmp_path / "small.yaml").write_text(SMALL, encoding="utf-8")
    building = load_building(tmp_path / "small.yaml")
    drawn = {name: (caption, figure) for name, caption, figure in drawings_of(building)}
    kinds = [sum(name.startswith(kind) for name in drawn) for kind in ("model_X", "model_Y", "plan_", "model_loads")]
    assert all(kinds), list(drawn)
    assert "+7.00" in texts(next(figure for name, (_, figure) in drawn.items() if name.startswith("model_X")))
    loads = texts(next(figure for name, (_, figure) in drawn.items() if name.startswith("model_loads")))
    assert "G 4, Q_B 2" in loads and any("G 400 kN" in text for text in loads)  # 4 kN/m2 on 10 m x 10 m


def test_elevations_of_a_building_show_the_dampers_that_stand_in_them(tmp_path: Path) -> None:
    """Chevrons in X2, diagonals in YA and YC, a damper across both directions in none, a tuned mass at A1 in X1."""
    (tmp_path / "damped.yaml").write_text(DAMPED, encoding="utf-8")
    found = drawings_of(load_building(tmp_path / "damped.yaml"))
    words = {caption.partition(" along")[0]: " ".join(texts(figure)) for _, caption, figure in found}
    frames = {name: text for name, text in words.items() if name.startswith("Frame")}
    assert list(frames) == ["Frame X1", "Frame X2", "Frame X3", "Frames YA, YC", "Frame YB"]
    assert "2 t, 1 Hz, 5 %" in frames["Frame X1"] and "viscous" not in frames["Frame X1"]
    assert "in place of the braces of a chevron" in frames["Frame X2"] and "c = 200 kN" in frames["Frame X2"]
    assert "along the diagonal, rising" in frames["Frames YA, YC"] and "rising" not in frames["Frame YB"]


def test_elevations_of_a_building_show_what_stands_at_ends_of_members(tmp_path: Path) -> None:
    """Panels shear and columns turn where these bend about their strong axis, so not in frames along y."""
    more = (
        "hinges: [{beams: {along: x, frames: 1}, parameters: lignos_krawinkler_2011}]",
        "joints: [{columns: {at: A, storeys: 1}, ends: start, stiffness: 20 MN*m/rad, resistance: 90 kN*m}]",
        "panel_zones: [{at: B, floors: 1, doubler: 8 mm}]",
    )
    (tmp_path / "ends.yaml").write_text(SMALL + "".join(f"{line}\n" for line in more), encoding="utf-8")
    found = drawings_of(load_building(tmp_path / "ends.yaml"))
    words = {caption.partition(" along")[0]: " ".join(texts(figure)) for _, caption, figure in found}
    frames = {name: text for name, text in words.items() if name.startswith("Frame")}
    assert list(frames) == ["Frame X1", "Frames X2, X3", "Frames YA, YC", "Frame YB"]
    assert all("panel zone that shears, doubler plates 8 mm" in frames[name] for name in ("Frame X1", "Frames X2, X3"))
    assert all("S_j = 20 MN m/rad, M_j,Rd = 90 kN m" in frames[name] for name in ("Frame X1", "Frames X2, X3"))
    hinged = [name for name, text in frames.items() if "plastic hinge of beams" in text]
    assert hinged == ["Frame X1"]
    assert not any(word in frames["Frames YA, YC"] for word in ("panel zone", "semi-rigid"))


def test_elevations_of_an_isolated_building_show_its_isolators(tmp_path: Path) -> None:
    page = (doc_pages.ROOT / "docs/how_to/isolation.md").read_text(encoding="utf-8")
    (text,) = (step.text for step in doc_pages.steps(page) if step.name == "isolated_building.yaml")
    (tmp_path / "isolated.yaml").write_text(text, encoding="utf-8")
    found = drawings_of(load_building(tmp_path / "isolated.yaml"))
    words = {caption.partition(" along")[0]: " ".join(texts(figure)) for _, caption, figure in found}
    frames = {name: text for name, text in words.items() if name.startswith("Frame")}
    assert not any("fixed support" in text for text in frames.values())
    assert "isolator slider, vertical 500 MN/m (B)" in frames["Frame X2"] and "slider" not in frames["Frame X1"]
    assert "beside the isolators: moat (A)" in frames["Frame X2"] and "moat" not in frames["Frame YA"]
    of_base = next(text for caption, text in words.items() if caption.startswith("Loads of the isolated base"))
    assert "G 5 G 5 G 5 G 5" in of_base and "floor 0: G 500 kN, mass 50.99 t" in of_base  # 5 kN/m2 on 10 m x 10 m


def test_plans_show_own_boxes_as_hollow(tmp_path: Path) -> None:
    """Each of nine columns is a closed line of five points and a gap, whatever the name of its section."""
    assert SMALL.count("HEB200") == 1
    text = SMALL.replace("HEB200", "tower") + (
        "sections: {tower: {height: 200 mm, width: 200 mm, flange: 12 mm, web: 12 mm, webs: 2}}\n"
    )
    (tmp_path / "boxes.yaml").write_text(text, encoding="utf-8")
    found = drawings_of(load_building(tmp_path / "boxes.yaml"))
    (figure,) = (figure for name, _, figure in found if name.startswith("plan_"))
    columns = max((line for line in figure.axes[0].lines if line.get_linewidth() == 1.5), key=lambda line: line.zorder)
    assert len(columns.get_xdata()) == 9 * (5 + 1)


def test_check_writes_the_drawings_and_says_where(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.chdir(tmp_path)
    text = (ROOT / "tests/cases/leaning_column/project.yaml").read_text(encoding="utf-8")
    Path("p.yaml").write_text(text, encoding="utf-8")
    assert main(["check", "p.yaml", "--figure"]) == 0
    assert capsys.readouterr().out.splitlines()[0] == "figure:     p_model.pdf"
    first = Path("p_model.pdf").read_bytes()
    assert first.startswith(b"%PDF") and first.count(b"/Type /Page ") == 2
    assert main(["check", "--figure", "p.yaml", "x.svg"]) == 0
    assert capsys.readouterr().out.splitlines()[:2] == ["figure:     x.svg", "figure:     x_loads.svg"]
    assert "Cantilevers that hold a leaning column" in Path("x.svg").read_text(encoding="utf-8")
    assert main(["check", "p.yaml", "page.html", "--figure"]) == 0
    assert Path("page.html").read_text(encoding="utf-8").count('<figure class="picture"') == 2


@pytest.mark.parametrize(
    ("words", "code", "said"),
    [
        (["x.svg"], 2, "x.svg: --figure E-CLI-05"),
        (["x.pgn", "--figure"], 2, "x.pgn: .svg, .png, .pdf, .html; did you mean `.png`? E-FILE-08"),
        (["p.yaml", "--figure"], 2, "p.yaml: E-FILE-08"),
        (["no/x.svg", "--figure"], 4, "no/x.svg: no E-FILE-06"),
    ],
)
def test_drawings_that_cannot_be_written_are_refused_at_once(
    words: list[str], code: int, said: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: Any
) -> None:
    monkeypatch.chdir(tmp_path)
    Path("p.yaml").write_text("edesign: 1\n", encoding="utf-8")
    assert main(["check", "p.yaml", *words]) == code
    assert says(capsys.readouterr().err, said)
    assert sorted(path.name for path in tmp_path.iterdir()) == ["p.yaml"]
