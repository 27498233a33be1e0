"""Campaigns of records of a structure: the declared building, and what its instruments recorded."""

from __future__ import annotations

import re
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from edesign.calibration.structures.building import Building, Damping
from edesign.calibration.structures.record import Channel, Measure, StructureTest
from edesign.calibration.structures.structure_file import ChannelsBlock, StructureFile, check_structure
from edesign.damper.laws import LAWS
from edesign.damper.parameters import read_parameters
from edesign.damper.testing.campaign import CampaignError, short_names
from edesign.damper.testing.campaign_blocks import check_law
from edesign.errors import InputError
from edesign.project.document import Document
from edesign.project.reading.file_bytes import is_there
from edesign.project.reading.problems import did_you_mean, listed
from edesign.project.reading.yaml_file import check_model, read_yaml_text
from edesign.tables.compressed import read_table
from edesign.tables.table import Table

_WHAT, _BEGINS = "campaign file", "structure:"
_FEWEST = 16  # samples
_UNEVEN = 0.05  # of a step: times are often rounded


@dataclass(frozen=True)
class Isolation:
    """Declared law of an isolation layer.

    Attributes:
        law: its name.
        values: all parameters, SI.
        named: those that the file gives; the others keep their defaults.
        refit: whether they are only a first guess.
    """

    law: str
    values: dict[str, float]
    named: tuple[str, ...]
    refit: bool = True


@dataclass(frozen=True)
class StructureCampaign:
    """Tests of one structure, in the order in which they were made.

    Attributes:
        name: of the structure.
        building: as declared, without its isolation layer.
        isolation: law of that layer; None: fixed base.
        refit: whether stiffness and damping of the storeys are only a first guess.
        tests: in the order of the file.
        path: the campaign file.
        title: for people.
        text: of the campaign file.
        document: for the cover of a report.
    """

    name: str
    building: Building
    isolation: Isolation | None
    refit: bool
    tests: tuple[StructureTest, ...]
    path: Path
    title: str = ""
    text: str = ""
    document: Document = Document()

    @property
    def label(self) -> str:
        """The title, or else the name of the structure."""
        return self.title or self.name


def load_structure_campaign(path: Path | str) -> StructureCampaign:
    """Read and check a campaign file of a structure and the records it names.

    Raises:
        InputError: the file cannot be read, or records are wrong; the message lists the first mistake of each of them.
        CampaignError: the file is wrong; the message lists all problems with file, line and column.
    """
    path = Path(path)
    text = read_yaml_text(path, _WHAT)
    file, problems = check_model(text, StructureFile, _WHAT, _BEGINS)
    if file is None:
        raise CampaignError(path, problems.found)
    check_structure(file, problems)
    check_law(file.law, problems, complete=True)
    first: dict[Path, int] = {}
    for i, entry in enumerate(file.tests):
        at = ("tests", i, "file")
        if not is_there(path.parent / entry.file):
            problems.at_value(at, f"there is no file {path.parent / entry.file} [E-FILE-01]")
        other = first.setdefault(Path(entry.file), i)
        if other != i:
            problems.at_value(
                at, f"the file is there already, in line {problems.node(('tests', other)).mark.line} [E-FILE-09]"
            )
    if problems.found:
        raise CampaignError(path, problems.found)
    tests, wrong = [], []
    plain = [Path(re.sub(r"\.gz$", "", entry.file, flags=re.IGNORECASE)) for entry in file.tests]
    for name, entry in zip(short_names(plain), file.tests, strict=True):
        try:
            step, base, channels, values = _record(path.parent / entry.file, file.channels)
        except InputError as error:
            wrong.append(str(error))
            continue
        source = str(path.parent / entry.file)
        tests.append(StructureTest(name, step, base, channels, values, entry.title, entry.use, source))
    if wrong:
        raise InputError("\n".join(wrong))
    return StructureCampaign(
        file.structure.name,
        _building(file),
        _isolation(file),
        file.structure.refit and bool(file.structure.storey_stiffness),
        tuple(tests),
        path,
        file.title,
        text,
        file.document,
    )


def _building(file: StructureFile) -> Building:
    block = file.structure
    isolated = block.base == "isolated"
    below = (0.0,) if isolated else ()
    n = len(block.floor_masses)
    damping = Damping()
    if block.damping is not None:
        first, second = block.damping.modes
        share = block.damping.share or 0.0
        damping = Damping(block.damping.type, block.damping.ratio, (first, second), block.damping.other, share)
    return Building(
        np.array(block.floor_masses),
        np.array((*below, *block.storey_stiffness)),
        damping,
        np.array((*below, *block.storey_dashpots)) if block.storey_dashpots is not None else np.zeros(n),
        isolated,
        None if block.storey_heights is None else np.cumsum((*below, *block.storey_heights)),
    )


def _isolation(file: StructureFile) -> Isolation | None:
    if file.law is None or file.law.parameters is None:
        return None
    law = LAWS[file.law.type]
    values = read_parameters(law, file.law.parameters)
    given = file.law.parameters
    return Isolation(law.name, values, tuple(values) if isinstance(given, str) else tuple(given), file.law.refit)


def _record(path: Path, block: ChannelsBlock) -> tuple[float, np.ndarray, tuple[Channel, ...], np.ndarray]:
    """Time step, base acceleration, channels and their values, SI."""
    table = read_table(path)
    time = block.units.time * _column(table, block.time)
    if time.size < _FEWEST:
        raise InputError(
            f"{path}:{table.lines[-1]}: a test needs at least {_FEWEST} samples, not {time.size} [E-CALIB-03]"
        )
    back = np.flatnonzero(np.diff(time) <= 0.0)
    if back.size:
        at = int(back[0]) + 1
        raise InputError(f"{table.where(row=at)}: the time {time[at]:g} s is not after {time[at - 1]:g} s [E-CALIB-03]")
    step = float(time[-1] - time[0]) / (time.size - 1)
    off = np.abs(time - time[0] - step * np.arange(time.size))
    if off.max() > _UNEVEN * step:
        at = int(np.argmax(off > _UNEVEN * step))
        raise InputError(
            f"{table.where(row=at)}: the time {time[at]:g} s is {off[at]:g} s off an even step of {step:g} s; "
            "records of structures need even steps [E-CALIB-03]"
        )
    base = block.units.acceleration * _column(table, block.base_acceleration)
    if np.ptp(base) == 0.0:
        raise InputError(
            f"{table.where(row=0)}: the base acceleration is the same in all lines; nothing moved [E-CALIB-03]"
        )
    channels, values = [], []
    measures: tuple[Measure, ...] = ("acceleration", "displacement")
    for measure in measures:
        headers = getattr(block, f"floor_{measure}s") or ()
        for floor, header in enumerate(headers):
            if header is not None:
                channels.append(Channel(measure, floor))
                values.append(getattr(block.units, measure) * _column(table, header))
                if np.ptp(values[-1]) == 0.0:
                    raise InputError(
                        f"{table.where(row=0)}: `{header}` is the same in all lines; nothing moved [E-CALIB-03]"
                    )
    return step, base, tuple(channels), np.column_stack(values)


def _column(table: Table, header: str) -> np.ndarray:
    if header not in table.headers:
        hint = did_you_mean(header, table.headers)
        raise InputError(
            f"{table.where()}: there is no column `{header}`{hint} (there are: {listed(table.headers)}) [E-TABLE-10]"
        )
    return table.rows[:, table.headers.index(header)]
