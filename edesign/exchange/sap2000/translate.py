"""Projects and buildings to SAP2000's text, and back."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path
from typing import Literal

from edesign.errors import InputError
from edesign.exchange.formats import MARK, ProgressLine, Translation
from edesign.exchange.sap2000.from_building import from_building
from edesign.exchange.sap2000.from_project import from_project
from edesign.exchange.sap2000.grid import Grid
from edesign.exchange.sap2000.read_model import read_model
from edesign.exchange.sap2000.tables import read_tables
from edesign.exchange.sap2000.to_building import building_text
from edesign.exchange.sap2000.to_project import project_text
from edesign.exchange.sap2000.write_model import model_text
from edesign.frame.sections.building_sections import BuildingSections
from edesign.project.building.building import Building
from edesign.project.building.loader import parse_building
from edesign.project.loader import parse_project
from edesign.project.project import Project


def translate_project(project: Project, path: Path, without_dampers: bool, progress: ProgressLine) -> Translation:
    """Return a project's frame as SAP2000's text.

    Raises:
        InputError: the frame has what the tables of SAP2000 do not have.
    """
    progress("writing the model for SAP2000")
    model, left_out = from_project(project, without_dampers)
    return Translation({path: model_text(model, path.name, MARK)}, tuple(left_out))


def translate_building(building: Building, path: Path, without_dampers: bool, progress: ProgressLine) -> Translation:
    """Return a building as SAP2000's text; buildings have no dampers."""
    progress("writing the model for SAP2000")
    model, left_out = from_building(building)
    return Translation({path: model_text(model, path.name, MARK)}, tuple(left_out))


MASS_SOURCES = ("MASS SOURCE", "MASSES 1 - MASS SOURCE")
"""Tables of the loads and parts that masses come from: of version 16 on, and up to 15."""


@dataclass(frozen=True)
class TakenModel:
    """A file of edesign made of a SAP2000 model.

    Attributes:
        kind: of the file.
        text: of the file, with what it does not have of the model in its head.
        left_out: sentences on what it does not have of the model.
    """

    kind: Literal["project", "building"]
    text: str
    left_out: tuple[str, ...]


def take_model(source: Path, target: Path) -> TakenModel:
    """Return the file of edesign that a SAP2000 text file makes: a project of a plane frame, else a building.

    Args:
        source: SAP2000's text.
        target: of the file, for messages; nothing is written.

    Raises:
        InputError: the file is no such text, or the model does not fit into a file of edesign; the message has the
            table, the line, the part and the reason.
    """
    tables = read_tables(source)
    read = read_model(tables)
    if not any(map(any, (*read.model.restraints.values(), *read.model.springs.values()))):
        raise InputError(
            f"{source}: no joint has a support: the table JOINT RESTRAINT ASSIGNMENTS holds none [E-SAP-07]"
        )
    try:
        grid = Grid(read.model)
        make = project_text if grid.is_plane else building_text
        text, left_out = make(read.model, grid)
    except InputError as error:
        message = str(error)
        raise InputError(message if message.startswith(str(source)) else f"{source}: {message}") from error
    kind: Literal["project", "building"] = "project" if grid.is_plane else "building"
    lines = [_one_line(sentence) for sentence in (*left_out, *(f"table {line}" for line in read.left_out))]
    if not any(tables.of(name) for name in MASS_SOURCES):
        lines.append("there is no mass source: the masses are those of members and joints, as in SAP2000")
    head = [f"# The {'plane frame' if grid.is_plane else 'building'} of a SAP2000 model."]
    head += ["# Not taken:", *(f"# - {line}" for line in lines)] if lines else []
    whole = "\n".join([*head, text])
    try:
        if grid.is_plane:
            parse_project(whole, target, BuildingSections())
        else:
            parse_building(whole, target, BuildingSections())
    except InputError as error:
        first = str(error).splitlines()[0]
        raise InputError(f"{source}: as a {kind} refused: {first}") from error
    return TakenModel(kind, whole, tuple(lines))


def _one_line(text: str) -> str:
    """A sentence without characters that would end a comment of a YAML file."""
    return "".join(c if c.isprintable() else "?" for c in text)
