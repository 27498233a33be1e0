"""SAP2000's tables as a model, and what the model does not take of them."""

from __future__ import annotations

from dataclasses import dataclass, field

import numpy as np

from edesign.errors import InputError
from edesign.exchange.sap2000.model import (
    DIRECTIONS,
    RELEASES,
    FrameObject,
    Link,
    Sap2000Model,
)
from edesign.exchange.sap2000.read_loads import read_cases, read_loads, read_masses
from edesign.exchange.sap2000.read_properties import (
    SECTIONS,
    STEEL_DATA,
    read_link_properties,
    read_materials,
    read_sections,
)
from edesign.exchange.sap2000.records import keyed, known_name, six_flags, six_values
from edesign.exchange.sap2000.tables import Row, Tables
from edesign.exchange.sap2000.units import Units, units_of
from edesign.project.reading.problems import listed
from edesign.project.reading.words import counted

_TAKEN = {
    *("PROGRAM CONTROL", "ACTIVE DEGREES OF FREEDOM", "COORDINATE SYSTEMS", "PROJECT INFORMATION"),
    *("MATERIAL PROPERTIES 01 - GENERAL", "MATERIAL PROPERTIES 02 - BASIC MECHANICAL PROPERTIES", STEEL_DATA),
    *(SECTIONS, "FRAME SECTION ASSIGNMENTS", "FRAME LOCAL AXES ASSIGNMENTS 1 - TYPICAL", "CONNECTIVITY - FRAME"),
    *("FRAME RELEASE ASSIGNMENTS 1 - GENERAL", "FRAME RELEASE ASSIGNMENTS 2 - PARTIAL FIXITY"),
    *("JOINT COORDINATES", "JOINT RESTRAINT ASSIGNMENTS", "JOINT SPRING ASSIGNMENTS 1 - UNCOUPLED"),
    *("CONSTRAINT DEFINITIONS - DIAPHRAGM", "JOINT CONSTRAINT ASSIGNMENTS", "JOINT ADDED MASS ASSIGNMENTS"),
    *("CONNECTIVITY - LINK", "LINK PROPERTY ASSIGNMENTS", "LINK PROPERTY DEFINITIONS 01 - GENERAL"),
    *("LINK PROPERTY DEFINITIONS 02 - LINEAR", "LINK PROPERTY DEFINITIONS 04 - DAMPER"),
    *("LOAD PATTERN DEFINITIONS", "JOINT LOADS - FORCE", "FRAME LOADS - DISTRIBUTED", "FRAME LOADS - POINT"),
    *("FRAME LOADS - GRAVITY", "MASS SOURCE", "MASSES 1 - MASS SOURCE", "FRAME AUTO MESH ASSIGNMENTS"),
    *("FRAME OFFSET ALONG LENGTH ASSIGNMENTS", "FRAME TENSION AND COMPRESSION LIMITS", "FRAME PROPERTY MODIFIERS"),
}
"""Tables that are read."""
_PARTLY = {"LOAD CASE DEFINITIONS", "CASE - STATIC 1 - LOAD ASSIGNMENTS", "CASE - STATIC 4 - NONLINEAR PARAMETERS"}
_HARMLESS = (
    *("FRAME OUTPUT STATION", "FRAME DESIGN PROCEDURES", "FRAME LOAD TRANSFER", "FRAME SECTION PROPERTIES 13"),
    *("FRAME SECTION PROPERTIES 05", "JOINT PATTERN", "FRAME SECTION PROPERTIES 02", "FRAME SECTION PROPERTIES 03"),
    *("CONSTRAINT DEFINITIONS", "LINK PROPERTY DEFINITIONS", "SOLID PROPERTY DEFINITIONS", "AREA SECTION PROPERT"),
    *("FRAME HINGE ASSIGNS", "FRAME AUTO SELECT", "FRAME P-DELTA", "CABLE SECTION", "TENDON SECTION"),
    *("FRAME OVERWRITES", "LINK LOCAL AXES"),
)
"""Beginnings of tables of parts that change nothing, or nothing unless other tables refer to them."""
_STRUCTURE = ("FRAME", "JOINT", "LINK", "CONNECTIVITY", "AREA", "SOLID", "CABLE", "TENDON", "CONSTRAINT")
"""Beginnings of tables of the structure and its loads."""


@dataclass
class ReadModel:
    """A model, and what is not taken of its file.

    Attributes:
        left_out: lines: a table, how many records, why.
    """

    model: Sap2000Model
    left_out: list[str] = field(default_factory=list)


def read_model(tables: Tables) -> ReadModel:
    """Return the model that tables describe.

    Raises:
        InputError: a record is wrong, refers to what does not exist, or is of a kind that cannot be taken and that
            would change the answer.
    """
    units = units_of(tables)
    found = ReadModel(Sap2000Model(title=_title(tables)))
    _check_tables(tables, found)
    model = found.model
    _coordinate_systems(tables)
    for row in tables.of("ACTIVE DEGREES OF FREEDOM")[:1]:
        model.degrees = six_flags(row.yes(name, True) for name in ("UX", "UY", "UZ", "RX", "RY", "RZ"))
    _joints(tables, units, model)
    read_materials(tables, units, model)
    read_sections(tables, units, model)
    read_link_properties(tables, units, model)
    _frames(tables, units, model)
    _links(tables, model)
    _constraints(tables, model)
    read_loads(tables, units, model)
    read_masses(tables, units, model)
    read_cases(tables, model)
    return found


