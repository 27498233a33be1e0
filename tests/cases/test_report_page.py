"""The report as people read it: in a browser, on a phone and on a desk, offline, whatever stands in the project."""

from __future__ import annotations

import base64
import hashlib
import html
import json
import re
import shutil
import subprocess
from dataclasses import dataclass
from html.parser import HTMLParser
from pathlib import Path

import h5py
import pytest
from report_project import TITLE, write_report_project
from unit.archive.archive_samples import archived_groups

from edesign.archive.writer import ArchiveWriter
from edesign.cli.main import main
from edesign.project import load_project
from edesign.report.archive.document import page_text
from edesign.study.run.run import run_project

BROWSERS = ("chromium", "google-chrome", "chromium-browser")
FRAMED = """<!DOCTYPE html><html><body><iframe src="page.html" style="width: {width}px; height: 800px; border: 0">
</iframe><script>onload = () => {{
  const page = document.querySelector('iframe').contentWindow;
  const all = words => [...page.document.querySelectorAll(words)];
  const size = e => e.getBoundingClientRect(), ids = all('[id]').map(e => e.id);
  document.documentElement.dataset.found = JSON.stringify({{
    inner: page.innerWidth, scroll: page.document.documentElement.scrollWidth, title: page.document.title,
    wide: all('figure, pre, dl, ul, p').filter(e => size(e).right > page.innerWidth + 1).map(e => e.className),
    empty: all('.gallery svg').filter(e => size(e).width < 200 || !e.querySelector('path')).length,
    tall: all('tr').filter(e => size(e).height > 200).map(e => e.textContent.slice(0, 40)),
    figures: all('.picture svg').length, tables: all('table').length, twice: ids.length - new Set(ids).size,
    requests: page.performance.getEntriesByType('resource').map(e => e.name),
    lost: all('nav a').filter(e => !page.document.querySelector(e.hash)).length
  }});
}};</script></body></html>"""


def browser() -> str | None:
    """A browser that runs; the one of Ubuntu may be a stub that only says how to get it."""
    for name in BROWSERS:
        path = shutil.which(name)
        if path and subprocess.run([path, "--version"], capture_output=True, check=False, timeout=30).returncode == 0:
            return path
    return None


@dataclass(frozen=True)
class Made:
    """An archive and its page."""

    archive: Path
    page: Path


@pytest.fixture(scope="module")
def made(tmp_path_factory: pytest.TempPathFactory) -> Made:
    """The report of the small project, made by the command."""
    folder = tmp_path_factory.mktemp("report")
    archive = run_project(load_project(write_report_project(folder)), folder / "office.h5").archive
    assert main(["report", str(archive), "--quiet"]) == 0
    return Made(archive, folder / "office.html")


class _Outline(HTMLParser):
    """Tags with their attributes, and the text of headings, as they stand in the file."""

    def __init__(self) -> None:
        super().__init__()
        self.tags: list[tuple[str, dict[str, str | None]]] = []
        self.text: list[str] = []

    def handle_starttag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        self.tags.append((tag, dict(attrs)))

    def handle_data(self, data: str) -> None:
        self.text.append(data)


def _outline(text: str) -> _Outline:
    outline = _Outline()
    outline.feed(text)
    return outline


@pytest.mark.parametrize("width", [pytest.param(360, marks=pytest.mark.slow), 1280])
def test_page_in_a_browser(made: Made, width: int, tmp_path: Path) -> None:
    program = browser()
    if program is None:
        pytest.skip("no chromium here")
    text = made.page.read_text(encoding="utf-8")
    (tmp_path / "page.html").write_text(text.replace("<details>", "<details open>"), encoding="utf-8")
    frame = tmp_path / "frame.html"  # windows are never as narrow as a phone
    frame.write_text(FRAMED.format(width=width), encoding="utf-8")
    options = ["--headless=new", "--no-sandbox", "--disable-gpu", f"--user-data-dir={tmp_path / 'profile'}"]
    options += ["--allow-file-access-from-files", "--window-size=1400,900", "--enable-logging=stderr", "--v=0"]
    words = [*options, "--dump-dom", frame.as_uri()]
    done = subprocess.run([program, *words], capture_output=True, text=True, check=False, timeout=60)
    assert "CONSOLE" not in done.stderr
    found = json.loads(html.unescape(re.search(r'data-found="([^"]*)"', done.stdout)[1]))  # type: ignore[index]
    assert found["inner"] == width
    assert found["scroll"] <= width
    assert found["wide"] == []
    assert found["tall"] == []  # no column so narrow that its words fall apart
    assert found["requests"] == []
    assert found["lost"] == 0 and found["twice"] == 0 and found["empty"] == 0
    assert found["title"] == TITLE
    tags = [tag for tag, _ in _outline(text).tags]
    assert found["figures"] == tags.count("svg") > 8
    assert found["tables"] == tags.count("table") > 8


