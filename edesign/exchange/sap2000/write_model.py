"""A model as SAP2000's tables in kN, m and C."""

from __future__ import annotations

from collections.abc import Iterator, Mapping

from edesign import __version__
from edesign.exchange.sap2000.model import (
    DIRECTIONS,
    FREE,
    RELEASES,
    FrameObject,
    Sap2000Model,
    Section,
)
from edesign.exchange.sap2000.tables import Value, written_tables
from edesign.exchange.sap2000.write_loads import Records, case_tables, load_tables

_KILO = 1e3
_VERSION = "20.2.0"  # of SAP2000, whose tables these are; newer ones import them


def model_text(model: Sap2000Model, name: str, mark: str) -> str:
    """Return a model as the text that SAP2000 imports.

    Args:
        model: in SI.
        mark: how its first line begins to say who wrote it.
    """
    return written_tables(f"File {name} was saved on m/d/yy at h:mm:ss. {mark} {__version__}", _tables(model))


def _tables(model: Sap2000Model) -> Iterator[tuple[str, Records]]:
    yield "PROGRAM CONTROL", iter([{"ProgramName": "SAP2000", "Version": _VERSION, "CurrUnits": "KN, m, C"}])
    degrees = zip(("UX", "UY", "UZ", "RX", "RY", "RZ"), model.degrees, strict=True)
    yield "ACTIVE DEGREES OF FREEDOM", iter([dict(degrees)])
    axes = dict.fromkeys(("X", "Y", "Z", "AboutZ", "AboutY", "AboutX"), 0)
    yield "COORDINATE SYSTEMS", iter([{"Name": "GLOBAL", "Type": "Cartesian", **axes}])
    about = {"Project Name": model.title, "Model Description": "; ".join(model.about)}
    yield "PROJECT INFORMATION", ({"Item": item, "Data": text} for item, text in about.items() if text)
    yield from _properties(model)
    yield from _geometry(model)
    yield from load_tables(model)
    yield from case_tables(model)


def _properties(model: Sap2000Model) -> Iterator[tuple[str, Records]]:
    materials = model.materials.values()
    yield (
        "MATERIAL PROPERTIES 01 - GENERAL",
        ({"Material": m.name, "Type": m.kind, "SymType": "Isotropic", "TempDepend": False} for m in materials),
    )
    yield (
        "MATERIAL PROPERTIES 02 - BASIC MECHANICAL PROPERTIES",
        (
            {
                "Material": m.name,
                "UnitWeight": m.weight / _KILO,
                "UnitMass": m.density / _KILO,
                "E1": m.E / _KILO,
                "G12": m.E / (2.0 * (1.0 + m.nu)) / _KILO,
                "U12": m.nu,
                "A1": 1.2e-5,  # per degree, EN 1993-1-1, 3.2.6(1); no load of this file uses it
            }
            for m in materials
        ),
    )
    yield (
        "MATERIAL PROPERTIES 03A - STEEL DATA",
        ({"Material": m.name, "Fy": m.fy / _KILO, "EffFy": m.fy / _KILO} for m in materials if m.fy is not None),
    )
    yield "FRAME SECTION PROPERTIES 01 - GENERAL", (_section(section) for section in model.sections.values())
    yield (
        "LINK PROPERTY DEFINITIONS 01 - GENERAL",
        (
            {"Link": p.name, "LinkType": p.kind, "Mass": 0, "Weight": 0, "RotInert1": 0, "RotInert2": 0, "RotInert3": 0}
            | {"DefLength": 1, "DefArea": 1, "PDM2I": 0, "PDM2J": 0, "PDM3I": 0, "PDM3J": 0}
            for p in model.link_properties.values()
        ),
    )
    linear = {"TransKE": "stiffness", "TransCE": "damping"}
    damper = {**linear, "TransK": "k", "TransC": "c"}
    for kind, table, fields in (
        ("Linear", "LINK PROPERTY DEFINITIONS 02 - LINEAR", linear),
        ("Damper - Exponential", "LINK PROPERTY DEFINITIONS 04 - DAMPER", damper),
    ):
        records: list[Mapping[str, Value]] = []
        for p in model.link_properties.values():
            if p.kind == kind:
                record: dict[str, Value] = {"Link": p.name, "DOF": "U1", "Fixed": False}
                record |= {} if kind == "Linear" else {"NonLinear": True}
                record |= {field: getattr(p, key) / _KILO for field, key in fields.items()}
                records.append(record if kind == "Linear" else record | {"CExp": p.exponent})
        yield table, iter(records)


