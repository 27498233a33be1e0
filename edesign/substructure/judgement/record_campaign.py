"""Measured substructure tests as a campaign that `edesign calibrate` takes."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import Literal

from edesign.damper.law_file import read_law_file
from edesign.damper.temperature import REFERENCE_C
from edesign.damper.testing.campaign import Campaign, write_campaign
from edesign.damper.testing.campaign_blocks import LawChoice
from edesign.damper.testing.measured_histories import DamperTest, Use
from edesign.errors import InputError
from edesign.project.dampers.dampers import LawDescription
from edesign.project.substructure.programme import RtsTest
from edesign.project.substructure.rts_file import RtsFile
from edesign.substructure.judgement.judge import Judgement
from edesign.substructure.judgement.measured import read_measured
from edesign.substructure.laboratory import TestedDamper, laboratory

Displacement = Literal["target", "encoder"]
"""Which displacement of a record the campaign has: what the specimen should do, or what was read at it."""
CHANNELS: dict[Displacement, str] = {"target": "target", "encoder": "displacement"}
EVERY = 3
"""Which tests are to validate with: each third one, so that three tests suffice, two of which are fitted to."""


def write_record_campaign(
    found: Sequence[Judgement], file: RtsFile, folder: Path, displacement: Displacement = "encoder"
) -> Campaign:
    """Write records as one campaign: NAME.csv of each, and campaign.yaml.

    Force, displacement and layers are those of one prototype of the law, as its parameters are. Effects of the
    specimen are not named, so that they can be found. Every third test is one to validate with, the others are to fit
    to.

    Args:
        found: what was judged with the file, in the order in which the tests were made.
        file: of the tests; says law and specimen.
        folder: made if it does not exist.
        displacement: which one; with `target` a late rig is one of the things that are found.

    Raises:
        InputError: the law has no size, or a channel is missing; two records have one name; the files would take the
            place of an input.
        ArchiveError: a file cannot be written.
    """
    damper = laboratory(file).damper
    if damper is None:
        raise InputError(f"{file.path}: specimen: a campaign needs a law; give `law` or `law_file` [E-RTS-05]")
    if damper.prototype is None:
        raise InputError(
            f"{file.path}: specimen: the law has no `prototype`, so the size of the layers is not known [E-RTS-05]"
        )
    tests = [
        _test(one, damper, displacement, "validate" if number % EVERY == 0 else "fit")
        for number, one in enumerate(found, start=1)
    ]
    said = _description(file, damper)
    law = LawChoice(said.type or damper.values.law, said.parameters)
    return write_campaign(folder, damper.prototype, tests, law, file.title or file.path.stem)


def _test(found: Judgement, damper: TestedDamper, displacement: Displacement, use: Use) -> DamperTest:
    channel = CHANNELS[displacement]
    record = read_measured(found.source, channel, "force")
    force, deformation = damper.scales
    return DamperTest(
        name=record.path.stem,
        time=record.time,
        displacement=deformation * record[channel],
        force=record["force"] / force,
        temperature_C=REFERENCE_C if damper.temperature_C is None else damper.temperature_C,
        title=f"{record.path.stem}, displacement of the {displacement}",
        use=use,
        # time counts from the beginning of the ground motion; before it the specimen is at rest
        start="at_rest" if isinstance(found.test, RtsTest) else "unknown",
    )


def _description(file: RtsFile, damper: TestedDamper) -> LawDescription:
    """The law as it is declared, in the file that it stands in."""
    placed = file.law
    if damper.declared.file is None or placed is None:
        return damper.declared
    return read_law_file(placed.path.parent / damper.declared.file, file.law_file_content(placed))[0]
