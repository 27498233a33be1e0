"""Names that pages write in code: each must be one of the program, its tests, its commands or its files.

A word in backquotes counts as known where it stands in a source: Python, C, a file of the projects, the Makefile. Paths
are those of files, options those of commands, sections those of the page that is named beside them.
"""

from __future__ import annotations

import ast
import re
from collections.abc import Iterator
from fnmatch import fnmatchcase
from functools import cache
from pathlib import Path
from typing import Any

ROOT = Path(__file__).parents[1]
PAGES = [
    page
    for page in sorted([*(ROOT / "docs").rglob("*.md"), ROOT / "README.md", ROOT / "CONTRIBUTING.md"])
    if "keys" not in page.parts  # made from the models
]
CODE = re.compile(r"(?<!`)`([^`\n]+(?:\n[^`\n]+)?)`(?!`)")
BLOCK = re.compile(r"```.*?```|^(?: {4}[^\n]*\n?)+", re.DOTALL | re.MULTILINE)
_NAME = re.compile(r"[A-Za-z_][A-Za-z0-9_]*")
_FILE = re.compile(
    r"(?<![\w/.~-])(?:(?:edesign|core_c|tests|tools|blind|benchmarks|projects|records|docs|licences|\.ci)/[\w.*/-]*"
    r"|(?:[\w.*-]+/)*[\w*-]+\.(?:py|c|h|md|js)\b)"
)
_SOURCES = ("edesign", "core_c", "tests", "tools", "blind", "benchmarks", "projects", "records", ".ci")
_ENDINGS = (".py", ".c", ".h", ".yaml", ".js", ".sh", ".csv", ".css", ".html", ".toml")
_FIXED = 3
"""Letters that a name which is put together has of its own at least: fewer would let any name pass."""
PLACES = ("NAME", "MEMBER", "COMPENSATOR", "STAGE", "KEYS", "LAW", "TEST", "PACKAGE", "CODE", "FORMAT", "SET",
          "COMPONENT", "NUMBER", "MAJOR", "MINOR", "PATCH", "N", "NN", "NNN", "DRAWING")  # fmt: skip
"""Words that stand for a name."""
_SELF = ("doc_names.py", "test_names.py")
_MADE = (".html", ".h5")  # what commands write
FOREIGN = frozenset(
    {
        "--variant",
        "CocConfig",
        "PIP_NO_CACHE_DIR",
        "_aligned_malloc",
        "decode_cf",
        "manylinux_2_35",
        "manylinux_2_NN_x86_64",
    }
)
"""Names of other programs."""
EXAMPLES = frozenset(
    {"S355J2", "asce41_C_1", "building_by_member", "el_centro_2", "harbour_1", "my_dampers", "n2_Gamma", "peer_spectra"}
)
"""Names that a user gives, or that follow from those, and the end of a name for `make pytest`."""
_PLACE = re.compile(r"[A-Z]{1,2}(?:_[A-Z]?\d+)*(?:_[A-Z])?(?:_[A-Z]?\d+)*(?:_[rfab])?")
"""Members and dampers by their places, such as `V_1_3_f`."""
_FORMER = re.compile(r"\w+_inside")
"""Forms of effects by the name that they had, which law files may still say (`edesign.damper.effects`)."""


@cache
def words() -> frozenset[str]:
    """All names that stand in sources, with the parts of names with dots."""
    found = {Path(name).stem for name in _SELF}
    for path in [ROOT / "Makefile", ROOT / "pyproject.toml", ROOT / "setup.py", ROOT / "mkdocs.yml", *_sources()]:
        found |= {path.stem, *_NAME.findall(path.read_text(encoding="utf-8", errors="replace"))}
    return frozenset(found)


def _sources() -> Iterator[Path]:
    """All sources but this one and its test, which names what there is not."""
    for folder in _SOURCES:
        for path in (ROOT / folder).rglob("*"):
            if path.is_file() and (path.suffix in _ENDINGS or folder == ".ci") and path.name not in _SELF:
                yield path


def spans(text: str) -> Iterator[tuple[int, str]]:
    """Yield line and content of each span of code outside of blocks."""
    hidden = BLOCK.sub(lambda found: re.sub(r"[^\n]", " ", found[0]), text)
    for found in CODE.finditer(hidden):
        yield hidden.count("\n", 0, found.start()) + 1, " ".join(found[1].split())


