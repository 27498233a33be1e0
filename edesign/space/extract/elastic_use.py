"""The use of members in the elastic design of a building, as the frames that are taken out of it tell it."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

import numpy as np

from edesign.codes.ec8.analysis.directions import SHARE
from edesign.codes.en1990.combinations import Combination
from edesign.project.building.building import Building
from edesign.project.building.names import Direction
from edesign.project.frame.member_design import AcrossBracing, ElasticUse
from edesign.space.analysis.bracing import bracing
from edesign.space.elastic_design import ElasticDesign, elastic_design
from edesign.space.structure.frame import AXES

_DIGITS = 4
"""Of uses and forces in a file."""


def elastic_use(building: Building, along: Direction) -> dict[str, ElasticUse]:
    """Return the largest use of each member in the elastic design of a building; {} without `design`, hazard or masses.

    Columns that braces of frames across load have the axial force of the seismic action across too, with its factor in
    combinations in which the action along leads: 30 %, of columns that are not dissipative with 1.1 gamma_ov Omega. The
    supports below them have their vertical reaction likewise, with gamma_Rd Omega.

    Args:
        building: from `load_building`.
        along: direction of the frames that are taken out of it.

    Raises:
        InputError: as `elastic_design`.

    Source: EN 1998-1:2004, 4.3.3.5.1(3), 4.4.2.6(4), 6.7.4(1).
    """
    if building.design is None or building.hazard is None or building.masses is None:
        return {}
    design = elastic_design(building)
    of, across, found = design.members, _across(design, along), {}
    for number, member in enumerate(design.frame.members):
        uses = np.nan_to_num(of.utilisation[number], nan=-1.0)
        check = int(uses.argmax())
        if uses[check] <= 0.0:
            continue
        row = of.rows[int(of.combination[number, check]) - 1]
        name = of.checks[check].split(" (")[0]
        found[member.name] = ElasticUse(
            use=_rounded(float(uses[check])), check=name, combination=row.name, across=across.get(number)
        )
    return found


def _across(design: ElasticDesign, along: Direction) -> Mapping[int, AcrossBracing]:
    """The bracing of frames across by the numbers of the columns that belong to it."""
    braced, axis = bracing(design.frame), 1 - AXES.index(along)
    rows = [row for row in design.members.amplified or design.members.rows if row.seismic[axis] != 0.0]
    if not rows:
        return {}
    factor = _least(rows, axis)
    below, found = _reactions(design, axis), {}
    for row, number in zip(braced.to_columns, braced.columns.tolist(), strict=True):
        loading = np.flatnonzero((np.abs(row) > 0.0) & (braced.axis == axis))
        N = factor * float(design.effects.seismic[axis, number, :, 0].max())
        if loading.size and N > 0.0:
            frames = dict.fromkeys(design.frame.members[braced.braces[at]].frame[0] for at in loading)
            V = below.get(design.frame.node_names[design.frame.members[number].start])
            found[number] = AcrossBracing.model_construct(frames=tuple(frames), N=_rounded(N), V=V)
    return found


def _least(rows: Sequence[Combination], axis: int) -> float:
    """The least factor of the seismic action across, which is that beside the leading one along."""
    return min(abs(row.seismic[axis]) * (SHARE if row.directions == "srss" else 1.0) for row in rows)


def _reactions(design: ElasticDesign, axis: int) -> dict[str, float]:
    """The vertical reactions of supports under the seismic action across, with gamma_Rd Omega of foundations, N."""
    rows = [row for row in design.combinations if row.set == "seismic" and row.seismic[axis] != 0.0]
    of = design.foundations
    values = (_least(rows, axis) if rows else 0.0) * of.factor[axis] * of.seismic[axis, :, 2]
    return {name: _rounded(float(value)) for name, value in zip(of.nodes, values, strict=True) if value > 0.0}


def _rounded(value: float) -> float:
    return float(f"{value:.{_DIGITS}g}")
