"""Tables of the ground under the columns: footings, what they do to the first mode, and wave passage."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import NamedTuple

import numpy as np

from edesign.archive.dataset import Group
from edesign.frame.footings import DIRECTIONS
from edesign.report.drawing.captions import some_names
from edesign.report.response.histories import groups_alike, names_of
from edesign.report.tables.column import col, text
from edesign.report.tables.items import Analysis, Place, at, attribute, places
from edesign.report.tables.table import Table, TableSpec
from edesign.report.tables.unit import KJ, M_S, MM, MPA, MS, ONE, PERCENT, S, Unit

FORMULAS = {
    "pais_kausel": "Pais & Kausel 1988",
    "gazetas": "Gazetas 1991",
}
SHOWN = 40
"""Rows of the tables of column bases and histories at most: a page of them can be read."""
WORK = "footing_work_final"
"""Variable that only histories with footings have."""
_WORDS = {
    2: ("horizontal", "vertical", "rocking"),
    3: ("along x", "along y", "vertical", "rocking about x", "rocking about y", "torsion"),
}
MEGA = Unit("", 1e6)
"""Of stiffness in MN/m and in MN m/rad below each other."""


class _Motion(NamedTuple):
    """One of the motions of a footing: its word, its name in the archive."""

    footing: Place
    word: str
    direction: str

    def value(self, what: str) -> float | None:
        return self.footing.value(f"footing_{what}_{self.direction}")


def _formula(footing: Place) -> str:
    """Who gives the static stiffness of a footing."""
    name = footing.word("footing_formula")
    return FORMULAS.get(name, name)


def _period(analysis: Analysis) -> float | None:
    fixed, ratio = analysis.attribute("fixed_base_period_s"), analysis.attribute("period_ratio")
    return None if fixed is None or ratio is None else fixed * ratio


def _of_any_direction(variable: str) -> Callable[[Place], float | None]:
    """The number of a support that is largest in magnitude over the directions of a building."""

    def of(place: Place) -> float | None:
        found = [place.known(variable, *at) for at in np.ndindex(place.group.variables[variable].values.shape[1:])]
        return max(found, key=abs)

    return of


FOOTINGS = TableSpec[Place](
    "footings",
    "Footings{of}",
    (
        text("footing", "name"),
        text("static stiffness by", _formula),
        col("G", MPA, at("footing_shear_modulus"), 3),
        col("G / G_0", ONE, at("footing_modulus_ratio"), 3),
        col("V_s", M_S, at("footing_wave_velocity"), 3),
        col("T", S, at("footing_period"), 3),
        col("a_0", ONE, at("footing_a_0"), 3),
    ),
    notes=("Stiffness and damping are those at the period T; a_0 = omega B / V_s, B half of the shorter side.",),
)
FOOTING_STIFFNESS = TableSpec[_Motion](
    "footing_stiffness",
    "Stiffness and damping of footings{of}",
    (
        text("footing", lambda motion: motion.footing.name),
        text("direction", "word"),
        col("K static", MEGA, lambda motion: motion.value("static_stiffness")),
        col("K at T", MEGA, lambda motion: motion.value("stiffness")),
        col("radiation", PERCENT, lambda motion: motion.value("radiation_damping"), 3),
        col("soil", PERCENT, lambda motion: motion.footing.value("footing_soil_damping"), 3),
        col("dashpot", MEGA, lambda motion: motion.value("dashpot") or None),
    ),
    notes=(
        "K in MN/m and MN m/rad, dashpots in MN s/m and MN m s/rad: 2 K (radiation + soil) / omega. A footing that "
        "lifts off has no vertical dashpot.",
    ),
)
FIRST_MODE = TableSpec[Analysis](
    "footing_periods",
    "First mode on fixed bases and on footings",
    (
        text("analysis", "name"),
        col("T fixed", S, attribute("fixed_base_period_s")),
        col("T", S, _period),
        col("ratio", ONE, attribute("period_ratio")),
        col("one mass: ratio", ONE, attribute("closed_period_ratio")),
        col("damping", PERCENT, attribute("foundation_damping"), 3),
        col("one mass: damping", PERCENT, attribute("closed_foundation_damping"), 3),
    ),
    notes=(
        "Damping by the soil alone: complex eigenvalue of the structure. One mass at the effective height of the first "
        "mode on a rigid base: Veletsos & Meek 1974, and NIST GCR 12-917-21, Eq. 2-10, ASCE/SEI 7-16, 19.3.",
    ),
)
FOOTING_WORK = TableSpec[Analysis](
    "footing_work",
    "Work on the dashpots of footings, kJ",
    (text("analysis", "name"),),  # and each footing
    notes=("It is part of the energy of the dampers in the balance.",),
    most=SHOWN,
    cut="The first {shown} of {all} histories.",
)
WAVE_PASSAGE = TableSpec[Place](
    "wave_passage",
    "Supports under wave passage",
    (
        text("analysis", "analysis"),
        text("support", "name"),
        col("delay", MS, at("foot_delay"), negligible=1e-9),
        col("largest displacement", MM, _of_any_direction("foot_displacement_largest"), negligible=1e-9),
        col("at the end", MM, _of_any_direction("foot_displacement_final"), negligible=1e-9),
    ),
    notes=("Displacements of the ground at the column base relative to the ground that the motion reaches first.",),
    keys=2,
    most=SHOWN,
    cut="The first {shown} of {all} supports.",
)


def ground_tables(groups: Mapping[str, Group]) -> list[Table]:
    """Return the tables of footings, and of supports under wave passage; none where there are none.

    Args:
        groups: results by the name of the analysis.
    """
    tables = [*_footings(groups), WAVE_PASSAGE.of(places(groups, "foot", "foot_delay"))]
    return [table for table in tables if table.rows]


def _footings(groups: Mapping[str, Group]) -> list[Table]:
    on_footings = {name: group for name, group in groups.items() if "footing" in group.coords}
    if not on_footings:
        return []
    tables, alike = [], groups_alike(on_footings, _shown)
    for several in alike:
        of = f" ({some_names(several)})" if len(alike) > 1 else ""
        footings = list(places(dict([next(iter(several.items()))]), "footing"))
        dimension = 3 if "footing_stiffness_rz" in next(iter(several.values())).variables else 2
        words = tuple(zip(_WORDS[dimension], DIRECTIONS[dimension], strict=True))
        motions = [_Motion(one, word, direction) for one in footings for word, direction in words]
        tables += [FOOTINGS.of(footings, of=of), FOOTING_STIFFNESS.of(motions, of=of)]
    return [*tables, first_mode_table(on_footings), _work(on_footings)]


def _shown(group: Group) -> tuple[str, ...]:
    """What tables say of the footings of an analysis."""
    values = [
        f"{value:.4g}"
        for name, variable in group.variables.items()
        if name.startswith("footing_") and variable.dims == ("footing",) and name not in ("footing_formula", WORK)
        for value in variable.values
    ]
    return (*names_of(group, "footing"), *map(str, group.variables["footing_formula"].values), *values)


def first_mode_table(groups: Mapping[str, Group]) -> Table:
    """Return period and damping of the first mode on fixed bases and on footings; no rows without footings."""
    found = (Analysis(name, group) for name, group in groups.items())
    # an isolated frame has a period on a fixed base too
    return FIRST_MODE.of(one for one in found if "period_ratio" in one.group.attributes)


def _work(groups: Mapping[str, Group]) -> Table:
    """Work on the dashpots of each footing in each history; a frame of another variant may stand on others."""
    histories = [Analysis(name, group) for name, group in groups.items() if WORK in group.variables]
    footings = dict.fromkeys(footing for one in histories for footing in names_of(one.group, "footing"))
    return FOOTING_WORK.of(histories, more=[col(footing, KJ, _work_of(footing), silent=True) for footing in footings])


def _work_of(footing: str) -> Callable[[Analysis], float | None]:
    def of(history: Analysis) -> float | None:
        names = names_of(history.group, "footing")
        return history.group.variables[WORK].values[names.index(footing)] if footing in names else None

    return of