@cache
def _composed() -> re.Pattern[str]:
    """Names that sources put together, such as f"brace_{quantity}_max", with anything in place of the values."""
    shapes: set[str] = set()
    for path in _sources():
        if path.suffix == ".py" and path.parts[len(ROOT.parts)] == "edesign":
            for node in ast.walk(ast.parse(path.read_text(encoding="utf-8"))):
                if isinstance(node, ast.JoinedStr):
                    parts = [str(one.value) if isinstance(one, ast.Constant) else "\0" for one in node.values]
                    shape = "".join(parts)
                    if re.fullmatch(r"[\w\0]+", shape) and len(re.findall(r"[A-Za-z]", shape)) >= _FIXED:
                        shapes.add(shape.replace("\0", r"\w+"))
    return re.compile("|".join(sorted(shapes)))


def is_name(name: str) -> bool:
    """Return whether a name stands in a source, is put together there, or has a place for another one in it."""
    if name in words() or name in FOREIGN | EXAMPLES or _composed().fullmatch(name):
        return True
    if _PLACE.fullmatch(name) or _FORMER.fullmatch(name):
        return True
    shape = "_".join(r"\w+" if part in PLACES else part for part in name.split("_"))
    return shape != name and any(re.fullmatch(shape, word) for word in words())


@cache
def files() -> frozenset[str]:
    """Paths of all files and folders from the root."""
    found = [*ROOT.glob("*"), *(ROOT / "docs").rglob("*"), *(ROOT / "licences").rglob("*")]
    for folder in _SOURCES:
        found += [path for path in (ROOT / folder).rglob("*") if "build" not in path.parts]
    return frozenset(path.relative_to(ROOT).as_posix() for path in found)


def is_file(name: str, page: Path) -> bool:
    """Return whether a path is one of the repository, seen from its root, the page, or a folder of packages."""
    plain = re.sub(rf"\b(?:{'|'.join(PLACES)})\b", "*", name.rstrip("/"))
    if (page.parent / plain).exists() or Path(plain).suffix in _MADE:
        return True
    return any(fnmatchcase(path, plain) or fnmatchcase(path, f"*/{plain}") for path in files())


def unknown_names(text: str) -> Iterator[tuple[int, str]]:
    """Yield line and word of each name in code that stands in no source."""
    for line, span in spans(text):
        for name in _NAME.findall(_FILE.sub(" ", span)):
            if ("_" in name.strip("_") or (name[0].isupper() and name[1:] != name[1:].lower())) and not is_name(name):
                yield line, name


def missing_files(text: str, page: Path) -> Iterator[tuple[int, str]]:
    """Yield line and path of each file in code that is not there."""
    blocks = "".join(found[0] for found in BLOCK.finditer(text))  # a tutorial names files that it makes there
    for line, span in spans(text):
        for name in _FILE.findall(span):
            if not is_file(name, page) and "/build/" not in name and name not in blocks:
                yield line, name


def _lines_of_code(text: str) -> Iterator[tuple[int, str]]:
    """Yield line and text of spans, and of the lines of blocks."""
    yield from spans(text)
    for number, line in enumerate(text.splitlines(), start=1):
        if line.startswith("    "):
            yield number, line.strip()


@cache
def commands() -> dict[tuple[str, ...], frozenset[str]]:
    """The options of each command of `edesign`, by its words."""
    import typer

    from edesign.cli.main import app

    found: dict[tuple[str, ...], frozenset[str]] = {}

    def walk(command: Any, path: tuple[str, ...]) -> None:
        command = getattr(command, "loaded", command)
        options = {name for parameter in command.params for name in (*parameter.opts, *parameter.secondary_opts)}
        found[path] = frozenset({"--help", *options})
        for name, below in getattr(command, "commands", {}).items():
            walk(below, (*path, name))

    walk(typer.main.get_command(app), ())
    return found


@cache
def options() -> frozenset[str]:
    """Options of all commands, those of scripts and of other programs that sources name."""
    found = set().union(*commands().values())
    for path in _sources():
        if path.suffix in (".py", ".sh"):
            found |= set(re.findall(r"(?<![\w-])--[a-z][a-z0-9-]+", path.read_text(encoding="utf-8")))
    return frozenset(found)


