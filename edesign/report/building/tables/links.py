"""The seismic links of eccentric bracings as tables: strength, length and rotation, and what their details ask for."""

from __future__ import annotations

from edesign.codes.rule_check import UNREAD
from edesign.report.building.results import BuildingResults, Row
from edesign.report.tables.column import col, count, text
from edesign.report.tables.table import Table, TableSpec
from edesign.report.tables.unit import KN, MM, ONE, M, Unit

LINKS = TableSpec[Row](
    "links",
    "Seismic links",
    (
        text("link", "member"),
        col("e", M, digits=3),
        text("kind", "category"),
        col("N/N_pl", ONE, "axial", 2),
        col("V/V_p", ONE, "shear_use", 3),
        col("M/M_p", ONE, "moment_use", 3),
        col("Omega_i", ONE, "Omega", 3),
        col("theta_p", Unit("", 1e-3), digits=3),
        col("limit", Unit("", 1e-3), "theta_pR", 3),
    ),
    notes=(
        "V_p, M_p: of web and flanges (EN 1998-1, 6.8.2(3)), less where N/N_pl is above 0.15; Omega_i: 1.5 V_p/V_Ed of "
        "short links, 1.5 M_p/M_Ed of others (6.8.3(1)); theta_p: plastic drift times span over e, "
        "and its limit, mrad (6.8.2(10))",
    ),
    formulas=True,
)
LINK_DETAILS = TableSpec[Row](
    "link_details",
    "Details of seismic links",
    (
        text("link", "member"),
        text("section"),
        col("e_s", M, digits=3),
        col("e_L", M, digits=3),
        col("ends t", MM, "end_thickness", 3),
        col("ends b", MM, "end_width", 3),
        count("between", "count"),
        col("every", MM, "spacing", 3),
        col("t", MM, "thickness", 3),
        col("b", MM, "width", 3),
        text("sides"),
        col("held", KN, "lateral", 3),
    ),
    notes=(
        "e_s, e_L: up to which it is short, from which it is long. ends: stiffeners at both sides of the web where "
        "braces meet it, thickness and width of both together; between: number of others, their largest distance, "
        "thickness, width of each, and at how many sides of the web (6.8.2(11) and (12)); intermediate and long links "
        "have one at 1.5 b_f from either end among them. held: force on the lateral supports of both flanges at the "
        "ends (6.8.2(14)). A link has one web plate without doubler and without hole (6.8.2(1)). Its connections, and "
        "those of the members that have it, resist E_d,G + 1.1 gamma_ov Omega_i E_d,E (6.8.4(1)). Distances below "
        f"0.08 rad, and `held`: {UNREAD[0].lower()}{UNREAD[1:]}",
    ),
    formulas=True,
)


def links_table(results: BuildingResults) -> Table:
    """Return strength, length and rotation of the links; no rows without any."""
    return LINKS.of(_rows(results))


def link_details_table(results: BuildingResults) -> Table:
    """Return limits of length, stiffeners and lateral supports of the links; no rows without any."""
    return LINK_DETAILS.of(_rows(results))


def _rows(results: BuildingResults) -> list[Row]:
    return results.rows("links", "link") if results.has("links") else []
