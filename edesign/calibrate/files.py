"""The files of a calibration in a folder: JSON, the corrected law or structure, histories."""

from __future__ import annotations

import json
from pathlib import Path

from edesign._version import __version__
from edesign.archive.dataset import Group
from edesign.archive.files import make_folder, write_text
from edesign.archive.writer import ArchiveWriter
from edesign.calibrate.result import Calibration
from edesign.calibrate.structure.campaign import StructureCampaign
from edesign.calibrate.structure.write import law_texts, structure_text
from edesign.calibrate.write import archive_groups, calibration_json, law_text
from edesign.damper.campaign import Campaign
from edesign.errors import InputError

NAMES = ("calibration.json", "law.yaml", "structure.yaml", "calibration.h5")
"""Files that are written, and overwritten; laws beside that of an isolation layer have longer names."""


def check_names(campaign: Path, folder: Path) -> None:
    """Refuse to write over the campaign file.

    Raises:
        InputError: a file of the calibration would stand in its place.
    """
    if campaign.name in NAMES and campaign.parent.resolve() == folder.resolve():
        raise InputError(f"{campaign}: the calibration writes a file of this name; choose another folder by --output")


def write_files(found: Calibration, campaign: Campaign | StructureCampaign, folder: Path) -> list[Path]:
    """Write calibration.json, law.yaml or structure.yaml, and calibration.h5; each appears when it is whole.

    Returns:
        The files.

    Raises:
        ArchiveError: one cannot be written.
    """
    make_folder(folder)
    told = json.dumps(calibration_json(found), indent=1, allow_nan=False) + "\n"
    texts = {"calibration.json": told, **_models(found, campaign)}
    for name, text in texts.items():
        write_text(text, folder / name)
    root = Group(
        attributes={"title": found.title, "kind": "calibration", "planned": [], "edesign_version": __version__}
    )
    root.add("calibration", (), told, "", "calibration.json")
    root.add("campaign", (), campaign.path.read_text(encoding="utf-8"), "", "the campaign file")
    archive_path = folder / "calibration.h5"
    with ArchiveWriter(archive_path, root) as writer:
        for name, group in archive_groups(found).items():
            writer.write(name, group)
        writer.finish({"status": "completed"})
    return [*(folder / name for name in texts), archive_path]


def _models(found: Calibration, campaign: Campaign | StructureCampaign) -> dict[str, str]:
    if isinstance(campaign, Campaign):
        return {"law.yaml": law_text(found, campaign)}
    return {"structure.yaml": structure_text(found, campaign), **law_texts(found, campaign)}
