"""Names and places that the file system refuses: a line that names them, the right exit code, and no traceback."""

from __future__ import annotations

import os
from pathlib import Path

import pytest
from building_examples import SMALL
from support.messages import says
from unit.archive.archive_samples import history_group
from unit.cli.small_project import Core, project

import edesign.cli.run  # noqa: F401  loads what keeps `load_project` before a test replaces it
from edesign.archive.dataset import Group
from edesign.archive.files import check_file, check_folder, write_text
from edesign.archive.reader import open_archive
from edesign.archive.writer import ArchiveWriter
from edesign.cli.main import main
from edesign.errors import ArchiveError, InputError
from edesign.project import loader
from edesign.project.reading.file_bytes import read_file
from edesign.study.run import analyses, run

LONG = "n" * 253  # and .h5 is 256; a file system takes 255
FITS = "n" * 252  # with .h5 it is a name, and with .h5.partial none
AWKWARD = {"long": LONG, "fits": FITS, "null": "a\0b", "surrogate": "a\udcff"}


@pytest.fixture
def whole(tmp_path: Path) -> Path:
    with ArchiveWriter(tmp_path / "a.h5", Group(attributes={"title": "t", "planned": ["x"]})) as writer:
        writer.write("analyses/x", history_group())
        return writer.finish({"status": "completed"})


def said(capsys: pytest.CaptureFixture[str]) -> str:
    text = capsys.readouterr().err
    assert "Traceback" not in text and "error in edesign itself" not in text
    return text


@pytest.mark.parametrize("name", [LONG, FITS])
def test_a_run_refuses_a_long_name_before_it_computes(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str], name: str
) -> None:
    core = Core()
    monkeypatch.setattr(analyses, "run_analysis", core)
    monkeypatch.setattr(run, "check_inputs", lambda *_: {})  # the small project has no frame
    monkeypatch.setattr(run, "project_warnings", lambda *_: [])
    monkeypatch.setattr(loader, "load_project", lambda path, *_, **__: project(tmp_path, "ab"))
    assert main(["run", "project.yaml", "--archive", str(tmp_path / f"{name}.h5")]) == 4
    assert says(said(capsys), f"{name}.h5: E-FILE-06") and core.ran == []


@pytest.mark.parametrize("command", ["show", "report", "compare"])
@pytest.mark.parametrize("place", ["long", "loop", "below a file", "surrogate", "fifo"])
def test_archives_that_cannot_be_read(
    tmp_path: Path, whole: Path, capsys: pytest.CaptureFixture[str], command: str, place: str
) -> None:
    (tmp_path / "loop.h5").symlink_to("loop.h5")
    os.mkfifo(tmp_path / "pipe.h5")
    name = {"loop": "loop", "below a file": "a.h5/b", "fifo": "pipe"}.get(place) or AWKWARD[place]
    (tmp_path / "reference.yaml").write_text(
        "edesign_reference: 1\ntitle: t\ntables:\n- {title: a, kind: variables, group: analyses/x, over: floor, "
        "rows: [{variable: u, label: u, unit: m, values: [1, 2, 3]}]}\n",
        encoding="utf-8",
    )
    words = [
        command,
        str(tmp_path / f"{name}.h5"),
        *{"show": [], "report": ["-o", str(tmp_path / "a.html")], "compare": [str(tmp_path / "reference.yaml")]}[
            command
        ],
    ]
    assert main(words) == 4
    assert words[1].encode("utf-8", "backslashreplace").decode() in said(capsys)


@pytest.mark.parametrize("name", [LONG, "f" * 245])  # the second with .html alone is a name
def test_pages_that_cannot_be_written(
    whole: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch, name: str
) -> None:
    """Reported before the archive is read."""
    monkeypatch.setattr(
        "edesign.report.archive.document.read_archive", lambda *_: pytest.fail("made before it was refused")
    )
    assert main(["report", "--quiet", str(whole), "--output", str(tmp_path / f"{name}.html")]) == 4
    assert says(said(capsys), f"{name}.html: E-FILE-06")
    (tmp_path / "folder.html").mkdir()
    assert main(["report", "--quiet", str(whole), "--output", str(tmp_path / "folder.html")]) == 4
    assert says(said(capsys), "folder.html: E-FILE-06")


