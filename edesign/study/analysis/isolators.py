"""Warnings about an isolated base after a history: isolators that are pulled, weights that change."""

from __future__ import annotations

import numpy as np

from edesign.archive.dataset import Group
from edesign.frame.frame_model import FrameModel
from edesign.frame.isolation import IsolatedBases, isolator_under
from edesign.project.analysis_file import AnalysisFile
from edesign.project.building.building import Building
from edesign.project.dampers.isolation import AnyIsolation
from edesign.project.frame.supports import VerticalSpring
from edesign.project.notation import names
from edesign.project.notation.grid import Grid
from edesign.project.notation.units import STANDARD_GRAVITY
from edesign.project.project import Project
from edesign.study.results.couples import NEGLECTED
from edesign.study.results.warnings import AnalysisWarning

_ROUNDING = 1e-9  # of an axial force that is none, against the largest


def isolator_warnings(project: AnalysisFile, group: Group, frame: FrameModel) -> list[AnalysisWarning]:
    """Return warnings of isolators in tension, of pendulums that lost contact, and of their weights.

    Args:
        project: with the isolated base.
        group: of the history, with its axial forces, and its vertical motion if it has one.
    """
    isolated, isolation = frame.isolated, project.isolation
    if isolated is None or isolation is None:
        return []
    most, least = (np.asarray(group.variables[f"isolator_axial_force_{which}"].values) for which in ("max", "min"))
    most = np.where(np.abs(most) <= _ROUNDING * np.abs(least).max(), 0.0, most)
    most_of = {isolator.name: float(force) for isolator, force in zip(isolated.isolators, most, strict=True)}
    pressed = float(np.abs(least).max())
    return [
        *_pulled(project.grid, isolation, isolated, most_of, pressed),
        *_moments_in_the_ground(project, group, isolated, most_of, pressed),
        *_moments_of_displacement(project.grid, group, isolated),
        *_weights(group, isolated, most_of, pressed),
    ]


def _pulled(
    grid: Grid, isolation: AnyIsolation, isolated: IsolatedBases, most_of: dict[str, float], pressed: float
) -> list[AnalysisWarning]:
    """Isolators that are pulled and as stiff then as under pressure; pendulums that slide on are reported elsewhere."""
    pulled = []
    for device in isolated.isolators:
        line = next(line for line in grid.lines if grid.node_name(line, 0) == device.column_base)
        isolator = isolator_under(isolation, line, grid)
        lifts = isolator is not None and isinstance(isolator.vertical, VerticalSpring) and isolator.vertical.uplift
        if most_of[device.name] > 0.0 and not lifts and device.name not in isolated.weighed:
            pulled.append(device.name)
    if not pulled:
        return []
    worst = max(pulled, key=lambda name: most_of[name])
    count = "1 isolator is" if len(pulled) == 1 else f"{len(pulled)} isolators are"
    text = (
        f"{count} pulled, {worst} with {most_of[worst] / 1e3:.4g} kN; it is as stiff in tension as in "
        "compression, which bearings of rubber and sliders are not (`uplift: true` of `vertical` lets it lift off)"
    )
    return [AnalysisWarning("isolator_tension", text, 1.0 + most_of[worst] / max(pressed, most_of[worst]))]


_LEFT_OUT = (
    "the axial forces of the isolators leave out the moments of the column bases, which `rotation` lets into the ground"
)
_BROUGHT = "`base.beams` brings them to the isolators"


def _moments_in_the_ground(
    project: AnalysisFile, group: Group, isolated: IsolatedBases, most_of: dict[str, float], pressed: float
) -> list[AnalysisWarning]:
    """What the axial forces of isolators leave out, where moments of column bases go into the ground by `rotation`."""
    assert isinstance(project, Project | Building) and project.isolation is not None
    base = project.isolation.base
    if base.beams is not None or base.rotation == "free":
        return []
    if isinstance(project, Building):
        return [AnalysisWarning("isolator_foot_moments", f"{_LEFT_OUT}; {_BROUGHT}", 1.0)]
    frame = project.frame
    most, least = (
        np.asarray(group.variables[f"member_bending_moment_{which}"].values)[:, 0] for which in ("max", "min")
    )
    members = [str(name) for name in group.coords["member"].values]
    columns = {line: names.column_name(line, 1) for line in frame.lines}
    rows = {line: members.index(column) for line, column in columns.items() if column in members}
    if len(rows) < 2:
        return []
    moments = np.array([0.5 * (most[row] - least[row]) for row in rows.values()])  # without what gravity has
    places = np.array([x for line, x in zip(frame.lines, frame.x, strict=True) if line in rows])
    forces = dict(zip((names.node_name(line, 0) for line in rows), _couples(moments, places), strict=True))
    change = {isolator.name: float(forces.get(isolator.column_base, 0.0)) for isolator in isolated.isolators}
    worst = max(change, key=lambda name: change[name])
    if change[worst] <= _ROUNDING * pressed:
        return []
    beside = f"about {change[worst] / 1e3:.4g} kN more and less at {worst}"
    text = f"{_LEFT_OUT}: {moments.sum() / 1e3:.4g} kNm in all, {beside}"
    near = [name for name, force in most_of.items() if -change[name] < force <= 0.0]
    if near:
        first = max(near, key=lambda name: most_of[name] + change[name])
        text += f"; they may pull at {first}, which is pressed by {max(0.0, -most_of[first]) / 1e3:.4g} kN at least"
    text += f"; {_BROUGHT}"
    return [AnalysisWarning("isolator_foot_moments", text, change[worst] / pressed)]


