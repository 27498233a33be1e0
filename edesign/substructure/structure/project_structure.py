"""The frame of a project as the numerical part: its tangent under gravity, condensed to the degrees with mass."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np
import scipy

from edesign.errors import InputError
from edesign.frame.damping import modal_ratios, modes_needed, proportional_factors
from edesign.frame.devices import Device
from edesign.project.analysis.damping import CaugheyDamping, MassDamping, ModalDamping, NoDamping
from edesign.project.frame.materials import ElasticMaterial
from edesign.project.project import Project
from edesign.project.reading.problems import unknown_name
from edesign.study.analysis.dampers import attachments
from edesign.study.analysis.structure import Structure, device_stiffness, frame_alone, make_structure
from edesign.substructure.structure.linear_building import LinearBuilding, building_of_frame
from edesign.substructure.structure.numerical import LinearPart, modal_damping_matrix

LINEAR_LAWS = {"kelvin_voigt": 2, "viscous": 1}
"""Laws that the matrices can hold, with the number of their parameters: (k, c) and (c)."""

MOST_IN_SERIES = 0.01
"""Share of the flexibility at the specimen that may belong to degrees without mass. It is left out, and with it that
share of the deformation: a fifth of the error of the response that criteria accept by default."""

WORTH_TELLING = 1e-4
"""Such a share that is reported: a force is not measured better."""

SMALL, SLOW = 1e-4, 1.0
"""Amplitude (m) and frequency (Hz) at which other dampers are linearised for an estimate."""

ROUNDING = 1e-9

DEGREES = ("ux", "uy", "rz")


@dataclass(frozen=True, eq=False)
class ProjectPart:
    """A project's frame without one of its dampers.

    Attributes:
        part: the numerical part; the specimen's deformation and force are those of the whole device.
        device: the damper that stands in the laboratory; its law at its size.
        building: its floors and storeys by displacements of the degrees.
        warnings: what the linear part leaves out, sentences.
    """

    part: LinearPart
    device: Device
    building: LinearBuilding
    warnings: tuple[str, ...] = ()


@dataclass(frozen=True)
class _Condensed:
    """Equations with mass, and how the others follow them statically.

    Attributes:
        heavy: (n,) numbers of the equations with mass.
        shape: (n_equations, n) displacements of all equations by those with mass.
        light: (m,) numbers of the equations without mass.
        light_stiffness: factors of their stiffness; None: there are none.
    """

    heavy: np.ndarray
    shape: np.ndarray
    light: np.ndarray
    light_stiffness: scipy.sparse.linalg.SuperLU | None

    def reduce(self, matrix: scipy.sparse.csc_matrix) -> np.ndarray:
        """Return shape' matrix shape, (n, n)."""
        reduced = self.shape.T @ (matrix @ self.shape)
        return np.asarray(0.5 * (reduced + reduced.T))

    def flexibility(self, direction: np.ndarray) -> float:
        """Return the deformation along (n_equations,) by a unit force there, the degrees with mass fixed, m/N."""
        if self.light_stiffness is None:
            return 0.0
        along = direction[self.light]
        return float(along @ self.light_stiffness.solve(along))


def project_part(project: Project, device: str, vertical: bool = True, estimate: bool = False) -> ProjectPart:
    """Return the numerical part of a project whose damper `device` stands in the laboratory.

    The stiffness is the tangent under the gravity combination, about which histories vibrate; with `corotational` or
    `p_delta` elements it has the effect of the gravity forces. Degrees without mass are condensed statically, which is
    exact but for forces of dampers on them. Inherent damping is that of histories: of the frame without dampers and
    tuned masses. Tuned masses stay in the numerical part, and other dampers whose law is a spring and a dashpot.

    Args:
        device: name of the damper, e.g. "S_1_1".
        vertical: whether masses resist vertical motion, if they do in the project. Without them the columns' fast axial
            modes are gone, which limit the step of explicit methods and lengthen each.
        estimate: True for margins beside a frame that may yield. Other dampers may have any law and count as they are
            in small vibration, and what degrees without mass leave out is not refused.

    Raises:
        InputError: the device does not exist or has a brace in series; another damper is not linear or has a brace; the
            frame has no mass or no `damping`, or is unstable without the damper; degrees without mass make up too much
            of the flexibility at the specimen.
        AnalysisError: no equilibrium under gravity, or no modes for the damping.
        CoreError: the frame is a mechanism.

    Source: static condensation: Chopra, Dynamics of Structures, 9.3.
    """
    if project.dampers is None or not project.dampers.devices:
        raise InputError(
            f"{project.path}: the project has no dampers, of which one could stand in the laboratory [E-PART-03]"
        )
    if project.damping is None:
        raise InputError(
            f"{project.path}: a substructure test needs `damping`; for none write `damping: {{kind: none}}` [E-KEY-02]"
        )
    structure = make_structure(project, dampers=True)
    specimen = _specimen(project, structure, device)
    unloaded = structure.analysis.stiffness()
    structure.apply_gravity()
    tangent = structure.analysis.stiffness()
    along = structure.analysis.damper_directions().toarray()
    condensed = _condense(project, tangent, _moving_masses(structure, vertical))
    k, c = _in_small_vibration(structure, specimen) if estimate else _other_dampers(project, structure, specimen)
    _add_dashpots(project, structure, c)
    dashpots = scipy.sparse.csc_matrix(along.T @ (c[:, None] * along))
    springs = scipy.sparse.csc_matrix(along.T @ (k[:, None] * along))
    mass = np.diag(structure.analysis.masses()[condensed.heavy])
    direction = along[specimen.number]
    stiffness = condensed.reduce(tangent + springs)
    part = LinearPart(
        mass,
        _inherent_damping(project, structure, condensed, mass, unloaded) + condensed.reduce(dashpots),
        stiffness,
        _horizontal(structure)[condensed.heavy],
        _interface(project, specimen, direction @ condensed.shape),
        tuple(_equation_names(structure)[number] for number in condensed.heavy),
    )
    omega, _ = part.modes()  # refuses an unstable one
    building = _building(structure, condensed, 2.0 * np.pi / omega[0] if omega[0] > 0.0 else np.inf)
    if estimate:
        return ProjectPart(part, specimen, building)
    warnings = _in_series(project, specimen, condensed.flexibility(direction), part)
    return ProjectPart(part, specimen, building, (*warnings, *_yielding(project)))


