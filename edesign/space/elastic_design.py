"""The elastic design of a building: analysis, combinations of actions, and all checks, from one building file."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import fields, replace

import numpy as np

from edesign.codes.ec8.analysis.modal_combination import LARGE_MODE
from edesign.core.space import SpaceModel
from edesign.core.space_modes import SpaceModes
from edesign.errors import InputError
from edesign.ground_motion.hazard import national_of, vertical_spectrum
from edesign.project.actions.hazard import NtcHazard
from edesign.project.building.building import Building
from edesign.space.analysis.actions import psi_of, with_joined_cases
from edesign.space.analysis.bracing import bracing
from edesign.space.analysis.buckled_diagonals import single_diagonals, with_buckled_diagonals
from edesign.space.analysis.combinations import building_combinations
from edesign.space.analysis.deflections import DeflectionAnalysis
from edesign.space.analysis.design_spectra import design_spectra, hazard_of
from edesign.space.analysis.effects import Effects, effects, largest
from edesign.space.analysis.lateral import lateral_cases, static_effects
from edesign.space.analysis.live_load_reduction import LiveLoadReduction
from edesign.space.analysis.response import ResponseSpectrumAnalysis, gravity_above
from edesign.space.analysis.storeys import storeys
from edesign.space.analysis.sway import SwayAnalysis
from edesign.space.analysis.vertical_component import vertical_component
from edesign.space.analysis.yielded_braces import with_restrained_braces, with_yielded_braces
from edesign.space.building_criteria import building_criteria, q_without_dissipation
from edesign.space.checks.capacity import dissipative_members, joints, overstrength
from edesign.space.checks.column_bases import hinged_bases
from edesign.space.checks.foundations import foundation_factors, foundations, supports
from edesign.space.checks.links import beside_links, links, overstrength_of_links
from edesign.space.checks.member_checks import LARGEST_CLASS, MemberChecker
from edesign.space.checks.regularity import regularity, shape
from edesign.space.checks.restrained_braces import hardening_of
from edesign.space.checks.rules import largest_q
from edesign.space.checks.web_panels import web_panels
from edesign.space.design_notes import design_notes
from edesign.space.designed import ElasticDesign
from edesign.space.file_places import keys_of_member, telling_member, telling_place
from edesign.space.structure.design_block import ECCENTRIC, MOMENT_FRAME, Regular, design_of, rules_of, system_of
from edesign.space.structure.frame import AXES, Axis, SpaceFrame
from edesign.space.structure.geometry import space_frame
from edesign.space.structure.load_cases import ALWAYS
from edesign.space.structure.model import member_properties, space_model
from edesign.space.structure.other_sections import OtherSections
from edesign.space.structure.restrained import RestrainedBraces, laws_of_groups, restrained_braces
from edesign.space.structure.steel_by_thickness import with_steel_by_thickness


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
        combinations: of actions.
        sections: the frame with other sections in the same places.

    Raises:
        InputError: a block is missing, a behaviour factor is out of its range, a direction has nothing that dissipates
            energy, a steel has no values by thickness, or the structure is a mechanism.
    """

    def __init__(self, building: Building, progress: Callable[[str], None] = lambda stage: None) -> None:
        self.building, self._progress = building, progress
        if (dampers := building.dampers) is not None:  # beams that they would meet are whole, too; laws stay
            none = dampers.model_copy(update={"devices": (), "attachments": (), "isolation": None})
            building = building.model_copy(update={"dampers": none})
        self._made = building = with_steel_by_thickness(building)
        self._design = design_of(building)
        hazard = hazard_of(building)
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
        self._laws = laws_of_groups(building)
        self._single = single_diagonals(self.frame, self.bracing)
        self.supports = supports(self.frame, self.bracing)
        self._bases = {axis: hinged_bases(self.frame, axis) for axis in AXES}
        self._spectra = design_spectra(building, self._design, hazard, self._national.beta)
        vertical = vertical_spectrum(hazard, building.design_level or None)
        self._vertical = vertical_component(self.frame, vertical, self._national.beta, self._rules.vertical)  # type: ignore[arg-type]
        concerned = self._vertical.members if self._vertical else np.zeros(0, dtype=int)
        self.members = MemberChecker(building, self.frame, self.dissipative, self.bracing, concerned)
        self._sway = SwayAnalysis(self.frame, self._design.imperfections == "sway")
        joined = with_joined_cases(self.frame).cases
        restrained = restrained_braces(self.frame, self._laws).numbers.tolist()
        self.combinations = building_combinations(
            building, self._design, self._national, joined, self.bracing, self._vertical is not None, restrained
        )
        psi = psi_of(building, self._national)
        wanted = building.loads.live_load_reduction
        self._reduction = LiveLoadReduction(building, self.frame, joined, psi) if wanted else None
        self._deflections = DeflectionAnalysis(self.frame, joined, ALWAYS, self.combinations.characteristic)
        self.sections = OtherSections(self.building, building, self.frame)

    def _refuse(self) -> None:
        """Refuse a system of which the building has nothing."""
        for axis in AXES:
            kind = system_of(self._design, axis).type
            if not self.dissipative[axis].size:
                what = "beam along it has a stiff end" if kind == MOMENT_FRAME else "bay along it is braced"
                what = "brace along it has a `link`" if kind == ECCENTRIC else what
                where = self.building.where("design", "systems", axis, "type")
                raise InputError(f"{where}: design.systems.{axis}.type: `{kind}`, but no {what} [E-SPACE-03]")
            riveted = [n for n in self.dissipative[axis] if self.frame.section(self.frame.members[n].section).parts]
            if riveted and self._design.ductility_class != "low":
                member = self.frame.members[riveted[0]]
                place = self.building.where(*keys_of_member(self.building, member.name), "section")
                raise InputError(
                    f"{place}: {member.name} dissipates energy along {axis}, and its section {member.section} is "
                    "riveted, whose rivets no rule here makes ductile; take `ductility_class: low` [E-SPACE-10]"
                )
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

    def design(self, sections: Mapping[str, str] | None = None, least_sway: bool = False) -> ElasticDesign:
        """Analyse the building and check it.

        Args:
            sections: section of each group; those of the file for groups without one. With any, `building` of the
                result has still those of the file.
            least_sway: whether one alpha_cr, below that of each combination, stands for all where it is above 10; all
                checks are the same then.

        Returns:
            The design; members of class 4, which the checks do not cover, are in `members.slender`.

        Raises:
            InputError: a section is not known, modes that SRSS needs apart are close, or results are not finite.
        """
        with telling_member(self.building):
            return self._designed(sections, least_sway)

    def _designed(self, sections: Mapping[str, str] | None, least_sway: bool) -> ElasticDesign:
        building, design, rows = self._made, self._design, self.combinations
        frame = self.sections.frame_with(sections) if sections else self.frame
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
        analysis = ResponseSpectrumAnalysis(model, frame, self._spectra.of_drifts, design, self.bracing, self.supports)
        with telling_place(building, "design", "combination"):
            response = {axis: analysis.response(modes, axis, self._spectra.reduced(q[axis])) for axis in AXES}
        height = np.array(building.storey_heights)
        gravity = gravity_above(frame, rows.seismic[0].static)
        of_storeys = {axis: storeys(response[axis], height, gravity, design, self._class_of_use) for axis in AXES}
        sway = self._sway.stability(model, frame, every, static, rows.fundamental, least_sway)
        acting, persistent = sway.added(effects(frame, static, response, of_storeys)), sway.rows
        if self._reduction is not None:
            acting, persistent = self._reduction.added(acting), self._reduction.rows(persistent)
        restrained = restrained_braces(frame, self._laws)
        acting = self._with_local_actions(acting, building, frame, gravity_model, restrained)
        in_earthquakes = largest(acting, rows.seismic)
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
                (acting, rows.seismic) if self._rules.gravity_apart else None,
            )
            for axis in AXES
        }
        Omega = {axis: replace(of, hardening=hardening_of(restrained, of.members)) for axis, of in Omega.items()}
        self._progress("checks of the members")
        most = {
            axis: q[axis] / q_without_dissipation(kind[axis], regular) if self._class_of_use else q[axis]
            for axis in AXES
        }
        combinations = persistent, rows.seismic, Omega, most, rows.yielded, rows.vertical
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
            frame, self.supports, static, response, of_storeys, rows.seismic, rows.fundamental, *factors, whole
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
        lateral = lateral_cases(frame, static, rows.characteristic)
        designed = ElasticDesign(
            building=building,
            frame=frame,
            modes=modes,
            static=static,
            response=response,
            storeys=of_storeys,
            sway=sway,
            effects=acting,
            combinations=tuple(map(self._rules.combination, (*checked.rows, *rows.characteristic))),
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
            criteria=(),
            notes=(),
        )
        criteria = building_criteria(
            designed,
            of_regularity,
            self._spectra,
            self.combinations,
            self._class_of_use,
            q_limit,
            self.dissipative,
            self._bases,
        )
        by_ntc = bool(self._class_of_use)
        notes = design_notes(designed, self.building, self._national, rows.seismic[0], self._vertical, by_ntc)
        notes += [text for axis in of_links for text in beside_links(of_links[axis], design, most[axis])]
        return replace(
            designed,
            criteria=tuple(map(self._rules.rule, criteria)),
            notes=tuple(map(self._rules.told, notes)),
        )

    def _with_local_actions(
        self,
        acting: Effects,
        building: Building,
        frame: SpaceFrame,
        gravity_model: SpaceModel,
        restrained: RestrainedBraces,
    ) -> Effects:
        """Return the effects with static cases of braces that yield and of the vertical component, where they count."""
        if self.combinations.yielded:
            of = frame, self.bracing, building, self._national.gamma_pb, restrained.numbers.tolist()
            acting = with_yielded_braces(acting, gravity_model, *of)
        if restrained.numbers.size:
            acting = with_restrained_braces(acting, gravity_model, frame, self.bracing, restrained)
        if self._single.any() and self._design.ductility_class != "low":
            acting = with_buckled_diagonals(acting, frame, self.bracing, self._single, building)
        return self._vertical.with_case(acting, self.combinations.seismic[0]) if self._vertical else acting

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
