"""The elastic design of a building: analysis, combinations of actions, and all checks, from one building file."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace

import numpy as np

from edesign.codes.ec8 import DesignSpectrum
from edesign.codes.ec8.criterion import Criterion
from edesign.codes.ec8.national import ActionFactors, NationalParameters, Psi, national_parameters
from edesign.codes.ec8.second_order import NEGLIGIBLE
from edesign.codes.en1990.combinations import Combination, characteristic, fundamental, seismic
from edesign.core.space_modes import SpaceModes
from edesign.errors import InputError
from edesign.ground_motion.hazard import elastic_spectrum
from edesign.project.building.building import Building
from edesign.project.building.design import Design
from edesign.project.hazard import Hazard
from edesign.space.capacity import Joint, Overstrength, dissipative_members, joints, overstrength
from edesign.space.criteria import (
    MOMENT_FRAME,
    behaviour_criteria,
    bracing_criteria,
    design_of,
    joint_criteria,
    largest_q,
    modal_criteria,
    storey_criteria,
    system_of,
)
from edesign.space.effects import Effects, effects
from edesign.space.frame import LoadCase, SpaceFrame
from edesign.space.geometry import space_frame
from edesign.space.member_checks import MemberResults, member_results
from edesign.space.model import space_model
from edesign.space.response import (
    AXES,
    Axis,
    SeismicResponse,
    StaticResponse,
    gravity_above,
    seismic_response,
    static_response,
)
from edesign.space.storeys import Storeys, storeys

PERMANENT = "permanent"  # category of load cases


@dataclass(frozen=True)
class ElasticDesign:
    """A building with its response and its checks.

    Attributes:
        building: the file.
        frame: its members, loads and masses.
        modes: natural modes that were taken.
        static: effects of the load cases.
        response: effects of the seismic action along x and y.
        storeys: the storeys under either.
        effects: on members, with second-order effects.
        combinations: of actions, with names.
        q: behaviour factors.
        overstrength: of either direction.
        joints: of moment frames.
        members: checks of all members.
        criteria: rules for the whole building.
        notes: what an engineer should know, a sentence each.
    """

    building: Building
    frame: SpaceFrame
    modes: SpaceModes
    static: StaticResponse
    response: Mapping[Axis, SeismicResponse]
    storeys: Mapping[Axis, Storeys]
    effects: Effects
    combinations: tuple[Combination, ...]
    q: Mapping[Axis, float]
    overstrength: Mapping[Axis, Overstrength]
    joints: tuple[Joint, ...]
    members: MemberResults
    criteria: tuple[Criterion, ...]
    notes: tuple[str, ...]

    @property
    def passed(self) -> bool:
        """Whether all checks and rules are met."""
        return not bool((self.members.utilisation > 1.0).any()) and all(
            rule.passed is not False for rule in self.criteria
        )


def elastic_design(building: Building) -> ElasticDesign:
    """Analyse a building and check it.

    Args:
        building: from `load_building`, with the blocks `hazard`, `masses` and `design`.

    Raises:
        InputError: a block is missing, a behaviour factor or a mode is out of its range.
        CoreError: the structure is a mechanism.
    """
    design = design_of(building)
    hazard = _hazard(building)
    national = national_parameters(hazard.country)
    frame = _with_joined_cases(space_frame(building))
    if not frame.node_mass.any():
        raise InputError(
            f"{building.path}: masses: the seismic action needs masses; docs/building_file.md explains them"
        )
    model = space_model(frame, building.materials)
    limit = {axis: largest_q(building, system_of(design, axis), axis, national.low_ductility_q) for axis in AXES}
    q = {axis: limit[axis] if (of := system_of(design, axis).q) == "table" else float(of) for axis in AXES}
    modes = model.modes(frame.node_mass, None if design.modes == "auto" else design.modes)
    static = static_response(model, frame)
    elastic = elastic_spectrum(hazard, design.level or next(iter(hazard.levels), None))
    response = {
        axis: seismic_response(
            model,
            frame,
            modes,
            axis,
            elastic,
            DesignSpectrum.of(elastic, q[axis], national.beta),
            design.combination,
            design.damping,
            design.accidental_torsion,
        )
        for axis in AXES
    }
    cases = {name: case.category for name, case in frame.cases.items()}
    psi = _psi(building, national)
    rows = seismic(cases, psi, "srss" if design.directions == "srss" else "30 %")
    gravity = gravity_above(frame, rows[0].static)
    height = np.array(building.heights)
    of_storeys = {axis: storeys(response[axis], height, gravity, design) for axis in AXES}
    acting = effects(frame, static, response, of_storeys)
    persistent = fundamental(cases, psi, _action_factors(design, national))
    gamma_M0 = design.partial_factors.M0
    Omega = {
        axis: overstrength(frame, building.materials, acting, rows, axis, system_of(design, axis).type, gamma_M0)
        for axis in AXES
    }
    checked = member_results(building, frame, acting, persistent, rows, Omega, design.overstrength)
    frames = [axis for axis in AXES if system_of(design, axis).type == MOMENT_FRAME]
    of_joints = {axis: joints(frame, building.materials, acting, rows, axis, gamma_M0) for axis in frames}
    criteria = modal_criteria(modes)
    modulus = {name: steel.E for name, steel in building.materials.items()}
    for axis in AXES:
        dissipative = dissipative_members(frame, axis, system_of(design, axis).type)
        criteria += behaviour_criteria(building, frame, q, limit, axis, [int(n) for n in dissipative])
        criteria += storey_criteria(of_storeys[axis])
        if design.ductility_class == "low":
            continue  # no capacity design (EN 1998-1, 6.1.2(4))
        if axis in frames:
            criteria += joint_criteria(of_joints[axis], axis)
        else:
            criteria += bracing_criteria(building, frame, Omega[axis], modulus)
    return ElasticDesign(
        building=building,
        frame=frame,
        modes=modes,
        static=static,
        response=response,
        storeys=of_storeys,
        effects=acting,
        combinations=(*checked.rows, *characteristic(cases, psi)),
        q=q,
        overstrength=Omega,
        members=checked,
        joints=tuple(joint for axis in frames for joint in of_joints[axis]),
        criteria=tuple(criteria),
        notes=tuple(_notes(response, of_storeys)),
    )


def _hazard(building: Building) -> Hazard:
    if building.hazard is None:
        raise InputError(f"{building.path}: hazard: this block is missing; docs/building_file.md explains it")
    return building.hazard


def _with_joined_cases(frame: SpaceFrame) -> SpaceFrame:
    """Return the frame with its permanent cases as one, `G`, and a single category of use as `Q`."""
    permanent = [case for case in frame.cases.values() if case.category == PERMANENT]
    variable = [case for case in frame.cases.values() if case.category != PERMANENT]
    cases = {"G": _sum("G", permanent)} | {case.name: case for case in variable}
    if len(variable) == 1:
        cases = {"G": cases["G"], "Q": replace(variable[0], name="Q")}
    return replace(frame, cases=cases)


def _sum(name: str, cases: Sequence[LoadCase]) -> LoadCase:
    return LoadCase(
        name,
        PERMANENT,
        nodal=np.sum([case.nodal for case in cases], axis=0),
        uniform=np.sum([case.uniform for case in cases], axis=0),
        point_member=np.concatenate([case.point_member for case in cases]),
        point_position=np.concatenate([case.point_position for case in cases]),
        point_force=np.concatenate([case.point_force for case in cases]),
    )


def _action_factors(design: Design, national: NationalParameters) -> ActionFactors:
    """Return the national partial factors with gamma_G and gamma_Q of the file."""
    return replace(national.action_factors, G_sup=design.partial_factors.G, Q=design.partial_factors.Q)


def _psi(building: Building, national: NationalParameters) -> dict[str, Psi]:
    """Return the national psi factors; psi_2 is that of the masses where the file gives it."""
    psi = dict(national.psi)
    masses = building.masses
    if masses is not None and masses.from_loads is not None:
        for category in psi:
            known = psi[category]
            try:
                psi[category] = Psi(known.psi_0, known.psi_1, masses.from_loads.psi_2(category))
            except KeyError:  # no load of this category
                continue
    return psi


def _notes(response: Mapping[Axis, SeismicResponse], of_storeys: Mapping[Axis, Storeys]) -> list[str]:
    found = []
    for axis in AXES:
        of = response[axis]
        if of.base_shear > 1.001 * of.base_shear_without_beta:
            found.append(
                f"beta = {of.spectrum.beta:g} governs the base shear along {axis}: {of.base_shear / 1e3:.0f} kN, "
                f"without it {of.base_shear_without_beta / 1e3:.0f} kN (EN 1998-1, 3.2.2.5(4)P)"
            )
        table = of_storeys[axis]
        if table.theta_q.max() > max(NEGLIGIBLE, 1.001 * table.theta.max()):
            found.append(
                f"theta along {axis} is up to {table.theta_q.max():.2f} with q d_e and {table.theta.max():.2f} with "
                "the cap of the elastic spectrum (EN 1998-1, 4.3.4(3))"
            )
    return found
