"""Axial force and moment of the columns that govern, with the resistance of EN 1993-1-1 around them."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from edesign.archive.dataset import Group
from edesign.archive.reader import Archive
from edesign.assess.members import VariantMembers
from edesign.codes.ec3.utilisation import ForcesAlong, utilisation
from edesign.core.member_checks import FORCES
from edesign.frame.sections.section_class import section_class
from edesign.project.analysis_file import AnalysisFile
from edesign.report.archived import archived_frame, archived_study
from edesign.report.drawing.captions import at_level, file_name
from edesign.report.drawing.style import MEAN, grid_figure, label_outer, legend_below, legend_label, styled
from edesign.report.response.histories import (
    History,
    by_level,
    histories,
    missing_text,
    names_of,
    variant_colors,
    with_results,
)
from edesign.space.analysis.response import STATIONS
from edesign.space.checks.member_checks import LARGEST_PLASTIC_CLASS
from edesign.study.results.checked_members import CheckedMember, checked_members

if TYPE_CHECKING:
    from matplotlib.figure import Figure

COLUMNS = 3
LEVELS = 41
"""Axial forces at which a curve of resistance is found."""
SECTION, MEMBER = ("N_M",), ("N_B", "M_B", "EQ_6_61", "EQ_6_62")


@dataclass(frozen=True)
class Governing:
    """The column with the largest use of a variant, with its forces; compression positive, N and N m.

    Attributes:
        title: variant and column.
        section, member: moments and axial forces at which the use of the section, and against buckling, is 1.
        steps: (n, 2) moment and axial force in the step with the largest use of each history.
        path: (nt, 2) over time in the history with the largest, where it was kept; (0, 2): it was not.
        color: of the variant.
    """

    title: str
    section: np.ndarray
    member: np.ndarray
    steps: np.ndarray
    path: np.ndarray
    color: str


def interaction_figures(archive: Archive) -> Iterator[tuple[str, str, Figure]]:
    """Yield for every level the governing column of each variant of a plane frame; buildings bend about two axes.

    Yields:
        Name of the file, caption and figure.
    """
    base = archived_frame(archive)
    if base is None:
        return
    colors, variants_of = variant_colors(archive), VariantMembers(base, archived_study(archive))
    for level, variants in by_level(histories(archive)).items():
        found = []
        for variant, chosen in variants.items():
            read = dict(with_results(archive, chosen, "section_use_max", "section_use_axial_force"))
            if read:
                name = next(iter(read)).variant
                one = _governing(read, variants_of.project(name), variant, colors[variant])
                found += [one] if one is not None else []
        if found:
            kept = (
                "; the line is its path in the history with the largest use" if any(o.path.size for o in found) else ""
            )
            caption = (
                f"Columns with the largest use{at_level(level)}: N and M in the step with the largest use of each "
                f"history{kept}. Resistance by EN 1993-1-1 without shear: of the section 6.2.9, against buckling 6.3.1 "
                f"to 6.3.3.{missing_text(history for chosen in variants.values() for history in chosen)}"
            )
            yield file_name("interaction", level), caption, interaction_figure(found)


def _governing(read: Mapping[History, Group], file: AnalysisFile, variant: str, color: str) -> Governing | None:
    """The column with the largest use in one of the histories."""
    first = next(iter(read.values()))
    names = names_of(first, "member")
    columns = [at for at, name in enumerate(names) if name.startswith("C_")]
    every = np.array([[_use(group, at) for at in columns] for group in read.values()])
    if not columns or not np.isfinite(every).all() or every.max() <= 0.0:
        return None
    row, column = np.unravel_index(int(every.argmax()), every.shape)
    at = columns[int(column)]
    (member,) = checked_members(file, [names[at]]).members
    steps = np.array([_step(group, at) for group in read.values()])
    kept = list(read.values())[int(row)]
    title = ": ".join(part for part in (variant, f"{names[at]}, {member.plastic.section.name}") if part)
    stable = "member_use_max" in first.variables
    return Governing(
        title,
        resistance(member, SECTION),
        resistance(member, MEMBER) if stable else np.zeros((0, 2)),
        steps,
        _path(kept, names[at]),
        color,
    )


def resistance(member: CheckedMember, checks: Sequence[str]) -> np.ndarray:
    """Return moments and compressions at which the largest of some checks of a member is 1, (n, 2) N m and N.

    The moment is the same all along, and there is no shear. Sections have the class that they have under the force.

    Args:
        checks: names of `Check`.
    """
    axis = FORCES.index("M_z" if member.weak else "M_y")
    N_Rd = member.plastic.constants.N_Rd
    M_Rd = member.plastic.constants.M_z_Rd if member.weak else member.plastic.constants.M_y_Rd

    def use(N: float, M: float) -> float:
        forces = np.zeros((STATIONS.size, len(FORCES)))
        forces[:, 0], forces[:, axis] = -N, M
        of = section_class(member.plastic.section, member.plastic.fy, -max(N, 0.0), not member.weak, member.weak)
        steel = member.plastic if of.number <= LARGEST_PLASTIC_CLASS else member.elastic
        along = ForcesAlong(STATIONS, forces, np.zeros_like(forces))
        return max(utilisation(steel, along, check, 0) or 0.0 for check in checks)

    found: list[tuple[float, float]] = []
    for N in np.linspace(0.0, N_Rd, LEVELS).tolist():
        if use(N, 0.0) > 1.0:
            low, high = found[-1][1], N  # the largest force lies between
            for _ in range(30):
                middle = 0.5 * (low + high)
                low, high = (middle, high) if use(middle, 0.0) <= 1.0 else (low, middle)
            found.append((0.0, low))
            break
        low, high = 0.0, 1.01 * M_Rd
        for _ in range(30):
            middle = 0.5 * (low + high)
            low, high = (middle, high) if use(N, middle) <= 1.0 else (low, middle)
        found.append((low, N))
    return np.array(found)


def _use(group: Group, at: int) -> float:
    return max(
        float(np.max(group.variables[name].values[at]))
        for name in ("section_use_max", "member_use_max")
        if name in group.variables
    )


def _step(group: Group, at: int) -> tuple[float, float]:
    """Moment and compression of a column in the step with its largest use."""
    of_section = np.asarray(group.variables["section_use_max"].values[at], dtype=float)
    of_member = group.variables.get("member_use_max")
    if of_member is not None and float(of_member.values[at]) > of_section.max():
        N, M = (
            np.asarray(group.variables[f"member_use_{part}"].values[at]) for part in ("axial_force", "bending_moment")
        )
        return float(np.abs(M).max()), float(-N.min())
    end = int(of_section.argmax())
    N, M = (np.asarray(group.variables[f"section_use_{part}"].values[at]) for part in ("axial_force", "bending_moment"))
    return float(np.abs(M[end])), float(-N[end])


def _path(group: Group, name: str) -> np.ndarray:
    """Moment and compression over time at the end with the larger moment; nothing where they were not kept."""
    if "recorded_member" not in group.coords or name not in names_of(group, "recorded_member"):
        return np.zeros((0, 2))
    at = names_of(group, "recorded_member").index(name)
    N, M = (
        np.asarray(group.variables[f"member_{part}"].values[:, at], dtype=float)
        for part in ("axial_force", "bending_moment")
    )
    end = int(np.abs(M).max(axis=0).argmax())
    return np.stack([np.abs(M[:, end]), N[:, end] * (1.0, -1.0)[end]], axis=1)


@styled
def interaction_figure(columns: Sequence[Governing]) -> Figure:
    """Draw the forces of columns in the curves of their resistance, a panel each.

    Args:
        columns: at least one.
    """
    from matplotlib.lines import Line2D

    figure, cells = grid_figure(len(columns), min(COLUMNS, len(columns)), 2.4, 2.6)
    for axis, one in zip(cells, columns, strict=True):
        lowest = 1.1e-3 * min(0.0, float(one.steps[:, 1].min()), *one.path[:, 1].tolist())
        axis.plot(*(1e-3 * one.section.T), color=MEAN, lw=1.2)
        if lowest < 0.0:  # in tension the section is as strong
            axis.plot(1e-3 * one.section[:, 0], -1e-3 * one.section[:, 1], color=MEAN, lw=1.2)
        if one.member.size:
            axis.plot(*(1e-3 * one.member.T), color=MEAN, lw=1.2, ls="--")
        if one.path.size:
            axis.plot(*(1e-3 * one.path.T), color=one.color, lw=0.5, alpha=0.7)
        axis.plot(*(1e-3 * one.steps.T), color=one.color, ls="none", marker="o", ms=3.5)
        axis.axhline(0.0, color=MEAN, lw=0.6, zorder=0.9)
        axis.set_title(legend_label(one.title), loc="left")
        axis.set_xlim(left=0.0)
        axis.set_ylim(lowest, 1.05e-3 * float(one.section[:, 1].max()))
        axis.locator_params(axis="x", nbins=5)
    label_outer(cells, min(COLUMNS, len(columns)), "moment (kN m)", "compression (kN)")
    handles = [Line2D([], [], color=MEAN, lw=1.2, label="resistance of the section")]
    if any(one.member.size for one in columns):
        handles.append(Line2D([], [], color=MEAN, lw=1.2, ls="--", label="against buckling"))
    handles.append(Line2D([], [], color=MEAN, ls="none", marker="o", ms=3.5, label="step with the largest use"))
    legend_below(figure, handles, [str(handle.get_label()) for handle in handles], len(handles))
    return figure
