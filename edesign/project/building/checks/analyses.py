"""Cross checks of the analyses of a building, and what plane frames have and buildings have not yet."""

from __future__ import annotations

from edesign.project.analysis.analyses import BuildingHistory, BuildingPushover
from edesign.project.analysis.damping import RayleighDamping
from edesign.project.analysis.outputs import FibreOutput, SectionOutput
from edesign.project.analysis.pushover import WAYS, Pushovers
from edesign.project.analysis.shaking import IN_PLACE, eccentricity_of
from edesign.project.building.building import Building
from edesign.project.building.checks.selections import Selections
from edesign.project.building.members import AS_DEVICES, NO_LAW_OF_LINKS, BraceRun, ColumnRun
from edesign.project.checks.analyses import check_shared
from edesign.project.checks.outputs import check_kept, check_member
from edesign.project.checks.pairs import check_pairs
from edesign.project.checks.shaking import check_shaking
from edesign.project.checks.wave_passage import check_wave_passage
from edesign.project.notation.selections import NumberSelection
from edesign.project.reading.problems import Keys, Problems
from edesign.project.records.pairs import InSpace


def check_analyses(building: Building, problems: Problems, files: bool = True) -> None:
    """Check what analyses ask of a building: laws of steels, damping, records, outputs.

    Args:
        building: its members and loads are right.
        files: whether the files of the records must be there.
    """
    for name, steel in building.materials.items():
        for key in steel.without_meaning:
            problems.at_key(("materials", name, key), f"the law `{steel.law}` does not have this key [E-KEY-03]")
    for i, brace in enumerate(building.braces if building.analyses else ()):
        if brace.law is not None:
            problems.at_value(("braces", i), f"{AS_DEVICES} [E-DEVICE-04]")
    check_shared(building, problems, files)
    pairs = {name: record for name, record in building.records.items() if isinstance(record, InSpace)}
    check_pairs(pairs, building.hazard, building.folder, problems, "building file" if files else "")
    for i, analysis in enumerate(building.analyses):
        if isinstance(analysis, BuildingHistory):
            check_shaking(building, problems, ("analyses", i), analysis)
            check_wave_passage(building, problems, ("analyses", i, "wave_passage"), analysis.wave_passage)
    if building.analyses and any(run.link is not None for run in building.braces):
        problems.at_key(("analyses",), f"braces have a `link`, and {NO_LAW_OF_LINKS}; leave one out [E-SPACE-12]")
    _anchors(building, problems)
    check_kept(building, problems)
    check = Selections(building, problems)
    for i, section in enumerate(building.outputs.sections):
        _points(building, problems, check, ("outputs", "sections", i), section)
    for i, fibre in enumerate(building.outputs.fibres):
        keys: Keys = ("outputs", "fibres", i)
        if _points(building, problems, check, keys, fibre) and isinstance(fibre.layers, NumberSelection):
            check.numbers((*keys, "layers"), fibre.layers, "fibre", 8 * building.fibres.half_flange)
    for i, analysis in enumerate(building.analyses):
        if isinstance(analysis, BuildingPushover):
            check_positions(building, problems, ("analyses", i), analysis)


def check_positions(building: Building, problems: Problems, keys: Keys, pushover: BuildingPushover | Pushovers) -> None:
    """Check that positions of masses displace the loads of a push across it, and that there are floors that turn.

    Args:
        building: its members and loads are right.
        problems: of the file that pushes it.
        keys: place of the push there.
        pushover: what that file says.
    """
    axes = dict.fromkeys(WAYS[direction][0] for direction in pushover.directions)
    here = (*keys, "eccentricity")
    for i, position in enumerate(pushover.eccentricity):
        if position in pushover.eccentricity[:i]:
            problems.at_item(here, i, f"`{position}` comes twice [E-NAME-02]")
        across = dict(zip(("y", "x"), eccentricity_of(position, 1.0), strict=True))
        if position != IN_PLACE and (still := [axis for axis in axes if not across[axis]]):
            message = (
                f"`{position}` does not displace the loads of a push along {still[0]}; name a side across it, or one "
                "along both axes as `+x+y` [E-PUSH-04]"
            )
            problems.at_item(here, i, message)
    if all(position == IN_PLACE for position in pushover.eccentricity):
        if pushover.eccentricity_ratio is not None:
            message = "all masses stand in place; name by `eccentricity` where they stand beside it [E-KEY-03]"
            problems.at_key((*keys, "eccentricity_ratio"), message)
        return
    if not building.rigid_floors:
        message = "loads beside the centres of mass turn rigid floors, and no floor is rigid (`diaphragms`) [E-PUSH-04]"
        problems.at_key(here, message)
    if not building.accidental_torsion and pushover.eccentricity_ratio is None:
        message = "this key is missing, as `design.accidental_torsion` is `none` [E-KEY-02]"
        problems.under(keys, "eccentricity_ratio", message)


def _anchors(building: Building, problems: Problems) -> None:
    """Modes 1 and 2 of a building are mostly x and y at nearly one frequency, at which no two anchors can stand."""
    damping = building.damping
    if isinstance(damping, RayleighDamping) and damping.periods is None and "modes" not in damping.model_fields_set:
        message = "modes 1 and 2 of a building are often those along x and y, with nearly one period"
        problems.under(("damping",), "modes", f"this key is missing, or `periods`: {message} [E-KEY-02]")


def _points(
    building: Building, problems: Problems, check: Selections, keys: Keys, asked: SectionOutput | FibreOutput
) -> bool:
    """The member exists and has sections; those of columns are counted, beams have more of them between loads."""
    if not check_member(building, problems, (*keys, "member"), asked.member):
        return False
    run = building.grid.members[asked.member]
    if isinstance(run, BraceRun):
        message = f"`{asked.member}` is a brace; a brace has no section points, only an axial force [E-HIST-04]"
        problems.at_value((*keys, "member"), message)
        return False
    last = building.elements.integration_points
    return not isinstance(run, ColumnRun) or check.numbers((*keys, "points"), asked.points, "point", last)
