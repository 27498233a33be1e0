"""The elastic design of a building: analysis, combinations of actions, and all checks, from one building file."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, fields, replace

import numpy as np

from edesign.codes.ec8 import DesignSpectrum, ElasticSpectrum
from edesign.codes.ec8.modal_combination import LARGE_MODE
from edesign.codes.ec8.second_order import NEGLIGIBLE
from edesign.codes.en1990.combinations import Combination, characteristic, fundamental, seismic
from edesign.codes.ntc2018 import NtcDesignSpectrum, NtcSpectrum
from edesign.codes.ntc2018.behaviour_factor import limit_of_q, limit_of_q_for_damage
from edesign.codes.ntc2018.drift import limit_state_of_drift
from edesign.codes.rule_check import ROUNDING, RuleCheck, at_most
from edesign.core.space import SpaceModel
from edesign.core.space_modes import SpaceModes
from edesign.errors import InputError
from edesign.ground_motion.hazard import checked_hazard, elastic_spectrum, national_of, vertical_spectrum
from edesign.project.actions.hazard import EC8Hazard, NtcHazard
from edesign.project.building.building import Building, Steel
from edesign.project.building.plausible import unusual
from edesign.project.notation.units import STANDARD_GRAVITY
from edesign.project.reading.problems import listed
from edesign.space.analysis.actions import (
    action_factors_of,
    patterns_of,
    psi_of,
    relieving_cases,
    stated_combinations,
    with_joined_cases,
)
from edesign.space.analysis.bracing import bracing
from edesign.space.analysis.buckled_diagonals import single_diagonals, with_buckled_diagonals
from edesign.space.analysis.deflections import DeflectionAnalysis, Deflections, deflection_criteria
from edesign.space.analysis.effects import Effects, effects, largest
from edesign.space.analysis.lateral import LateralCases, lateral_cases, static_effects, sway_limits
from edesign.space.analysis.live_load_reduction import NOTE as LIVE_LOADS_REDUCED
from edesign.space.analysis.live_load_reduction import LiveLoadReduction
from edesign.space.analysis.response import (
    AnyDesignSpectrum,
    ResponseSpectrumAnalysis,
    SeismicResponse,
    StaticResponse,
    gravity_above,
)
from edesign.space.analysis.storeys import Storeys, storeys
from edesign.space.analysis.sway import SwayAnalysis, SwayStability, sway_criteria, sway_notes
from edesign.space.analysis.vertical_component import vertical_combinations, vertical_component
from edesign.space.analysis.yielded_braces import with_yielded_braces, yielded_combinations
from edesign.space.checks.capacity import Joint, Overstrength, dissipative_members, joints, overstrength
from edesign.space.checks.column_bases import base_criteria, hinged_bases
from edesign.space.checks.foundations import Foundations, foundation_factors, foundations, supports
from edesign.space.checks.links import Link, link_criteria, links, overstrength_of_links
from edesign.space.checks.member_checks import LARGEST_CLASS, MemberChecker, MemberResults
from edesign.space.checks.regularity import regularity, shape
from edesign.space.checks.rules import (
    allowed_class,
    behaviour_criteria,
    bracing_criteria,
    connection_criteria,
    joint_criteria,
    largest_q,
    modal_criteria,
    storey_criteria,
)
from edesign.space.checks.secondary_beams import secondary_criteria
from edesign.space.checks.web_panels import Panel, panel_criteria, web_panels
from edesign.space.file_places import keys_of_member, telling_member, telling_place
from edesign.space.structure.composite import stiffness_factor
from edesign.space.structure.design_block import ECCENTRIC, MOMENT_FRAME, Regular, design_of, rules_of, system_of
from edesign.space.structure.frame import AXES, Axis, Member, SpaceFrame
from edesign.space.structure.geometry import space_frame
from edesign.space.structure.load_cases import ALWAYS, NON_STRUCTURAL, SELF_WEIGHT, self_weight
from edesign.space.structure.masses import node_masses
from edesign.space.structure.model import member_properties, space_model
from edesign.space.structure.steel_by_thickness import steel_by_thickness, with_steel_by_thickness


@dataclass(frozen=True)
class ElasticDesign:
    """A building with its response and its checks.

    Attributes:
        building: the file, with steels by thickness where it asks for them.
        frame: its members, loads and masses.
        modes: natural modes that were taken.
        static: effects of the load cases.
        response: effects of the seismic action along x and y.
        storeys: the storeys under either.
        sway: stability under persistent combinations.
        effects: on members, with second-order effects and those of sway imperfections.
        combinations: of actions, with names.
        regular: whether the building counts as regular.
        q: behaviour factors.
        overstrength: of either direction.
        joints: of moment frames.
        panels: web panels at the joints of moment frames.
        links: seismic links of eccentric bracings.
        foundations: reactions of the supports and design actions on foundations.
        members: checks of all members.
        deflections: of the beams, under characteristic combinations.
        lateral: load cases that act sideways, and the drifts of storeys under them and in characteristic combinations.
        criteria: rules for the whole building.
        notes: what an engineer should know, a sentence each.
    """

    building: Building
    frame: SpaceFrame
    modes: SpaceModes
    static: StaticResponse
    response: Mapping[Axis, SeismicResponse]
    storeys: Mapping[Axis, Storeys]
    sway: SwayStability
    effects: Effects
    combinations: tuple[Combination, ...]
    regular: Regular
    q: Mapping[Axis, float]
    overstrength: Mapping[Axis, Overstrength]
    joints: tuple[Joint, ...]
    panels: tuple[Panel, ...]
    links: tuple[Link, ...]
    foundations: Foundations
    members: MemberResults
    deflections: Deflections
    lateral: LateralCases
    criteria: tuple[RuleCheck, ...]
    notes: tuple[str, ...]

    @property
    def passed(self) -> bool:
        """True if all checks and rules are met."""
        return not bool((self.members.utilisation > 1.0).any()) and all(
            rule.passed is not False for rule in self.criteria
        )


def elastic_design(building: Building, progress: Callable[[str], None] = lambda stage: None) -> ElasticDesign:
    """Analyse a building and check it.

    Args:
        building: from `load_building`, with the blocks `hazard`, `masses` and `design`.
        progress: called with the name of each stage at its beginning.

    Raises:
        InputError: a block is missing, a behaviour factor or a mode is out of its range, a section is of class 4 under
            its forces, or the structure is a mechanism.
    """
    found = ElasticAnalysis(building, progress).design()
    if found.members.slender:
        member = found.frame.members[found.members.slender[0]]
        place = building.where(*keys_of_member(building, member.name), "section")
        raise InputError(
            f"{place}: {member.name}: {member.section} of {member.material} is of class 4 under its forces, "
            "and effective sections (EN 1993-1-5) are not in the checks; choose a section of class "
            f"{LARGEST_CLASS} or less [E-EC3-03]"
        )
    return found


class ElasticAnalysis:
    """The elastic design of a building with the sections of its file, or with others in the same places.

    What sections do not change is prepared once: places of members, loads but the self weight, spectra, combinations,
    and the symbolic analysis of the stiffness.

    Args:
        building: from `load_building`, with the blocks `hazard`, `masses` and `design`.
        progress: called with the name of each stage at its beginning.

    Attributes:
        frame: with the sections of the file; load cases as `space_frame` gives them.
        regular: whether the building counts as regular, with the sections of the file.
        q: behaviour factors, with the sections of the file.
        q_limit: their upper limits, Table 6.2.
        dissipative: numbers of the dissipative members of both directions.
        bracing: what braces bring to columns and beams.
        supports: of the frame.
        members: checks of the members.
        fundamental, seismic, yielded, vertical: combinations of actions; `yielded` of beams beside buckled braces,
            `vertical` of members that the vertical component concerns.

    Raises:
        InputError: a block is missing, a behaviour factor is out of its range, a direction has nothing that dissipates
            energy, a steel has no values by thickness, or the structure is a mechanism.
    """

    def __init__(self, building: Building, progress: Callable[[str], None] = lambda stage: None) -> None:
        self.building, self._progress = building, progress
        self._material = {run.group: run.material for run in building.columns}
        self._material |= {run.group: run.material for run in building.beams}
        self._material |= {run.group: run.material for run in building.braces}
        building = building.model_copy(update={"dampers": None})  # beams that they would meet are whole, too
        self._made = building = with_steel_by_thickness(building)
        self._design = design_of(building)
        hazard = _hazard(building)
        self._national, self._rules = national_of(hazard), rules_of(self._design)
        self._class_of_use = hazard.class_of_use if isinstance(hazard, NtcHazard) else ""
        progress("members, loads and masses")
        self.frame = space_frame(building, design=True)
        if not self.frame.node_mass.any():
            raise InputError(
                f"{building.where('masses')}: masses: the seismic action needs masses; "
                "docs/reference/building_file.md explains them [E-KEY-02]"
            )
        progress(f"stiffness of {len(self.frame.members)} members")
        with telling_member(self.building):
            self._models = [space_model(self.frame, building.materials, gravity) for gravity in (False, True)]
        self._properties = [member_properties(self.frame, building.materials, gravity) for gravity in (False, True)]
        system = {axis: system_of(self._design, axis) for axis in AXES}
        self._shape = shape(building, self.frame)
        self.regular, _ = regularity(building, self.frame, self._models[0], self._shape)
        self.q, self.q_limit = self._behaviour_factors(self.regular)
        self.dissipative = {axis: dissipative_members(self.frame, axis, system[axis].type) for axis in AXES}
        self._refuse()
        self.bracing = bracing(self.frame)
        self._single = single_diagonals(self.frame, self.bracing)
        self.supports = supports(self.frame, self.bracing)
        self._bases = {axis: hinged_bases(self.frame, axis) for axis in AXES}
        level = building.design_level or None
        self._elastic = elastic_spectrum(hazard, level)
        self._damage, self._capping = self._of_serviceability(hazard)
        vertical = vertical_spectrum(hazard, level)
        self._vertical = vertical_component(self.frame, vertical, self._national.beta, self._rules.vertical)  # type: ignore[arg-type]
        concerned = self._vertical.members if self._vertical else np.zeros(0, dtype=int)
        self.members = MemberChecker(building, self.frame, self.dissipative, self.bracing, concerned)
        self._sway = SwayAnalysis(self.frame, self._design.imperfections == "sway")
        joined = with_joined_cases(self.frame).cases
        cases = {name: case.category for name, case in joined.items()}
        psi = psi_of(building, self._national)
        directions = "srss" if self._design.directions == "srss" else "30 %"
        asked, factors = self._design.fundamental, action_factors_of(self._design, self._national)
        partly = relieving_cases(joined), patterns_of(joined, building.loads.pattern)
        apart = [name for name in cases if name == NON_STRUCTURAL]
        with telling_place(building, "loads"):
            self.fundamental = fundamental(cases, psi, factors, asked.expression, asked.favourable, *partly, apart)
        self.fundamental += stated_combinations(self._design, joined)
        self.seismic = seismic(cases, psi, directions, relieving=partly[0])
        self._characteristic = characteristic(cases, psi, False, *partly)
        self.yielded = yielded_combinations(self.seismic[0], self.bracing, self._design)
        self.vertical = (
            vertical_combinations(seismic(cases, psi, directions, True, partly[0])) if self._vertical else ()
        )
        wanted = building.loads.live_load_reduction
        self._reduction = LiveLoadReduction(building, self.frame, joined, psi) if wanted else None
        self._deflections = DeflectionAnalysis(self.frame, joined, ALWAYS, self._characteristic)
        self._groups: dict[str, list[int]] = {}
        for number, member in enumerate(self.frame.members):
            self._groups.setdefault(member.group, []).append(number)
        self._variants: dict[tuple[str, str], list[Member]] = {}

    def _refuse(self) -> None:
        """Refuse a system of which the building has nothing."""
        for axis in AXES:
            kind = system_of(self._design, axis).type
            if not self.dissipative[axis].size:
                what = "beam along it has a stiff end" if kind == MOMENT_FRAME else "bay along it is braced"
                what = "brace along it has a `link`" if kind == ECCENTRIC else what
                where = self.building.where("design", "systems", axis, "type")
                raise InputError(f"{where}: design.systems.{axis}.type: `{kind}`, but no {what} [E-SPACE-03]")
            without = np.intersect1d(self.dissipative[axis], self.frame.unclassified)
            if without.size:
                member = self.frame.members[without[0]]
                place = self.building.where(*keys_of_member(self.building, member.name), "section")
                raise InputError(
                    f"{place}: {member.name} dissipates energy along {axis}, and its section {member.section} has no "
                    "class and no plastic resistance; give it plates or a profile, or leave `design` out [E-SPACE-10]"
                )

    def _behaviour_factors(self, regular: Regular) -> tuple[dict[Axis, float], dict[Axis, float]]:
        """Return q of both directions, and their upper limits."""
        system, low = {axis: system_of(self._design, axis) for axis in AXES}, self._national.low_ductility_q
        limit = {axis: largest_q(self.building, system[axis], axis, low, regular) for axis in AXES}
        return {axis: limit[axis] if (q := system[axis].q) == "table" else float(q) for axis in AXES}, limit

    def steel_mass(self) -> float:
        """Return the mass of the members of the file, kg."""
        pairs, of_members = self.frame.sections
        metre = [self.frame.section(name).A * self._made.materials[steel].density for name, steel in pairs]
        return float(np.array(metre)[of_members] @ self.frame.length)

    def steel_of(self, group: str, section: str) -> tuple[str, Steel]:
        """Return the steel of a section in a group, and its name.

        Args:
            group: of members.

        Returns:
            Name of the steel, and the steel.

        Raises:
            InputError: with yield strengths by thickness the section is thicker than the standard knows.
        """
        return steel_by_thickness(self.building, section, self._material[group])

    def frame_with(self, sections: Mapping[str, str]) -> SpaceFrame:
        """Return the frame with other sections, and the self weight and masses that follow from them.

        Args:
            sections: section of each group; groups without one keep theirs.

        Raises:
            InputError: a section is not known, or too thick for its steel.
        """
        frame, members = self.frame, list(self.frame.members)
        for name, numbers in self._groups.items():
            wanted = sections.get(name)
            if wanted is not None and wanted != frame.members[numbers[0]].section:
                if (name, wanted) not in self._variants:
                    material, steel = self.steel_of(name, wanted)
                    self._made.materials.setdefault(material, steel)
                    factor = self._slab_factor(name, wanted)
                    self._variants[name, wanted] = [
                        replace(
                            of,
                            section=wanted,
                            material=material,
                            stiffness_factor=of.stiffness_factor if factor is None else factor,
                        )
                        for of in (frame.members[k] for k in numbers)
                    ]
                for number, member in zip(numbers, self._variants[name, wanted], strict=True):
                    members[number] = member
        found = frame.with_sections(tuple(members), frame.cases, frame.node_mass)
        if SELF_WEIGHT not in frame.cases:
            return found
        cases = frame.cases | {SELF_WEIGHT: self_weight(self._made, found)}
        found = found.with_sections(found.members, cases, frame.node_mass)
        return found.with_sections(found.members, cases, node_masses(self._made, found))

    def _slab_factor(self, group: str, section: str) -> float | None:
        """Return the factor on E I that a slab makes with a section in a group; None where it has no slab."""
        for number, run in enumerate(self.building.beams):
            if run.group == group and run.slab is not None:
                return stiffness_factor(self.building, number, run, section)
        return None

    def design(self, sections: Mapping[str, str] | None = None) -> ElasticDesign:
        """Analyse the building and check it.

        Args:
            sections: section of each group; those of the file for groups without one. With any, `building` of the
                result has still those of the file.

        Returns:
            The design; members of class 4, which the checks do not cover, are in `members.slender`.

        Raises:
            InputError: a section is not known, modes that SRSS needs apart are close, or results are not finite.
        """
        with telling_member(self.building):
            return self._designed(sections)

    def _designed(self, sections: Mapping[str, str] | None) -> ElasticDesign:
        building, design = self._made, self._design
        frame = self.frame_with(sections) if sections else self.frame
        model, gravity_model = self._with_sections(frame)
        frame = with_joined_cases(frame)
        regular, of_regularity = regularity(building, frame, model, self._shape)
        q, q_limit = self._behaviour_factors(regular)
        self._progress("natural modes")
        modes = every = model.modes(frame.node_mass)
        if design.modes != "auto":
            modes = _first(modes, design.modes, building)
        self._progress("effects of the actions")
        static = static_effects(gravity_model, model, frame, self.bracing, self.supports)
        analysis = ResponseSpectrumAnalysis(model, frame, self._capping, design, self.bracing, self.supports)
        with telling_place(building, "design", "combination"):
            response = {axis: analysis.response(modes, axis, self._design_spectrum(q[axis])) for axis in AXES}
        height = np.array(building.storey_heights)
        gravity = gravity_above(frame, self.seismic[0].static)
        of_storeys = {axis: storeys(response[axis], height, gravity, design, self._class_of_use) for axis in AXES}
        sway = self._sway.stability(model, frame, every, static, self.fundamental)
        acting, persistent = sway.added(effects(frame, static, response, of_storeys)), sway.rows
        if self._reduction is not None:
            acting, persistent = self._reduction.added(acting), self._reduction.rows(persistent)
        acting = self._with_local_actions(acting, building, frame, gravity_model)
        in_earthquakes = largest(acting, self.seismic)
        steel, gamma_M0 = building.materials, design.partial_factors.M0
        kind = {axis: system_of(design, axis).type for axis in AXES}
        of_links = {
            axis: links(
                self.building,
                frame,
                steel,
                in_earthquakes,
                self.dissipative[axis],
                of_storeys[axis],
                response[axis].drift,
            )
            for axis in AXES
            if kind[axis] == ECCENTRIC
        }
        Omega = {
            axis: overstrength_of_links(of_links[axis], self.dissipative[axis], axis)
            if axis in of_links
            else overstrength(
                frame,
                steel,
                in_earthquakes,
                self.dissipative[axis],
                axis,
                kind[axis],
                gamma_M0,
                (acting, self.seismic) if self._rules.gravity_apart else None,
            )
            for axis in AXES
        }
        self._progress("checks of the members")
        most = {axis: q[axis] / self._q_ND(axis, regular) if self._class_of_use else q[axis] for axis in AXES}
        combinations = persistent, self.seismic, Omega, most, self.yielded, self.vertical
        checked = self.members.results(frame, acting, *combinations)
        of_joints = {
            axis: joints(frame, steel, in_earthquakes, self.dissipative[axis], axis, gamma_M0)
            for axis in AXES
            if kind[axis] == MOMENT_FRAME
        }
        deflections = self._deflections.deflections(frame, self._properties[1], static)
        factors = foundation_factors(building, frame, self.supports, in_earthquakes, Omega, q)
        whole = bool(self._rules.foundations)
        found = foundations(
            frame, self.supports, static, response, of_storeys, self.seismic, self.fundamental, *factors, whole
        )
        of_panels = {
            axis: web_panels(
                frame,
                steel,
                acting.seismic[number],
                self.dissipative[axis],
                Omega[axis].Omega,
                axis,
                gamma_M0,
            )
            for number, axis in enumerate(AXES)
            if axis in of_joints
        }
        criteria = [*modal_criteria(modes, self._rules), *of_regularity]
        criteria += sway_criteria(sway, design.imperfections == "sway")
        for axis in AXES:
            criteria += behaviour_criteria(building, frame, q, q_limit, axis, self.dissipative[axis], regular)
            criteria += storey_criteria(of_storeys[axis], self._limited_drift())
            criteria += self._strength_under_damage(response[axis], regular)
            if self._design.ductility_class == "low":
                continue  # no capacity design (EN 1998-1, 6.1.2(4))
            if axis in of_joints:
                highest = allowed_class(design, q[axis], q_limit[axis], regular)
                criteria += connection_criteria(design, axis, q[axis])
                criteria += joint_criteria(of_joints[axis], axis)
                criteria += base_criteria(
                    frame,
                    steel,
                    acting,
                    checked.amplified,
                    self._bases[axis],
                    axis,
                    highest,
                    gamma_M0,
                    self._rules.base_axial,
                )
                criteria += panel_criteria(of_panels[axis], len(of_joints[axis]), axis, design.members.doubler_plates)
            elif axis in of_links:
                criteria += link_criteria(of_links[axis], design.overstrength)
            else:
                criteria += bracing_criteria(building, frame, Omega[axis])
        names = [member.name for member in frame.members]
        criteria += deflection_criteria(deflections, design.serviceability.beams, names)
        criteria += secondary_criteria(building, self.fundamental, self._characteristic)
        lateral = lateral_cases(frame, static, self._characteristic)
        criteria += sway_limits(lateral, design.serviceability.sway, self._characteristic)
        return ElasticDesign(
            building=building,
            frame=frame,
            modes=modes,
            static=static,
            response=response,
            storeys=of_storeys,
            sway=sway,
            effects=acting,
            combinations=tuple(map(self._rules.combination, (*checked.rows, *self._characteristic))),
            regular=regular,
            q=q,
            overstrength=Omega,
            members=checked,
            deflections=deflections,
            lateral=lateral,
            joints=tuple(joint for of_axis in of_joints.values() for joint in of_axis),
            panels=tuple(panel for of_axis in of_panels.values() for panel in of_axis),
            links=tuple(link for of_axis in of_links.values() for link in of_axis),
            foundations=found,
            criteria=tuple(map(self._rules.rule, criteria)),
            notes=tuple(
                map(
                    self._rules.told,
                    (
                        *_notes(response, of_storeys, bool(self._class_of_use)),
                        *sway_notes(sway),
                        *found.uplift,
                        *self._limits(frame),
                        *_without_dampers(self.building),
                    ),
                )
            ),
        )

    def _of_serviceability(
        self, hazard: EC8Hazard | NtcHazard
    ) -> tuple[NtcSpectrum | None, ElasticSpectrum | NtcSpectrum | NtcDesignSpectrum]:
        """Return the elastic spectrum of SLD, if any, and the one of the drifts that count beside those of the design.

        By EN 1998-1 these are the elastic drifts of the design level. By NTC 2018, 7.3.6.1, those of SLD with q = 1, or
        of SLO, whose design spectrum is the elastic one (3.2.3.4).
        """
        if not isinstance(hazard, NtcHazard):
            return None, self._elastic  # type: ignore[return-value]
        of_state = {
            state: elastic_spectrum(hazard, level)
            for state in ("SLO", "SLD")
            if (level := self._made.level_of_limit_state(state)) is not None
        }
        damage: NtcSpectrum | None = of_state.get("SLD")  # type: ignore[assignment]
        if self._design.drift.limit == "none":
            return damage, self._elastic  # type: ignore[return-value]
        state = limit_state_of_drift(hazard.class_of_use)
        return damage, NtcDesignSpectrum(of_state[state], 1.0) if state == "SLD" else of_state[state]  # type: ignore[arg-type,return-value]

    def _design_spectrum(self, q: float) -> AnyDesignSpectrum:
        """Return S_d of the code for a behaviour factor."""
        if isinstance(self._elastic, NtcSpectrum):
            return NtcDesignSpectrum(self._elastic, q, beta=self._national.beta)
        return DesignSpectrum.of(self._elastic, q, self._national.beta)  # type: ignore[arg-type]

    def _limited_drift(self) -> str:
        """Return what the code calls the drift that it limits."""
        return f"q d_r / h under {limit_state_of_drift(self._class_of_use)}" if self._class_of_use else "nu d_r / h"

    def _q_ND(self, axis: Axis, regular: Regular) -> float:
        """Return q of NTC 2018, Eq. 7.3.2, if the building did not dissipate energy."""
        return limit_of_q(system_of(self._design, axis).type, "low", 1.0, regular.elevation)

    def _strength_under_damage(self, response: SeismicResponse, regular: Regular) -> list[RuleCheck]:
        """Return whether members that resist SLV resist SLD as well, which classes of use III and IV ask for.

        Source: NTC 2018, Table 7.3.III and 7.3.1, Table 7.3.I; Circolare 7/2019, C7.3.1.
        """
        if self._damage is None:
            return []
        axis, T_1 = response.axis, response.T_1
        q_ND = self._q_ND(axis, regular)
        SLV, SLD = (float(of.acceleration(T_1)) for of in (self._elastic, self._damage))
        text = f"q up to which strength under SLV is strength under SLD, direction {axis}"
        rule = at_most("NTC 2018, C7.3.1", text, limit_of_q_for_damage(q_ND, SLV, SLD), response.spectrum.q)
        asked = self._class_of_use in ("III", "IV")
        detail = f"q_ND = {q_ND:.3g}, T_1 = {T_1:.3g} s"
        return [replace(rule, detail=detail) if asked else replace(rule, passed=None, detail=f"{detail}; informs")]

    def _with_local_actions(
        self, acting: Effects, building: Building, frame: SpaceFrame, gravity_model: SpaceModel
    ) -> Effects:
        """Return the effects with static cases of buckled braces and of the vertical component, where they count."""
        if self.yielded:
            gamma_pb = self._national.gamma_pb
            acting = with_yielded_braces(acting, gravity_model, frame, self.bracing, building, gamma_pb)
        if self._single.any() and self._design.ductility_class != "low":
            acting = with_buckled_diagonals(acting, frame, self.bracing, self._single, building)
        return self._vertical.with_case(acting, self.seismic[0]) if self._vertical else acting

    def _limits(self, frame: SpaceFrame) -> list[str]:
        """Return what the analysis adds to this building or leaves out of it, a sentence each."""
        found = [text for _, text in unusual(self.building)]
        if frame.unclassified.size:
            names = listed([frame.members[number].name for number in frame.unclassified], 3)
            sections = listed(dict.fromkeys(frame.members[number].section for number in frame.unclassified))
            found.append(
                f"{names} are not checked by EN 1993-1-1 and EN 1998-1: sections {sections} have no class; their "
                "forces are in the archive"
            )
        found += [self._vertical.note] if self._vertical else []
        found += [LIVE_LOADS_REDUCED] if self._reduction is not None else []
        if stiffer := [member.name for member in frame.members if member.stiffness_factor != 1.0]:
            found.append(
                f"E I of {listed(stiffer, 3)} is multiplied by their `stiffness_factor`; their resistance is that of "
                "the steel section alone"
            )
        psi = psi_of(self.building, self._national)
        if lasting := [name for name, case in frame.cases.items() if case.own and psi[case.category].psi_2 > 0.0]:
            found.append(
                f"own load cases act with psi_2 beside the seismic action, and bring no masses, which stand under "
                f"`masses.added`: {listed(lasting)}"
            )
        weight = float(frame.node_mass.sum()) * STANDARD_GRAVITY
        loads = float(gravity_above(frame, self.seismic[0].static)[0])
        if weight > loads * (1.0 + ROUNDING):  # masses from loads weigh at most as much as these
            found.append(
                f"the masses weigh {weight / 1e3:.0f} kN and the loads beside the seismic action only "
                f"{loads / 1e3:.0f} kN; P and theta are those of the loads"
            )
        if self._design.accidental_torsion and not frame.diaphragms:
            found.append("accidental torsion is left out: no floor is rigid, and its moments act on rigid floors")
        return found

    def _with_sections(self, frame: SpaceFrame) -> list[SpaceModel]:
        """Return the models for earthquakes and for gravity with the sections of a frame."""
        for number, model in enumerate(self._models):
            properties = member_properties(frame, self._made.materials, gravity=number == 1)
            if (changed := np.flatnonzero((properties != self._properties[number]).any(axis=1))).size:
                model.change_sections(changed, properties[changed])
                self._properties[number] = properties
        return self._models


def _first(modes: SpaceModes, count: int, building: Building) -> SpaceModes:
    """Return the first modes; with some mass in both directions, or there is nothing to design for."""
    there = modes.period.size
    if count > there:
        raise InputError(
            f"{building.where('design', 'modes')}: design.modes: {count} modes, the building has {there} [E-SPACE-02]"
        )
    mass = modes.effective_mass_ratio[:count, :2].sum(axis=0)
    if mass.min() < LARGE_MODE:
        sums = ", ".join(f"{share:.1%} along {axis}" for axis, share in zip(AXES, mass, strict=True))
        raise InputError(
            f"{building.where('design', 'modes')}: design.modes: the first {count} modes have {sums} of the mass; take "
            "more, or `auto` [E-SPACE-02]"
        )
    return replace(modes, **{field.name: getattr(modes, field.name)[:count] for field in fields(modes)})


def _hazard(building: Building) -> EC8Hazard | NtcHazard:
    if building.hazard is None:
        raise InputError(
            f"{building.where('hazard')}: hazard: this block is missing; docs/reference/building_file.md explains it"
            " [E-KEY-02]"
        )
    checked_hazard(building)
    assert building.design_hazard is not None, "check_design wants it"
    return building.design_hazard


def _without_dampers(building: Building) -> list[str]:
    """What the elastic design leaves out."""
    there = building.dampers is not None and not building.dampers.none
    return ["the elastic design is that of the building without its dampers"] if there else []


def _notes(
    response: Mapping[Axis, SeismicResponse], of_storeys: Mapping[Axis, Storeys], by_ntc: bool = False
) -> list[str]:
    found = []
    if by_ntc:
        found.append(
            "gamma_G of all permanent loads is that of G_1: those that are not structural are taken as well defined "
            "(NTC 2018, Table 2.6.I, note 1); otherwise give `partial_factors: {G: 1.5}`"
        )
        found.append(
            "capacity over demand of adjacent storeys is not compared (NTC 2018, 7.2.1 f); where it differs by more "
            "than 30 %, give `regular_in_elevation: false`"
        )
    for axis in AXES:
        of = response[axis]
        if round(of.base_shear / 1e3) > round(of.base_shear_without_beta / 1e3):
            found.append(
                f"beta = {of.spectrum.beta:g} governs the base shear along {axis}: {of.base_shear / 1e3:.0f} kN, "
                f"without it {of.base_shear_without_beta / 1e3:.0f} kN (EN 1998-1, 3.2.2.5(4)P)"
            )
        table = of_storeys[axis]
        if (
            not by_ntc
            and table.theta_q.max() > NEGLIGIBLE
            and round(table.theta_q.max(), 2) > round(table.theta.max(), 2)
        ):
            found.append(
                f"theta along {axis} is up to {table.theta_q.max():.2f} with q d_e and {table.theta.max():.2f} with "
                "the cap of the elastic spectrum (EN 1998-1, 4.3.4(3))"
            )
    return found
