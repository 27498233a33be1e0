"""Lists what is hard to read in the docs: sentences of more than 25 words, lines of more than 100 characters.

Usage: python tools/prose.py [PAGE...]               what stands where
       python tools/prose.py --counts               how much there is of both, page by page
       python tools/prose.py --wrap PAGE...         break the lines of paragraphs that have too long ones
       python tools/prose.py --renew                write tests/unit/docs/prose.yaml after a page became better

A table cell counts as sentences of its own. Code, tables' rulers, links' addresses, generated pages, and what a tool
writes between `<!-- begin` and `<!-- end` do not count. Rows of tables, which cannot be broken, may be longer than a
line, and a line may be long by the address of a link.
"""

from __future__ import annotations

import re
import sys
import textwrap
from collections.abc import Iterator
from pathlib import Path

import yaml

ROOT = Path(__file__).resolve().parents[1]
BASELINE = ROOT / "tests" / "unit" / "docs" / "prose.yaml"
WORDS, LENGTH = 25, 100
WRAPPED = 96
"""Length of the lines that --wrap makes: the next change of a word need not break them again."""
GENERATED = re.compile(r"^<!-- (?:written by|Made from) ", re.MULTILINE)
_FENCE = re.compile(r"^```.*?^```$", re.DOTALL | re.MULTILINE)
_BLOCK = re.compile(r"(?:^|(?<=\n\n))(?:(?: {4}|\t).*\n|\n(?= {4}))+", re.MULTILINE)
_WRITTEN = re.compile(r"^<!-- begin .*?^<!-- end", re.DOTALL | re.MULTILINE)
_LINK = re.compile(r"!?\[([^\]]*)\]\([^)]*\)")
_END = re.compile(r"(?<=[.!?:;])\s+(?=[\"`(\[*]*[A-Z0-9`])")
_STARTS = re.compile(r"(?:[-*] |\d+\. |#|\||<!--|!\[|:::)")
_WORD = re.compile(r"[A-Za-z]{2,}|\ba\b")


def pages() -> dict[str, Path]:
    """Pages that people wrote, by their paths below the root: those of docs, and README.md."""
    found = [*sorted((ROOT / "docs").rglob("*.md")), ROOT / "README.md"]
    return {
        path.relative_to(ROOT).as_posix(): path
        for path in found
        if not GENERATED.search(path.read_text(encoding="utf-8"))
    }


def long_lines(text: str) -> Iterator[tuple[int, str]]:
    """Lines of prose that are too long, with their numbers from 1.

    Args:
        text: of a page.

    Returns:
        Number and line; rows of tables and lines that a link makes long are left out.
    """
    for number, line in enumerate(_blank_code(text).splitlines(), 1):
        if len(line) > LENGTH and not line.startswith("|") and len(_LINK.sub(r"\1", line)) > LENGTH:
            yield number, line


def long_sentences(text: str) -> Iterator[tuple[int, str]]:
    """Sentences of prose that are too long, with the number of the line in which they begin.

    Args:
        text: of a page.

    Returns:
        Number and sentence.
    """
    paragraph: list[str] = []
    start = 1
    for number, line in enumerate([*_blank_code(text).splitlines(), ""], 1):
        if line.startswith("|"):
            for cell in re.split(r"(?<!\\)\|", line):
                yield from _long(cell, number)
        starts_anew = _STARTS.match(line.lstrip()) is not None
        if not line.strip() or starts_anew:
            yield from _long(" ".join(paragraph), start)
            paragraph, start = [], number
        if line.strip() and not line.startswith(("|", "#", "<!--")):
            start = start if paragraph else number
            paragraph.append(line.strip())


def _long(text: str, number: int) -> Iterator[tuple[int, str]]:
    for sentence in _END.split(_LINK.sub(r"\1", text)):
        if len(_WORD.findall(re.sub(r"`[^`]*`", " code ", sentence))) > WORDS:
            yield number, sentence.strip()


def _blank_code(text: str) -> str:
    """The page with code and what tools write empty, so that numbers of lines stay."""
    for pattern in (_WRITTEN, _FENCE, _BLOCK):
        text = pattern.sub(lambda found: "\n" * found[0].count("\n"), text)
    return text


def wrapped(text: str) -> str:
    """Break the lines of paragraphs and items of lists that have too long ones.

    Args:
        text: of a page.

    Returns:
        The page; code, tables, headings and what another tool writes between `<!-- begin` and `<!-- end` stay.
    """
    lines, blank, made = text.splitlines(), _blank_code(text).splitlines(), list[str]()
    at, written = 0, False
    while at < len(lines):
        written = (written or lines[at].startswith("<!-- begin")) and not lines[at].startswith("<!-- end")
        if written or not blank[at].strip() or blank[at].startswith(("|", "#", "<!--", "!", ":::", " ")):
            made.append(lines[at])
            at += 1
            continue
        end = at + 1
        while end < len(lines) and blank[end].strip() and not _STARTS.match(blank[end]):
            end += 1
        part = lines[at:end]
        made += _filled(part) if any(len(line) > LENGTH for line in part) else part
        at = end
    return "\n".join(made) + "\n"


def _filled(part: list[str]) -> list[str]:
    item = re.match(r"(?:[-*] |\d+\. )?", part[0])
    indent = " " * len(item[0] if item else "")
    # what would begin a list or a heading at the beginning of a line stays with the word before it
    kept = re.sub(r" (?=(?:[-+*>#]|\d+\.) )", "\0", " ".join(line.strip() for line in part))
    filled = textwrap.wrap(kept, WRAPPED, subsequent_indent=indent, break_long_words=False, break_on_hyphens=False)
    return [line.replace("\0", " ") for line in filled]


def counts() -> dict[str, dict[str, int]]:
    """How many long sentences and lines each page has; pages without any are left out."""
    found = {}
    for name, path in pages().items():
        text = path.read_text(encoding="utf-8")
        both = {"sentences": len([*long_sentences(text)]), "lines": len([*long_lines(text)])}
        if any(both.values()):
            found[name] = both
    return found


def main(words: list[str]) -> None:
    """Print or write what is asked for."""
    if "--renew" in words:
        BASELINE.write_text(
            "# Long sentences and lines that pages still have; written by tools/prose.py --renew. It may only shrink.\n"
            + yaml.safe_dump(counts(), default_flow_style=None, width=120),
            encoding="utf-8",
        )
        return
    if "--wrap" in words:
        for word in words[words.index("--wrap") + 1 :]:
            page = Path(word)
            page.write_text(wrapped(page.read_text(encoding="utf-8")), encoding="utf-8")
        return
    if "--counts" in words:
        for name, both in sorted(counts().items(), key=lambda item: -item[1]["sentences"]):
            print(f"{both['sentences']:5d} sentences {both['lines']:5d} lines  {name}")
        return
    wanted = {str(Path(word).resolve().relative_to(ROOT)) for word in words}
    for name, path in pages().items():
        if wanted and name not in wanted:
            continue
        text = path.read_text(encoding="utf-8")
        for number, line in long_lines(text):
            print(f"{name}:{number}: line of {len(line)} characters")
        for number, sentence in long_sentences(text):
            print(f"{name}:{number}: {len(_WORD.findall(sentence))} words: {sentence}")


if __name__ == "__main__":
    main(sys.argv[1:])
