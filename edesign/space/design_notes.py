"""What an engineer should know of an elastic design: what it adds to the building, leaves out, and goes by."""

from __future__ import annotations

from edesign.codes.ec8.national import NationalParameters
from edesign.codes.ec8.verification.second_order import NEGLIGIBLE
from edesign.codes.en1990.combinations import Combination
from edesign.codes.rule_check import ROUNDING
from edesign.frame.sections.channels import packing_distance
from edesign.frame.sections.riveted import NOTE
from edesign.project.building.building import Building
from edesign.project.building.checks.plausible import unusual
from edesign.project.notation.units import STANDARD_GRAVITY
from edesign.project.reading.problems import listed
from edesign.space.analysis.actions import psi_of
from edesign.space.analysis.live_load_reduction import NOTE as LIVE_LOADS_REDUCED
from edesign.space.analysis.response import gravity_above
from edesign.space.analysis.sway import sway_notes
from edesign.space.analysis.vertical_component import VerticalComponent
from edesign.space.designed import ElasticDesign
from edesign.space.structure.design_block import design_of
from edesign.space.structure.frame import AXES


def design_notes(
    found: ElasticDesign,
    building: Building,
    national: NationalParameters,
    seismic: Combination,
    vertical: VerticalComponent | None,
    by_ntc: bool,
) -> list[str]:
    """Return what an engineer should know of an elastic design, a sentence each.

    Args:
        building: as its file says.
        seismic: a seismic combination, for the loads beside the seismic action.
        by_ntc: whether the code is NTC 2018.
    """
    return [
        *_of_response(found, by_ntc),
        *sway_notes(found.sway),
        *found.foundations.uplift,
        *_limits(found, building, national, seismic, vertical),
        *_without_dampers(building),
    ]


def _limits(
    found: ElasticDesign,
    building: Building,
    national: NationalParameters,
    seismic: Combination,
    vertical: VerticalComponent | None,
) -> list[str]:
    """Return what the analysis adds to this building or leaves out of it."""
    frame = found.frame
    notes = [text for _, text in unusual(building)]
    if frame.unclassified.size:
        names = listed([frame.members[number].name for number in frame.unclassified], 3)
        sections = listed(dict.fromkeys(frame.members[number].section for number in frame.unclassified))
        notes.append(
            f"{names} are not checked by EN 1993-1-1 and EN 1998-1: sections {sections} have no class; their "
            "forces are in the archive"
        )
    notes += [vertical.note] if vertical else []
    notes += [LIVE_LOADS_REDUCED] if building.loads.live_load_reduction else []
    if riveted := sorted({name for name, _ in frame.sections[0] if frame.section(name).parts}):
        notes.append(f"{listed(riveted)}: {NOTE}")
    if pairs := sorted({name for name, _ in frame.sections[0] if frame.section(name).kind == "2U"}):
        each = ", ".join(f"{name} every {packing_distance(name):.2f} m" for name in pairs)
        notes.append(f"two channels act as one with packings at most 15 i_min apart: {each} (EN 1993-1-1, 6.4.4)")
    if any(run.law is not None for run in building.braces):
        notes.append(
            "weight, mass and cost of buckling-restrained braces count with their steel cores alone; their casings "
            "stand under `loads` where they matter"
        )
    if stiffer := [of.name for of in frame.members if of.stiffness_factor != 1.0 and not of.axial_only]:
        notes.append(
            f"E I of {listed(stiffer, 3)} is multiplied by their `stiffness_factor`; their resistance is that of "
            "the steel section alone"
        )
    psi = psi_of(building, national)
    if lasting := [name for name, case in frame.cases.items() if case.own and psi[case.category].psi_2 > 0.0]:
        notes.append(
            f"own load cases act with psi_2 beside the seismic action, and bring no masses, which stand under "
            f"`masses.added`: {listed(lasting)}"
        )
    weight = float(frame.node_mass.sum()) * STANDARD_GRAVITY
    loads = float(gravity_above(frame, seismic.static)[0])
    if weight > loads * (1.0 + ROUNDING):  # masses from loads weigh at most as much as these
        notes.append(
            f"the masses weigh {weight / 1e3:.0f} kN and the loads beside the seismic action only "
            f"{loads / 1e3:.0f} kN; P and theta are those of the loads"
        )
    if design_of(building).accidental_torsion and not frame.diaphragms:
        notes.append("accidental torsion is left out: no floor is rigid, and its moments act on rigid floors")
    return notes


def _without_dampers(building: Building) -> list[str]:
    """What the elastic design leaves out."""
    there = building.dampers is not None and not building.dampers.none
    return ["the elastic design is that of the building without its dampers"] if there else []


def _of_response(found: ElasticDesign, by_ntc: bool) -> list[str]:
    """Return what governs the response."""
    notes = []
    if by_ntc:
        notes.append(
            "permanent loads `G` have gamma_G of G_1: what of them is not structural is taken as well defined "
            "(NTC 2018, Table 2.6.I, note 1); otherwise give it as `G2`"
        )
        notes.append(
            "capacity over demand of adjacent storeys is not compared (NTC 2018, 7.2.1 f); where it differs by more "
            "than 30 %, give `regular_in_elevation: false`"
        )
    for axis in AXES:
        of = found.response[axis]
        if round(of.base_shear / 1e3) > round(of.base_shear_without_beta / 1e3):
            notes.append(
                f"beta = {of.spectrum.beta:g} governs the base shear along {axis}: {of.base_shear / 1e3:.0f} kN, "
                f"without it {of.base_shear_without_beta / 1e3:.0f} kN (EN 1998-1, 3.2.2.5(4)P)"
            )
        table = found.storeys[axis]
        if (
            not by_ntc
            and table.theta_q.max() > NEGLIGIBLE
            and round(table.theta_q.max(), 2) > round(table.theta.max(), 2)
        ):
            notes.append(
                f"theta along {axis} is up to {table.theta_q.max():.2f} with q d_e and {table.theta.max():.2f} with "
                "the cap of the elastic spectrum (EN 1998-1, 4.3.4(3))"
            )
    return notes
