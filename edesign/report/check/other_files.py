"""Summaries of suites, reference and rig files, campaigns of structures, archives and results."""

from __future__ import annotations

import json
from collections import Counter
from pathlib import Path
from typing import Any

from edesign.errors import InputError
from edesign.project.reading.file_bytes import read_file
from edesign.report.check.damper_files import warnings_of


def suite_summary(path: Path) -> dict[str, str]:
    """Return the recordings of a suite, and where they are found.

    Raises:
        InputError: it is wrong, or a recording is found nowhere.
    """
    from edesign.ground_motion.plausibility import record_warnings
    from edesign.ground_motion.sources import find_suite
    from edesign.ground_motion.suite import load_suite
    from edesign.project.notation.units import STANDARD_GRAVITY
    from edesign.study.check.summary import ORIGINS

    suite = load_suite(path)
    found = find_suite(suite, ())
    origins = Counter(item.origin for item in found)
    pgas = sorted(item.record.pga / STANDARD_GRAVITY for item in found)
    warnings = [f"{item.record.name}: {text}" for item in found for text in record_warnings(item.record)]
    peer = sum(entry.peer is not None for entry in suite.records)
    missing = sum(item.origin == "simulated" and item.entry is not None and item.entry.file is None for item in found)
    if missing:
        where = "; `folders` of the project, or `--folder`, says where yours are" if peer else ""
        warnings.append(f"{missing} of {len(found)} recordings are simulated here{where}")
    return {
        "title": suite.title,
        "recordings": f"{len(found)}: {', '.join(f'{count} {ORIGINS[origin]}' for origin, count in origins.items())}",
        "events": str(len({(entry.event, entry.year) for entry in suite.records if entry.event})) + " named",
        "PGA": f"{pgas[0]:.3g} to {pgas[-1]:.3g} g as recorded",
        **warnings_of(warnings),
    }


def reference_summary(path: Path) -> dict[str, str]:
    """Return the tables of a reference file.

    Raises:
        InputError: it is wrong.
    """
    from edesign.project.study.reference import ResponseTable
    from edesign.project.study.reference_loader import load_reference

    reference = load_reference(path)
    lines = []
    for table in reference.tables:
        if isinstance(table, ResponseTable):
            cells = [(row, v, level, cell) for row in table.rows for v, level, cell in row.cells()]
            bars = [table.bar(*one) for one in cells]
        else:
            bars = [table.bar(row, cell) for row in table.rows for cell in row.cells() if cell is not None]
        barred = sum(bar is not None for bar in bars)
        lines.append(f"{table.title}: {len(table.rows)} rows, {len(bars)} values, {barred} with a bar (`within`)")
    return {
        "title": reference.title,
        **({"source": reference.source} if reference.source else {}),
        "tables": "\n".join(lines),
    }


def rig_summary(path: Path) -> dict[str, str]:
    """Return the rig of a rig file.

    Raises:
        InputError: it is wrong.
    """
    from edesign.project.substructure.loader import read_rig_file
    from edesign.project.substructure.summary import rig_text

    file = read_rig_file(path)
    limits = file.rig.limits
    unlimited = limits.stroke is None and limits.velocity is None and limits.force is None
    warnings = ["no `limits`: the rig reaches any stroke, velocity and force"] if unlimited else []
    noise = f"{1e6 * file.encoder_noise:.3g} um" if file.encoder_noise is not None else "not said"
    return {
        "rig": rig_text(file.rig),
        "encoder": f"noise {noise}",
        **({"source": file.source} if file.source else {}),
        **warnings_of(warnings),
    }


def structure_campaign_summary(path: Path) -> dict[str, str]:
    """Return the structure and the records of a campaign of a structure.

    Raises:
        InputError: it, or a record, is wrong, or there are too few of them.
    """
    from edesign.calibration.structures.campaign import load_structure_campaign
    from edesign.calibration.structures.from_campaign import structure_problem

    campaign = load_structure_campaign(path)
    structure_problem(campaign)  # refuses too few tests, and channels of a wrong unit or sign
    building, uses = campaign.building, Counter(test.use for test in campaign.tests)
    channels = {channel.label: None for test in campaign.tests for channel in test.channels}
    return {
        "title": campaign.title or campaign.name,
        "structure": f"{building.floors} floors, {1e-3 * float(building.masses.sum()):.4g} t, "
        + ("isolated" if building.isolated else "fixed base"),
        **({"law": campaign.isolation.law} if campaign.isolation is not None else {}),
        "tests": f"{len(campaign.tests)}: {uses['fit']} to fit to, {uses['validate']} to validate",
        "channels": ", ".join(channels),
    }


