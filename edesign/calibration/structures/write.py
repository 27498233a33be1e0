"""The files of a calibrated building."""

from __future__ import annotations

from pathlib import Path

from edesign.calibration.results import write
from edesign.calibration.results.result import Calibration
from edesign.calibration.structures.campaign import StructureCampaign
from edesign.calibration.structures.corrected import FILES, corrected_texts
from edesign.calibration.structures.from_campaign import blank_problem


def check_structure_files(campaign: Path, title: str, folder: Path, overwrite: bool = False) -> None:
    """Refuse to write over inputs, and over files and archives that are no results of this campaign.

    Args:
        campaign: the campaign file.
        title: of the calibration.
        folder: where the files go.
        overwrite: whether results of other campaigns, and files that edesign did not write, may be replaced.

    Raises:
        InputError: a file of the calibration would stand in the place of something else.
        ArchiveError: likewise, of an archive.
    """
    write.check_files(campaign, title, folder, overwrite, FILES)


def write_structure_files(found: Calibration, campaign: StructureCampaign, folder: Path) -> list[Path]:
    """Write calibration.json, structure.yaml, laws of an isolation layer and calibration.h5, each when it is whole.

    Args:
        found: by the calibration.
        campaign: records.
        folder: where the files go.

    Returns:
        The files.

    Raises:
        ArchiveError: one cannot be written.
    """
    texts = corrected_texts(found, campaign, blank_problem(campaign))
    return write.write_calibration(found, campaign.path, campaign.text, texts, folder)