def test_pdf_of_an_archive(made: Made, tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """Beside the archive, with the sections and all figures of the page, the moment of the run and no other."""
    pypdf = pytest.importorskip("pypdf")
    archive = Path(shutil.copy(made.archive, tmp_path / "office.h5"))
    code = main(["report", str(archive), "--pdf", "--appendix", "--paper", "letter", "--quiet"])
    said = capsys.readouterr()
    if "Pango" in said.err or "edesign[pdf]" in said.err:
        pytest.skip(said.err)
    assert code == 0 and said.out.startswith(f"report: {tmp_path / 'office.pdf'} (")
    reader = pypdf.PdfReader(tmp_path / "office.pdf")
    texts = [re.sub(r"\s+", "", sheet.extract_text()) for sheet in reader.pages]  # without where lines are broken
    assert TITLE.replace(" ", "") in texts[0] and f"Page1of{len(texts)}" in texts[0]
    text, page = "".join(texts), made.page.read_text(encoding="utf-8")
    for caption in re.findall(r"<figcaption>(.*?)</figcaption>", page, re.DOTALL):
        words = html.unescape(re.sub(r"<[^>]*>", "", caption)).split()
        assert "".join(words[:3]) in text
    with h5py.File(archive) as file:
        created = file["provenance"].attrs["created"].decode()
    assert reader.metadata.creation_date.isoformat() == created


@pytest.mark.parametrize(
    ("words", "said"),
    [
        (["--paper", "A4"], "edesign: --paper: only a PDF has sheets; say --pdf too [E-CLI-01]\n"),
        (["--pdf", "-o", "page.html"], "edesign: page.html: the name of a PDF ends in .pdf [E-FILE-08]\n"),
    ],
)
def test_errors_of_a_pdf(made: Made, words: list[str], said: str, capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["report", str(made.archive), "--quiet", *words]) == 2
    assert capsys.readouterr().err == said


def test_sections_of_a_plain_run(made: Made) -> None:
    """It has no design, no other temperature, no incremental study: nothing empty stands for them."""
    text = made.page.read_text(encoding="utf-8")
    tags = _outline(text).tags
    there = [attributes["id"] for tag, attributes in tags if tag == "section"]
    assert there[0] == "summary" and there[-1] == "provenance"
    assert there[:5] == ["summary", "checks", "model", "assumptions", "warnings"]
    assert {"ground-motion", "modes", "response", "hinges", "histories", "dampers"} <= set(there)
    assert not {"design", "temperature", "incremental"} & set(there)
    links = [attributes["href"] for tag, attributes in tags if tag == "a"]
    assert links == ["#content", *(f"#{name}" for name in there), "#contents"]
    assert "could not be shown" not in text


def test_nothing_is_fetched_and_only_the_viewer_runs(made: Made) -> None:
    text = made.page.read_text(encoding="utf-8")
    outline = _outline(text)
    scripts = re.findall(r"<script([^>]*)>(.*?)</script>", text, re.DOTALL)
    assert [words for words, _ in scripts] == [' type="application/json"'] * (len(scripts) - 1) + [""]
    digest = base64.b64encode(hashlib.sha256(scripts[-1][1].encode()).digest()).decode()
    assert re.findall(r"script-src ([^;\"]*)", text) == [f"'sha256-{digest}'"]  # the viewer runs, nothing else
    assert not re.search(r"fetch\(|XMLHttp|import\(|eval\(|https?://(?!www\.w3\.org/2000/svg)", scripts[-1][1])
    assert not {"img", "iframe", "object", "embed", "video"} & {tag for tag, _ in outline.tags}
    for tag, attributes in outline.tags:
        assert not any(name.startswith("on") or name in ("src", "srcset") for name in attributes), tag
        assert (attributes.get("href") or "#").startswith(("#", "data:,")), attributes
    assert not re.search(r"@import|url\((?!#)", text)
    assert "default-src 'none'" in text


def test_text_of_the_project_is_text(made: Made) -> None:
    """In the title, as heading, and in the file to the letter, where YAML has its quotes doubled."""
    text = "".join(_outline(made.page.read_text(encoding="utf-8")).text)
    assert text.count(TITLE) == 2
    assert text.count(TITLE.replace("'", "''")) == 1


def test_numbers_of_the_summary_are_those_of_the_archive(made: Made) -> None:
    """The tile of the drift against the envelopes, read with h5py alone."""
    with h5py.File(made.archive) as file:
        drifts = [
            max(abs(file[f"analyses/{name}/storey_drift_{end}"][()]).max() for end in ("max", "min"))
            for name in ("bare.DBE", "damped.DBE")
        ]
    text = made.page.read_text(encoding="utf-8")
    tile = re.search(r"Interstorey drift at DBE</span>\s*<span class=\"value\">([\d.]+) → ([\d.]+)", text)
    assert tile is not None
    assert [float(value) for value in tile.groups()] == pytest.approx([100.0 * d for d in drifts], rel=0.005)


def test_failed_and_missing_analyses_are_named(made: Made, tmp_path: Path) -> None:
    """A copy of the archive in which one history failed, one is still to come, and the run goes on."""
    groups = archived_groups(made.archive)
    groups["analyses/bare.MCE"].attributes |= {"status": "failed", "reason": "no equilibrium at 3.21 s <b>here</b>"}
    del groups["analyses/damped.DBE"]
    with ArchiveWriter(tmp_path / "office.h5", groups.pop("")) as writer:
        for place, group in groups.items():
            writer.write(place, group)
        archive = writer.partial
    text = page_text(archive)
    assert "no equilibrium at 3.21 s &lt;b&gt;here&lt;/b&gt;" in text
    assert re.search(r"bare, MCE, motion: no equilibrium", text[: text.index('id="inputs"')])
    banner = text[text.index("banner") : text.index('id="contents"')]
    assert "1 of 6 analyses have no result yet" in banner


@pytest.mark.parametrize("name", ["missing.h5", "folder"])
def test_errors_are_for_people(name: str, tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    (tmp_path / "folder").mkdir()
    assert main(["report", str(tmp_path / name)]) == 4
    said = capsys.readouterr().err
    assert str(tmp_path / name) in said and "Traceback" not in said
    assert not list(tmp_path.glob("*.html"))


@pytest.mark.parametrize("name", ["office.h5", "office.yaml", "office"])
def test_the_page_takes_no_other_file_s_place(
    made: Made, tmp_path: Path, name: str, capsys: pytest.CaptureFixture[str]
) -> None:
    """Neither the archive it is made of nor the user's files: the ending says whether a page may be written."""
    archive = Path(shutil.copy(made.archive, tmp_path / "office.h5"))
    (tmp_path / "office.yaml").write_text("edesign: 1\n", encoding="utf-8")
    before = {path.name: path.read_bytes() for path in tmp_path.iterdir()}
    assert main(["report", str(archive), "--output", str(tmp_path / name), "--quiet"]) == 2
    assert (
        capsys.readouterr().err == f"edesign: {tmp_path / name}: the name of a page ends in .html or .htm [E-FILE-08]\n"
    )
    assert {path.name: path.read_bytes() for path in tmp_path.iterdir()} == before


def test_a_study_without_its_text_is_damaged(made: Made, tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    root = archived_groups(made.archive)[""]
    root.attributes["kind"] = "study"
    with ArchiveWriter(tmp_path / "office.h5", root) as writer:
        archive = writer.finish({"status": "completed"})
    assert main(["show", str(archive)]) == 4
    assert capsys.readouterr().err.endswith("damaged: the text of the study (`study_text`) is missing [E-ARCH-03]\n")
