"""Text of tables: its encoding, its lines, and the numbers and clock times in its cells."""

from __future__ import annotations

import codecs
import math
import re
from collections.abc import Sequence
from dataclasses import dataclass
from datetime import date
from pathlib import Path

from edesign.errors import InputError
from edesign.project.notation.table_format import Decimal, Encoding, TableFormat
from edesign.project.reading.file_bytes import read_file
from edesign.project.reading.limits import LINE_CHARACTERS, TABLE_ADVICE, TABLE_CELLS, TABLE_COLUMNS, TABLE_LINES
from edesign.tables.binary import describe_binary

_CODECS: dict[Encoding, str] = {
    "utf-8": "utf-8-sig",
    "utf-16": "utf-16",
    "latin-1": "latin-1",
    "windows-1252": "cp1252",
    "gbk": "gb18030",
    "shift-jis": "cp932",
}
_EAST_ASIAN: dict[Encoding, re.Pattern[str]] = {  # words of headers, which no text in another encoding shows by chance
    "gbk": re.compile("时间|位移|荷载|载荷|负荷|温度|加速度"),
    "shift-jis": re.compile("時間|変位|荷重|温度|加速度"),
}
_DAY = 86400.0  # s
_HEAD = 1 << 16  # bytes that show an encoding
_UTF_16_SHARE = 0.3  # of bytes at even, or odd, places that are zero: those of ASCII in UTF-16 are, all but a few
_LINE_END = re.compile(r"\r\n|\r|\n")
_PAGE_END = re.compile(r"\f+(?=[\r\n]|\Z)|(?<=[\r\n])\f+|\A\f+")
"""Form feeds where a line ends or begins; others part lines."""
_D_EXPONENT = re.compile(r"(?<![\w.])([-+]?(?:\d+\.\d*|\.\d+))[dD]([-+]\d{1,3})(?![\w.])")
"""Of Fortran's numbers of double precision: `0.1D-02`."""
_CLOCK = re.compile(
    r"(?:(?:(?P<year>\d{4})[-/.](?P<month>\d{1,2})[-/.](?P<day>\d{1,2})"
    r"|(?P<day_first>\d{1,2})\.(?P<month_second>\d{1,2})\.(?P<year_last>\d{4}))[ T]+)?"
    r"(?P<hour>\d{1,3}):(?P<minute>\d{2}):(?P<second>\d{2}(?:[.,]\d*)?)"
)


@dataclass(frozen=True)
class TableText:
    """The lines of a table without comments and blank lines.

    Attributes:
        path: the file.
        encoding: of the file.
        numbers: of the lines, from 1.
        lines: those that are neither skipped, blank nor comments.
        last: number of the last line of the file.
        mark: maker whose format the file has; empty: it is recognised by marks in the lines, if at all.
        decimal: sign before the decimals as the file says it; None: it does not.
        above: lines above the headers that were left out.
    """

    path: Path
    encoding: Encoding
    numbers: list[int]
    lines: list[str]
    last: int
    mark: str = ""
    decimal: Decimal | None = None
    above: int = 0


def table_text(
    path: Path,
    what: str,
    given: TableFormat | None = None,
    comments: tuple[str, ...] = ("#",),
    content: bytes | None = None,
    blank: str | None = " \t,;",
) -> TableText:
    """Read the lines of a table.

    Args:
        what: it is, for messages.
        given: what is said of its format.
        comments: signs with which lines begin that are skipped.
        content: of the file, if it has been read.
        blank: signs that a line may have and still be blank; None: white space.

    Raises:
        InputError: the file cannot be read, or is no text in the encoding that is said.
    """
    data = read_file(path, what) if content is None else content
    encoding, text = decoded(path, data, given.encoding if given else None)
    skip = given.skip or 0 if given else 0
    lines = lines_of(path, text)
    last = len(lines) - (lines[-1] == "")
    kept = [
        (i, line)
        for i, line in enumerate(lines, 1)
        if i > skip and line.strip(blank) and not line.lstrip().startswith(comments)
    ]
    return TableText(path, encoding, [i for i, _ in kept], [line for _, line in kept], last)


