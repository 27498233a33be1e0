"""The report as a PDF: heads and feet, contents, tables over several sheets, nothing cut, nothing folded unasked."""

from __future__ import annotations

import re
import sys
from dataclasses import replace
from pathlib import Path
from typing import Any

import matplotlib.font_manager
import pytest
from matplotlib.figure import Figure
from matplotlib.textpath import TextPath
from plain_tables import plain_table

from edesign.errors import ArchiveError, InputError
from edesign.report.html.inline_svg import picture_of
from edesign.report.html.render import Cover, Page
from edesign.report.html.section import Facts, Folded, Heading, Part, Picture, Section
from edesign.report.page.step import Step, part_of, steps
from edesign.report.pdf.appendix import appendix_number, printed
from edesign.report.pdf.document import WRITTEN, check_pdf_engine, print_text, write_page_as_pdf
from edesign.report.pdf.fit import fit_table, picture_size, text_width, upright
from edesign.report.pdf.fonts import fonts_folder
from edesign.report.pdf.paper import MARGIN_SIDE, PAPERS, PrintOptions
from edesign.report.pdf.texts import begun_at_left
from edesign.report.tables import column
from edesign.report.tables.table import TableSpec
from edesign.report.tables.unit import ONE

TITLE = 'Tower "A" of <b>Fort-de-France</b> & annexes, which has a title that is longer than the head of a page can be'
COVER = Cover(
    TITLE,
    "Study report",
    "2026-03-31 · edesign 9.8",
    footer="The last line.",
    document=(("Client", "City"), ("Project number", "17-B"), ("Revision", "C"), ("Author", "E. Author")),
    origin="edesign 9.8 · 2026-03-31",
    created="2026-03-31T12:00:00+00:00",
)
LONG = plain_table(
    "Storeys of the tower", ("storey", "drift [%]", "verdict"), [[f"s{i}", f"{i}.5", "met"] for i in range(60)]
)
WIDE = plain_table(
    "Twenty measures", [f"measure{i} [kN·m]" for i in range(20)], [[f"{i}12345.678" for i in range(20)]] * 3
)


@pytest.fixture(scope="module", autouse=True)
def _engine() -> None:
    pytest.importorskip("pypdf")
    try:
        check_pdf_engine()
    except InputError as error:
        pytest.skip(str(error))


def _picture(name: str, height: float = 4.5) -> Picture:
    figure = Figure(figsize=(6.5, height))
    figure.subplots().plot([0.0, 1.0], [0.0, 1.0], label=name)
    return picture_of(name, f"Caption of {name}. More words.", figure)


def _page(*parts: Part) -> Page:
    return Page(COVER, (Section("one", "First part", ("What it says.",), parts), Section("two", "Last", (), (LONG,))))


def _texts(path: Path) -> list[str]:
    from pypdf import PdfReader

    return [sheet.extract_text() for sheet in PdfReader(path).pages]