def _section(section: Section) -> Mapping[str, Value]:
    sizes = {"t3": section.depth, "t2": section.width} if section.depth and section.width else {}
    return {
        "SectionName": section.name,
        "Material": section.material,
        "Shape": "General",
        **sizes,
        "Area": section.area,
        "TorsConst": section.J,
        "I33": section.I33,
        "I22": section.I22,
        "I23": 0,
        "AS2": section.AS2,
        "AS3": section.AS3,
        "FromFile": False,
        "AMod": section.axial_share,
        **dict.fromkeys(("A2Mod", "A3Mod", "JMod", "I2Mod", "I3Mod", "MMod", "WMod"), 1),
    }


def _geometry(model: Sap2000Model) -> Iterator[tuple[str, Records]]:
    place = {"CoordSys": "GLOBAL", "CoordType": "Cartesian"}
    yield (
        "JOINT COORDINATES",
        ({"Joint": n, **place, "XorR": x, "Y": y, "Z": z, "SpecialJt": True} for n, (x, y, z) in model.joints.items()),
    )
    frames = model.frames.values()
    yield (
        "CONNECTIVITY - FRAME",
        ({"Frame": f.name, "JointI": f.i, "JointJ": f.j, "IsCurved": False} for f in frames),
    )
    yield "CONNECTIVITY - LINK", ({"Link": k.name, "JointI": k.i, "JointJ": k.j} for k in model.links.values())
    yield (
        "JOINT RESTRAINT ASSIGNMENTS",
        ({"Joint": n, **dict(zip(DIRECTIONS, flags, strict=True))} for n, flags in model.restraints.items()),
    )
    yield (
        "JOINT SPRING ASSIGNMENTS 1 - UNCOUPLED",
        (
            {"Joint": n, "CoordSys": "GLOBAL", **{d: v / _KILO for d, v in zip(DIRECTIONS, stiffnesses, strict=True)}}
            for n, stiffnesses in model.springs.items()
        ),
    )
    yield (
        "CONSTRAINT DEFINITIONS - DIAPHRAGM",
        ({"Name": n, "CoordSys": "GLOBAL", "Axis": "Z", "MultiLevel": False} for n in model.diaphragms),
    )
    yield (
        "JOINT CONSTRAINT ASSIGNMENTS",
        ({"Joint": j, "Constraint": n} for n, joints in model.diaphragms.items() for j in joints),
    )
    yield (
        "JOINT ADDED MASS ASSIGNMENTS",
        (
            {"Joint": n, "CoordSys": "GLOBAL", "Mass1": x / _KILO, "Mass2": y / _KILO, "Mass3": z / _KILO}
            | dict.fromkeys(("MMI1", "MMI2", "MMI3"), 0)
            for n, (x, y, z) in model.joint_masses.items()
        ),
    )
    yield (
        "FRAME SECTION ASSIGNMENTS",
        (
            {"Frame": f.name, "SectionType": "General", "AutoSelect": "N.A.", "AnalSect": f.section}
            | {"DesignSect": f.section, "MatProp": "Default"}
            for f in frames
        ),
    )
    yield (
        "FRAME LOCAL AXES ASSIGNMENTS 1 - TYPICAL",
        ({"Frame": f.name, "Angle": f.angle, "AdvanceAxes": False} for f in frames if f.angle != 0.0),
    )
    loose = [f for f in frames if f.released != (FREE, FREE)]
    yield "FRAME RELEASE ASSIGNMENTS 1 - GENERAL", (_released(f) for f in loose)
    yield "FRAME RELEASE ASSIGNMENTS 2 - PARTIAL FIXITY", (_partial(f) for f in loose if any(map(any, f.springs)))
    # joints on a frame do not divide it: those that do are its ends
    yield (
        "FRAME AUTO MESH ASSIGNMENTS",
        ({"Frame": f.name, "AutoMesh": False} for f in frames),
    )
    yield (
        "LINK PROPERTY ASSIGNMENTS",
        (
            {"Link": k.name, "LinkType": model.link_properties[k.property].kind, "LinkJoints": "TwoJoint"}
            | {"LinkProp": k.property, "LinkFDProp": "None"}
            for k in model.links.values()
        ),
    )


def _released(frame: FrameObject) -> Mapping[str, Value]:
    ends = {f"{name}{end}": frame.released[i][n] for i, end in enumerate("IJ") for n, name in enumerate(RELEASES)}
    return {"Frame": frame.name, **ends, "PartialFix": any(map(any, frame.springs))}


def _partial(frame: FrameObject) -> Mapping[str, Value]:
    stiffnesses = {
        f"{name}{end}": frame.springs[i][n] / _KILO
        for i, end in enumerate("IJ")
        for n, name in enumerate(RELEASES)
        if frame.springs[i][n] > 0.0
    }
    return {"Frame": frame.name, **stiffnesses}