def _title(tables: Tables) -> str:
    items = {row.text("Item", ""): row.text("Data", "") for row in tables.of("PROJECT INFORMATION")}
    return next((items[name] for name in ("Project Name", "Model Name") if items.get(name)), "")


def _check_tables(tables: Tables, found: ReadModel) -> None:
    """Refuse tables of the structure that are not read, and list the others."""
    for name, rows in tables.rows.items():
        if name in _TAKEN or not rows:
            continue
        if name.startswith(_STRUCTURE) and not name.startswith(_HARMLESS):
            raise rows[0].error(
                f"edesign takes no such table, and without its {len(rows)} records the structure would be another; "
                "take these parts out of the model [E-SAP-11]"
            )
        partly = ", but for the loads before the modes" if name in _PARTLY else ""
        found.left_out.append(f"{name}: {counted(len(rows), 'record')}{partly}")


def _coordinate_systems(tables: Tables) -> None:
    for row in tables.of("JOINT COORDINATES"):
        if row.text("CoordSys", "GLOBAL").upper() != "GLOBAL" or row.text("CoordType", "Cartesian") != "Cartesian":
            raise row.error("coordinates are taken in the system GLOBAL, Cartesian, only [E-SAP-10]")


def _joints(tables: Tables, units: Units, model: Sap2000Model) -> None:
    def place(row: Row) -> tuple[float, float, float]:
        model.rows["joint", row.text("Joint")] = row
        x, y, z = (row.number(name) * units.length for name in ("XorR", "Y", "Z"))
        return x, y, z

    model.joints = keyed(tables, "JOINT COORDINATES", "Joint", place)
    if not model.joints:
        raise InputError(
            f"{tables.path}: the table JOINT COORDINATES is missing or empty: there is no structure [E-SAP-07]"
        )
    for row in keyed(tables, "JOINT RESTRAINT ASSIGNMENTS", "Joint", lambda row: row).values():
        restraints = six_flags(row.yes(name) for name in DIRECTIONS)
        model.restraints[known_name(row, "Joint", model.joints, "joint")] = restraints
        model.rows["restraint", row.text("Joint")] = row
    for row in keyed(tables, "JOINT SPRING ASSIGNMENTS 1 - UNCOUPLED", "Joint", lambda row: row).values():
        if row.text("CoordSys", "GLOBAL").upper() not in ("GLOBAL", "LOCAL"):  # joints have no local axes of their own
            raise row.error("springs are taken in the system GLOBAL only [E-SAP-10]")
        factors = [units.force / units.length] * 3 + [units.moment] * 3
        springs = six_values(row.number(n, 0.0) * f for n, f in zip(DIRECTIONS, factors, strict=True))
        if min(springs) < 0.0:
            raise row.error("a stiffness is negative [E-SAP-09]")
        model.springs[known_name(row, "Joint", model.joints, "joint")] = springs
        model.rows["spring", row.text("Joint")] = row


def _frames(tables: Tables, units: Units, model: Sap2000Model) -> None:
    assigned = keyed(tables, "FRAME SECTION ASSIGNMENTS", "Frame", lambda row: row)
    turned = keyed(tables, "FRAME LOCAL AXES ASSIGNMENTS 1 - TYPICAL", "Frame", _angle)
    flags = [f"{name}{end}" for end in "IJ" for name in RELEASES]
    general, partial = (
        "FRAME RELEASE ASSIGNMENTS 1 - GENERAL",
        "FRAME RELEASE ASSIGNMENTS 2 - PARTIAL FIXITY",
    )
    loose = keyed(tables, general, "Frame", lambda row: [row.yes(name) for name in flags])
    stiffnesses = keyed(tables, partial, "Frame", lambda row: [row.number(name, 0.0) for name in flags])
    factors = ([units.force / units.length] * 3 + [units.moment] * 3) * 2

    def frame(row: Row) -> FrameObject:
        name = row.text("Frame")
        model.rows["frame", name] = row
        i, j = (known_name(row, key, model.joints, "joint") for key in ("JointI", "JointJ"))
        if row.yes("IsCurved"):
            raise row.error(f"frame {name} is curved; only straight members are taken [E-SAP-12]")
        if name not in assigned:
            raise row.error(f"frame {name} has no section in FRAME SECTION ASSIGNMENTS [E-SAP-05]")
        section = known_name(assigned[name], "AnalSect", model.sections, "section of FRAME SECTION PROPERTIES 01")
        if assigned[name].text("MatProp", "Default") != "Default":
            raise assigned[name].error(f"frame {name} has a material of its own; give it to a section [E-SAP-12]")
        if np.linalg.norm(np.subtract(model.joints[i], model.joints[j])) < 1e-6:
            raise row.error(f"frame {name} has no length: joints {i} and {j} are in one place [E-SAP-09]")
        released = loose.get(name, [False] * 12)
        springs = [value * factor for value, factor in zip(stiffnesses.get(name, [0.0] * 12), factors, strict=True)]
        springs = [spring if free else 0.0 for spring, free in zip(springs, released, strict=True)]
        return FrameObject(
            name,
            i,
            j,
            section,
            turned.get(name, 0.0),
            (six_flags(iter(released[:6])), six_flags(iter(released[6:]))),
            (six_values(iter(springs[:6])), six_values(iter(springs[6:]))),
            row,
        )

    model.frames = keyed(tables, "CONNECTIVITY - FRAME", "Frame", frame)
    if not model.frames:
        raise InputError(
            f"{tables.path}: the table CONNECTIVITY - FRAME is missing or empty: there are no members [E-SAP-07]"
        )
    for table in (*_ASSIGNED, general, partial, "FRAME LOCAL AXES ASSIGNMENTS 1 - TYPICAL"):
        for row in tables.of(table):
            known_name(row, "Frame", model.frames, "frame")
            _check_assigned(row)