def _moments_of_displacement(grid: Grid, group: Group, isolated: IsolatedBases) -> list[AnalysisWarning]:
    """What the base would get of the moments N u of weights and displacement, if the isolators had a height.

    Half of them above a bearing of rubber, whose ends turn alike; all of them above a pendulum with the dish on top. In
    a building that is along the direction in which they are most.
    """
    at_rest = np.asarray(group.variables["isolator_axial_force_final"].values)
    shares = np.array([1.0 if device.name in isolated.weighed else 0.5 for device in isolated.isolators])
    moved = np.atleast_1d(_largest(group, "base_displacement"))
    moments = shares @ np.maximum(-at_rest, 0.0) * moved
    of_storeys = np.atleast_1d(np.asarray(grid.storey_heights) @ _largest(group, "storey_shear"))
    worst = int(np.argmax(moments - NEGLECTED * of_storeys))
    moment, overturning = float(moments[worst]), float(of_storeys[worst])
    if moment <= NEGLECTED * overturning:
        return []
    far, beside = 1e3 * float(moved[worst]), f"{moment / 1e3:.4g} kNm beside {overturning / 1e3:.4g} kNm of overturning"
    text = (
        f"isolators have no height: moments of their axial forces and the displacement of {far:.3g} mm, up to "
        f"{beside}, go into the ground and not into base and columns"
    )
    return [AnalysisWarning("isolator_height", text, moment / max(NEGLECTED * overturning, _ROUNDING * moment))]


def _largest(group: Group, name: str) -> np.ndarray:
    """The largest magnitude of a quantity."""
    most, least = (np.asarray(group.variables[f"{name}_{which}"].values) for which in ("max", "min"))
    return np.asarray(np.maximum(most, -least))


def _couples(moments: np.ndarray, places: np.ndarray) -> np.ndarray:
    """What moments of one sense at the supports of a beam change the reactions by, (n,) N.

    Each goes into the spans beside it in proportion to their stiffness, 1/L of one section, and a span balances what
    it has by the shear of its ends. For two supports that is the couple of equilibrium.

    Args:
        moments: (n,) N m.
        places: (n,) of the supports, ascending, m.
    """
    stiffness = 1.0 / np.diff(places)
    beside = np.concatenate(([0.0], stiffness, [0.0]))
    share = moments / (beside[:-1] + beside[1:])  # per stiffness of a span
    shear = np.concatenate(([0.0], (share[:-1] + share[1:]) * stiffness * stiffness, [0.0]))
    return np.abs(np.diff(shear))


def _weights(group: Group, isolated: IsolatedBases, most_of: dict[str, float], pressed: float) -> list[AnalysisWarning]:
    """Pendulums that slide under their weight by gravity, whatever presses on them."""
    weighed = [name for name in most_of if name in isolated.weighed]
    if not weighed:
        return []
    found = []
    free = [name for name in weighed if most_of[name] >= 0.0]
    if free:
        worst = max(free, key=lambda name: most_of[name])
        pulls = most_of[worst] > 0.0
        text = f"pulls at {worst} with {most_of[worst] / 1e3:.4g} kN" if pulls else f"lifts off {worst}"
        count = "1 friction pendulum" if len(free) == 1 else f"{len(free)} friction pendulums"
        rest = "it slides as under its weight" if len(free) == 1 else "they slide as under their weight"
        message = f"{count} of {len(weighed)} lost contact: the frame {text}; {rest} (`weight: varying` follows it)"
        found.append(AnalysisWarning("isolator_uplift", message, 1.0 + most_of[worst] / pressed))
    if "vertical_pga_m_s2" in group.attributes:
        peak = float(str(group.attributes["vertical_pga_m_s2"])) / STANDARD_GRAVITY
        text = (
            f"the vertical ground motion, {peak:.3g} g, changes the weight on the friction pendulums, which slide as "
            "under gravity (`weight: varying` follows it)"
        )
        found.append(AnalysisWarning("isolator_weight", text, 1.0 + peak))
    return found