def _specimen(project: Project, structure: Structure, name: str) -> Device:
    devices = {device.name: device for device in structure.frame.devices}
    if name not in devices:
        raise InputError(f"{project.path}: {unknown_name('damper', name, devices)}")
    found = devices[name]
    if found.brace > 0.0:
        raise InputError(
            f"{project.path}: the damper {name} has a brace in series ({found.brace:g} N/m); say what stands in the "
            "laboratory: make the brace `rigid` and give the damper's own stiffness, or test both together as one law"
            " [E-PART-05]"
        )
    return found


def _other_dampers(project: Project, structure: Structure, specimen: Device) -> tuple[np.ndarray, np.ndarray]:
    """Stiffness and damping, (n_dampers,) each, of the dampers that stay in the numerical part."""
    model = structure.frame.model
    k, c = np.zeros(len(model.damper_names)), np.zeros(len(model.damper_names))
    for device in structure.frame.devices:
        if device.number == specimen.number:
            continue
        law = device.values
        reason = None
        if law.law not in LINEAR_LAWS:
            reason = f"its law `{device.law}` ({law.law}) is no spring and dashpot; kelvin_voigt and viscous are"
        elif law.effects:
            reason = f"its law `{device.law}` has effects"
        elif device.brace > 0.0:
            reason = "it has a brace in series"
        if reason is not None:
            raise InputError(
                f"{project.path}: beside {specimen.name} the damper {device.name} would stay in the linear numerical "
                f"part, and {reason} [E-PART-05]"
            )
        scale = device.force_scale * device.deformation_scale
        values = (0.0, *law.values)[-2:]
        k[device.number], c[device.number] = scale * values[0], scale * values[1]
    return k, c


def _in_small_vibration(structure: Structure, specimen: Device) -> tuple[np.ndarray, np.ndarray]:
    """The same for any law, with its brace: at SMALL and SLOW."""
    count = len(structure.frame.model.damper_names)
    k, c = np.zeros(count), np.zeros(count)
    for device in structure.frame.devices:
        if device.number != specimen.number:
            found = device_stiffness(device, SMALL, SLOW)
            k[device.number], c[device.number] = found.real, found.imag / (2.0 * np.pi * SLOW)
    return k, c


def _add_dashpots(project: Project, structure: Structure, c: np.ndarray) -> None:
    """Those of tuned masses."""
    model = structure.frame.model
    for attached in attachments(project):
        dashpot = f"{attached.name}_dashpot"
        if dashpot in model.damper_names:
            c[model.damper_names.index(dashpot)] = attached.damping


def _condense(project: Project, tangent: scipy.sparse.csc_matrix, masses: np.ndarray) -> _Condensed:
    heavy, light = np.flatnonzero(masses > 0.0), np.flatnonzero(masses <= 0.0)
    if heavy.size == 0:
        raise InputError(
            f"{project.path}: the frame has no `masses`; without inertia there is no motion to integrate [E-PART-01]"
        )
    shape = np.zeros((masses.size, heavy.size))
    shape[heavy, np.arange(heavy.size)] = 1.0
    if light.size == 0:
        return _Condensed(heavy, shape, light, None)
    try:
        factors = scipy.sparse.linalg.splu(tangent[light][:, light].tocsc())
    except RuntimeError as error:
        text = "nothing restrains the degrees without mass once the damper stands in the laboratory [E-PART-01]"
        raise InputError(f"{project.path}: {text}") from error
    shape[light] = -factors.solve(tangent[light][:, heavy].toarray())
    return _Condensed(heavy, shape, light, factors)


