"""The members of a project's frame in the core's model."""

from __future__ import annotations

import math
from collections.abc import Callable
from functools import cache, partial
from typing import Any

from edesign.core import Model
from edesign.frame.frame_model import Member
from edesign.frame.hinges import MemberBuilder, MemberEnd, member_ends
from edesign.frame.loads import Stretches
from edesign.frame.panel_zones import BuiltPanel, PanelBuilder, panels_of
from edesign.frame.rigid_ends import rigid_ends
from edesign.frame.sections.core_sections import CoreSections
from edesign.frame.struts import Strut, bar_of_member, equivalent_camber, strut
from edesign.project.actions.beam_loads import breaks_of_members, points_of_member
from edesign.project.frame.braces import BraceBuckling
from edesign.project.frame.materials import ElasticMaterial
from edesign.project.frame.members import BeamRun, BraceRun, ColumnRun
from edesign.project.notation.names import MemberKind, member_kind
from edesign.project.project import Project


def add_members(
    project: Project, model: Model, nodes: dict[str, int]
) -> tuple[dict[str, Member], dict[int, list[int]], dict[str, BuiltPanel]]:
    """Add columns, beams and braces, their hinges and panel zones, to the model of a frame.

    Args:
        nodes: ids by name.

    Returns:
        Members by name, nodes behind hinges and joints that share the displacements of a node, and panel zones.

    Raises:
        InputError: a member has a section that it cannot have.
    """
    parts = CoreSections(project, model)
    geometry = project.elements.geometry
    of_kind: dict[MemberKind, str] = {"column": geometry.columns, "beam": geometry.beams, "brace": geometry.braces}
    places: dict[int, tuple[float, ...]] = {node: project.frame.nodes[place] for place, node in nodes.items()}
    panels = PanelBuilder(model, nodes, places, panels_of(project))
    builder = MemberBuilder(model, places)
    at_ends = member_ends(project)
    breaks = breaks_of_members(project.frame, project.loads)
    rigid = rigid_ends(project)
    struts = cache(partial(strut, project))  # many members are alike
    found = {}
    for name, run in project.frame.members.items():
        facts = _facts(project, name, run, struts)
        start, end, kind = facts["start"], facts["end"], facts["kind"]
        if isinstance(run, BraceRun):
            if run.buckling is not None:
                found[name] = _buckling_brace(project, model, parts, facts, run, run.buckling, nodes)
                continue
            material, area = parts.brace(run)
            element = model.truss(name, nodes[start], nodes[end], material, area, geometry=of_kind[kind])
            found[name] = Member(**facts, element=element, parts=(element,))
            continue
        first, last = at_ends.get(name, (MemberEnd(), MemberEnd()))
        arms = panels.arm(start, kind), panels.arm(end, kind)
        ends = first.from_edge(arms[0]), last.from_edge(arms[1])
        hinged = any(of.hinge is not None for of in ends)
        section, fibres = parts.section(run, hinged)
        EI = parts.bending_stiffness(run)
        inside = Stretches(arms, (facts["length"] - sum(arms),)).on_only_element(breaks.get(name, ()))
        built = builder.add(
            name,
            panels.ends(name, (start, end), EI, of_kind[kind]),
            section,
            EI,
            project.elements.integration_points,
            of_kind[kind],
            project.frame.released.get(name, (False, False)),
            ends,
            inside,
        )
        if name in rigid:  # such a member has no hinges and no panel zones
            model.rigid_ends(built.interior, *rigid[name])
        stretches = Stretches(arms, built.lengths)
        found[name] = Member(
            **facts,
            element=built.interior,
            fibres=fibres,
            outer=() if fibres is None else (0, fibres.size - 1),
            points=points_of_member(project.elements, inside),
            parts=built.parts,
            stretches=stretches,
            springs=built.springs,
            rigid_ends=rigid.get(name, (0.0, 0.0)),
        )
    return found, builder.moving_with, panels.built


def _facts(
    project: Project,
    name: str,
    run: ColumnRun | BeamRun | BraceRun,
    struts: Callable[[str, str, float], Strut | None],
) -> dict[str, Any]:
    """What the file says of a member."""
    start, end = project.frame.ends[name]
    length = project.frame.length(name)
    return {
        "name": name,
        "kind": member_kind(name),
        "start": start,
        "end": end,
        "section": run.section,
        "material": run.material,
        "steel": project.materials[run.material],
        "length": length,
        "bar": None if isinstance(run, BeamRun) else bar_of_member(name, run, length, struts),
    }


def _buckling_brace(
    project: Project,
    model: Model,
    parts: CoreSections,
    facts: dict[str, Any],
    run: BraceRun,
    buckling: BraceBuckling,
    nodes: dict[str, int],
) -> Member:
    """Add a brace that buckles; `facts` is what the file says of it."""
    length, steel = facts["length"], facts["steel"]
    camber = buckling.camber
    if camber == "ec3":
        effective = run.buckling_length_factor * length
        camber = equivalent_camber(project, run.section, run.material, buckling.axis, effective)
    stiffnesses = {"pinned": 0.0, "fixed": math.inf}
    stiffness = stiffnesses[buckling.ends] if isinstance(buckling.ends, str) else buckling.ends
    section, material, area = parts.buckling_brace(run, buckling)
    element = model.strut(
        facts["name"],
        nodes[facts["start"]],
        nodes[facts["end"]],
        section,
        material,
        area,
        camber,
        elements=buckling.n_elements,
        points=project.elements.integration_points,
        buckling_length=run.buckling_length_factor,
        end_stiffness=stiffness,
        geometry=project.elements.geometry.braces,
    )
    yields = math.inf if isinstance(steel, ElasticMaterial) else steel.fy * length / steel.E
    return Member(
        **facts,
        element=element,
        parts=(element,),
        yield_elongation=yields,
        fractures=buckling.fracture is not None,
    )
