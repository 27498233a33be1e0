"""What a design archives: variables declared as columns, those of all methods here, those of one beside its sizing."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from edesign.archive.dataset import Group
from edesign.study.design.bounds import Bound, governing
from edesign.study.design.braces import BraceUse
from edesign.study.design.building import Building
from edesign.study.design.condensed import TOLD, alike
from edesign.study.design.device_model import DeviceModel
from edesign.study.design.estimate import FrameEstimate
from edesign.study.design.loop import Round
from edesign.study.design.verification import store_outcomes
from edesign.study.results.recording import coordinate

_ROUNDING = 1e-12  # of shares and damping of modes that are none

Model = DeviceModel[Any, Any]
Text = str | Callable[[Any], str]
Column = tuple[str, tuple[str, ...], Callable[[Any, Any], Any], Text, Text]
"""Name of a variable, dimensions and value of one item (given the model too; None: it has none), unit, and meaning.

Along `PLACE` a value has one number for each place (d,), of which the largest of each storey is archived."""
ONE: tuple[str, ...] = ()
STOREY, FRAME, MODE, PLACE = ("storey",), ("frame_storey",), ("mode",), ("place",)


@dataclass(frozen=True)
class Results:
    """What designs by one method archive beside what all do.

    Attributes:
        storeys: of the dampers of a sizing.
        facts: attributes that describe a sizing, and their values.
        modes: of the modes with dampers, as the designer of the method has them.
        steps: of an iteration, each a variable `iteration_NAME`.
        rounds: of a round, each a variable `round_NAME`.
        identity: names of those of a round that identify its dampers.
        estimate: of the estimated response, each a variable `estimated_NAME`.
        demand: what dampers bear in the estimate of a bound, a variable `bound_NAME`.
        bounds: meaning of the stiffness ratio and of the damping of a bound, by name.
        assemblies: what modes are found for, beside dampers with their braces, and what the names mean.
    """

    storeys: tuple[Column, ...]
    facts: Mapping[str, Callable[[Any, Any], Any]]
    modes: tuple[Column, ...]
    steps: tuple[Column, ...]
    rounds: tuple[Column, ...]
    identity: tuple[str, ...]
    estimate: tuple[Column, ...]
    demand: Column
    bounds: Mapping[str, str]
    assemblies: tuple[tuple[str, ...], str] = ((), "")


_STIFFNESS = "stiffness of the storey: shear over drift under the loads of the first mode, without dampers"
_STOREY_STIFFNESS = "stiffness of the storey without dampers"
_MET = "1: all criteria and the target met, and braces of sections hold; 0 too where no verification is asked for"
_REACHED = "damping ratio that answers a target damping; nan: the target is another"
_COLUMN_SHEAR = "estimated shear of the columns, without dampers' forces"
_TEMPERATURE = "temperature of the dampers; nan: that of the design"

_STOREYS: tuple[Column, ...] = (
    ("storey_stiffness", STOREY, lambda m, s: m.building.designed_stiffness, "N/m", _STOREY_STIFFNESS),
    ("computed_storey_stiffness", FRAME, lambda m, s: m.building.computed_stiffness, "N/m", _STIFFNESS),
    ("brace_stiffness", STOREY, lambda m, s: m.brace, "N/m", "horizontal stiffness of the braces of the storey"),
)
_ROUNDS: tuple[Column, ...] = (
    ("target", ONE, lambda m, r: r.sizing.target, "1", "target: damping ratio, beta, or share"),
    ("reached", ONE, lambda m, r: r.sizing.reached, "1", _REACHED),
    ("met", ONE, lambda m, r: int(r.met), "1", _MET),
)
_DRIFT = "storey drift over height estimated by the response spectrum"
_ESTIMATE: tuple[Column, ...] = (
    ("storey_drift", FRAME, lambda m, r: r[0].drift, "1", f"{_DRIFT}, with dampers"),
    ("bare_storey_drift", FRAME, lambda m, r: r[1].drift, "1", lambda m: f"{_DRIFT}, {m.without}"),
    ("column_shear", FRAME, lambda m, r: r[0].storey_shear, "N", _COLUMN_SHEAR),
    ("damper_force", PLACE, lambda m, r: r[0].damper_force, "N", "estimated force of the dampers of a place"),
)
_BOUNDS: tuple[Column, ...] = (
    ("factor", ONE, lambda m, b: b.factor, "1", "property modification factor"),
    ("temperature", ONE, lambda m, b: math.nan if b.temperature_C is None else b.temperature_C, "degC", _TEMPERATURE),
    ("stiffness_ratio", ONE, lambda m, b: b.stiffness_ratio, "1", ""),
    ("period", ONE, lambda m, b: b.period, "s", "first period with dampers and braces"),
    ("damping", ONE, lambda m, b: b.damping, "1", ""),
    ("storey_drift", FRAME, lambda m, b: b.response.drift, "1", "estimated storey drift over height"),
    ("column_shear", FRAME, lambda m, b: b.response.storey_shear, "N", "estimated shear of columns"),
    ("roof_displacement", ONE, lambda m, b: b.response.roof_displacement, "m", "estimated displacement of the roof"),
    ("base_shear", ONE, lambda m, b: b.response.base_shear, "N", "estimated shear of columns and dampers"),
    ("damper_force", PLACE, lambda m, b: b.response.damper_force, "N", "estimated force of the dampers of a place"),
)
DEVICE_COUNT: Column = (
    "device_count",
    STOREY,
    lambda m, s: m.spec.number * np.bincount(m.building.place_storey),
    "1",
    "number of dampers in the storey",
)
DEVICE_DEMANDS: tuple[Column, ...] = (
    ("device_force", PLACE, lambda m, r: r.damper_force / m.spec.number, "N", "estimated force of one damper"),
    ("device_stroke", PLACE, lambda m, r: r.dampers["stroke"], "m", "estimated stroke of a damper, without its brace"),
)
STROKE: Column = ("damper_stroke", PLACE, lambda m, r: r.dampers["stroke"], "m", "estimated stroke of the dampers")


def store(group: Group, model: Model, columns: Iterable[Column], item: Any, prefix: str = "") -> None:
    """Add the variables of one item to the group of a design; those without a value are left out."""
    for name, dims, of, unit, label in columns:
        value = of(model, item)
        if value is not None:
            at, value = _archived(model.building, dims, value)
            group.add(f"{prefix}{name}", at, value, _text(unit, model), _text(label, model))


def store_rows(group: Group, model: Model, axis: str, columns: Iterable[Column], items: Sequence[Any]) -> None:
    """Add variables AXIS_NAME of a row of items along an axis of the group; without any value they are left out."""
    for name, dims, of, unit, label in columns:
        values = [of(model, item) for item in items]
        if any(value is not None for value in values):
            found = [_archived(model.building, dims, math.nan if value is None else value) for value in values]
            at = (axis, *found[0][0])
            group.add(f"{axis}_{name}", at, [row for _, row in found], _text(unit, model), _text(label, model))


def store_sizing(group: Group, model: Model, results: Results, sizing: Any, modes: Any) -> None:
    """Add the storeys of the frame, the dampers in them, and the modes without and with them."""
    building, bare = model.building, model.bare
    group.attributes |= {"number": model.spec.number, "places": int(building.place_storey.size)}
    group.attributes["device_names"] = list(building.names)
    coordinate(group, "storey", building.storeys, "1", "storey with dampers")
    coordinate(group, "frame_storey", np.arange(1, building.heights.size + 1), "1", "storey of the frame")
    store(group, model, (*_STOREYS, *results.storeys), sizing)
    facts = {name: of(model, sizing) for name, of in results.facts.items()}
    group.attributes |= {name: value for name, value in facts.items() if value is not None}
    found = [np.asarray(of(model, modes)) for _, _, of, _, _ in results.modes]
    count = min(TOLD, bare.omega.size, *(values.shape[-1] for values in found))
    named = "number of the mode" if building.frame.plan is None else "modes with most mass along the direction"
    coordinate(group, "mode", np.arange(1, count + 1), "1", named)
    group.add("bare_period", MODE, 2.0 * np.pi / bare.omega[bare.told][:count], "s", f"natural period {model.without}")
    if results.assemblies[0]:
        coordinate(group, "assembly", list(results.assemblies[0]), "", results.assemblies[1])
    for (name, dims, _, unit, label), values in zip(results.modes, found, strict=True):
        group.add(name, dims, values[..., :count], _text(unit, model), _text(label, model))


def store_plan_modes(group: Group, model: Model, state: Any) -> None:
    """Add the modes of a building with dampers that count in a state: where they move, and what damping they get.

    They go up to the last of those that lead along x, along y and in turns; nothing of a plane frame.
    """
    frame = model.building.frame
    if frame.plan is None:
        return
    modes = frame.modes(model.storage(state))
    found = np.column_stack([frame.mass_ratios(modes), model.losses(state, modes)])
    found[found < _ROUNDING] = 0.0
    ratios, damping = found[:, :3], found[:, 3]
    last = max(TOLD, int(ratios.argmax(axis=0).max()) + 1)
    root = np.sqrt(frame.mass)
    bare = model.bare.omega[alike(modes.masses * root, model.bare.masses * root)]
    coordinate(group, "plan_mode", np.arange(1, last + 1), "1", "number of the mode of the building with dampers")
    group.add("plan_period", ("plan_mode",), 2.0 * np.pi / modes.omega[:last], "s", "natural period with dampers")
    label = f"natural period {model.without} of the mode that is most like it"
    group.add("plan_bare_period", ("plan_mode",), 2.0 * np.pi / bare[:last], "s", label)
    for name, ratio in zip(("x", "y", "turn"), ratios.T, strict=True):
        where = "in turns about the vertical" if name == "turn" else f"along {name}"
        label = f"effective mass {where} over that of the building"
        group.add(f"plan_mass_ratio_{name}", ("plan_mode",), ratio[:last], "1", label)
    label = "share of the mode in the vibration along the direction, by which means are taken"
    group.add("plan_share", ("plan_mode",), modes.lead.share[:last], "1", label)
    label = "damping ratio that the dampers of the design add, by modal strain energy"
    group.add("plan_damping", ("plan_mode",), damping[:last], "1", label)
    group.attributes["leading_mode"] = modes.first + 1


def store_iterations(group: Group, model: Model, results: Results, rounds: Sequence[Round[Any]]) -> None:
    """Add the iterations of all rounds, one after the other; nothing for a method that has none."""
    if not results.steps:
        return
    rows = [(r.number, step) for r in rounds for step in r.sizing.iterations]
    coordinate(group, "iteration", np.arange(1, len(rows) + 1), "1", "number of the iteration, of all rounds")
    numbers = [number for number, _ in rows]
    group.add("iteration_round", ("iteration",), numbers, "1", "round that the iteration belongs to")
    store_rows(group, model, "iteration", results.steps, [step for _, step in rows])


def store_rounds(group: Group, model: Model, results: Results, rounds: Sequence[Round[Any]], changed: str) -> None:
    """Add the rounds of sizing and verification: what each changed and aimed at, its dampers, and its verdicts.

    What is changed is said for people.
    """
    coordinate(group, "round", [r.number for r in rounds], "1", "round of sizing and verification")
    group.add("round_changed", ("round",), [r.changed for r in rounds], "1", f"what is changed: {changed}")
    store_rows(group, model, "round", _ROUNDS, rounds)
    store_outcomes(group, "round", [r.number for r in rounds], [r.outcome for r in rounds])
    drifts = [() if r.outcome is None else r.outcome.drift for r in rounds]
    storeys = max(map(len, drifts))
    if storeys:
        rows = [drift or (math.nan,) * storeys for drift in drifts]
        label = "storey drift over height, mean of the histories of the round; nan: none was completed"
        group.add("round_history_drift", ("round", "frame_storey"), rows, "1", label)
    store_rows(group, model, "round", results.rounds, rounds)
    if model.holding is None:
        return
    stiffness = [model.holding.horizontal(r.sizing.braces) for r in rounds]
    group.add("round_brace_stiffness", ("round", *STOREY), stiffness, "N/m", "horizontal stiffness of the braces")
    forces = [() if r.outcome is None else r.outcome.force for r in rounds]
    if any(forces):
        uses = [math.nan if r.outcome is None else r.outcome.brace_use for r in rounds]
        label = "largest N_Ed / N_b,Rd of the braces, by the forces of the histories of the round"
        group.add("round_brace_use", ("round",), uses, "1", label)
        rows = [force or (math.nan,) * model.building.storeys.size for force in forces]
        group.attributes["history_force_level"] = next(r.outcome.force_level for r in rounds if r.outcome is not None)
        label = "force of the dampers of a place, mean of the histories of the round, or their largest"
        group.add("round_history_force", ("round", *STOREY), rows, "N", label)


def store_braces(group: Group, model: Model, use: BraceUse, factor: np.ndarray, share: np.ndarray) -> None:
    """Add the sections of the braces, and how far the dampers use them.

    Args:
        use: of the braces under the forces of the dampers with all factors.
        factor: on the forces of histories, by stroke, velocity and overstrength, (s,).
        share: of the forces of histories over the estimated ones in each storey, (s,); 1 without histories.
    """
    assert model.holding is not None
    group.add("brace_section", STOREY, list(use.section), "", "section of the braces")
    for name, values, unit, label in (
        ("length", use.length, "m", "length of a brace between its nodes"),
        ("slenderness", use.slenderness, "1", "non-dimensional slenderness of a brace"),
        ("force", use.force, "N", "N_Ed of a brace: of the dampers with all factors"),
        ("resistance", use.resistance, "N", "N_b,Rd of a brace by EN 1993-1-1, 6.3.1"),
        ("mass", use.mass, "kg", "mass of all braces of the storey, between nodes"),
        ("force_factor", factor, "1", "factor on the force of the dampers: stroke, velocity and overstrength"),
        ("history_share", share, "1", "force of the dampers in histories over the estimated one"),
    ):
        group.add(f"brace_{name}", STOREY, values, unit, label)
    group.add("brace_share", STOREY, use.share, "1", "axial force of a brace over that of the dampers of a place")
    brace = model.holding.brace
    group.attributes["brace_chosen"] = int(model.holding.chosen)
    group.attributes |= {"brace_material": brace.material, "brace_length_factor": brace.buckling_length_factor}


def store_estimate(group: Group, model: Model, results: Results, found: FrameEstimate, bare: FrameEstimate) -> None:
    """Add the response that the spectrum estimates with dampers, and that of the bare frame.

    Forces of a place are of all its dampers, those of a device of one.
    """
    store(group, model, _ESTIMATE, (found, bare), "estimated_")
    store(group, model, results.estimate, found, "estimated_")


def store_bounds(group: Group, model: Model, results: Results, found: Sequence[Bound]) -> None:
    """Add the estimated response with each bound of the properties, and the bound that governs each quantity."""
    name, dims, of, unit, label = results.demand
    coordinate(group, "bound", [b.name for b in found], "", "bound of the properties of the dampers")
    columns = ((*column[:4], results.bounds.get(column[0], column[4])) for column in _BOUNDS)
    store_rows(group, model, "bound", columns, found)
    store_rows(group, model, "bound", ((name, dims, lambda m, b: of(m, b.response), unit, label),), found)
    group.attributes["governing"] = governing(found, {name: lambda r: float(of(model, r).max())})


def of_storeys(building: Building, of_places: np.ndarray) -> np.ndarray:
    """Return the largest value of the places of each storey with dampers, (s,).

    Args:
        building: the frame with its places.
        of_places: a value of each place, (d,).
    """
    return np.array([of_places[building.place_storey == i].max() for i in range(building.storeys.size)])


def _archived(building: Building, dims: tuple[str, ...], value: Any) -> tuple[tuple[str, ...], Any]:
    """Dimensions and value as archived: of places the largest of each storey."""
    return (STOREY, of_storeys(building, value)) if dims == PLACE else (dims, value)


def _text(text: Text, model: Model) -> str:
    return text if isinstance(text, str) else text(model)
