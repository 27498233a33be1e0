"""Texts of users and of archives that would act on a terminal are shown, on every way by which a command prints."""

from __future__ import annotations

import io
import json
import re
import sys
import unicodedata
from pathlib import Path

import pytest
from support.plain_tables import plain_table
from unit.assess.known_history import known_history

from edesign.archive.dataset import Group
from edesign.archive.writer import ArchiveWriter
from edesign.cli.main import main
from edesign.cli.shared.progress import listener
from edesign.cli.shared.streams import visible_streams
from edesign.report.tables.text import print_tables
from edesign.report.tables.visible import visible, visible_line
from edesign.study.run.progress import Progress

HOSTILE = "a\x1b]0;owned\x07 \x9b31m \x7f \u202etxt\u2066 [red]b[/red] [link=http://x]c[/link] :warning: \\"
SHOWN = r"a\u001b]0;owned\u0007 \u009b31m \u007f \u202etxt\u2066 [red]b[/red] [link=http://x]c[/link] :warning: " + "\\"
STYLES = re.compile(r"\x1b\[[0-9;?]*[A-Za-z]")  # colours, and the movements of a bar


class Terminal(io.StringIO):
    """A stream that says it is a terminal."""

    encoding = "utf-8"

    def isatty(self) -> bool:
        return True


@pytest.fixture
def archive(tmp_path: Path) -> Path:
    """What somebody else may send: nothing that a project file would allow as a name."""
    root = Group(attributes={"title": f"{HOSTILE}\nsecond line", "planned": ["one"], "project_file": HOSTILE})
    with ArchiveWriter(tmp_path / "a.h5", root) as writer:
        group = known_history(status="failed")
        group.attributes |= {"order": 0, "name": "one", "variant": HOSTILE, "level": "a\tb\r\nc", "reason": HOSTILE}
        writer.write("analyses/one", group)
        return writer.finish({"status": "failed"})


def acting(text: str) -> list[str]:
    """The characters of a text that a terminal obeys; line feeds are its own."""
    bidirectional = ("LRE", "RLE", "PDF", "LRO", "RLO", "LRI", "RLI", "FSI", "PDI")
    return [
        one
        for one in text
        if one != "\n" and (unicodedata.category(one) == "Cc" or unicodedata.bidirectional(one) in bidirectional)
    ]


def test_every_control_and_bidirectional_character_is_written_out() -> None:
    """The categories are those of the Unicode database, not of this code."""
    everything = "".join(map(chr, range(sys.maxunicode + 1)))
    assert acting(visible_line(everything)) == [] and "\n" not in visible_line(everything)
    assert visible("one\n\ttwo\r") == "one\n\ttwo\\u000d" and visible_line("one\n\ttwo") == r"one\n\ttwo"
    assert visible(HOSTILE) == SHOWN
    assert visible("größer ≥ 中 😀 \u05d0\u200d") == "größer ≥ 中 😀 \u05d0\u200d"  # letters and joiners stay


def test_tables_in_a_pipe_and_on_a_terminal(
    archive: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    assert main(["show", str(archive), "--all"]) == 0
    plain = capsys.readouterr().out
    assert acting(plain) == [] and plain.startswith(SHOWN + r"\nsecond line" + "\narchive ")
    rows = [line for line in plain.splitlines() if line.startswith("one ")]  # in parts, as the table is wide
    assert any(SHOWN in row for row in rows) and any(r"a\tb\u000d\nc" in row for row in rows)
    monkeypatch.setenv("TERM", "xterm")
    monkeypatch.setenv("COLUMNS", "400")
    terminal = Terminal()
    monkeypatch.setattr(sys, "stdout", terminal)
    assert main(["show", str(archive)]) == 0
    coloured = terminal.getvalue()
    assert "\x1b[1m" in coloured and acting(STYLES.sub("", coloured)) == []
    assert coloured.count(SHOWN) >= 3  # title, variant, reason: brackets and colons stay as they are
    assert sys.stdout is terminal  # as it was before


def test_json_stays_json_with_the_same_values(archive: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["show", str(archive), "--json"]) == 0
    text = capsys.readouterr().out
    assert acting(text) == []
    (analysis,) = json.loads(text)["analyses"]
    assert (analysis["variant"], analysis["level"]) == (HOSTILE, "a\tb\r\nc")


def test_messages_of_errors(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    for words, code in (
        (["check", str(tmp_path / HOSTILE)], 2),  # the name of a file
        (["show", str(tmp_path / "\udcff.h5")], 4),  # one that is no UTF-8
        (["show", f"--{HOSTILE}"], 2),  # what typer says
        (["laws", HOSTILE], 2),
    ):
        assert main(words) == code
        output, errors = capsys.readouterr()
        assert output == "" and acting(errors) == [] and ("1b]0;owned" in errors or r"\udcff.h5" in errors)


def test_progress_in_a_log_and_on_a_terminal(monkeypatch: pytest.MonkeyPatch) -> None:
    reports = [
        Progress("note", message=HOSTILE, count=1),
        Progress("start", HOSTILE, 1, 1),
        Progress("advance", HOSTILE, 1, 1, 0.5),
        Progress("end", HOSTILE, 1, 1, 1.0, f"failed: {HOSTILE}", 1.0),
    ]
    monkeypatch.setenv("TERM", "xterm")
    monkeypatch.setenv("COLUMNS", "400")
    for stream, least in ((io.StringIO(), 3), (Terminal(), 4)):  # a log has a line at the end alone
        monkeypatch.setattr(sys, "stderr", stream)
        with visible_streams(), listener() as listen:
            for report in reports:
                listen(report)
        text = STYLES.sub("", stream.getvalue()).replace("\r", "")
        assert acting(text) == [] and text.count(SHOWN) >= least


def test_a_stream_of_ascii_takes_all_texts(monkeypatch: pytest.MonkeyPatch) -> None:
    """As with PYTHONIOENCODING=ascii; JSON stays JSON there too."""
    raw = io.BytesIO()
    monkeypatch.setattr(sys, "stdout", io.TextIOWrapper(raw, encoding="ascii", newline="\n"))
    with visible_streams():
        print(json.dumps("m² 😀 \x9b", ensure_ascii=False), flush=True)
        print_tables([plain_table("中", ("m²",), [["1"]])])
        sys.stdout.flush()
        assert not hasattr(sys.stdout, "buffer")  # by which bytes would pass
    lines = raw.getvalue().decode("ascii").splitlines()
    assert json.loads(lines[0]) == "m² 😀 \x9b" and lines[1] == r"\u4e2d"
