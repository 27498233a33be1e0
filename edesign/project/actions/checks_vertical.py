"""Cross checks of vertical ground motion: one source, a record that is as recorded, masses that it moves."""

from __future__ import annotations

from edesign.project.analysis.analyses import HistoryAnalysis
from edesign.project.project import Project
from edesign.project.reading.problems import Keys, Problems, unknown_name
from edesign.project.records.records import RecordSet, record_of


def check_vertical(project: Project, problems: Problems, keys: Keys, history: HistoryAnalysis) -> None:
    """Check the vertical motion of a history; `project` has no schema problems."""
    motion = history.vertical
    if motion is None:
        return
    if (motion.ratio is None) == (motion.record is None):
        problems.at_key(keys, "give either `ratio` (times the horizontal record) or `record`, one of them")
        return
    if project.masses is not None and project.masses.directions == "horizontal":
        message = (
            "the masses resist horizontal motion alone (`masses.directions`), so that vertical motion would do nothing"
        )
        problems.at_key(keys, message)
    for key in ("pga", "scale"):
        if motion.record is None and getattr(motion, key) is not None:
            problems.at_key((*keys, key), "the `ratio` says the scale; leave this key out")
    if motion.record is None:
        return
    if motion.pga is not None and motion.scale is not None:
        problems.at_key((*keys, "scale"), "`pga` and `scale` exclude each other; keep one of them")
    if motion.record not in project.records:
        problems.at_value((*keys, "record"), unknown_name("record", motion.record, project.records))
        return
    record = project.records[motion.record]
    if isinstance(record, RecordSet):
        message = (
            f"`{motion.record}` has several motions; vertical motion is one record, or a `ratio` of each horizontal one"
        )
        problems.at_value((*keys, "record"), message)
    elif record.match is not None:
        message = f"`{motion.record}` is fitted to the horizontal spectrum; a vertical record is used as recorded"
        problems.at_value((*keys, "record"), message)
    horizontal = project.records.get(record_of(history.record))
    if horizontal is not None and horizontal.match is not None and motion.pga is None and motion.scale is None:
        message = (
            f"this key is missing; `{history.record}` is fitted, and has no factor that the vertical record could share"
        )
        problems.under(keys, "scale", message)
