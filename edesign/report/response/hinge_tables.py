"""Tables of plastic hinges, joints, panel zones and springs under the columns: what they are and what they did.

All values of a row are of the analysis that the row names.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping

from edesign.archive.dataset import Group
from edesign.report.tables.cell import Quantity, Value
from edesign.report.tables.column import col, text
from edesign.report.tables.items import Place, at, largest, most_in_any, places
from edesign.report.tables.table import Table, TableSpec
from edesign.report.tables.text import wrapped
from edesign.report.tables.unit import KN, KN_M, MM, MN_M_RAD, MRAD, ONE, PERCENT, Unit

SHOWN = 20
"""Rows of a table at most, those that were used most: a page of them can be read."""
_LEAST = 1e-12  # m, rad, N: what does not move


def _plastic(hinge: Place) -> float:
    return hinge.largest("hinge_plastic_rotation") or 0.0


def _used(hinge: Place) -> float:
    return _plastic(hinge) / (hinge.value("hinge_theta_p") or float("nan"))


def _yield_distortion(panel: Place) -> float:
    return (panel.value("panel_yield_moment") or 0.0) / (panel.value("panel_stiffness") or float("nan"))


def _distorted(panel: Place) -> float:
    return (panel.largest("panel_distortion") or 0.0) / _yield_distortion(panel)


HINGES = TableSpec[Place](
    "plastic_hinges",
    "Plastic hinges",
    (
        text("hinge", "name"),
        col("M_y", KN_M, at("hinge_M_y")),
        col("theta_p", MRAD, at("hinge_theta_p")),
        col("plastic rotation", MRAD, _plastic, negligible=1e-9),
        col("of theta_p", PERCENT, _used, 3, negligible=1e-8),
        col("strength left", PERCENT, at("hinge_strength_left_final")),
        text("analysis", "analysis"),
    ),
    formulas=True,
)
JOINTS = TableSpec[Place](
    "joints",
    "Joints",
    (
        text("joint", "name"),
        col("S_j", MN_M_RAD, at("joint_stiffness")),
        col("S_j L_b / (E I_b)", ONE, at("joint_stiffness_ratio"), 3),
        text("class", lambda joint: joint.word("joint_class")),
        col("M_j,Rd", KN_M, lambda joint: joint.finite("joint_M_y")),
        col("moment", KN_M, largest("joint_moment")),
        col("rotation", MRAD, largest("joint_rotation")),
        text("analysis", "analysis"),
    ),
    notes=(
        "Of each joint the analysis in which it turned most.",
        "Class by the stiffness of the analysis, of an unbraced frame (EN 1993-1-8, 5.2.2.5).",
    ),
    formulas=True,
    most=SHOWN,
    cut="The {shown} of {all} joints that turned most.",
)
PANEL_ZONES = TableSpec[Place](
    "panel_zones",
    "Panel zones",
    (
        text("panel", "name"),
        col("yield moment", KN_M, at("panel_yield_moment")),
        col("moment", KN_M, largest("panel_moment")),
        col("distortion at yield", MRAD, _yield_distortion),
        col("distortion", MRAD, largest("panel_distortion")),
        col("distortion / yield", ONE, _distorted, 3),
        text("analysis", "analysis"),
    ),
    notes=("Of each panel zone the analysis with its largest distortion; yield: of the web in shear.",),
    most=SHOWN,
    cut="The {shown} of {all} panel zones that were distorted most.",
)
SUPPORTS = TableSpec[dict[str, Value]](
    "springs_at_supports",
    "Springs at supports",
    (text("support"), text("quantity"), col("largest", ONE), text("analysis")),
    notes=("Largest magnitudes; what no spring holds, and what does not move, is left out.",),
    keys=2,
)
_OF_FRAMES: tuple[tuple[str, str, Unit], ...] = (
    ("support_displacement_x", "sway", MM),
    ("support_displacement_y", "vertical displacement", MM),
    ("support_rotation", "rotation", MRAD),
    ("support_reaction_x", "horizontal reaction", KN),
    ("support_reaction_y", "vertical reaction", KN),
    ("support_reaction_moment", "moment", KN_M),
)
_OF_BUILDINGS: tuple[tuple[str, str, Unit], ...] = tuple(
    (f"{name}_{axis}", f"{label} {axis}", unit)
    for name, label, unit in (
        ("support_displacement", "displacement along", MM),
        ("support_rotation", "rotation about", MRAD),
        ("support_reaction", "reaction along", KN),
        ("support_reaction_moment", "moment about", KN_M),
    )
    for axis in "xyz"
)


def hinge_tables(groups: Mapping[str, Group]) -> list[Table]:
    """Return the tables of all analyses with hinges, joints, panel zones or springs at supports.

    Args:
        groups: results by the name of the analysis.
    """
    tables = (
        _hinges(groups),
        JOINTS.of(most_in_any(groups, "joint", "joint_rotation")),
        PANEL_ZONES.of(most_in_any(groups, "panel", "panel_distortion")),
        SUPPORTS.of(_supports(groups)),
    )
    return [table for table in tables if table.rows]


def _hinges(groups: Mapping[str, Group]) -> Table:
    turned = most_in_any(groups, "hinge", "hinge_plastic_rotation")
    turned.sort(key=lambda hinge: (-_used(hinge), hinge.name))
    weakest = _weakest_hinges(groups)
    shown = [
        place
        for hinge in turned[:SHOWN]
        for place in {one.analysis: one for one in (hinge, weakest.get(hinge.name, hinge))}.values()
    ]
    notes = wrapped(
        "Of each hinge the analysis in which it turned most, and the one that left it least strength. Strength left: "
        "yield moment at its end over that at first, 0 % beyond the ultimate rotation or the energy capacity."
    )
    if len(turned) > SHOWN:
        notes.append(f"The {SHOWN} of {len(turned)} hinges that turned most of theta_p.")
    return HINGES.of(shown, notes=notes)


def _weakest_hinges(groups: Mapping[str, Group]) -> dict[str, Place]:
    """Each hinge in the analysis that left it least strength, of those that have lost some."""
    found: dict[str, Place] = {}
    least: dict[str, float] = {}
    for hinge in places(groups, "hinge", "hinge_strength_left_final"):
        left = hinge.value("hinge_strength_left_final")
        if left is not None and left < least.get(hinge.name, 1.0):
            least[hinge.name], found[hinge.name] = left, hinge
    return found


def _supports(groups: Mapping[str, Group]) -> Iterator[dict[str, Value]]:
    """The largest magnitude of each quantity of a support in any analysis."""
    in_space = any("direction" in group.coords for group in groups.values())
    quantities = _OF_BUILDINGS if in_space else _OF_FRAMES
    found = {name: {p.name: p for p in most_in_any(groups, "sprung_support", name)} for name, _, _ in quantities}
    nodes = dict.fromkeys(place.name for place in places(groups, "sprung_support"))
    for node in nodes:
        for name, label, unit in quantities:
            place = found[name].get(node)
            value = place.largest(name) if place is not None else None
            if place is not None and value is not None and value >= _LEAST:
                number = Quantity(value, unit, beside=True)
                row: dict[str, Value] = {"support": node, "quantity": f"{label} [{unit.name}]", "largest": number}
                yield row | {"analysis": place.analysis}
