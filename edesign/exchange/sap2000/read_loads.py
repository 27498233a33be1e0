"""Load patterns, loads, masses and the gravity case of SAP2000's tables."""

from __future__ import annotations

from collections.abc import Iterable, Mapping

import numpy as np

from edesign.exchange.sap2000.model import (
    FrameLoad,
    FramePoint,
    GravityCase,
    JointLoad,
    LoadPattern,
    MassSource,
    Sap2000Model,
    Vector,
)
from edesign.exchange.sap2000.records import keyed
from edesign.exchange.sap2000.tables import Row, Tables
from edesign.exchange.sap2000.units import Units
from edesign.project.notation.units import STANDARD_GRAVITY
from edesign.project.reading.problems import did_you_mean

_FORCES = ("F1", "F2", "F3", "M1", "M2", "M3")
_GLOBAL: Mapping[str, Vector] = {
    "X": (1.0, 0.0, 0.0),
    "Y": (0.0, 1.0, 0.0),
    "Z": (0.0, 0.0, 1.0),
    "GRAVITY": (0.0, 0.0, -1.0),
}
GENTLE = 1e-9
"""Share of a sum or length that counts as nothing."""


def read_loads(tables: Tables, units: Units, model: Sap2000Model) -> None:
    """Add the load patterns and loads of tables to a model, whose joints and frames it has."""
    model.patterns = keyed(tables, "LOAD PATTERN DEFINITIONS", "LoadPat", _load_pattern)
    for row in tables.of("JOINT LOADS - FORCE"):
        system = row.text("CoordSys", "GLOBAL").upper()
        if system not in ("GLOBAL", "LOCAL"):  # joints have no local axes of their own
            raise row.error(f"forces in the system {system} are not taken, only in GLOBAL [E-SAP-10]")
        joint = _part(row, "Joint", model.joints)
        values = [row.number(name, 0.0) for name in _FORCES]
        a, b, c = (value * units.force for value in values[:3])
        d, e, f = (value * units.moment for value in values[3:])
        model.joint_loads.append(JointLoad(joint, _pattern(row, model), (a, b, c, d, e, f), row))
    for row in tables.of("FRAME LOADS - DISTRIBUTED"):
        _distributed(row, units, model)
    for row in tables.of("FRAME LOADS - POINT"):
        frame, along = _frame_direction(row, model)
        at = _place(row, "", units, model.length(model.frames[frame]))
        force = row.number("Force") * units.force
        model.frame_points.append(FramePoint(frame, _pattern(row, model), along, at, force, row))
    for row in tables.of("FRAME LOADS - GRAVITY"):
        _gravity(row, model)


def _load_pattern(row: Row) -> LoadPattern:
    return LoadPattern(row.text("LoadPat"), row.text("DesignType", "Other"), row.number("SelfWtMult", 0.0), row)


def _distributed(row: Row, units: Units, model: Sap2000Model) -> None:
    frame, along = _frame_direction(row, model)
    length = model.length(model.frames[frame])
    begin, end = (_place(row, letter, units, length) for letter in "AB")
    if begin > end:
        raise row.error("the load ends before it begins [E-SAP-09]")
    first, last = (row.number(f"FOverL{letter}") * units.force / units.length for letter in "AB")
    if end > begin:
        model.frame_loads.append(FrameLoad(frame, _pattern(row, model), along, begin, end, first, last, row))


def _gravity(row: Row, model: Sap2000Model) -> None:
    """Multiples of the weight of a frame, along the global axes."""
    frame = model.frames[_part(row, "Frame", model.frames)]
    section = model.sections[frame.section]
    weight = section.area * (model.materials[section.material].weight if section.material in model.materials else 0.0)
    for name, along in (("X", _GLOBAL["X"]), ("Y", _GLOBAL["Y"]), ("Z", _GLOBAL["Z"])):
        q = row.number(f"Multiplier{name}", 0.0) * weight
        if q != 0.0:
            model.frame_loads.append(FrameLoad(frame.name, _pattern(row, model), along, 0.0, 1.0, q, q, row))


def _part(row: Row, key: str, there: Mapping[str, object]) -> str:
    name = row.text(key)
    if name not in there:
        raise row.error(f"`{key}={name}`: there is no such {key.lower()}{did_you_mean(name, list(there))} [E-SAP-05]")
    return name


