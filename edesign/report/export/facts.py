"""Where the tables of an archive come from."""

from __future__ import annotations

from edesign._version import __version__
from edesign.archive.reader import Archive

_ROOT = ("title", "kind", "status", "project_file", "study_file", "building_file", "edesign_version", "core_version")
_CHECKSUMS = ("input_checksum", "project_checksum", "building_checksum", "rts_checksum", "code_checksum")


def provenance_facts(archive: Archive) -> dict[str, str]:
    """Return names and texts: the archive, its source, checksums of the input, versions, and damage."""
    own = archive.group_attributes("provenance") if "provenance" in archive.names() else {}
    facts = {"archive": archive.path.name}
    for source, names in ((archive.attributes, (*_ROOT, *_CHECKSUMS)), (own, tuple(own))):
        facts |= {name.replace("_", " "): str(source[name]) for name in names if source.get(name) not in (None, "")}
    facts["complete"] = "yes" if archive.complete else "no: the run goes on or was interrupted"
    facts |= {"damage": damage} if (damage := archive.damage_in_short()) else {}
    return {**facts, "exported by": f"edesign {__version__}"}
