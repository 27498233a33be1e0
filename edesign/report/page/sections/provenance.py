"""Where the results come from, and how well the equations were solved."""

from __future__ import annotations

from operator import itemgetter
from typing import Any

from edesign.report.drawing.captions import plain
from edesign.report.html.section import Facts, Folded, Part, Section, Warnings
from edesign.report.page.source import Source
from edesign.report.response.analysis_tables import fallbacks_table, statistics_table
from edesign.report.tables.column import text
from edesign.report.tables.table import TableSpec

ROOT = (
    ("edesign", "edesign_version"),
    ("Numerical core", "core_version"),
    ("SHA-256 of the program", "code_checksum"),
    ("Libraries", "libraries"),
    ("Study file", "study_file"),
    ("Project file", "project_file"),
    ("Building file", "building_file"),
    ("File of tests", "rts_file"),
    ("SHA-256 of the input files", "project_checksum"),
    ("SHA-256 of the building file", "building_checksum"),
    ("SHA-256 of the texts of tests, project, rig and laws", "rts_checksum"),
    ("SHA-256 of files and records", "input_checksum"),
)

CHECKSUMS = TableSpec[tuple[str, str]](
    "record_checksums",
    "",
    (text("record", itemgetter(0)), text("SHA-256", itemgetter(1))),
    keys=2,
    named_by_title=True,
)


def provenance(source: Source) -> Section:
    """Return the section on versions, checksums, date and machine, and the statistics of the solution."""
    about, made = source.attributes, source.provenance
    rows = [("Made", str(made["created"]))] if made.get("created") else []
    rows += [(title, str(about[name])) for title, name in ROOT if about.get(name)]
    rows += [(_title(name), str(value)) for name, value in made.items() if name not in ("created", "order")]
    parts: list[Part] = []
    if source.left_out:
        parts.append(Warnings("What could not be shown", tuple(source.left_out)))
    solved = _solution(source.entries)
    if solved:
        parts.append(Facts(tuple(solved)))
    statistics = statistics_table(source.entries)
    if statistics.rows:
        parts.append(Folded("Statistics of each analysis", (statistics,)))
    fallbacks = [fallbacks_table(name, group) for name, group in source.groups.items()]
    reported = tuple(table for table in fallbacks if table.rows)
    if reported:
        parts.append(Folded(f"Steps that did not converge at once, in {len(reported)} analyses", reported))
    parts.append(Facts(tuple(rows)))
    records = about.get("record_checksums")
    if isinstance(records, dict) and records:
        parts.append(Folded("SHA-256 of the samples of each record", (CHECKSUMS.of(records.items()),)))
    return Section("provenance", "Provenance and accuracy of the solution", (), tuple(parts))


def _solution(entries: list[dict[str, Any]]) -> list[tuple[str, str]]:
    """Sums over all analyses that made steps, and the worst of them."""
    stepped = [item for item in entries if item["statistics"].get("steps")]
    if not stepped:
        return []
    steps, iterations, fallbacks, cpu = (
        sum(item["statistics"].get(key) or 0 for item in stepped)
        for key in ("steps", "iterations", "fallbacks", "cpu_s")
    )
    rows = [
        ("Steps", f"{steps:,.0f} in {len(stepped)} analyses, {iterations / steps:.2f} iterations a step"),
        ("Fallbacks", f"{fallbacks:,.0f} in {sum(bool(i['statistics'].get('fallbacks')) for i in stepped)} analyses"),
        ("CPU time of the solution", f"{plain(cpu)} s"),
    ]
    errors = {i["name"]: abs(i["statistics"]["energy_error"]) for i in stepped if i["statistics"].get("energy_error")}
    if errors:
        worst = max(errors, key=lambda name: errors[name])
        rows.append(("Energy balance", f"closes to {errors[worst]:.1e} of the input at worst ({worst})"))
    return rows


def _title(name: str) -> str:
    return name.replace("_version", "").replace("_", " ").replace("hdf5", "HDF5")