def _angle(row: Row) -> float:
    if row.yes("AdvanceAxes"):
        raise row.error("advanced local axes are not taken; turn the frame by an angle [E-SAP-12]")
    return row.number("Angle", 0.0)


_ASSIGNED = (
    "FRAME OFFSET ALONG LENGTH ASSIGNMENTS",
    "FRAME TENSION AND COMPRESSION LIMITS",
    "FRAME PROPERTY MODIFIERS",
)


def _check_assigned(row: Row) -> None:
    """Refuse what a frame has and no member of edesign; records that change nothing pass."""
    name = row.text("Frame")
    if row.table == _ASSIGNED[0] and (row.number("LengthI", 0.0) or row.number("LengthJ", 0.0)):
        if row.number("RigidFact", 0.0):
            raise row.error(
                f"frame {name} has rigid ends, which are not taken; set their rigid zone factor to 0 [E-SAP-12]"
            )
    if row.table == _ASSIGNED[1] and (row.yes("TensLimit") or row.yes("CompLimit")):
        raise row.error(f"frame {name} has a limit of its axial force, which makes the analysis nonlinear [E-SAP-12]")
    if row.table == _ASSIGNED[2]:
        for field in ("AMod", "AS2Mod", "AS3Mod", "JMod", "I22Mod", "I33Mod", "MassMod", "WeightMod"):
            if row.number(field, 1.0) != 1.0:
                raise row.error(
                    f"frame {name}: the modifier `{field}` is not 1; give its section other properties [E-SAP-12]"
                )


def _links(tables: Tables, model: Sap2000Model) -> None:
    kinds = keyed(tables, "LINK PROPERTY DEFINITIONS 01 - GENERAL", "Link", lambda row: row)
    properties = keyed(tables, "LINK PROPERTY ASSIGNMENTS", "Link", lambda row: row)

    def link(row: Row) -> Link:
        name = row.text("Link")
        model.rows["link", name] = row
        i, j = (known_name(row, key, model.joints, "joint") for key in ("JointI", "JointJ"))
        if name not in properties:
            raise row.error(f"link {name} has no property in LINK PROPERTY ASSIGNMENTS [E-SAP-05]")
        of = properties[name].text("LinkProp")
        if of not in model.link_properties:
            kind = kinds[of].text("LinkType", "") if of in kinds else "unknown"
            allowed = listed(["Linear", "Damper - Exponential"])
            raise properties[name].error(
                f"link {name} has the property {of} of the type `{kind}`; taken are {allowed} [E-SAP-13]"
            )
        return Link(name, i, j, of, row)

    model.links = keyed(tables, "CONNECTIVITY - LINK", "Link", link)


def _constraints(tables: Tables, model: Sap2000Model) -> None:
    levels = {}
    for row in keyed(tables, "CONSTRAINT DEFINITIONS - DIAPHRAGM", "Name", lambda row: row).values():
        if row.text("Axis", "Z").upper() not in ("Z", "AUTO") or row.text("CoordSys", "GLOBAL").upper() != "GLOBAL":
            raise row.error(f"diaphragm {row.text('Name')} is not horizontal [E-SAP-14]")
        levels[row.text("Name")] = row.yes("MultiLevel")
        model.diaphragms[row.text("Name")] = []
    for row in tables.of("JOINT CONSTRAINT ASSIGNMENTS"):
        joint, name = known_name(row, "Joint", model.joints, "joint"), row.text("Constraint")
        if name not in levels:
            raise row.error(f"joint {joint} has the constraint {name}; only diaphragms are taken [E-SAP-14]")
        model.rows["diaphragm", name] = row
        model.diaphragms[name].append(joint)
    for name in [name for name, multi in levels.items() if multi]:
        for joint in model.diaphragms.pop(name):
            level = f"{name} at Z = {model.joints[joint][2]:g} m"
            model.diaphragms.setdefault(level, []).append(joint)