def lines_of(path: Path, text: str) -> list[str]:
    """Return the lines of a text; of Fortran's numbers `0.1D-02` is `0.1E-02`.

    Lines end as those of any system do, also with the two carriage returns that a transfer may leave, or with a page.

    Args:
        path: the file, for messages.
        text: its content.

    Raises:
        InputError: there are more lines than are read, or a longer one.
    """
    if "\f" in text:
        text = _PAGE_END.sub("", text).replace("\f", "\n")
    text = text.replace("\r\r\n", "\n").replace("\r\n", "\n").replace("\r", "\n")
    if text.count("\n") > TABLE_LINES:
        raise InputError(
            f"{path}:{TABLE_LINES + 1}: more lines than the {TABLE_LINES} that are read: {TABLE_ADVICE} [E-TABLE-03]"
        )
    if (count := max(map(text.count, ",;\t"))) > TABLE_CELLS:
        raise InputError(
            f"{path}: the table has {count} cells; at most {TABLE_CELLS} are read: {TABLE_ADVICE} [E-TABLE-03]"
        )
    if any(sign in text for sign in ("D+", "D-", "d+", "d-")):
        text = _D_EXPONENT.sub(r"\1E\2", text)
    lines = text.split("\n")
    for i, line in enumerate(lines, 1):
        if len(line) > TABLE_COLUMNS:  # one with less has no more cells
            _check_line(f"{path}:{i}", line)
    return lines


def _check_line(where: str, line: str) -> None:
    if len(line) > LINE_CHARACTERS:
        raise InputError(
            f"{where}: the line has {len(line)} characters; at most {LINE_CHARACTERS} are read: is this a table of "
            "numbers? [E-TABLE-03]"
        )
    width = max(len(line.split()), *(1 + line.count(sign) for sign in ",;\t"))
    if width > TABLE_COLUMNS:
        raise InputError(
            f"{where}: the line has {width} cells; at most {TABLE_COLUMNS} are read: write samples below each other, "
            "or export less channels [E-TABLE-03]"
        )


def decoded(path: Path, data: bytes, given: Encoding | None = None) -> tuple[Encoding, str]:
    """Decode a text file.

    Args:
        path: the file, for messages.
        data: its content.
        given: encoding that is said; found from the content if None.

    Returns:
        Encoding and text.

    Raises:
        InputError: it is no text in this encoding, or in none that is found.
    """
    encoding = given or encoding_of(data)
    if encoding is None:
        seen = describe_binary(data) or "a text file in UTF-8 or UTF-16 is expected"
        raise InputError(f"{path}: this is not a text file; {seen} [E-TABLE-01]")
    codec = _CODECS[encoding]
    if encoding == "utf-16" and not data.startswith((codecs.BOM_UTF16_LE, codecs.BOM_UTF16_BE)):
        codec = "utf-16-le" if data[1:2] == b"\0" else "utf-16-be"
    try:
        text = data.decode(codec)
    except UnicodeDecodeError as error:
        line = len(_LINE_END.findall(data[: error.start].decode(codec, errors="replace"))) + 1
        how = "as `encoding` says" if given else "as its beginning has it; is the file cut off or damaged?"
        raise InputError(f"{path}:{line}: this is no text in {encoding}, {how} [E-TABLE-01]") from None
    if "\0" in text:
        raise InputError(f"{path}: this is not a text file in {encoding} [E-TABLE-01]")
    return encoding, text


