"""The campaigns that a model is calibrated by: tests of a damper, tables of its moduli, records of a structure."""

from __future__ import annotations

from pathlib import Path

from edesign.calibration.properties.campaign import KEY, PropertyCampaign, load_property_campaign
from edesign.calibration.structures.campaign import StructureCampaign, load_structure_campaign
from edesign.damper.testing.campaign import Campaign as DamperCampaign
from edesign.damper.testing.campaign import load_campaign as load_damper_campaign
from edesign.project.reading.yaml_file import read_yaml_text
from edesign.project.reading.yaml_nodes import parse

Campaign = DamperCampaign | PropertyCampaign | StructureCampaign
"""Its class says what was measured."""


def load_campaign(path: Path | str) -> Campaign:
    """Read and check a campaign file, and the tests, records or table that it names.

    Args:
        path: the campaign file. One of a table has the key `properties`, one of a structure the key `structure`.

    Raises:
        InputError: the file or what it names cannot be read, or is wrong.
        CampaignError: the file is wrong; the message lists all problems with file, line and column.
    """
    root, _ = parse(read_yaml_text(Path(path), "campaign file"))
    if root.child(KEY) is not None:
        return load_property_campaign(path)
    return load_structure_campaign(path) if root.child("structure") is not None else load_damper_campaign(path)
