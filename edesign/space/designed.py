"""What the elastic design of a building finds: its response and its checks."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

from edesign.codes.en1990.combinations import Combination
from edesign.codes.rule_check import RuleCheck
from edesign.core.space_modes import SpaceModes
from edesign.project.building.building import Building
from edesign.space.analysis.deflections import Deflections
from edesign.space.analysis.effects import Effects
from edesign.space.analysis.lateral import LateralCases
from edesign.space.analysis.response import SeismicResponse, StaticResponse
from edesign.space.analysis.storeys import Storeys
from edesign.space.analysis.sway import SwayStability
from edesign.space.checks.capacity import Joint, Overstrength
from edesign.space.checks.foundations import Foundations
from edesign.space.checks.links import Link
from edesign.space.checks.member_checks import MemberResults
from edesign.space.checks.web_panels import Panel
from edesign.space.structure.design_block import Regular
from edesign.space.structure.frame import Axis, SpaceFrame


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
