"""Writes the tables of docs/results from the CSV files in docs/results/data: measured numbers are data, pages are text.

What stands between `<!-- begin data/NAME.csv -->` and `<!-- end -->` is replaced by the table of the file.

Usage: python tools/result_tables.py [--check]
"""

from __future__ import annotations

import csv
import re
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parents[1]
RESULTS = ROOT / "docs" / "results"
BLOCK = re.compile(r"(<!-- begin (?P<file>data/\S+\.csv) -->\n).*?(<!-- end -->)", re.DOTALL)


def table(path: Path) -> str:
    """The table of a CSV file in Markdown.

    Args:
        path: of the file, UTF-8, with one line of headers.

    Returns:
        Header, ruler and rows, each with the end of its line.
    """
    with path.open(encoding="utf-8", newline="") as file:
        header, *rows = csv.reader(file)
    lines = [header, ["---"] * len(header), *rows]
    made = ["| " + " | ".join(cells) + " |" for cells in lines]
    made[1] = made[1].replace(" ", "")
    return "\n".join(made) + "\n"


def filled(text: str, folder: Path = RESULTS) -> str:
    """A page with its tables as the files have them."""
    return BLOCK.sub(lambda found: f"{found[1]}\n{table(folder / found['file'])}\n{found[3]}", text)


def out_of_date() -> list[Path]:
    """Pages whose tables are not those of their files."""
    return [page for page in sorted(RESULTS.glob("*.md")) if filled(text := page.read_text("utf-8")) != text]


def main() -> int:
    """Write the pages, or with --check name those that are out of date."""
    pages = out_of_date()
    for page in pages:
        if "--check" in sys.argv[1:]:
            print(f"{page.relative_to(ROOT)} is out of date: python tools/result_tables.py writes it", file=sys.stderr)
        else:
            page.write_text(filled(page.read_text("utf-8")), "utf-8")
    return int("--check" in sys.argv[1:] and bool(pages))


if __name__ == "__main__":
    sys.exit(main())