def _pattern(row: Row, model: Sap2000Model) -> str:
    name = row.text("LoadPat")
    if name not in model.patterns:
        raise row.error(
            f"`LoadPat={name}`: there is no such load pattern{did_you_mean(name, model.patterns)} [E-SAP-05]"
        )
    return name


def _frame_direction(row: Row, model: Sap2000Model) -> tuple[str, Vector]:
    """The frame that a load is on, and its direction as a global unit vector."""
    frame = _part(row, "Frame", model.frames)
    if row.text("Type", "Force").lower() != "force":
        raise row.error(f"moments along frame {frame} are not taken [E-SAP-25]")
    system, direction = row.text("CoordSys", "GLOBAL").upper(), row.text("Dir").upper()
    if system == "GLOBAL" and direction in _GLOBAL:
        return frame, _GLOBAL[direction]
    axes = model.axes(model.frames[frame])
    if system == "LOCAL" and direction in ("1", "2", "3"):
        x, y, z = (round(float(part), 12) + 0.0 for part in axes[int(direction) - 1])
        return frame, (x, y, z)
    if direction == "GRAV PROJ" and abs(axes[0][2]) < GENTLE:  # on a level frame the same
        return frame, _GLOBAL["GRAVITY"]
    raise row.error(f"the load on frame {frame} acts along {direction} of {system}, which is not taken [E-SAP-10]")


def _place(row: Row, letter: str, units: Units, length: float) -> float:
    """A place along a frame as a share of its length."""
    if row.text("DistType", "RelDist").lower() == "reldist":
        share = row.number(f"RelDist{letter}")
    else:
        share = row.number(f"AbsDist{letter}") * units.length / length
    if not -GENTLE <= share <= 1.0 + GENTLE:
        raise row.error(f"the load stands at {share:g} of the length of its frame, outside of it [E-SAP-09]")
    return min(max(share, 0.0), 1.0)


def read_masses(tables: Tables, units: Units, model: Sap2000Model) -> None:
    """Add the added masses of joints and the mass source to a model."""
    for row in keyed(tables, "JOINT ADDED MASS ASSIGNMENTS", "Joint", lambda row: row).values():
        joint = _part(row, "Joint", model.joints)
        x, y, z = (row.number(f"Mass{axis}", 0.0) * units.mass for axis in "123")
        if min(x, y, z) < 0.0:
            raise row.error(f"joint {joint} has a negative mass [E-SAP-09]")
        if any(row.number(f"MMI{axis}", 0.0) for axis in "123"):
            raise row.error(f"joint {joint} has a rotational inertia, which nodes of edesign do not have [E-SAP-15]")
        model.joint_masses[joint] = x, y, z
        model.rows["mass", joint] = row
    rows = tables.of("MASS SOURCE")
    if rows:
        names = [row.text("MassSource", "") for row in rows if row.yes("IsDefault")]
        chosen = names[0] if names else rows[0].text("MassSource", "")
        own = [row for row in rows if row.text("MassSource", "") == chosen]
        model.mass_source = MassSource(own[0].yes("Elements"), own[0].yes("Masses"), _mass_patterns(own, model))
        return
    if rows := tables.of("MASSES 1 - MASS SOURCE"):  # up to version 15
        kind = next((row.text("MassFrom") for row in rows if row.has("MassFrom")), "Elements").lower()
        elements = "element" in kind
        model.mass_source = MassSource(elements, elements, _mass_patterns(rows, model))
        return
    model.mass_source = MassSource(elements=True, joints=True)  # what SAP2000 takes without the table


def _mass_patterns(rows: Iterable[Row], model: Sap2000Model) -> dict[str, float]:
    """The factors of the load patterns of a mass source, each of which has a record."""
    found: dict[str, float] = {}
    for row in rows:
        if row.has("LoadPat"):
            name = _pattern(row, model)
            if name in found:
                raise row.error(f"LoadPat {name} is there twice [E-SAP-06]")
            found[name] = row.number("Multiplier", 1.0)
    return found


