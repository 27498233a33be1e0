"""Footings in archives: what they are, what they dissipate, and what they do to the first mode."""

from __future__ import annotations

from dataclasses import dataclass, replace
from math import pi, sqrt

import numpy as np
import scipy

from edesign.archive.dataset import Group
from edesign.core import Modes, damped_eigenvalue
from edesign.errors import AnalysisError
from edesign.frame.footings import DIRECTIONS
from edesign.frame.frame_model import FrameModel
from edesign.project.analysis_file import AnalysisFile
from edesign.study.analysis.dampers import device_laws
from edesign.study.analysis.structure import Structure, build, make_structure
from edesign.study.results.recording import Quantity, Terms, coordinate

_WORDS = {
    2: ("horizontally", "vertically", "in rocking"),
    3: ("along x", "along y", "vertically", "in rocking about x", "in rocking about y", "in torsion"),
}


def store_footings(group: Group, frame: FrameModel) -> None:
    """Add stiffness, damping and soil of each footing of a frame to a group; nothing if it has none."""
    if not frame.footings:
        return
    coordinate(group, "footing", list(frame.footings), "", "name of the node that stands on the footing")
    springs = [built.springs for built in frame.footings.values()]
    formulas = np.asarray([of.formula for of in springs])
    group.add("footing_formula", ("footing",), formulas, "", "formula of the static stiffness")
    for name, values, unit, label in (
        ("period", [of.period for of in springs], "s", "period at which stiffness and damping are taken"),
        ("a_0", [of.a_0 for of in springs], "1", "omega B / V_s at the period, B half of the shorter side"),
        ("shear_modulus", [of.soil.shear_modulus for of in springs], "Pa", "G of the soil under the earthquake"),
        ("modulus_ratio", [of.soil.modulus_ratio for of in springs], "1", "G over that at small strains"),
        ("wave_velocity", [of.soil.wave_velocity for of in springs], "m/s", "V_s that belongs to G"),
        ("soil_damping", [of.soil.damping for of in springs], "1", "hysteretic damping ratio of the soil"),
        ("mass", [of.mass for of in springs], "kg", "mass of the footing; 0: it has none"),
    ):
        group.add(f"footing_{name}", ("footing",), values, unit, label)
    dimension = frame.model.dimension
    for i, (direction, words) in enumerate(zip(DIRECTIONS[dimension], _WORDS[dimension], strict=True)):
        per_motion, per_rate = ("N/m", "N*s/m") if i < dimension else ("N*m/rad", "N*m*s/rad")
        for name, values, unit, label in (
            ("static_stiffness", [of.static[i] for of in springs], per_motion, "static stiffness"),
            ("stiffness", [of.stiffness[i] for of in springs], per_motion, "stiffness at the period"),
            ("radiation_damping", [of.radiation[i] for of in springs], "1", "damping ratio of radiated waves"),
            ("dashpot", [of.dashpot[i] for of in springs], per_rate, "dashpot of radiation and soil"),
        ):
            group.add(f"footing_{name}_{direction}", ("footing",), values, unit, f"{label}, {words}")


def footing_quantities(frame: FrameModel, group: Group) -> list[Quantity]:
    """Return the work of the footings' dashpots, which a history records, and add the footings to its group.

    Returns:
        One quantity over (footing,) in J; none without footings.
    """
    store_footings(group, frame)
    if not frame.footings:
        return []
    cells: tuple[Terms, ...] = tuple(
        tuple((1.0, "damper_work", dashpot, 0) for dashpot in built.dashpots if dashpot is not None)
        for built in frame.footings.values()
    )
    label = "work on the dashpots of the footing: what the soil dissipates and radiates"
    return [Quantity("footing_work", ("footing",), (len(cells),), cells, "J", label, keep=("final",))]


@dataclass(frozen=True)
class Interaction:
    """The first mode of a frame on its footings beside that of the same frame on fixed bases.

    Attributes:
        fixed, flexible: periods, s.
        height, mass: effective, of the first mode on fixed bases, m and kg.
        closed_period_ratio: T_flexible / T_fixed of one mass at the effective height.
        closed_damping: its foundation damping, as a ratio of critical.
        damping: that of the frame, by its complex eigenvalue.

    The closed forms are those of column bases that all stand on footings; None: some do not.
    """

    fixed: float
    flexible: float
    height: float
    mass: float
    damping: float
    closed_period_ratio: float | None = None
    closed_damping: float | None = None