def encoding_of(data: bytes) -> Encoding | None:
    """Return the encoding of a text file; None: no text.

    Marks and zero bytes show UTF-16, and what is valid UTF-8 is that. Of the others, GBK and Shift-JIS are taken
    where they give words of headers, and Windows-1252 or Latin-1 if not.
    """
    if data.startswith((codecs.BOM_UTF16_LE, codecs.BOM_UTF16_BE)):
        return "utf-16"
    if b"\0" in data:
        head = data[:_HEAD]
        zeros = max(head[0::2].count(0), head[1::2].count(0))
        return "utf-16" if zeros > _UTF_16_SHARE * len(head) and len(data) % 2 == 0 else None
    try:
        data.decode("utf-8-sig")
        return "utf-8"
    except UnicodeDecodeError:
        pass
    for encoding, words in _EAST_ASIAN.items():
        try:
            if words.search(data.decode(_CODECS[encoding])):
                return encoding
        except UnicodeDecodeError:
            pass
    try:
        data.decode("cp1252")
    except UnicodeDecodeError:
        return "latin-1"
    return "windows-1252"


def is_number(cell: str) -> bool:
    """Return whether a cell is a number as Python reads it, infinite and nan too, without `_` between digits."""
    try:
        float(cell)
    except ValueError:
        return False
    return "_" not in cell


def like_number(cell: str) -> bool:
    """Return whether a cell is a number, also one with a decimal comma, or a clock time."""
    return is_number(cell.replace(",", ".")) or is_clock(cell)


def number(word: str, path: Path, line: int, what: str = "an acceleration") -> float:
    """Read a finite number.

    Args:
        word: the cell.
        path: of the file, for messages.
        line: number of the line, from 1.
        what: what the number is, for messages.

    Raises:
        InputError: `word` is none; the message names file, line (from 1) and what was expected.
    """
    if not is_number(word):
        raise InputError(f"{path}:{line}: `{word[:40]}` is not a number; {what} is expected here [E-TABLE-08]")
    value = float(word)
    if not math.isfinite(value):
        raise InputError(f"{path}:{line}: `{word[:40]}` is not a finite number; {what} is expected here [E-TABLE-08]")
    return value


def is_clock(cell: str) -> bool:
    """Return whether a cell is a time of a clock, such as `13:05:07.250`, with a date before it or without."""
    return _CLOCK.fullmatch(cell.strip()) is not None


def clock_seconds(path: Path, cells: Sequence[str], numbers: Sequence[int]) -> list[str]:
    """Return seconds since the first of clock times, to nanoseconds, as text.

    Times without a date that go back by more than half a day have gone over midnight.

    Args:
        path: of the file, for messages.
        numbers: numbers of their lines in the file, from 1.

    Raises:
        InputError: a cell is no clock time, some have a date and others not, or a date does not exist.
    """
    seconds: list[float] = []
    first_day: int | None = None
    midnights = 0  # gone over by times without a date
    for cell, line in zip(cells, numbers, strict=True):
        match = _CLOCK.fullmatch(cell.strip())
        if match is None:
            raise InputError(
                f"{path}:{line}: `{cell[:40]}` is no clock time, as `{cells[0].strip()}` in the first row [E-TABLE-16]"
            )
        day = 0
        try:
            if match["year"]:
                day = date(int(match["year"]), int(match["month"]), int(match["day"])).toordinal()
            elif match["year_last"]:  # with points the day stands first in every country that writes so
                day = date(int(match["year_last"]), int(match["month_second"]), int(match["day_first"])).toordinal()
        except ValueError:
            raise InputError(f"{path}:{line}: `{cell[:40]}`: there is no such day [E-TABLE-16]") from None
        first_day = day if first_day is None else first_day
        if (day == 0) != (first_day == 0):
            raise InputError(
                f"{path}:{line}: `{cell[:40]}`: some clock times have a date, and others none [E-TABLE-16]"
            )
        of_day = 3600.0 * int(match["hour"]) + 60.0 * int(match["minute"]) + float(match["second"].replace(",", "."))
        since_first = _DAY * (day - first_day + midnights) + of_day
        if day == 0 and seconds and -_DAY < since_first - seconds[-1] < -_DAY / 2.0:
            midnights, since_first = midnights + 1, since_first + _DAY
        seconds.append(since_first)
    return [f"{value - seconds[0]:.9f}" for value in seconds]