def national_summary(path: Path) -> dict[str, str]:
    """Return which national parameters a file has.

    Raises:
        InputError: it is wrong.
    """
    from edesign.project.actions.national_file import parse_national
    from edesign.project.reading.yaml_file import read_yaml_text

    found = parse_national(read_yaml_text(path, "national data file"), path)
    zones: dict[str, Any] = found.get("zones", {})
    named = ", ".join(map(str, zones.get("value", {})))
    return {"parameters": ", ".join(found), **({"zones": f"{named} [{zones.get('unit')}]"} if named else {})}


def archive_summary(path: Path) -> dict[str, str]:
    """Return the kind and progress of an archive.

    Raises:
        ArchiveError: it cannot be read.
    """
    from edesign.archive.reader import open_archive
    from edesign.report.archive_view import input_warnings, planned
    from edesign.study.results.kinds import ANALYSES

    with open_archive(path) as archive:
        about = archive.attributes
        names = planned(archive)
        states: Counter[str] = Counter()
        for name in names:
            there = name in archive.names(ANALYSES)
            state = archive.group_attributes(f"{ANALYSES}/{name}").get("status") if there else "not run"
            states[str(state)] += 1
        files = dict.fromkeys(str(about[key]) for key in about if key.endswith("_file") and about[key])
        warnings = list(input_warnings(archive))
        if not archive.complete:
            warnings.insert(0, "the archive is partial: its run was interrupted, and goes on when it is run again")
        if states["failed"]:
            warnings.insert(0, f"{states['failed']} of {len(names)} analyses failed; `edesign show {path}` says why")
        return {
            "title": str(about.get("title", "")),
            "archive": "; ".join(files) or path.name,
            "made by": f"edesign {about.get('edesign_version', 'of unknown version')}",
            "analyses": ", ".join(f"{count} {state}" for state, count in states.items()) or "none",
            **warnings_of(warnings),
        }


def result_summary(path: Path) -> dict[str, str]:
    """Return the verdict in calibration.json, or the law in fit.json.

    Raises:
        InputError: it is neither.
    """
    try:
        found = json.loads(read_file(path, "result"))
    except (UnicodeDecodeError, json.JSONDecodeError, RecursionError) as error:
        raise InputError(f"{path}: this is no JSON: {error} [E-FILE-05]") from error
    try:
        if isinstance(found, dict) and "verdict" in found and isinstance(found.get("error"), dict):
            return _calibration(found)
        if isinstance(found, dict) and "nrms_percent" in found and "law" in found:
            return _fit(found)
    except (AttributeError, TypeError) as error:
        raise InputError(f"{path}: this is no result that edesign has written: {error} [E-FILE-05]") from error
    raise InputError(f"{path}: this is no result of edesign: calibration.json and fit.json are [E-FILE-05]")


def _fit(found: dict[str, Any]) -> dict[str, str]:
    nrms = found.get("nrms_percent_overall")
    return {
        "fit": f"{found['law']}, {len(found.get('fitted', ()))} parameters fitted",
        "error": f"NRMS {nrms:.4g} %" if isinstance(nrms, (int, float)) else "not said",
        **warnings_of([str(text) for text in found.get("doubts", ())]),
    }


def _calibration(found: dict[str, Any]) -> dict[str, str]:
    def percent(model: str) -> str:
        value = found["error"].get(model, {}).get("validate")
        return f"{model} {100.0 * value:.3g} %" if isinstance(value, (int, float)) else f"{model} -"

    def names(key: str) -> str:
        return ", ".join(str(one.get("title") or one.get("name")) for one in found.get(key, ())) or "none"

    warnings = [f"refused: {text}" for text in found.get("refused", ())]
    if found.get("search") not in ("complete", None):
        warnings.append(f"the search is {found['search']}: not all effects were looked at")
    return {
        "title": str(found.get("title", "")),
        "law": str(found.get("law", "")),
        "verdict": str(found["verdict"]),
        "effects": names("effects"),
        "error": "validation NRMS: " + ", ".join(percent(model) for model in ("declared", "refit", "corrected")),
        **warnings_of(warnings),
    }
