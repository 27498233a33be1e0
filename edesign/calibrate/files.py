"""The files of a calibration in a folder: JSON, the corrected law, histories."""

from __future__ import annotations

import json
from pathlib import Path

from edesign._version import __version__
from edesign.archive.dataset import Group
from edesign.archive.files import make_folder, write_text
from edesign.archive.writer import ArchiveWriter
from edesign.calibrate.result import Calibration
from edesign.calibrate.write import archive_groups, calibration_json, law_text
from edesign.damper.campaign import Campaign


def write_files(found: Calibration, campaign: Campaign, folder: Path) -> list[Path]:
    """Write calibration.json, law.yaml and calibration.h5; each appears when it is whole.

    Returns:
        The files.

    Raises:
        ArchiveError: one cannot be written.
    """
    make_folder(folder)
    told = json.dumps(calibration_json(found), indent=1, allow_nan=False) + "\n"
    json_path, law_path, archive_path = (folder / n for n in ("calibration.json", "law.yaml", "calibration.h5"))
    write_text(told, json_path)
    write_text(law_text(found, campaign), law_path)
    root = Group(
        attributes={"title": found.title, "kind": "calibration", "planned": [], "edesign_version": __version__}
    )
    root.add("calibration", (), told, "", "calibration.json")
    root.add("campaign", (), campaign.path.read_text(encoding="utf-8"), "", "the campaign file")
    with ArchiveWriter(archive_path, root) as writer:
        for name, group in archive_groups(found).items():
            writer.write(name, group)
        writer.finish({"status": "completed"})
    return [json_path, law_path, archive_path]
