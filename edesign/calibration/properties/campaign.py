"""Campaigns whose tests are the rows of a property table: specimen, law, table, and the rows held out."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Annotated

import numpy as np
from pydantic import Field

from edesign.damper.testing.campaign import CampaignError
from edesign.damper.testing.campaign_blocks import (
    LawBlock,
    LawChoice,
    LayeredSpecimenBlock,
    Text,
    check_law,
    check_specimen,
)
from edesign.damper.testing.measured_histories import Use
from edesign.damper.testing.property_table import SAME_LEVEL, SAME_TEMPERATURE, PropertyTable, read_property_table
from edesign.damper.testing.specimen import Specimen
from edesign.damper.thesis_tables import measured
from edesign.project.document import Document
from edesign.project.notation.temperature import Temperature
from edesign.project.notation.units import PositiveFrequency, PositiveRatio
from edesign.project.reading.base import Model
from edesign.project.reading.file_bytes import is_there
from edesign.project.reading.problems import Problems
from edesign.project.reading.yaml_file import check_model, read_yaml_text

KEY = "properties"
PUBLISHED = "thesis_appendix_a"
_WHAT, _BEGINS = "campaign file", "specimen:"
_LEAST = 2  # groups of rows fitted to: each is left out in turn


class HoldOut(Model):
    """Rows that nothing is fitted to: those of these temperatures, strains or frequencies.

    Attributes:
        temperatures: temperatures whose rows are held out.
        strains: strains whose rows are held out.
        frequencies: frequencies whose rows are held out.
    """

    temperatures: tuple[Temperature, ...] = ()
    strains: tuple[PositiveRatio, ...] = ()
    frequencies: tuple[PositiveFrequency, ...] = ()


class PropertiesBlock(Model):
    """The table of measured properties, and its rows that are held out.

    Attributes:
        table: CSV file relative to the campaign file, or the published `thesis_appendix_a`.
        hold_out: rows that nothing is fitted to.
    """

    table: Text
    hold_out: Annotated[HoldOut, Field(default_factory=HoldOut)]


class PropertyCampaignFile(Model):
    """A campaign file of a property table.

    Attributes:
        title: title of the report.
        document: what the cover of a report says beside the title.
        specimen: what was tested.
        law: law that is thought to describe the specimen.
        properties: the table of properties.
    """

    title: str = ""
    document: Document = Document()
    specimen: LayeredSpecimenBlock
    law: LawBlock
    properties: PropertiesBlock


@dataclass(frozen=True)
class Group:
    """Rows of one temperature and strain, over frequency: a test of the loop.

    Attributes:
        name: for people.
        use: fit or validate.
        rows: (n,) indices in the table.
    """

    name: str
    use: Use
    rows: np.ndarray


@dataclass(frozen=True, eq=False)
class PropertyCampaign:
    """A property table with the law that is thought to describe it.

    Attributes:
        specimen: what was tested.
        law: declared, with its parameters.
        table: the rows.
        groups: of the rows.
        path: the campaign file.
        title: for people.
        text: of the campaign file.
        document: for the cover of a report.
    """

    specimen: Specimen
    law: LawChoice
    table: PropertyTable
    groups: tuple[Group, ...]
    path: Path
    title: str = ""
    text: str = ""
    document: Document = Document()

    @property
    def label(self) -> str:
        """The title, or else the name of the specimen."""
        return self.title or self.specimen.name


def load_property_campaign(path: Path | str) -> PropertyCampaign:
    """Read and check a campaign file and its table.

    Raises:
        InputError: the file or the table cannot be read, or the table is wrong.
        CampaignError: the file is wrong; the message lists all problems with file, line and column.
    """
    path = Path(path)
    text = read_yaml_text(path, _WHAT)
    file, problems = check_model(text, PropertyCampaignFile, _WHAT, _BEGINS)
    if file is None:
        raise CampaignError(path, problems.found)
    check_specimen(file.specimen, problems)
    check_law(file.law, problems, complete=True)
    if file.law.parameters is None:
        problems.under(("law",), "parameters", "this key is missing; the loop needs a declared law [E-CALIB-01]")
    at = path.parent / file.properties.table
    if file.properties.table != PUBLISHED and not is_there(at):
        problems.at_value(
            (KEY, "table"),
            f"there is no file {at}; name a CSV file, or {PUBLISHED}, the table that comes with edesign [E-FILE-01]",
        )
    if problems.found:
        raise CampaignError(path, problems.found)
    table = published() if file.properties.table == PUBLISHED else read_property_table(at)
    held = file.properties.hold_out
    _check_levels(table, held, problems)
    groups = groups_of(table, held_out(table, held))
    count = {use: sum(group.use == use for group in groups) for use in ("fit", "validate")}
    if not problems.found and count["fit"] < _LEAST:
        problems.at_key(
            (KEY,),
            f"{count['fit']} of {len(groups)} groups of rows (one temperature and strain each) are left to be fitted "
            f"to; an effect is adopted when it lowers the error of groups left out, so that {_LEAST} are the least"
            " [E-CALIB-02]",
        )
    if not problems.found and not count["validate"]:
        problems.at_key(
            (KEY,),
            "no row is held out; the error before and after is reported on rows that nothing was fitted to: "
            "`hold_out: {temperatures: [...], strains: [...], frequencies: [...]}` [E-CALIB-02]",
        )
    if problems.found:
        raise CampaignError(path, problems.found)
    of_file = path, file.title, text, file.document
    return PropertyCampaign(file.specimen.specimen, file.law.choice, table, groups, *of_file)


def published() -> PropertyTable:
    """Tables A.1-A.4 of the thesis."""
    rows = measured()
    return PropertyTable(
        rows.temperature_C, rows.strain, rows.frequency, rows.G_storage, rows.G_eq, rows.loss_factor, PUBLISHED
    )


def held_out(table: PropertyTable, held: HoldOut) -> np.ndarray:
    """Whether each row (n,) is one for validation."""
    return np.asarray(
        _near(table.temperature_C, held.temperatures, SAME_TEMPERATURE, 0.0)
        | _near(table.strain, held.strains, 0.0, SAME_LEVEL)
        | _near(table.frequency, held.frequencies, 0.0, SAME_LEVEL)
    )


def groups_of(table: PropertyTable, validate: np.ndarray) -> tuple[Group, ...]:
    """Rows of one temperature, strain and use, ascending in frequency; in the order of temperature and strain.

    Args:
        validate: (n,) whether a row is one for validation.
    """
    temperatures, strains, _ = table.levels
    found = []
    for T in temperatures:
        for strain in strains:
            here = _near(table.temperature_C, (T,), SAME_TEMPERATURE, 0.0) & _near(
                table.strain, (strain,), 0.0, SAME_LEVEL
            )
            uses: tuple[tuple[Use, np.ndarray], ...] = (("fit", here & ~validate), ("validate", here & validate))
            parts = [(use, np.flatnonzero(chosen)) for use, chosen in uses if chosen.any()]
            for use, rows in parts:
                name = f"{100.0 * strain:.4g} % at {T:.4g} degC"
                name += f" ({use})" if len(parts) > 1 else ""
                found.append(Group(name, use, rows[np.argsort(table.frequency[rows], kind="stable")]))
    return tuple(found)


def _near(values: np.ndarray, levels: Sequence[float], absolute: float, relative: float) -> np.ndarray:
    chosen = np.zeros(values.shape, dtype=bool)
    for level in levels:
        chosen |= np.abs(values - level) <= absolute + relative * abs(level)
    return chosen


def _check_levels(table: PropertyTable, held: HoldOut, problems: Problems) -> None:
    """Every level held out must be in the table."""
    temperatures, strains, frequencies = table.levels
    for key, levels, known, scale, unit, absolute, relative in (
        ("temperatures", held.temperatures, temperatures, 1.0, "degC", SAME_TEMPERATURE, 0.0),
        ("strains", held.strains, strains, 100.0, "%", 0.0, SAME_LEVEL),
        ("frequencies", held.frequencies, frequencies, 1.0, "Hz", 0.0, SAME_LEVEL),
    ):
        for i, level in enumerate(levels):
            if not _near(known, (level,), absolute, relative).any():
                there = ", ".join(f"{scale * value:.4g} {unit}" for value in known)
                problems.at_value(
                    (KEY, "hold_out", key, i),
                    f"the table has no row at {scale * level:.4g} {unit} (there are: {there}) [E-CALIB-05]",
                )
