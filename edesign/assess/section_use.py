"""Use of the resistance of sections by N, M_y and M_z that act at one instant of a history."""

from __future__ import annotations

import math

import numpy as np

from edesign.archive.dataset import Group
from edesign.codes.ec3.cross_section import plastic_interaction
from edesign.codes.ec3.member import Member, Stability, Strength
from edesign.codes.ec3.section import SteelSection
from edesign.frame.sections.own_section import section_of
from edesign.frame.sections.section_class import section_class
from edesign.project.analysis_file import AnalysisFile
from edesign.project.building.building import Building
from edesign.project.criteria.criteria import QuantityCriterion
from edesign.project.notation.names import member_kind
from edesign.space.structure.steel_by_thickness import with_steel_by_thickness

_HIGHEST_PLASTIC, _HIGHEST_ELASTIC = 2, 3


def section_use(group: Group, asked: QuantityCriterion, project: AnalysisFile) -> np.ndarray | None:
    """Return the largest use of the resistance of each recorded column and beam at its ends.

    N, M_y and M_z are those of one instant. The class of the section is that of bending about both axes with the
    largest compression of the history. Partial factors are 1, shear is left out, and the forces are those that the law
    of the steel allows: hardening may lead beyond 1.

    Args:
        group: of a history with end forces over time.
        project: whose sections and steels the members have.

    Returns:
        (recorded members,), 1: the resistance is used up; infinite of a section of class 4, minus infinity of braces
        and of sections without class; None: there are no forces of a building over time.

    Source: EN 1993-1-1:2005, 6.2.9.1(2), Eq. 6.31, and (6), Eq. 6.41, or 6.2.1(7), Eq. 6.2, of class 1 and 2; 6.2.9.2,
        Eq. 6.42, of class 3.
    """
    moments, axial = (group.variables.get(f"member_{name}") for name in ("bending_moment", "axial_force"))
    if moments is None or axial is None or moments.dims[-1] != "axis" or not isinstance(project, Building):
        return None
    about = [str(axis) for axis in group.coords["axis"].values]
    M = np.abs(np.asarray(moments.values, dtype=float))[..., [about.index("y"), about.index("z")]]
    N = np.asarray(axial.values, dtype=float) * np.array([1.0, -1.0])  # on the ends: compression acts inwards
    building = with_steel_by_thickness(project)
    found = []
    for at, name in enumerate(str(label) for label in group.coords["recorded_member"].values):
        if member_kind(name) == "brace":
            found.append(-math.inf)
            continue
        run = building.layout.members[name]
        section = section_of(building, run.section)
        if not section.has_class:
            found.append(-math.inf)
            continue
        found.append(_largest(section, building.materials[run.material].fy, N[:, at].ravel(), M[:, at]))
    return np.array(found)


def _largest(section: SteelSection, fy: float, compression: np.ndarray, moments: np.ndarray) -> float:
    """The largest use over all instants and ends.

    The linear sum is never less than what the clause asks for. So instants are looked at from its largest value down,
    until it is below what was found.

    Args:
        compression: (n,) N.
        moments: of the same instants and ends, magnitudes about y and z, N m; its last axis.
    """
    number = section_class(section, fy, -max(float(compression.max()), 0.0), about_y=True, about_z=True).number
    if number > _HIGHEST_ELASTIC:
        return math.inf
    strength = Strength(Member(section, fy, Stability(0.0, 0.0, 0.0), number, gamma_M0=1.0))
    resistance = strength.N_pl_Rd()
    n = np.abs(compression) / resistance
    m_y, m_z = moments.reshape(-1, 2).T / np.array([[strength.M_Rd("y")], [strength.M_Rd("z")]])
    linear = np.asarray(n + m_y + m_z)
    if number > _HIGHEST_PLASTIC:
        return float(linear.max())
    found = 0.0
    for at in np.argsort(-linear):
        if linear[at] <= found:
            break
        of = float(n[at])
        reduced = strength.reduced_by_axial_force(of * resistance, of, 0.0)
        found = max(found, plastic_interaction(section.kind, of, float(m_y[at]), float(m_z[at]), *reduced))
    return found
