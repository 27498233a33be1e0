"""Cross checks of vertical ground motion: one source, a record that is of the component, masses that it moves."""

from __future__ import annotations

from collections.abc import Sequence

from edesign.project.analysis.analyses import VerticalMotion
from edesign.project.analysis_file import AnalysisFile
from edesign.project.checks.matching import check_fitted_levels
from edesign.project.reading.problems import Keys, Problems, listed, unknown_name
from edesign.project.records.pairs import InSpace
from edesign.project.records.records import RecordSet, record_of

_STILL = "the masses resist horizontal motion alone (`masses.directions`), so that vertical motion would do nothing"


def check_vertical(
    project: AnalysisFile,
    problems: Problems,
    keys: Keys,
    motion: VerticalMotion | None,
    records: Sequence[str],
    levels: Sequence[str],
) -> None:
    """Check the vertical motion of histories; `project` has no schema problems.

    Args:
        project: whose records it is of.
        problems: of the file in which it stands.
        keys: its place there.
        motion: beside the horizontal one; None: there is none.
        records: references of the horizontal records.
        levels: of the hazard, at which the histories are; empty: none is said.
    """
    still = project.masses is not None and project.masses.directions == "horizontal"
    pairs = {name: project.records.get(name) for name in map(record_of, records)}
    upwards = [name for name, pair in pairs.items() if isinstance(pair, InSpace) and pair.vertical]
    if upwards and still:
        problems.at_value(keys[:-1], f"`{upwards[0]}` has a vertical component: {_STILL} [E-VERT-01]")
    if motion is None:
        return
    if upwards:
        message = f"`{upwards[0]}` has a vertical component of its own; leave out this key, or its `vertical`"
        problems.at_key(keys, f"{message} [E-KEY-03]")
    elif motion.ratio is not None:
        for name in (name for name, pair in pairs.items() if isinstance(pair, InSpace)):
            message = f"`{name}` is a pair, and none of its components is the one that this multiplies"
            problems.at_key((*keys, "ratio"), f"{message}; its vertical one acts by `vertical` there [E-KEY-03]")
    if (motion.ratio is None) == (motion.record is None):
        problems.at_key(keys, "give either `ratio` (times the horizontal record) or `record`, one of them [E-KEY-03]")
        return
    if still:
        problems.at_key(keys, f"{_STILL} [E-VERT-01]")
    for key in ("pga", "scale"):
        if motion.record is None and getattr(motion, key) is not None:
            problems.at_key((*keys, key), "the `ratio` says the scale; leave this key out [E-KEY-03]")
    if motion.record is None:
        return
    if motion.pga is not None and motion.scale is not None:
        problems.at_key((*keys, "scale"), "`pga` and `scale` exclude each other; keep one of them [E-KEY-03]")
    if motion.record not in project.records:
        problems.at_value((*keys, "record"), unknown_name("record", motion.record, project.records))
        return
    record = project.records[motion.record]
    if isinstance(record, RecordSet | InSpace):
        message = (
            f"`{motion.record}` has several motions; vertical motion is one record, or a `ratio` of each horizontal one"
            " [E-SCALE-01]"
        )
        problems.at_value((*keys, "record"), message)
    elif record.match is not None:
        _fitted(project, problems, keys, motion, motion.record, levels)
    elif motion.pga is None and motion.scale is None:
        _shared_factor(project, problems, keys, records)


def check_horizontal(project: AnalysisFile, problems: Problems, keys: Keys, records: Sequence[str]) -> None:
    """Check that the records of horizontal motions are not fitted to a vertical spectrum.

    Args:
        project: the file, which has no schema problems.
        records: references of the records.
    """
    for i, name in enumerate(map(record_of, records)):
        match = project.records[name].match if name in project.records else None
        if match is not None and match.component == "vertical":
            message = (
                f"`{name}` is fitted to the vertical spectrum; it is the `record` of a `vertical` motion [E-SCALE-02]"
            )
            problems.at_item(keys, i, message)


def _fitted(
    project: AnalysisFile, problems: Problems, keys: Keys, motion: VerticalMotion, name: str, levels: Sequence[str]
) -> None:
    """A record that is fitted to the vertical spectrum is scaled by the level of its history."""
    match = project.records[name].match
    assert match is not None
    if match.component != "vertical":
        message = f"`{name}` is fitted to the horizontal spectrum; a vertical one is as recorded, or has"
        problems.at_value((*keys, "record"), f"{message} `match: {{component: vertical}}` [E-SCALE-02]")
        return
    for key in ("pga", "scale"):
        if getattr(motion, key) is not None:
            message = (
                f"`{name}` is fitted to the vertical spectrum of the hazard; the level of the history says the scale"
                " [E-KEY-03]"
            )
            problems.at_key((*keys, key), message)
    if not levels:
        known = listed(project.hazard_levels) if project.hazard_levels else "the hazard has none [E-HAZ-05]"
        message = f"`{name}` is fitted to the vertical spectrum and scaled to the level of the history, which has none"
        problems.at_value((*keys, "record"), f"{message} ({known}) [E-HAZ-05]")
    check_fitted_levels((*keys, "record"), (name,), levels, project, problems)


def _shared_factor(project: AnalysisFile, problems: Problems, keys: Keys, records: Sequence[str]) -> None:
    """Without a scale of its own a record has the factor of the horizontal one, which a fitted one has not."""
    for reference in records:
        horizontal = project.records.get(record_of(reference))
        if horizontal is not None and horizontal.fitted:
            message = f"`{reference}` is fitted, and has no factor that the vertical record could share"
            problems.under(keys, "scale", f"this key is missing; {message} [E-KEY-02]")
            return