@pytest.fixture(scope="module")
def made(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A PDF with all kinds of parts, some of them folded."""
    folded = Folded("The file of the project", text="frame: {storeys: 3}"), Folded("Each record", (WIDE,))
    page = _page(Heading("Drifts"), _picture("drift"), WIDE, *folded, Facts((("Steel", "S275"),)))
    return write_page_as_pdf(page, tmp_path_factory.mktemp("pdf") / "report.pdf")


def test_every_sheet_says_what_it_is(made: Path) -> None:
    """Title, number, revision and kind above, version, date and sheet of sheets below; the first has the cover."""
    texts = _texts(made)
    for i, text in enumerate(texts, 1):
        assert f"Page {i} of {len(texts)}" in text and "edesign 9.8 · 2026-03-31" in text
        assert ("Project number 17-B · Revision C · Study report · City" in text) == (i > 1)
        assert 'Tower "A" of <b>Fort-de-France</b> & annexes' in text.replace("\n", " ")
    assert "Author E. Author" in texts[0]


def test_the_contents_name_the_sheets_of_the_sections(made: Path) -> None:
    from pypdf import PdfReader

    reader = PdfReader(made)
    texts = [sheet.extract_text() for sheet in reader.pages]
    contents = re.findall(r"(First part|Last)[ .]+(\d+)", texts[0].partition("Contents")[2])
    assert [name for name, _ in contents] == ["First part", "Last"]
    marks = {
        mark.title: reader.get_destination_page_number(mark) + 1
        for mark in reader.outline
        if mark and not isinstance(mark, list)
    }
    for name, number in contents:
        assert name in texts[int(number) - 1]
        assert marks[f"{'1' if name == 'First part' else '2'} {name}"] == int(number)


def test_a_table_goes_on_under_its_header(made: Path) -> None:
    """Sixty rows take two sheets or more, each begins with the header; no row is lost, none is alone."""
    sheets = [text for text in _texts(made) if re.search(r"^s\d+ ", text, re.MULTILINE)]
    assert len(sheets) >= 2
    rows = []
    for text in sheets:
        found = re.findall(r"^(s\d+) [\d.]+", text, re.MULTILINE)
        assert len(found) >= 2
        assert text.index("drift [%]") < text.index(f"{found[0]} ")
        rows += found
    assert rows == [f"s{i}" for i in range(60)]


def test_a_wide_table_lies_on_a_sheet_on_its_long_side_and_nothing_is_cut(made: Path) -> None:
    from pypdf import PdfReader

    sheets = [sheet for sheet in PdfReader(made).pages if "Twenty measures" in sheet.extract_text()]
    assert len(sheets) == 1 and sheets[0].mediabox.width > sheets[0].mediabox.height
    ends: list[float] = []

    def collect(text: str, cm: list[float], tm: list[float], font: object, size: float) -> None:
        if re.fullmatch(r"measure\d+|\[kN·m\]", text.strip()):
            ends.append(cm[4] + cm[0] * (tm[4] + text_width(text.strip(), bold=True) * size))

    text = sheets[0].extract_text(visitor_text=collect)
    assert all(len(re.findall(rf"\b{i}12345\.678", text)) == 3 for i in range(20))
    assert len(ends) == 40  # the titles of the columns, two lines each
    assert max(ends) <= float(sheets[0].mediabox.width) - MARGIN_SIDE + 0.5  # as a cell is rounded


def test_what_is_folded_is_printed_on_demand(made: Path, tmp_path: Path) -> None:
    plain = "\n".join(_texts(made))
    assert "frame: {storeys: 3}" not in plain and "Each record" not in plain
    assert "HTML report has them: First part (2)." in plain
    page = _page(Facts((("Steel", "S275"),)), Folded("The file", text="frame: {storeys: 3}"), Folded("Each", (LONG,)))
    full = _texts(write_page_as_pdf(page, tmp_path / "full.pdf", options=PrintOptions(appendix=True)))
    begin = next(i for i, text in enumerate(full) if re.search(r"Appendix A\s+First part", text))
    assert re.search(rf"A\s+First part[ .]+{begin + 1}", full[0])
    assert "frame: {storeys: 3}" in full[begin] and "s59" in "".join(full[begin:])
    assert "HTML report has them" not in "".join(full)


def test_paper(made: Path, tmp_path: Path) -> None:
    """Sizes of ISO 216, which is that of a page of which nothing is said, and of ANSI/ASME Y14.1, inches."""
    from pypdf import PdfReader

    short = Page(COVER, (Section("one", "First part", ("What it says.",), ()),))
    letter = write_page_as_pdf(short, tmp_path / "a.pdf", options=PrintOptions(PAPERS["Letter"]))
    for path, sides in ((made, (210.0 / 25.4, 297.0 / 25.4)), (letter, (8.5, 11.0))):
        box = PdfReader(path).pages[0].mediabox
        found = (float(box.width) / 72.0, float(box.height) / 72.0)
        assert found == pytest.approx(sides, abs=3e-4)  # points are written to a hundredth


def test_the_same_page_gives_the_same_bytes(tmp_path: Path) -> None:
    page = Page(COVER, (Section("one", "First part", ("What it says.",), (WIDE, _picture("drift"))),))
    first, second = (write_page_as_pdf(page, tmp_path / f"{i}.pdf").read_bytes() for i in range(2))
    assert first == second


def test_no_heading_and_no_caption_alone(tmp_path: Path) -> None:
    """Headings come at every height of a sheet, as the facts before them are of many lengths."""
    parts: list[Part] = []
    for i in range(14):
        parts += [Heading(f"Heading {i}"), Facts(tuple((f"name {k}", "text") for k in range(3 + 2 * i)))]
    parts += [part for i in range(4) for part in (Heading(f"Heading of figure {i}"), _picture(f"figure{i}", 3.0 + i))]
    texts = _texts(write_page_as_pdf(_page(*parts), tmp_path / "report.pdf"))
    assert len(texts) > 6
    for text in texts:
        lines = [line for line in text.splitlines() if line.strip()]
        body = [line for line in lines if not line.startswith(("edesign 9.8", "Page ", "Tower", "Project number"))]
        assert body, "an empty sheet"
        assert not body[-1].startswith("Heading")
        assert not body[0].startswith("Caption of")


def test_appendices_have_letters_and_no_heading_is_left_without_content() -> None:
    assert [appendix_number(i) for i in (0, 25, 26, 52)] == ["A", "Z", "A1", "A2"]
    parts = (Heading("gone"), Folded("f", text="t"), Heading("kept"), LONG, Heading("gone too"), Folded("g", (LONG,)))
    shown = printed([Section("one", "One", (), parts), Section("two", "Two", (), parts[1:2])], appendix=False)
    assert [section.id for section in shown.sections] == ["one"]
    assert shown.sections[0].parts == (Heading("kept"), LONG)
    assert shown.left_out == ("One (2)", "Two (1)")


@pytest.mark.parametrize("text", ["ImperialValley1979_H-CHI012", "0.8513 rad", "γ_M0 ± 12 %, 35 °C"])
def test_widths_of_text_are_those_that_matplotlib_draws(text: str) -> None:
    """To the side bearings of the first and last letter, and to kerning, which the width leaves out."""
    font = matplotlib.font_manager.FontProperties(fname=str(fonts_folder() / "DejaVuSans.ttf"), size=100.0)
    drawn = TextPath((0.0, 0.0), text, prop=font).get_extents().width / 100.0
    assert drawn <= text_width(text) <= drawn + 0.3


def test_tables_get_smaller_type_before_they_lie_down() -> None:
    paper = PAPERS["A4"]
    fits = [
        fit_table(replace(WIDE, columns=WIDE.columns[:n], rows=[row[:n] for row in WIDE.rows]), paper)
        for n in (3, 11, 20)
    ]
    assert [fit.wide for fit in fits] == [False, False, True]
    assert fits[0].size > fits[1].size
    for fit in fits:
        assert fit.size * sum(fit.widths) <= (paper.long_line if fit.wide else paper.line) + 1e-9  # rounding of doubles
    broken = fit_table(plain_table("t", ["w" * 200] * 30, [["1" * 40] * 30]), paper)
    assert broken.wide and broken.size * sum(broken.widths) <= paper.long_line + 1e-9


@pytest.mark.parametrize(("width", "height"), [(400.0, 200.0), (468.0, 324.0), (900.0, 300.0), (400.0, 2000.0)])
def test_a_figure_fits_on_a_sheet(width: float, height: float) -> None:
    paper = PAPERS["Letter"]
    found = picture_size(Picture("n", "c", f'<svg viewBox="0 0 {10 * width} {10 * height}">', width), paper)
    assert found[1] / found[0] == pytest.approx(height / width)
    assert found[0] <= paper.line and found[1] < paper.column


def test_nothing_is_fetched(tmp_path: Path, caplog: pytest.LogCaptureFixture) -> None:
    """Text that looks like HTML is text; fonts are the only files that are read."""
    hostile = '<img src="https://example.org/x.png"><link rel=stylesheet href=https://example.org/x.css>'
    page = Page(replace(COVER, title=hostile), (Section("one", hostile, (hostile,), (Facts(((hostile, hostile),)),)),))
    assert "<img" not in print_text(page)
    path = write_page_as_pdf(page, tmp_path / "report.pdf")
    assert "<img src=" in _texts(path)[0]
    assert not [record for record in caplog.records if "example.org" in record.getMessage()]


def test_errors_are_for_people(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    page = _page(LONG)
    with pytest.raises(InputError, match=r"report\.html: .*\.pdf.*E-FILE-08"):
        write_page_as_pdf(page, tmp_path / "report.html")
    with pytest.raises(ArchiveError, match=r"report\.pdf: .*no does not exist.*E-FILE-06"):
        write_page_as_pdf(page, tmp_path / "no" / "report.pdf")
    monkeypatch.setitem(sys.modules, "weasyprint", None)
    with pytest.raises(InputError, match=r"pip install 'edesign\[pdf\]'.*E-CLI-06"):
        write_page_as_pdf(page, tmp_path / "report.pdf")


def test_a_missing_library_of_the_system_is_named(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """What weasyprint says where Pango is missing, from a package of that name."""
    for name in [name for name in sys.modules if name.partition(".")[0] == "weasyprint"]:
        monkeypatch.delitem(sys.modules, name)
    (tmp_path / "weasyprint.py").write_text('raise OSError("cannot load library libpango-1.0-0\\nmore")\n')
    monkeypatch.syspath_prepend(tmp_path)
    with pytest.raises(InputError, match=r"Pango(.|\n)*libpango-1.0-0(.|\n)*E-CLI-06") as raised:
        check_pdf_engine()
    assert "more" not in str(raised.value)
    monkeypatch.delitem(sys.modules, "weasyprint", raising=False)


def test_figures_of_single_records_are_printed_behind_the_sections() -> None:
    """Of a section that stands aside tables stay, figures and their headings go; nothing is lost."""
    table, loops, fold = plain_table("Peaks", ("a",), [["1"]]), _picture("loops"), Folded("More", (_picture("more"),))
    section = Section("dampers", "Dampers", (), (table, Heading("DBE"), loops, fold), aside=True)
    shown = printed([section], appendix=False)
    assert (shown.sections[0].parts, shown.left_out) == ((table,), ("Dampers (2)",))
    (appendix,) = printed([section], appendix=True).appendices
    assert appendix.parts == (Heading("DBE"), loops, Heading("More"), *fold.parts)


def test_wide_tables_of_numbers_are_cut_between_levels() -> None:
    """Nine sets of three variants at three levels with differences: the columns of a level stay together."""
    levels = ("FOE", "DBE", "MCE")
    sets = [f"{variant}, {level}" for level in levels for variant in ("bare", "elastomers", "oil_dampers")]
    made = [column.text("measure")]
    for name in sets:
        made.append(column.col(column.literal(name), ONE, lambda row: 123456.7))
        made += [column.col("diff.", ONE, lambda row: -12.3, joined=True)] * (not name.startswith("bare"))
    rows = [{"measure": f"residual interstorey drift {i}"} for i in range(3)]
    table = TableSpec[dict[str, Any]]("t", "Mean response", tuple(made), notes=("A note.",)).of(rows)
    paper = PAPERS["A4"]
    assert fit_table(table, paper).wide
    parts = upright(table, paper)
    assert [part.headers[0] for part in parts] == ["measure"] * len(parts) and len(parts) > 1
    assert [header for part in parts for header in part.headers[1:]] == table.headers[1:]
    assert all(not fit_table(part, paper).wide for part in parts)
    assert [part.title for part in parts] == ["Mean response", *[""] * (len(parts) - 1)]
    assert [list(part.notes) for part in parts] == [*[[]] * (len(parts) - 1), ["A note."]]
    for level in levels:
        assert sum(any(header.endswith(level) for header in part.headers) for part in parts) == 1
    words = plain_table("Words", [f"column{i}" for i in range(20)], [["a word " * 4] * 20])
    assert upright(words, paper) == [words]


def test_texts_of_figures_begin_where_they_stood() -> None:
    """IPE400 of 7.5 points at its middle: half of its width, measured by matplotlib, to the left; turned texts too."""
    half = 0.5 * 75.0 * TextPath((0, 0), "IPE400", size=1.0).get_extents().width
    found = begun_at_left('<text x="500" y="10" style="font-size:75px;text-anchor:middle">IPE400</text>')
    assert float(re.findall(r'x="(-?\d+)"', found)[0]) == pytest.approx(
        500 - half, abs=8.0
    )  # the blank before an I is 0.1 em
    assert "text-anchor" not in found
    turned = '<text transform="translate(5 6) rotate(-90)" style="font-size:75px;text-anchor:end">N_E<tspan/></text>'
    assert float(re.findall(r' x="(-?\d+)"', begun_at_left(turned))[0]) < 0.0
    plain = '<text x="500" y="10" style="font-size:75px">IPE400</text>'
    assert begun_at_left(plain) == plain


def test_figures_have_no_picture_for_a_text(tmp_path: Path) -> None:
    """Viewers cut the first letter of a text that is a form of its own ("PE400" for IPE400)."""
    from pypdf import PdfReader

    path = write_page_as_pdf(_page(_picture("one")), tmp_path / "a.pdf")
    assert not any(sheet["/Resources"].get("/XObject") for sheet in PdfReader(path).pages)


def test_the_share_of_a_report_is_told(tmp_path: Path) -> None:
    told: list[str] = []
    write_page_as_pdf(_page(_picture("one")), tmp_path / "a.pdf", part_of(told.append, 0.7, 1.0))
    assert [one.share for one in told if isinstance(one, Step)] == pytest.approx([0.7, 0.7 + 0.3 * WRITTEN])
    assert "laying out the PDF: sheet 1" in told
    shares = [step.share for step in steps(["summary", "model", "hinges", "provenance"])]
    assert shares[0] == 0.0 and shares == sorted(shares) and shares[-1] < 1.0
    assert str(steps(["moment_rotation"]).__next__()) == "section 1 of 1, moment rotation"
