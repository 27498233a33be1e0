"""Texts of users in figures and pages are drawn as texts, whatever signs they have; a figure that fails is named."""

from __future__ import annotations

import re
import xml.etree.ElementTree as ElementTree
from collections.abc import Iterator
from pathlib import Path

import numpy as np
import pytest
from matplotlib.figure import Figure
from unit.report.figure_archive import RECORDS, history, small_archive

from edesign.archive.reader import Archive, open_archive
from edesign.damper.testing.property_table import PropertyTable
from edesign.optional_stages import noting_failures
from edesign.report.archive import analysis_figures
from edesign.report.archive.document import page_text
from edesign.report.archive.figures import all_figures, draw_figures
from edesign.report.damper.measured_figures import properties_figure
from edesign.report.drawing.captions import LONGEST, UniqueNames, file_name
from edesign.report.drawing.style import new_figure, styled, svg_text
from edesign.report.page.sections import response
from edesign.report.response.response_figures import response_figures

VARIANTS = (
    "$^$",  # mathtext that cannot be parsed
    r"$\frac{1}{2}$ a_b",  # and one that can
    "_hidden",  # matplotlib leaves labels with an underscore out of legends
    "<b>&amp;\"'",
    "\x1b]0;owned\x07 \u202etxt",
    "\u05de\u05d2\u05d3\u05dc \u4e2d\u6587 \U0001f600",  # from right to left; without glyphs in the fonts of matplotlib
    "../../x/" + "v" * 300,
)


def archive_with(folder: Path, variants: tuple[str, ...], level: str = "DBE") -> Path:
    groups = [
        (f"analyses/h{i}{j}", history(variant, record, 100 + 10 * i + j, 1.0, level=level))
        for i, variant in enumerate(variants)
        for j, record in enumerate(RECORDS)
    ]
    return small_archive(folder, *groups)


def texts(svg: str) -> str:
    root = ElementTree.fromstring(svg)
    return "\n".join(element.text or "" for element in root.iter() if element.tag.endswith("text"))


@pytest.mark.slow
@pytest.mark.filterwarnings("ignore:Glyph:UserWarning")  # what the command does with it is another test's
def test_every_figure_is_drawn_and_says_the_names(tmp_path: Path) -> None:
    page = page_text(archive_with(tmp_path, VARIANTS))
    assert "What could not be shown" not in page and "<b>" not in page
    assert not re.search("[\x00-\x08\x0b-\x1f\x7f-\x9f\u202a-\u202e\u2066-\u2069]", page)
    ids = re.findall(r'\bid="([^"]*)"', page)
    assert len(ids) == len(set(ids)) and all(re.fullmatch(r"[A-Za-z0-9_.-]+", one) for one in ids)
    (legend,) = re.findall(rf'<svg[^>]*aria-labelledby="figure-response_DBE_{RECORDS[0]}-title".*?</svg>', page)
    for variant in VARIANTS:
        shown = variant.replace("\x1b", r"\u001b").replace("\x07", r"\u0007").replace("\u202e", r"\u202e")
        assert shown in texts(legend)


@pytest.mark.filterwarnings("ignore:Glyph:UserWarning")
@pytest.mark.parametrize("level", ["\u5927", "../" + "v" * 300])
def test_files_of_figures(level: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """Each has its own file, which any file system takes, and is XML."""
    monkeypatch.setattr(analysis_figures, "FIGURES", (response_figures,))
    path = archive_with(tmp_path, ("\x1b[31m",), level)
    with open_archive(path) as archive:
        names = [name for name, _, _ in all_figures(archive)]
    drawn = draw_figures(path, tmp_path / "figures", "svg")
    assert len({written.name.lower() for written in drawn}) == len(names) == len(list((tmp_path / "figures").iterdir()))
    for written in drawn:
        assert len(written.name.encode()) < 255
        assert written.suffix == ".svg" and ElementTree.parse(written)


def test_names_of_files() -> None:
    assert file_name("a", "\u5927") != file_name("a", "\u5c0f")
    assert file_name("v" * 300) != file_name("v" * 299) and len(file_name("v" * 300)) < LONGEST + 10
    assert file_name("..", "x") == "-_x" and file_name(".hidden") == "-hidden"
    unique = UniqueNames()
    assert [unique(name) for name in ("a", "A", "a-2", "b")] == ["a", "A-2", "a-2-2", "b"]


def test_our_own_symbols_are_still_set_as_mathematics() -> None:
    table = PropertyTable(*([np.array([1.0, 2.0])] * 6))
    svg = svg_text(properties_figure(table, 1.0))
    assert "$" not in texts(svg)


def test_one_figure_that_fails_is_named_and_the_rest_is_there(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    @styled
    def broken() -> Figure:
        figure, ((axes,),) = new_figure(1, 1, 2.0, 2.0)
        axes.set_title("$^$", parse_math=True)
        return figure

    def some_figures(archive: Archive) -> Iterator[tuple[str, str, Figure]]:
        yield "wrong", "A figure that cannot be drawn.", broken()
        yield "right", "A figure below it.", new_figure(1, 1, 2.0, 2.0)[0]
        raise ZeroDivisionError("no more")

    monkeypatch.setattr(response, "profile_figures", some_figures)
    with noting_failures() as failures:
        page = page_text(small_archive(tmp_path))
    assert [one.stage for one in failures] == ["figure wrong", "some figures"]
    assert 'id="figure-right"' in page and 'id="figure-wrong"' not in page and "figure-response_DBE" in page
    mistake = "an error in edesign itself"
    assert f"figure wrong: {mistake} (ValueError" in page
    assert f"some figures: {mistake} (ZeroDivisionError: no more)" in page
    assert "What could not be shown" in page
