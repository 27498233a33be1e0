"""The files of a calibration in a folder: JSON, the corrected law or structure, histories."""

from __future__ import annotations

import json
from pathlib import Path

from edesign._version import __version__
from edesign.archive.dataset import Group
from edesign.archive.files import check_own_yaml, make_folder, source_file, write_text, write_yaml
from edesign.archive.owner import check_owner
from edesign.archive.writer import ArchiveWriter
from edesign.calibrate.result import Calibration
from edesign.calibrate.structure.campaign import StructureCampaign
from edesign.calibrate.structure.write import LAWS_BESIDE, law_texts, structure_text
from edesign.calibrate.write import archive_groups, calibration_json, law_text
from edesign.damper.testing.campaign import Campaign
from edesign.input_files import spare_inputs

LAWS = ("law.yaml", "structure.yaml", *LAWS_BESIDE)
ARCHIVE = "calibration.h5"
NAMES = ("calibration.json", "calibration.html", *LAWS, ARCHIVE)
"""Files that are written, in place of earlier ones of the same campaign."""


def check_files(campaign: Path, title: str, folder: Path, overwrite: bool = False) -> None:
    """Refuse to write over inputs, and over laws and archives that are no results of this campaign.

    Args:
        campaign: the campaign file.
        title: of the calibration.
        folder: where the files go.
        overwrite: whether results of other campaigns, and laws that edesign did not write, may be replaced.

    Raises:
        InputError, ArchiveError: a file of the calibration would stand in the place of something else.
    """
    spare_inputs(*(folder / name for name in NAMES))
    for name in LAWS:
        check_own_yaml(folder / name, campaign, overwrite)
    check_owner(folder / ARCHIVE, _root(campaign, title, folder), overwrite)


def write_files(found: Calibration, campaign: Campaign | StructureCampaign, folder: Path) -> list[Path]:
    """Write calibration.json, law.yaml or structure.yaml, and calibration.h5; each appears when it is whole.

    Returns:
        The files.

    Raises:
        ArchiveError: one cannot be written.
    """
    make_folder(folder)
    told = json.dumps(calibration_json(found), indent=1, allow_nan=False) + "\n"
    write_text(told, folder / "calibration.json")
    models = _models(found, campaign)
    for name, text in models.items():
        write_yaml(text, folder / name, campaign.path)
    root = _root(campaign.path, found.title, folder)
    root.attributes |= {"verdict": found.verdict, "search": found.ending}
    root.add("calibration", (), told, "", "calibration.json")
    root.add("campaign", (), campaign.text, "", "the campaign file")
    with ArchiveWriter(folder / ARCHIVE, root) as writer:
        for name, group in archive_groups(found).items():
            writer.write(name, group)
        writer.finish({"status": "completed"})
    return [folder / name for name in ("calibration.json", *models, ARCHIVE)]


def _root(campaign: Path, title: str, folder: Path) -> Group:
    source = source_file(campaign, folder / ARCHIVE)
    about = {"title": title, "kind": "calibration", "source_file": source}
    return Group(attributes={**about, "planned": [], "edesign_version": __version__})


def _models(found: Calibration, campaign: Campaign | StructureCampaign) -> dict[str, str]:
    if isinstance(campaign, Campaign):
        return {"law.yaml": law_text(found, campaign)}
    return {"structure.yaml": structure_text(found, campaign), **law_texts(found, campaign)}
