"""Writes docs/develop/map.md: what every folder of the repository is, from the docstrings of its packages.

The page is not typed: it goes out of date in no other way than by a docstring, and a test compares it.

Usage: python tools/package_map.py [--check]
"""

from __future__ import annotations

import ast
import re
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parents[1]
PAGE = ROOT / "docs" / "develop" / "map.md"
PACKAGES = ("edesign", "blind", "benchmarks")
FOLDERS = {
    "core_c": "The numerical core in C11.",
    "core_c/include": "Its public headers; `edcore.h` includes them all.",
    "core_c/src/analysis": "Static and modal analysis, pushovers, time histories, spectra.",
    "core_c/src/base": "Contexts, status codes with their messages, small dense kernels.",
    "core_c/src/damper": "Damper laws, one file each, their effects, the differential equations for SUNDIALS.",
    "core_c/src/element": "Force-based beam-columns, braces, links.",
    "core_c/src/material": "Uniaxial laws of steel.",
    "core_c/src/section": "Fibre sections: layers as arrays.",
    "core_c/src/space": "Linear elastic frames in space, for the design of buildings.",
    "core_c/src/spring": "Springs with hysteresis and deterioration: hinges, joints, supports.",
    "core_c/src/substructure": "Virtual substructure tests, step by step.",
    "core_c/src/system": "Degrees of freedom, assembly, sparse solver, eigenvalues, damping.",
    "core_c/tests": "Tests of the core in C, run under sanitizers.",
    "docs": "These pages, a folder for each kind of question.",
    "docs/assets": "Style and scripts of the site.",
    "docs/tutorials": "Whole ways from files to results, step by step.",
    "docs/how_to": "One task a page.",
    "docs/reference": "Files, commands, laws, effects: every key and what it means.",
    "docs/theory": "What is computed, with sources.",
    "docs/verification": "What was checked against what.",
    "docs/results": "Results of long computations beside what they are compared with.",
    "docs/develop": "For those who change the program.",
    "licences": "Licences of the libraries that wheels carry.",
    "projects": "Projects that run as they are, most of them of the reference work.",
    "records": "Suites of recordings that come with edesign, and what may stand beside them.",
    "records/suites": "One file for each suite, which files and commands name without a path.",
    "tests": "Tests in Python.",
    "tests/unit": "Tests of single packages, in folders named as those of `edesign`.",
    "tests/cases": "Whole projects with the results expected of them.",
    "tests/verification": "Results against closed forms and independent computations.",
    "tests/published": "Results against printed tables.",
    "tests/peers": "Results against other programs, where these are installed.",
    "tests/support": "What several tests share: frames, campaigns, damaged files.",
    "tools": "Scripts that set the system up, and that write pages, figures and data of the repository.",
}
"""Folders that are no packages of Python."""
WHOLE = {name for name in FOLDERS if name not in ("core_c", "tests", "docs")} | set(PACKAGES)
"""Folders whose inner folders need no line of their own; packages inside a package have their docstrings."""
HEAD = """# Map of the packages

<!-- written by tools/package_map.py from the docstrings of the packages: change these -->

Every folder of the repository stands here with what it holds. The text of a package is its
docstring; the docstring of a module, on its first line, says what the module holds.
"""


def modules(folder: Path) -> list[Path]:
    """Modules of a package but its `__init__.py`, in the order of their names."""
    return sorted(path for path in folder.glob("*.py") if path.name != "__init__.py")


def docstring(path: Path) -> str:
    """Docstring of a module, empty if it has none."""
    return ast.get_docstring(ast.parse(path.read_text(encoding="utf-8"))) or ""


def packages(root: Path = ROOT) -> dict[str, Path]:
    """Folders that are packages by their paths in the repository, each before those inside it."""
    found = [sorted(path.parent for path in (root / top).rglob("__init__.py")) for top in PACKAGES]
    return {folder.relative_to(root).as_posix(): folder for folders in found for folder in folders}


def without_docstring(root: Path = ROOT) -> list[str]:
    """Packages and modules of the packages that say nothing about themselves."""
    found = []
    for folder in packages(root).values():
        found += [path for path in [folder / "__init__.py", *modules(folder)] if not docstring(path).strip()]
    return [path.relative_to(root).as_posix() for path in found]


def unplaced(root: Path = ROOT) -> list[str]:
    """Folders with files that the page does not explain, neither themselves nor by one of the folders in `WHOLE`."""
    known = {*packages(root), *FOLDERS, "."}
    found = {path.parent.relative_to(root) for top in root.iterdir() if top.is_dir() for path in top.rglob("*.*")}
    return sorted(
        folder.as_posix()
        for folder in found
        if not folder.parts[0].startswith(".")
        and not {"build", "dist", "__pycache__"}.intersection(folder.parts)
        and not folder.parts[0].endswith(".egg-info")
        and folder.as_posix() not in known
        and not any(parent.as_posix() in WHOLE for parent in folder.parents)
    )


def page() -> str:
    """The text of the page."""
    lines = [HEAD]
    for name, folder in packages().items():
        text = docstring(folder / "__init__.py").strip()
        if name.count("/") < 2:
            lines.append(f"\n{'#' * (name.count('/') + 2)} `{name}`\n\n{text}\n")
            continue
        inner = name.split("/", 2)[2]
        lines.append(("" if lines[-1].lstrip().startswith("- ") else "\n") + f"- **`{inner}`** {in_short(text)}\n")
    lines.append("\n## Other folders\n\n| folder | what it holds |\n|---|---|\n")
    lines += [f"| `{name}` | {text} |\n" for name, text in FOLDERS.items()]
    return "".join(lines)


def in_short(text: str) -> str:
    """A docstring on one line, up to its first list or block."""
    paragraphs = text.split("\n\n")
    kept = [part for at, part in enumerate(paragraphs) if at == 0 or not re.match(r" |- |[A-Z]\w+:$", part)]
    return " ".join(" ".join(kept).split())


def main() -> int:
    """Write the page, or with --check say whether it is out of date."""
    wanted = page()
    if "--check" in sys.argv[1:]:
        current = PAGE.read_text(encoding="utf-8") if PAGE.exists() else ""
        if current != wanted:
            print(f"{PAGE.relative_to(ROOT)} is out of date: python tools/package_map.py writes it", file=sys.stderr)
        return int(current != wanted)
    PAGE.write_text(wanted, encoding="utf-8")
    return 0


if __name__ == "__main__":
    sys.exit(main())
