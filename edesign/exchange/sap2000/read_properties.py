"""Materials, sections and link properties of SAP2000's tables."""

from __future__ import annotations

from edesign.exchange.sap2000.model import LinkProperty, Material, Sap2000Model, Section
from edesign.exchange.sap2000.records import keyed
from edesign.exchange.sap2000.tables import Row, Tables
from edesign.exchange.sap2000.units import Units

STEEL_DATA = "MATERIAL PROPERTIES 03A - STEEL DATA"
SECTIONS = "FRAME SECTION PROPERTIES 01 - GENERAL"
_SIZES = {"depth": "t3", "width": "t2", "flange": "tf", "web": "tw"}
_PAIRS = (("t2b", "t2"), ("tfb", "tf"))


def read_materials(tables: Tables, units: Units, model: Sap2000Model) -> None:
    """Add the materials of tables to a model."""
    general = "MATERIAL PROPERTIES 01 - GENERAL"
    kinds = keyed(tables, general, "Material", lambda row: row.text("Type", "Other"))
    yields = keyed(tables, STEEL_DATA, "Material", lambda row: row.number("Fy") * units.stress)

    def material(row: Row) -> Material:
        name, E = row.text("Material"), row.number("E1") * units.stress
        if E <= 0.0:
            raise row.error("the modulus of elasticity is not greater than zero [E-SAP-08]")
        nu = row.number("U12", 0.3)
        density = row.number("UnitMass", 0.0) * units.mass / units.length**3
        weight = row.number("UnitWeight", 0.0) * units.force / units.length**3
        return Material(name, kinds.get(name, "Other"), E, nu, weight, density, yields.get(name), row)

    table = "MATERIAL PROPERTIES 02 - BASIC MECHANICAL PROPERTIES"
    rows = [row for row in tables.of(table) if row.has("E1")]
    model.materials = keyed(Tables(tables.path, {table: rows}), table, "Material", material)


def read_sections(tables: Tables, units: Units, model: Sap2000Model) -> None:
    """Add the frame sections of tables to a model."""
    length = units.length

    def section(row: Row) -> Section:
        name = row.text("SectionName")
        model.rows["section", name] = row
        sizes = {key: row.number(field, 0.0) * length for key, field in _SIZES.items()}
        same = all(abs(row.number(a, row.number(b, 0.0)) - row.number(b, 0.0)) < 1e-9 for a, b in _PAIRS)
        for field in ("A2Mod", "A3Mod", "JMod", "I2Mod", "I3Mod", "MMod", "WMod"):
            if row.number(field, 1.0) != 1.0:
                raise row.error(
                    f"section {name}: the modifier `{field}` is not 1; give its properties instead [E-SAP-12]"
                )
        return Section(
            name=name,
            material=row.text("Material", ""),
            area=row.number("Area", 0.0) * length**2,
            J=row.number("TorsConst", 0.0) * length**4,
            I33=row.number("I33", 0.0) * length**4,
            I22=row.number("I22", 0.0) * length**4,
            AS2=row.number("AS2", 0.0) * length**2,
            AS3=row.number("AS3", 0.0) * length**2,
            shape=row.text("Shape", "General"),
            catalogue=row.text("SectInFile", name),
            equal_flanges=same,
            axial_share=row.number("AMod", 1.0),
            row=row,
            **sizes,
        )

    model.sections = keyed(tables, SECTIONS, "SectionName", section)


def read_link_properties(tables: Tables, units: Units, model: Sap2000Model) -> None:
    """Add the properties of links that are used to a model: springs and dampers along their axis."""
    used = {row.text("LinkProp") for row in tables.of("LINK PROPERTY ASSIGNMENTS")}
    for row in tables.of("LINK PROPERTY DEFINITIONS 01 - GENERAL"):
        for field, what in (("Mass", "masses"), ("Weight", "loads")):
            if row.text("Link") in used and row.number(field, 0.0):
                raise row.error(
                    f"link property {row.text('Link')} has a `{field}`, which dampers of edesign do not have; give "
                    f"half of it to each joint of its links, with the {what} of joints [E-SAP-13]"
                )
    stiffness, damping = units.force / units.length, units.force / units.length
    for table in ("LINK PROPERTY DEFINITIONS 02 - LINEAR", "LINK PROPERTY DEFINITIONS 04 - DAMPER"):
        for row in tables.of(table):
            name = row.text("Link")
            if name not in used:
                continue
            if row.text("DOF").upper() != "U1":
                raise row.error(
                    f"link property {name} acts along {row.text('DOF')}; only U1, its axis, is taken [E-SAP-13]"
                )
            if name in model.link_properties:
                raise row.error(f"Link {name} is there twice [E-SAP-06]")
            if row.yes("Fixed"):
                raise row.error(
                    f"link property {name} is fixed along U1; only springs and dampers are taken [E-SAP-13]"
                )
            exponent = row.number("CExp", 1.0)
            model.link_properties[name] = LinkProperty(
                name,
                "Linear" if table.endswith("LINEAR") else "Damper - Exponential",
                row.number("TransKE", 0.0) * stiffness,
                row.number("TransCE", 0.0) * damping,
                row.number("TransK", 0.0) * stiffness,
                row.number("TransC", 0.0) * units.force / units.length**exponent,
                exponent,
                row.yes("NonLinear"),
                row,
            )