@pytest.mark.parametrize("kind", AWKWARD)
def test_files_that_cannot_be_written(tmp_path: Path, kind: str) -> None:
    path = tmp_path / f"{AWKWARD[kind]}.csv"
    if kind == "surrogate":  # a name that is no text is a name all the same
        write_text("a\udcff\n", path)
        assert path.read_bytes() == b"a\\udcff\n"
        return
    for write in (check_file, lambda place: write_text("a\n", place)):
        with pytest.raises(ArchiveError, match="(too long|embedded null).*E-FILE-06"):
            write(path)
    assert list(tmp_path.iterdir()) == []


@pytest.mark.parametrize("name", [LONG + "nnn", "a\0b", "loop/x", "file/x"])
def test_folders_that_cannot_be_used(tmp_path: Path, name: str) -> None:
    (tmp_path / "loop").symlink_to("loop")
    (tmp_path / "file").write_text("", encoding="utf-8")
    with pytest.raises(ArchiveError, match=str(tmp_path)):
        check_folder(tmp_path / name)


@pytest.mark.parametrize("name", [LONG + "nnn", "a\0b", "loop", "file/x", "folder", "missing"])
def test_inputs_that_cannot_be_read(tmp_path: Path, name: str) -> None:
    (tmp_path / "loop").symlink_to("loop")
    (tmp_path / "file").write_text("", encoding="utf-8")
    (tmp_path / "folder").mkdir()
    with pytest.raises(InputError, match="law file.*E-FILE-0[12]"):
        read_file(tmp_path / name, "law file")


@pytest.mark.parametrize("kind", ["null", "surrogate"])
def test_archives_of_awkward_names(tmp_path: Path, kind: str) -> None:
    path = tmp_path / f"{AWKWARD[kind]}.h5"
    root = Group(attributes={"title": AWKWARD[kind], "project_file": f"{AWKWARD[kind]}.yaml"})
    if kind == "null":
        with pytest.raises(ArchiveError, match="embedded null byte.*E-FILE-06"):
            ArchiveWriter(path, root)
        return
    with ArchiveWriter(path, root) as writer:
        writer.finish()
    with open_archive(path) as archive:
        assert archive.attributes["title"] == "a\\udcff"


def test_names_that_are_no_text_are_printed(whole: Path, tmp_path: Path) -> None:
    """On a standard output that takes UTF-8 alone."""
    import subprocess
    import sys

    path = whole.rename(tmp_path / "a\udcff.h5")
    words = [sys.executable, "-m", "edesign", "show", str(path)]
    ended = subprocess.run(
        words, capture_output=True, env={**os.environ, "PYTHONIOENCODING": "utf-8:strict"}, check=False
    )
    assert ended.returncode == 0 and rb"a\udcff.h5" in ended.stdout


def test_a_file_that_a_project_names(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """Too long a name, and one with a null byte, which YAML can write."""
    assert main(["new", str(tmp_path / "p")]) == 0
    path = tmp_path / "p" / "project.yaml"
    text = path.read_text(encoding="utf-8")
    for name in (LONG + "nnn", r"a\0b"):
        begin = text.index("records:")
        changed = text[:begin] + f'records:\n  odd: {{file: "{name}"}}\n' + text[begin + len("records:\n") :]
        path.write_text(changed, encoding="utf-8")
        assert main(["check", str(path)]) == 2
        assert says(said(capsys), "records.odd.file: E-FILE-01")


@pytest.mark.parametrize(
    ("words", "code", "text"),
    [
        (["extract", "a.yaml", "--frame", "X1", "--output", "-"], 2, "-: .yaml E-FILE-08"),
        (["design", "a.yaml", "--output", "a.h5"], 2, "a.h5: .yaml E-FILE-08"),
        (["sections", "IPE300", "--csv", "-"], 2, "-: .csv E-FILE-08"),
        (["sections", "IPE300", "--csv", "/proc/x.csv"], 4, "/proc E-FILE-06"),
    ],
)
def test_outputs_are_refused_before_anything_is_made(
    tmp_path: Path,
    monkeypatch: pytest.MonkeyPatch,
    capsys: pytest.CaptureFixture[str],
    words: list[str],
    code: int,
    text: str,
) -> None:
    """Nobody writes to standard output with `-`; to an administrator even /proc seems to be writable."""
    monkeypatch.chdir(tmp_path)
    Path("a.yaml").write_text(SMALL, encoding="utf-8")
    assert main(words) == code and says(said(capsys), text)
    assert [path.name for path in tmp_path.iterdir()] == ["a.yaml"]
