"""A measured substructure test as a campaign that `edesign calibrate` takes."""

from __future__ import annotations

from pathlib import Path
from typing import Literal

from edesign.damper.campaign import Campaign, write_campaign
from edesign.damper.law_file import read_law_file
from edesign.damper.temperature import REFERENCE_C
from edesign.damper.test_files import LawChoice
from edesign.damper.test_record import DamperTest
from edesign.errors import InputError
from edesign.project.dampers import LawDescription
from edesign.project.substructure.rts_file import RtsFile
from edesign.substructure.judgement.measured import MeasuredRecord
from edesign.substructure.laboratory import TestedDamper, laboratory

Displacement = Literal["target", "encoder"]
"""Which displacement of a record the campaign has: what the specimen should do, or what was read at it."""
CHANNELS: dict[Displacement, str] = {"target": "target", "encoder": "displacement"}


def write_test_campaign(
    record: MeasuredRecord, file: RtsFile, folder: Path, displacement: Displacement = "encoder"
) -> Campaign:
    """Write a record as a campaign of one test: NAME.csv and campaign.yaml.

    Force and displacement are those of one prototype of the law, as its parameters are. Effects of the specimen are
    not named, so that they can be found.

    Args:
        record: has target or displacement, and force.
        file: of the test; says law and specimen.
        folder: made if it does not exist.
        displacement: which one; with `target` a late rig is one of the things that are found.

    Raises:
        InputError: the law has no size, or a channel is missing; the files would take the place of an input.
        ArchiveError: a file cannot be written.
    """
    damper = laboratory(file).damper
    if damper is None:
        raise InputError(f"{file.path}: specimen: a campaign needs a law; give `law` or `law_file`")
    if damper.specimen is None:
        raise InputError(f"{file.path}: specimen: the law has no `prototype`, so the size of the layers is not known")
    for name in (CHANNELS[displacement], "force"):
        if name not in record.channels:
            raise InputError(f"{record.path}: there is no column of {name}, which the campaign needs")
    force, deformation = damper.scales
    test = DamperTest(
        name=record.path.stem,
        time=record.time,
        displacement=deformation * record[CHANNELS[displacement]],
        force=record["force"] / force,
        temperature_C=REFERENCE_C if damper.temperature_C is None else damper.temperature_C,
        title=f"{record.path.stem}, displacement of the {displacement}",
    )
    said = _description(file, damper)
    law = LawChoice(said.type or damper.values.law, said.parameters)
    return write_campaign(folder, damper.specimen, [test], law, f"{file.title or file.path.stem}: {record.path.stem}")


def _description(file: RtsFile, damper: TestedDamper) -> LawDescription:
    """The law as it is declared, in the file that it stands in."""
    placed = file.law
    if damper.declared.file is None or placed is None:
        return damper.declared
    return read_law_file(placed.path.parent / damper.declared.file)[0]
