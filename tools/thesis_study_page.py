"""Writes the tables of docs/results/thesis_study.md from the archive of the thesis study: no figure in it is typed.

What stands between `<!-- begin NAME -->` and `<!-- end -->` is replaced: NAME is `archive` (what was run, and with
which records) or the beginning of the title of a table of the reference file.

With `--causes` the blocks `causes` are filled from the archive of `causes.yaml`: every variant beside Table 5.8; with
`--redesign` the block `redesign` from that of `redesign.yaml`: its rounds and its response.

Usage: python tools/thesis_study_page.py ARCHIVE [--causes ARCHIVE] [--redesign ARCHIVE]
    [--reference FILE] [--page FILE]
"""

from __future__ import annotations

import argparse
import re
import sys
from collections import Counter
from collections.abc import Sequence
from pathlib import Path

from edesign.archive.files import write_text
from edesign.archive.reader import Archive, open_archive
from edesign.assess.measures import response_measures
from edesign.errors import EdesignError, InputError
from edesign.ground_motion.sources import is_simulated
from edesign.project.study.reference_loader import load_reference
from edesign.report.archive.study_tables import study_tables
from edesign.report.archive_view import all_results, planned, record_entries
from edesign.report.assessment.measure_columns import MEASURE_ROWS, Measure
from edesign.report.comparison.cells import Comparison
from edesign.report.comparison.compare import compare
from edesign.report.comparison.variants import variant_tables
from edesign.report.comparison.wide_tables import wide_tables
from edesign.report.tables.column import col, text
from edesign.report.tables.table import Table, TableSpec
from edesign.report.tables.unit import ONE, PERCENT
from edesign.study.results.kinds import ANALYSES, RECORDS

ROOT = Path(__file__).resolve().parents[1]
BLOCK = re.compile(r"(<!-- begin (?P<name>.+?) -->\n).*?(<!-- end -->)", re.DOTALL)


Row = tuple[Measure, float | None, float | None]
"""A measure at the temperature of the design and at another one."""


def _change(row: Row) -> float | None:
    _, usual, other = row
    return None if not usual or other is None else (other - usual) / usual


TEMPERATURES = TableSpec[Row](
    "temperatures",
    "",
    (
        text("measure", lambda row: row[0].head),
        col("{usual}", ONE, lambda row: row[0].cell(row[1])),
        col("{other}", ONE, lambda row: row[0].cell(row[2])),
        col("diff.", PERCENT, _change, form="+.1f", bare=True),
    ),
)


def main() -> None:
    """Replace the tables of the page."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("archive", type=Path)
    parser.add_argument("--causes", type=Path)
    parser.add_argument("--redesign", type=Path)
    parser.add_argument("--reference", type=Path, default=ROOT / "projects" / "thesis_10_storey" / "reference.yaml")
    parser.add_argument("--page", type=Path, default=ROOT / "docs" / "results" / "thesis_study.md")
    options = parser.parse_args()
    try:
        reference = load_reference(options.reference)
        with open_archive(options.archive) as opened:
            comparison = compare(opened, reference)
            blocks = {"archive": about(opened), "temperature": temperature(opened)} | tables(comparison)
        if options.causes is not None:
            with open_archive(options.causes) as opened:
                made = variant_tables(opened, reference, "damped")
                blocks |= {f"causes, {table.title}": markdown(table) for table in made}
        if options.redesign is not None:
            with open_archive(options.redesign) as opened:
                blocks["redesign"] = redesign(opened)
        write_text(replaced(options.page.read_text(encoding="utf-8"), blocks), options.page)
    except EdesignError as error:
        sys.exit(str(error))


def replaced(page: str, blocks: dict[str, str]) -> str:
    """Return a page with its blocks filled.

    Raises:
        InputError: a block has no counterpart.
    """

    def fill(match: re.Match[str]) -> str:
        found = [text for title, text in blocks.items() if title.startswith(match["name"])]
        if not found and match["name"].startswith(("causes", "redesign")):
            return match[0]  # its archive was not given
        if not found:
            raise InputError(f"the page has a block `{match['name']}`, there is only {', '.join(blocks)} [E-NAME-01]")
        return "\n\n".join([match[1].rstrip(), *found, match[3]])

    return BLOCK.sub(fill, page)


def about(archive: Archive) -> str:
    """What was run: versions, histories by status, records by origin."""
    versions = f"edesign {archive.attributes.get('edesign_version')}, core {archive.attributes.get('core_version')}"
    status: Counter[str] = Counter()
    have = archive.names(ANALYSES)
    for name in planned(archive):
        found = archive.group_attributes(f"{ANALYSES}/{name}") if name in have else {"kind": "", "status": "not run"}
        if found.get("kind") in ("history", ""):
            status[str(found["status"])] += 1
    lines = [f"- {versions}", f"- histories: {', '.join(f'{count} {name}' for name, count in status.items())}"]
    for entry in record_entries(archive, RECORDS):
        origins = Counter(str(record.get("origin")) for record in entry.get("records", [entry]))
        simulated = [
            str(record.get("name")) for record in entry.get("records", []) if is_simulated(record.get("origin"))
        ]
        counts = (f"{count} {name if is_simulated(name) else f'from {name}'}" for name, count in origins.items())
        lines.append(f"- {entry.get('name')}: {', '.join(counts)}")
        if simulated:
            lines.append(f"- simulated in place of recordings: {', '.join(simulated)}")
    return "\n".join(lines)


def temperature(archive: Archive) -> str:
    """Response measures of the history at another temperature beside those of the same record at the design's."""
    histories = {n: g for n, g in all_results(archive).items() if g.attributes.get("kind") == "history"}
    same = ("variant", "level", "record")
    usual = {
        tuple(group.attributes.get(key) for key in same): name
        for name, group in histories.items()
        if group.attributes.get("temperature_C") is None
    }
    lines = []
    for name, group in histories.items():
        other = usual.get(tuple(group.attributes.get(key) for key in same), name)
        if other == name:
            continue
        measures = [response_measures(histories[found]) for found in (other, name)]
        rows = [(row, *(found[row.name] for found in measures)) for row in MEASURE_ROWS]
        lines.append(markdown(TEMPERATURES.of(rows, usual=other, other=name)))
    return "\n\n".join(lines)


def redesign(archive: Archive) -> str:
    """Rounds of the designs, mean response, and verdicts."""
    wanted = ("Rounds", "Mean response", "Criteria", "What governs the criteria", "Remarks on the criteria")
    wanted += ("What the criteria require",)
    return "\n\n".join(markdown(table) for table in study_tables(archive) if table.title in wanted)


def tables(comparison: Comparison) -> dict[str, str]:
    """Tables in Markdown by their titles; a part without a title belongs to the table before it."""
    blocks: dict[str, str] = {}
    last = ""
    for table in wide_tables(comparison):
        last = table.title or last
        blocks[last] = "\n\n".join(part for part in (blocks.get(last, ""), markdown(table)) if part)
    return blocks


def markdown(table: Table) -> str:
    """A table in Markdown, its notes below."""
    lines = [f"**{table.title}**", ""] if table.title else []
    lines += [_row(table.headers), _row(["---"] * table.keys + ["--:"] * (len(table.columns) - table.keys))]
    lines += [_row(row) for row in table.texts]
    return "\n".join([*lines, "", *(f"{note}  " for note in table.notes)]).rstrip()


def _row(cells: Sequence[str]) -> str:
    return f"| {' | '.join(cells)} |"


if __name__ == "__main__":
    main()
