"""Tables of a design of dampers: what stands in each storey, what it adds, and the rounds that led to it."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from types import MappingProxyType
from typing import Any

import numpy as np

from edesign.archive.dataset import Group
from edesign.assess.raised_devices import RaisedDevices
from edesign.assess.requirement import UNITS
from edesign.assess.sets import HistorySet
from edesign.ground_motion.hazard import rules_in_force
from edesign.project.actions.hazard_base import Hazard
from edesign.report.design.braces_table import braces_table
from edesign.report.design.device_order import devices_tables
from edesign.report.design.hysteretic_tables import hysteretic_damping_table, hysteretic_storeys_table
from edesign.report.design.placement_tables import placement_tables
from edesign.report.design.storeys import STOREY, first_mode, heading
from edesign.report.design.viscous_tables import kilonewtons, viscous_damping_table, viscous_storeys_table
from edesign.report.tables.cell import Quantity, Value, yes_or_no
from edesign.report.tables.column import Column, col, count, literal, text, verdict
from edesign.report.tables.items import Place, at, places
from edesign.report.tables.table import MORE, Table, TableSpec
from edesign.report.tables.unit import CM, DEGC, KN, KN_PER_M, M2, MM, ONE, PERCENT, S, Unit

Row = dict[str, Value]
EMPTY: Mapping[str, float] = MappingProxyType({})
_DAMPINGS = ("damping_strain_energy", "damping_frequencies", "damping_complex")
_CHANGED = {
    "target": ("target", PERCENT),
    "area": ("factor on areas", ONE),
    "thickness": ("factor on thicknesses", ONE),
    "coefficient": ("factor on coefficients", ONE),
}
"""What rounds change, and its unit."""
_BOUNDS = (
    ("factor on the forces", "factor", ONE),
    ("temperature", "temperature", DEGC),
    ("T1", "period", S),
    ("added damping", "damping", PERCENT),
    ("storey drift", "storey_drift", PERCENT),
    ("roof displacement", "roof_displacement", CM),
    ("shear of columns", "column_shear", KN),
    ("base shear", "base_shear", KN),
    ("force of a damper", "damper_force", KN),
    ("damper strain", "damper_strain", PERCENT),
    ("stroke of a damper", "damper_stroke", MM),
)


def _stiffness_ratio(storey: Place) -> float | None:
    damper, own = storey.value("damper_stiffness"), storey.value("storey_stiffness")
    return None if damper is None or own is None else damper / own


def _round_name(one: Place) -> str:
    chosen = one.number + 1 == one.group.attributes.get("chosen_round")
    return f"{one.number + 1}{' (chosen)' if chosen else ''}"


def _determined(variable: str) -> Callable[[Place], float | str | None]:
    """A value of a round, "-" where it is none, None of a design that has it in no round."""

    def of(one: Place) -> float | str | None:
        value = one.value(variable)
        return "-" if value is not None and np.isnan(value) else value

    return of


ELASTOMER_STOREYS = TableSpec[Place](
    "elastomer_design",
    "Design {design}",
    (
        STOREY,
        col("k_S", KN_PER_M, at("storey_stiffness")),
        col("k_D", KN_PER_M, at("damper_stiffness")),
        col("k_D/k_S", ONE, _stiffness_ratio),
        col("braces", KN_PER_M, at("brace_stiffness")),
        col("layer", M2, at("layer_area")),
        col("A_D/A_P", ONE, at("area_ratio")),
        col("force", KN, at("estimated_damper_force")),
        col("columns", KN, at("estimated_column_shear")),
    ),
    formulas=True,
    optional=True,
    named_by_title=True,
)
ELASTOMER_DAMPING = TableSpec[Row](
    "elastomer_damping",
    "",
    (
        count("mode"),
        col("T bare", S, "bare_period"),
        text("dampers"),
        col("T", S, "period"),
        col("energies", PERCENT, "damping_strain_energy"),
        col("frequencies", PERCENT, "damping_frequencies"),
        col("complex", PERCENT, "damping_complex"),
    ),
    notes=("added damping: by energies of the modes with dampers, frequencies, complex eigenvalues",),
    keys=0,
    named_by_title=True,
)
PLAN_MODES = TableSpec[Place](
    "modes_with_design",
    "Modes of the building with the dampers of this design",
    (
        count("mode", lambda mode: int(mode.name)),
        col("T bare", S, at("plan_bare_period")),
        col("T", S, at("plan_period")),
        col("along x", PERCENT, at("plan_mass_ratio_x")),
        col("along y", PERCENT, at("plan_mass_ratio_y")),
        col("in turns", PERCENT, at("plan_mass_ratio_turn")),
        col("share", PERCENT, at("plan_share"), optional=True),
        col("added damping", PERCENT, at("plan_damping")),
    ),
    keys=0,
)
ROUNDS = TableSpec[Place](
    "rounds",
    "Rounds",
    (
        text("round", _round_name),
        col("{changed}", "changed", at("round_changed")),
        col("damping", PERCENT, lambda one: round_damping(one.group)[one.number]),
        col("T1", S, at("round_period")),
        col("{size}", "size", lambda one: round_sizes(one.group)[0][one.number]),
        col("strain", PERCENT, _determined("round_strain"), optional=True),
        col("in histories", PERCENT, _determined("round_history_strain"), optional=True),
        MORE,  # each criterion
        col("made least", ONE, at("round_objective"), optional=True),
        col("braces", ONE, _determined("round_brace_use"), optional=True, digits=3),
        verdict("met", lambda one: yes_or_no(bool(one.value("round_met")))),
    ),
)
BOUNDS = TableSpec[Row](
    "bounds_of_a_design",
    "Bounds of the properties (estimates by the response spectrum)",
    (text(""), MORE, text("governs", missing="")),  # each bound
    notes=("of quantities over the height the largest",),
    named_by_title=True,
)


def design_tables(
    group: Group,
    sets: Sequence[HistorySet] = (),
    factors: Mapping[str, float] = EMPTY,
    hazard: Hazard | None = None,
    raised: RaisedDevices = RaisedDevices(),  # noqa: B008 - frozen
) -> list[Table]:
    """Return the tables of a design.

    Args:
        group: designs/NAME of an archive.
        sets: histories by variant and level, for the order of dampers.
        factors: property factors of the variants that have the design, by their names.
        hazard: of the project, whose code is in force.
        raised: factors of the code on what dampers are ordered with.
    """
    rules = rules_in_force(hazard)
    method = group.attributes.get("method")
    if method == "placement":
        tables = [*placement_tables(group, sets, factors, rules), _lines(_warning_lines(group))]
        return [table for table in tables if table.rows or table.notes]
    order = devices_tables(group, sets, factors, rules, raised)
    if method == "viscous":
        sized = [viscous_storeys_table(group), *order, viscous_damping_table(group)]
    elif method == "hysteretic":
        sized = [hysteretic_storeys_table(group), *order, hysteretic_damping_table(group)]
    else:
        sized = [storeys_table(group), *order, damping_table(group)]
    sized.insert(1, braces_table(group, sets, factors, rules, raised))
    tables = [*sized, plan_modes_table(group), _warnings(group), rounds_table(group), bounds_table(group)]
    return [table for table in tables if table.rows or table.notes]


def storeys_table(group: Group) -> Table:
    """Return stiffness of storey, dampers and braces, area of a layer, as thesis Table 5.7, and estimated forces."""
    about, notes = group.attributes, []
    if "layer_thickness_m" in about:
        notes.append(
            f"{about['number']} x {about['layers']} layers of {1e3 * float(about['layer_thickness_m']):.4g} mm at each "
            f"place; G' {1e-6 * float(about['G_storage_Pa']):.4g} MPa, n {float(about['loss_factor']):.4g} at "
            f"{float(about['frequency_Hz']):.3g} Hz{_strains(group)}; all layers "
            f"{float(about['total_layer_area_m2']):.4g} m2{_prototypes(about)}"
        )
        notes.append("k_S, k_D: of the storey and of its dampers; layer: area of one; A_D/A_P: over the prototype")
    if "estimated_damper_force" in group.variables:
        level = f" at {about['level']}" if about.get("level") else ""
        notes.append(f"estimated{level}: force of the dampers and the brace of a place, shear of all columns")
    return ELASTOMER_STOREYS.of(places({"": group}, "storey"), notes=notes, design=heading(group))


def _strains(group: Group) -> str:
    """The strain of the properties, and what is reached."""
    about = group.attributes
    if "strain" not in about:
        return ""
    text = f", {100.0 * float(str(about['strain'])):.3g} % strain"
    reached = []
    if "estimated_strain" in about:
        reached.append(f"estimated {100.0 * float(str(about['estimated_strain'])):.3g} %")
    chosen = int(str(about.get("chosen_round", 1))) - 1
    if "round_history_strain" in group.variables:
        strain = float(group.variables["round_history_strain"].values[chosen])
        reached += [f"in histories {100.0 * strain:.3g} %"] if np.isfinite(strain) else []
    return f"{text} ({', '.join(reached)})" if reached else text


def _prototypes(about: Mapping[str, Any]) -> str:
    return f", those of {float(about['prototypes']):.4g} prototypes" if "prototypes" in about else ""


def _warnings(group: Group) -> Table:
    """Return why a design failed, what stands beside it, and the warnings about it; no columns."""
    reason = group.attributes.get("reason")
    return _lines([*([f"failed: {reason}"] if reason else []), *_beside(group), *_warning_lines(group)])


def _beside(group: Group) -> list[str]:
    """The designs beside which a design was sized, and what they do there."""
    about = group.attributes
    if "beside_damping" not in about:
        return []
    names, damping = about["beside"], 100.0 * float(str(about["beside_damping"]))
    assert isinstance(names, list)
    return [
        f"beside {', '.join(map(str, names))}: stiffness of storeys and T bare with these dampers; they add "
        f"{damping:.4g} % to the {first_mode(group)} with all, beside the damping above"
    ]


def _lines(notes: list[str]) -> Table:
    return Table("", notes=notes, headed=False)


def _warning_lines(group: Group) -> list[str]:
    warnings = group.attributes.get("warnings")
    return [f"warning: {text}" for text in (warnings if isinstance(warnings, list) else [])]


def damping_table(group: Group) -> Table:
    """Return the damping that the dampers add to each mode, by three ways, alone and with their braces."""
    rows: list[Row] = []
    for mode in places({"": group}, "mode", "damping_complex"):
        for assembly in places({"": group}, "assembly"):
            row: Row = {key: assembly.value(key, mode.number) for key in ("period", *_DAMPINGS)}
            row |= {"mode": int(mode.name), "bare_period": mode.value("bare_period")}
            rows.append(row | {"dampers": assembly.name.replace("_", " ")})
    return ELASTOMER_DAMPING.of(rows)


def plan_modes_table(group: Group) -> Table:
    """Return where the modes of a building move, and the damping that the dampers of a design add to them."""
    modes = list(places({"": group}, "plan_mode", "plan_damping"))
    if not modes:
        return Table("")
    leading = f"mode {group.attributes['leading_mode']} leads along {group.attributes['along']}"
    notes = [f"{leading}; along, in turns: share of the mass; added damping: by energies, of this design alone"]
    return PLAN_MODES.of(modes, notes=notes)


def rounds_table(group: Group) -> Table:
    """Return the rounds of sizing and verification; none if there was only one and nothing to verify."""
    rounds = list(places({"": group}, "round"))
    if not rounds or (len(rounds) == 1 and "criterion" not in group.coords):
        return Table("")
    values, notes = group.variables, []
    criteria = _criteria(group)
    if "verdict_limit" in values:
        limits = zip(criteria.items(), values["verdict_limit"].values[-1], strict=True)
        said = [f"{name} {column.text(float(limit))} {column.unit_in_files}" for (name, column), limit in limits]
        notes.append(f"limits: {', '.join(one.rstrip() for one in said)}")
    if group.attributes.get("braces_in_target") is False and "damping_target" in group.attributes:
        notes.append("target: of the dampers alone (`braces_in_target: false`); damping: with their braces")
    if "round_brace_use" in values:
        level = group.attributes["history_force_level"]
        notes.append(f"braces: the largest N_Ed / N_b,Rd by the forces of the histories at {level}")
    if "round_objective" in values:
        notes.append(f"made least: {values['round_objective'].long_name}")
    changed, unit = _changed(group)
    _, size, size_unit = round_sizes(group)
    units = {"changed": unit, "size": size_unit}
    return ROUNDS.of(rounds, more=list(criteria.values()), units=units, notes=notes, changed=changed, size=size)


def _criteria(group: Group) -> dict[str, Column[Place]]:
    """A column of rounds for each criterion, by its name."""
    if "criterion" not in group.coords:
        return {}
    names = [str(name) for name in group.coords["criterion"].values]
    if "criterion_unit" in group.variables:
        units = [Unit(*UNITS[str(unit)]) for unit in group.variables["criterion_unit"].values]
    else:
        units = [Unit("SI")] * len(names)  # archives that do not say them
    columns = zip(names, units, strict=True)
    return {name: col(literal(name), unit, at("verdict_value", i)) for i, (name, unit) in enumerate(columns)}


def round_damping(group: Group) -> np.ndarray:
    """Return the damping ratio that the dampers of each round add to the first mode."""
    kind = {"viscous": "complex", "hysteretic": "equivalent"}.get(str(group.attributes.get("method")), "strain_energy")
    return np.asarray(group.variables[f"round_damping_{kind}"].values, dtype=float)


def _changed(group: Group) -> tuple[str, Unit]:
    """Return the quantity that the rounds of a design change, and its unit."""
    about = group.attributes
    if about.get("method") == "simplified" and about.get("changed") == "target":
        return "beta", ONE
    return _CHANGED.get(str(about.get("changed")), ("changed", ONE))


def round_sizes(group: Group) -> tuple[np.ndarray, str, Unit]:
    """Return what all dampers of each round are in sum (SI), its name, and the unit that it is shown in."""
    if group.attributes.get("method") == "viscous":
        coefficient = group.variables["round_device_coefficient"]
        return _sum(group, "device_coefficient"), "sum of c", kilonewtons(coefficient.unit)
    if group.attributes.get("method") == "hysteretic":
        return _sum(group, "device_yield_force"), "sum of F_y", KN
    return round_areas(group), "all layers", M2


def _sum(group: Group, of_one: str) -> np.ndarray:
    return np.asarray(group.variables[f"round_{of_one}"].values @ group.variables["device_count"].values)


def round_areas(group: Group) -> np.ndarray:
    """Return the area of all layers of all dampers of each round, m2."""
    about = group.attributes
    storeys = group.coords["storey"].values.size
    layers = int(str(about.get("layers", 1))) * int(str(about.get("number", 1)))
    places = int(str(about.get("places", storeys))) / storeys
    return np.asarray(places * layers * np.sum(group.variables["round_layer_area"].values, axis=1))


def bounds_table(group: Group) -> Table:
    """Return the estimated response with lower, nominal and upper properties, and which of them governs."""
    if "bound" not in group.coords:
        return Table("")
    bounds = [str(name) for name in group.coords["bound"].values]
    found = group.attributes.get("governing")
    governing = found if isinstance(found, Mapping) else {}
    rows: list[Row] = []
    for title, key, unit in _BOUNDS:
        if (values := group.variables.get(f"bound_{key}")) is not None:
            largest = values.values.reshape(len(bounds), -1).max(axis=1)
            cells = (None if np.isnan(value) else Quantity(float(value), unit, beside=True) for value in largest)
            row = {"": f"{title} [{unit.name}]" if unit.name else title, "governs": str(governing.get(key, ""))}
            rows.append(row | dict(zip(bounds, cells, strict=True)))
    return BOUNDS.of(rows, more=[col(bound, ONE) for bound in bounds])