def read_cases(tables: Tables, model: Sap2000Model) -> None:
    """Find the gravity loads before the modes: the case that the modal case begins with, or GRAVITY."""
    cases = keyed(tables, "LOAD CASE DEFINITIONS", "Case", lambda row: row)
    modal = [row for row in cases.values() if row.text("Type", "") == "LinModal"]
    before = [row.text("InitialCond", "Zero") for row in modal]
    name = next((case for case in before if case in cases), "GRAVITY" if "GRAVITY" in cases else "")
    if not name:
        return
    factors: dict[str, float] = {}
    for row in tables.of("CASE - STATIC 1 - LOAD ASSIGNMENTS"):
        if row.text("Case") != name:
            continue
        if row.text("LoadType", "Load pattern").lower() != "load pattern":
            raise row.error(f"the case {name} before the modes has loads that are no load patterns [E-SAP-25]")
        pattern = row.text("LoadName")
        if pattern not in model.patterns:
            raise row.error(
                f"`LoadName={pattern}`: there is no such load pattern{did_you_mean(pattern, model.patterns)} [E-SAP-05]"
            )
        factors[pattern] = factors.get(pattern, 0.0) + row.number("LoadSF", 1.0)
    kinds = {
        row.text("Case"): row.text("GeoNonLin", "None") for row in tables.of("CASE - STATIC 4 - NONLINEAR PARAMETERS")
    }
    stiffened = name in before and kinds.get(name, "None") != "None"
    model.gravity = GravityCase(factors, stiffened)


def nodal_masses(model: Sap2000Model) -> dict[str, np.ndarray]:
    """Return the mass of each joint along X, Y, Z, kg, of the mass source.

    Frames and the loads on them count at their ends as if these were simply supported.

    Raises:
        InputError: a joint at which no frame ends has a mass.

    Source: CSI Analysis Reference Manual, frame element, mass; mass source.
    """
    found: dict[str, np.ndarray] = {}

    def add(joint: str, mass: float | np.ndarray) -> None:
        found[joint] = found.get(joint, np.zeros(3)) + mass

    source = model.mass_source
    if source.joints:
        for joint, mass in model.joint_masses.items():
            add(joint, np.array(mass))
    if source.elements:
        for frame in model.frames.values():
            section = model.sections[frame.section]
            material = model.materials.get(section.material)
            half = 0.5 * section.area * model.length(frame) * (material.density if material is not None else 0.0)
            if half:
                add(frame.i, half)
                add(frame.j, half)
    for pattern, factor in source.patterns.items():
        for joint, weight in nodal_weights(model, pattern).items():
            add(joint, factor * weight / STANDARD_GRAVITY)
    ends = {joint for frame in model.frames.values() for joint in (frame.i, frame.j)}
    for joint in found:
        if joint not in ends and np.any(found[joint] != 0.0):
            raise model.error(
                "joint", joint, "it has a mass, and no member ends there; give it to joints of members [E-SAP-26]"
            )
    return {joint: mass for joint, mass in found.items() if np.any(mass != 0.0)}


def nodal_weights(model: Sap2000Model, pattern: str) -> dict[str, float]:
    """Return what each joint carries of a load pattern downwards, N, if frames were simply supported."""
    found: dict[str, float] = {}

    def add(joint: str, weight: float) -> None:
        found[joint] = found.get(joint, 0.0) + weight

    for load in model.joint_loads:
        if load.pattern == pattern:
            add(load.joint, -load.forces[2])
    for on_part in model.frame_loads:
        if on_part.pattern != pattern:
            continue
        frame = model.frames[on_part.frame]
        part = (on_part.end - on_part.start) * model.length(frame)
        down = -on_part.along[2]
        whole = 0.5 * (on_part.at_start + on_part.at_end) * part * down
        twice = (on_part.at_start + 2.0 * on_part.at_end) / 6.0 * part * down
        centre = on_part.start * whole + (on_part.end - on_part.start) * twice
        add(frame.i, whole - centre)
        add(frame.j, centre)
    for point in model.frame_points:
        if point.pattern == pattern:
            frame, down = model.frames[point.frame], -point.along[2] * point.force
            add(frame.i, (1.0 - point.at) * down)
            add(frame.j, point.at * down)
    multiple = model.patterns[pattern].self_weight
    if multiple:
        for frame in model.frames.values():
            half = 0.5 * multiple * frame_weight(model, frame.name)
            add(frame.i, half)
            add(frame.j, half)
    return found


def frame_weight(model: Sap2000Model, name: str) -> float:
    """Return the weight of a frame, N."""
    frame = model.frames[name]
    section = model.sections[frame.section]
    material = model.materials.get(section.material)
    return section.area * model.length(frame) * (material.weight if material is not None else 0.0)
