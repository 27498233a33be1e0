"""What analyses record of braces that buckle."""

from __future__ import annotations

import math

import numpy as np

from edesign.archive.dataset import Group
from edesign.frame.frame_model import FrameModel, Member
from edesign.study.results.recording import Quantity, Terms, coordinate
from edesign.study.results.warnings import AnalysisWarning

BRACE = "buckling_brace"
RECORDED = "recorded_brace"


def buckling_braces(frame: FrameModel) -> list[Member]:
    """Return the braces of a frame that buckle in the analysis."""
    return [member for member in frame.of_kind("brace") if member.yield_elongation is not None]


def brace_quantities(frame: FrameModel, group: Group) -> list[Quantity]:
    """Return the extremes of the braces that buckle, and add their coordinate to the group; none without such braces.

    Args:
        group: of the analysis.
    """
    braces = buckling_braces(frame)
    if not braces:
        return []
    coordinate(group, BRACE, [brace.name for brace in braces], "", "name of the brace that buckles")
    yields = [brace.yield_elongation or math.inf for brace in braces]
    group.add("brace_yield_elongation", (BRACE,), yields, "m", "f_y L / E; infinite: it does not yield")
    found = [
        _of_braces("brace_elongation", braces, "deformation", "m", "elongation of the brace between its nodes"),
        Quantity(
            "brace_ductility",
            (BRACE,),
            (len(braces),),
            tuple(
                () if math.isinf(limit) else ((1.0 / limit, "deformation", brace.element, 0),)
                for brace, limit in zip(braces, yields, strict=True)
            ),
            "1",
            "elongation of the brace / f_y L / E, negative in compression",
        ),
        _of_braces("brace_deflection", braces, "deflection", "m", "distance of the middle of the brace from its chord"),
    ]
    if any(brace.fractures for brace in braces):
        label = "damage of the fibre of the brace with most, 1: it has broken"
        found.append(_of_braces("brace_damage", braces, "damage", "1", label))
        label = "share of the area that has broken, of the section of the brace of which most has"
        found.append(_of_braces("brace_broken_share", braces, "broken_share", "1", label))
    return found


def fracture_warnings(group: Group) -> list[AnalysisWarning]:
    """Return one warning about the braces that have broken in an analysis."""
    share = group.variables.get("brace_broken_share_final")
    if share is None or not np.any(share.values > 0.0):
        return []
    worst = int(np.argmax(share.values))
    text = (
        f"fibres of {np.count_nonzero(share.values)} of {share.values.size} buckling braces have broken by low-cycle "
        f"fatigue, most in {group.coords[BRACE].values[worst]}, {100.0 * share.values[worst]:.3g} % of its section"
    )
    return [AnalysisWarning("brace_fracture", text, float(share.values[worst]))]


def recorded_braces(members: list[Member], group: Group) -> list[Quantity]:
    """Return force, elongation and deflection over time of the recorded braces that buckle.

    Args:
        members: those of `outputs.members`.
        group: of the history, to which the names of the braces are added.
    """
    braces = [member for member in members if member.yield_elongation is not None]
    if not braces:
        return []
    coordinate(group, RECORDED, [brace.name for brace in braces], "", "brace that buckles and is recorded")
    parts = (
        ("recorded_brace_axial_force", "axial_force", "N", "axial force of the brace, positive in tension"),
        ("recorded_brace_elongation", "deformation", "m", "elongation of the brace between its nodes"),
        ("recorded_brace_deflection", "deflection", "m", "distance of the middle of the brace from its chord"),
    )
    return [
        Quantity(name, (RECORDED,), (len(braces),), _terms(braces, kind), unit, label, history=True, keep=())
        for name, kind, unit, label in parts
    ]


def _of_braces(name: str, braces: list[Member], kind: str, unit: str, label: str) -> Quantity:
    return Quantity(name, (BRACE,), (len(braces),), _terms(braces, kind), unit, label)


def _terms(braces: list[Member], kind: str) -> tuple[Terms, ...]:
    return tuple(((1.0, kind, brace.element, 0),) for brace in braces)