def _moving_masses(structure: Structure, vertical: bool) -> np.ndarray:
    """Masses of the equations, (n_equations,); without the vertical ones if they are to be left out."""
    masses = structure.analysis.masses()
    if not vertical:
        upright = structure.analysis.equations[:, 1]
        masses[upright[upright >= 0]] = 0.0
    return masses


def _inherent_damping(
    project: Project,
    structure: Structure,
    condensed: _Condensed,
    mass: np.ndarray,
    unloaded: scipy.sparse.csc_matrix,
) -> np.ndarray:
    """Damping (n, n) N s/m as histories have it; the modes are those of the frame without tuned masses."""
    damping = project.damping
    if damping is None or isinstance(damping, NoDamping):
        return np.zeros_like(mass)
    alone = frame_alone(project)
    if damping.state == "gravity":
        alone.apply_gravity()
    count = modes_needed(damping, alone.most_modes)
    if not isinstance(damping, (ModalDamping, CaugheyDamping)):
        omega = alone.modes(count).omega if count else np.empty(0)
        a0, a1 = proportional_factors(damping, omega)
        if isinstance(damping, MassDamping):
            return np.asarray(a0 * mass)
        base = unloaded if damping.stiffness == "initial" else structure.analysis.stiffness()
        return np.asarray(a0 * mass + a1 * condensed.reduce(base))
    modes = alone.modes(count)
    more = structure.analysis.n_equations - modes.equations.shape[1]  # tuned masses have the last equations
    padded = replace(modes, equations=np.pad(modes.equations, ((0, 0), (0, more))))
    return modal_damping_matrix(
        mass, modes.omega, padded.equations[:, condensed.heavy].T, modal_ratios(damping, modes.omega)
    )


def _interface(project: Project, specimen: Device, interface: np.ndarray) -> np.ndarray:
    if np.abs(interface).max() <= ROUNDING * max(abs(coefficient) for coefficient, _, _ in specimen.terms):
        raise InputError(
            f"{project.path}: no degree with mass moves the damper {specimen.name}: the loop would have no inertia; "
            "give `masses` at its ends [E-PART-01]"
        )
    return interface


def _in_series(project: Project, specimen: Device, flexibility: float, part: LinearPart) -> list[str]:
    """What is left out where the damper's force bends degrees without mass, which move at once."""
    softness = np.linalg.solve(part.stiffness, part.interface) @ part.interface + flexibility
    share = flexibility / softness
    if share <= WORTH_TELLING:
        return []
    text = (
        f"{100.0 * share:.2g} % of the flexibility at the damper {specimen.name} ({flexibility:.3g} m/N) belongs to "
        "degrees without mass"
    )
    if share > MOST_IN_SERIES:
        raise InputError(
            f"{project.path}: {text}; they would answer the measured force at once, and no step can be made of that; "
            "give masses there, e.g. `masses: {directions: both}` [E-PART-01]"
        )
    return [f"{text}; it is left out"]


def _yielding(project: Project) -> list[str]:
    """Materials of the frame that can yield."""
    used = {run.material for run in project.grid.members.values()}
    names = sorted(name for name in used if not isinstance(project.materials[name], ElasticMaterial))
    return [f"the numerical part is linear: {', '.join(names)} would not yield in it"] if names else []


def _horizontal(structure: Structure) -> np.ndarray:
    """Displacements of the equations when the ground moves by 1 along x, (n_equations,)."""
    influence = np.zeros(structure.analysis.n_equations)
    across = structure.analysis.equations[:, 0]
    influence[across[across >= 0]] = 1.0
    return influence


def _building(structure: Structure, condensed: _Condensed, period: float) -> LinearBuilding:
    across = structure.analysis.equations[:, 0]
    rows = np.where(across[:, None] >= 0, condensed.shape[across], 0.0)
    return building_of_frame(structure.frame, rows, period)


def _equation_names(structure: Structure) -> list[str]:
    """Name of each equation: that of the floor that it moves as a whole, or of its first node with the degree."""
    analysis, frame = structure.analysis, structure.frame
    names = [""] * analysis.n_equations
    for floor in frame.floors:
        across = {int(analysis.equations[node, degree]) for ((_, node, degree),) in floor.movers[0]}
        if len(across) == 1 and min(across) >= 0:
            names[min(across)] = f"floor {floor.number}"
    for node, equations in zip(frame.model.node_names, analysis.equations, strict=True):
        for degree, equation in zip(DEGREES, equations, strict=True):
            if equation >= 0 and not names[equation]:
                names[equation] = f"{node} {degree}"
    return names