def wrong_commands(text: str) -> Iterator[tuple[int, str]]:
    """Yield line and words of commands, options and targets of the Makefile that there are not."""
    known, every = commands(), options()
    targets = set(re.findall(r"^([a-z-]+):", (ROOT / "Makefile").read_text(encoding="utf-8"), re.MULTILINE))
    for number, line in _lines_of_code(text):
        for part in re.split(r"&&|;|\|", line.partition("  #")[0]):
            words_of = part.split()
            if words_of[:1] == ["make"] and words_of[1:] and words_of[1] not in targets and words_of[1].islower():
                yield number, f"make {words_of[1]}"
            elif words_of[:1] == ["edesign"]:
                path: tuple[str, ...] = ()
                while len(path) + 1 < len(words_of) and (*path, words_of[len(path) + 1]) in known:
                    path = (*path, words_of[len(path) + 1])
                if not path and re.fullmatch(r"[a-z]+", words_of[1] if len(words_of) > 1 else ""):
                    yield number, part.strip()
                for option in re.findall(r"(?<![\w-])--[a-z][a-z0-9-]+", part):
                    if option not in known[path]:
                        yield number, f"{' '.join(('edesign', *path))} {option}"
            elif re.match(r"--[a-z]", line) and words_of[0].partition("=")[0] not in every | FOREIGN:
                yield number, words_of[0]


_HEADING = re.compile(r"^#+ +(.+?) *$", re.MULTILINE)


def slug(heading: str) -> str:
    """Return the anchor of a heading, as the site and GitHub make it."""
    return re.sub(r"[\s]+", "-", re.sub(r"[^\w\s-]", "", heading.replace("`", "").lower()).strip())


def headings(page: Path) -> list[str]:
    """Return the headings of a page."""
    return _HEADING.findall(BLOCK.sub("", page.read_text(encoding="utf-8")))


def missing_sections(text: str, page: Path) -> Iterator[tuple[int, str]]:
    """Yield line and target of links to sections, and names of sections, that are not there."""
    for found in re.finditer(r"\]\(([^)#\s:]*)#([^)\s]+)\)", text):
        target = (page.parent / found[1]) if found[1] else page
        if found[2].startswith("edesign."):  # of the docstrings, which only the site has
            continue
        if not target.is_file() or found[2] not in {slug(one) for one in headings(target)}:
            yield text.count("\n", 0, found.start()) + 1, found[0][2:-1]
    every = {heading for one in PAGES for heading in headings(one)}
    for found in re.finditer(r"\bsection \"([^\"]+)\"", text):
        if " ".join(found[1].split()) not in every:
            yield text.count("\n", 0, found.start()) + 1, found[0]


def unproven_sections(text: str) -> Iterator[tuple[int, str]]:
    """Yield line and heading of what says what was verified and names no test, and rows of it without test or link.

    Such a section has a heading with "verified", "verification" or "checked against" in it. Where one of its tables
    has a column `test`, or rows that name one, all rows name one or lead to a section that does.
    """
    for found in re.finditer(r"^(#+ .+)\n((?:(?!^#).*\n?)*)", text, re.MULTILINE):
        line = text.count("\n", 0, found.start()) + 1
        verified = re.search(r"\bverif(?:ied|ication)\b|checked against", found[1], re.IGNORECASE)
        if verified and "\n| " in found[2] and " against |" in found[2] and not _TEST.search(found[2]):
            yield line, found[1]
        for table in re.finditer(r"(?:^\|.*\n?)+", found[2], re.MULTILINE):
            head, *rows = table[0].splitlines()
            if re.search(r"\| (?:test|reference) \|$", head) or re.match(r"\| (?:verified|subject) \| against", head):
                for row in rows[1:]:
                    if not _TEST.search(row) and "](" not in row:
                        yield line, row


_TEST = re.compile(r"test_\w+(?:\.(?:py|c)\b|\*)|tests/\w+|[a-z]+/tests\b")


def faults(page: Path) -> list[str]:
    """Return what a page names and there is not, with its line."""
    text = page.read_text(encoding="utf-8")
    found = [*unknown_names(text), *missing_files(text, page), *wrong_commands(text)]
    found += [*missing_sections(text, page), *unproven_sections(text)]
    return [f"{page.relative_to(ROOT)}:{line}: {name}" for line, name in sorted(found)]


if __name__ == "__main__":
    print("\n".join(fault for page in PAGES for fault in faults(page)))
