"""The kinds of archives: a new one is written in a file beside this one and named in `KINDS`."""

from __future__ import annotations

from edesign.archive.reader import Archive
from edesign.report.archive.building import BUILDING_KIND
from edesign.report.archive.kind import ArchiveKind
from edesign.report.archive.project import PROJECT_KIND
from edesign.report.archive.study import STUDY_KIND
from edesign.report.archive.substructure import SUBSTRUCTURE_KIND

KINDS = {kind.name: kind for kind in (PROJECT_KIND, STUDY_KIND, BUILDING_KIND, SUBSTRUCTURE_KIND)}


def kind_of(archive: Archive) -> ArchiveKind:
    """Return the kind of an archive; archives without one, and of kinds that are not known, are those of projects."""
    return KINDS.get(str(archive.attributes.get("kind", "")), PROJECT_KIND)