def interaction(project: AnalysisFile, structure: Structure, modes: Modes, gravity: bool) -> Interaction:
    """Return the effect of the footings on the first mode of a frame without dampers, but for restrained braces.

    Effective height and mass are those in the direction in which most of the mass moves in the first mode.

    Args:
        structure: the frame on its footings, in the state of the modes.
        gravity: whether this state is that under the gravity loads.

    Raises:
        AnalysisError: the frame on fixed bases is unstable, or its first mode on footings is overdamped.

    Source: period, Veletsos & Meek 1974, Earthquake Engineering and Structural Dynamics 3, 121-138; damping, NIST GCR
        12-917-21, Eq. 2-10, and ASCE/SEI 7-16, 19.3, with the exponent 2 of dashpots that are taken at the period.
    """
    laws = device_laws(project) if structure.frame.devices else {}
    fixed = make_structure(project, build(project, laws=laws, footings={}))
    if gravity:
        fixed.apply_gravity()
    on_fixed = fixed.modes(1)
    frame = structure.frame
    along = max(
        (direction.degree for direction in frame.directions), key=lambda at: on_fixed.effective_mass_ratio[0, at]
    )
    of_nodes = [(mass, frame.nodes[name], frame.places[name][-1]) for name, mass in frame.masses.items()]
    moved = [(mass * on_fixed.shapes[0, node, along], level) for mass, node, level in of_nodes]
    height = sum(share * level for share, level in moved) / sum(share for share, _ in moved)
    mass = float(on_fixed.participation[0, along]) ** 2
    found = Interaction(float(on_fixed.period[0]), float(modes.period[0]), height, mass, _damping(structure, modes))
    if set(frame.footings) != set(frame.supports):
        return found
    ratio, damping = _closed_forms(frame, found, along)
    return replace(found, closed_period_ratio=ratio, closed_damping=damping)


def _closed_forms(frame: FrameModel, of: Interaction, along: int) -> tuple[float, float]:
    """Period ratio and foundation damping of one mass on the footings, which a rigid base connects.

    Args:
        along: degree of the core in which the mass moves.
    """
    up = frame.up
    turn = frame.model.degrees.index("rz" if frame.model.dimension == 2 else ("ry", "rx")[along])
    places = np.array([frame.places[name][along] for name in frame.footings])
    k = np.array([built.springs.stiffness for built in frame.footings.values()])
    c = np.array([built.springs.dashpot for built in frame.footings.values()])
    turned = np.array([frame.grounds[name][turn] is not None for name in frame.footings])  # not by a pinned base
    arms = places - places @ k[:, up] / k[:, up].sum()  # from where a vertical force turns nothing
    sway, rocking = k[:, along].sum(), turned @ k[:, turn] + arms**2 @ k[:, up]
    in_sway, in_rocking = c[:, along].sum(), turned @ c[:, turn] + arms**2 @ c[:, up]
    of_structure = of.mass * (2.0 * pi / of.fixed) ** 2
    ratio = sqrt(1.0 + of_structure / sway + of_structure * of.height**2 / rocking)
    omega = 2.0 * pi / (ratio * of.fixed)
    # beta (T_x / T)^2 + beta (T_yy / T)^2, with beta = c omega / 2 k and T_x^2 = 4 pi^2 m / k
    damping = 0.5 * of.mass * omega**3 * (in_sway / sway**2 + in_rocking * of.height**2 / rocking**2)
    return ratio, float(damping)


def _damping(structure: Structure, modes: Modes) -> float:
    """Ratio of the first mode with the dashpots of the footings alone."""
    analysis, frame = structure.analysis, structure.frame
    along = analysis.damper_directions()
    coefficients = np.zeros(along.shape[0])
    for built in frame.footings.values():
        for number, coefficient in zip(built.dashpots, built.springs.dashpot, strict=True):
            if number is not None:
                coefficients[number] = coefficient
    if not coefficients.any():
        return 0.0
    damping = (along.T @ scipy.sparse.diags(coefficients) @ along).tocsc()
    stiffness = analysis.stiffness()
    if frame.brace_stiffness is not None:
        stiffness = (stiffness + along.T @ scipy.sparse.diags(frame.brace_stiffness) @ along).tocsc()
    omega, shape = float(modes.omega[0]), modes.equations[0]
    try:
        value = damped_eigenvalue(stiffness, analysis.masses(), damping, omega, shape)
    except (ValueError, RuntimeError) as error:
        raise AnalysisError(f"the first mode with the dashpots of the footings: {error} [E-MODAL-01]") from error
    return float(-value.real / abs(value))


def store_interaction(group: Group, found: Interaction) -> None:
    """Add the effect of the footings on the first mode to the attributes of a group.

    Args:
        group: of the modal analysis.
    """
    group.attributes |= {
        "fixed_base_period_s": found.fixed,
        "period_ratio": found.flexible / found.fixed,
        "foundation_damping": found.damping,
        "effective_height_m": found.height,
        "effective_mass_kg": found.mass,
    }
    if found.closed_period_ratio is not None:
        group.attributes |= {
            "closed_period_ratio": found.closed_period_ratio,
            "closed_foundation_damping": found.closed_damping,
        }
