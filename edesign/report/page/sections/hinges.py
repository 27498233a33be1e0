"""Plastic hinges in the frame or building, axial forces of its columns, and footings under them."""

from __future__ import annotations

from collections.abc import Iterable, Sequence

from edesign.archive.dataset import Group
from edesign.project.building import Building
from edesign.project.notation.frames import frames_of_member
from edesign.report.html.section import Folded, Part, Picture, Section
from edesign.report.page.source import Source, headed
from edesign.report.response.axial_figures import axial_figures
from edesign.report.response.frame_figures import frame_figures, plastic_rotations
from edesign.report.response.ground_tables import ground_tables
from edesign.report.response.hinge_tables import hinge_tables

JUDGED = "_acceptance"  # ends the names of hinge maps by performance levels


def hinges(source: Source) -> Section:
    """Return the section on yielding members, hinges, joints, axial forces of columns, and supports, level by level.

    Of a level at which hinges are judged by performance levels, the maps of their rotations are shown on demand.
    Of a building the frames along x and along y with the largest plastic rotation are shown, and the others on demand.
    """
    pictures = source.pictures(frame_figures)
    others: Sequence[Picture] = ()
    if isinstance(source.base, Building):
        completed = (group for found in source.sets for group in found.completed.values())
        worst = _worst_frames(completed)
        shown = [one for one in pictures if one.name.split("_")[1:2] and one.name.split("_")[1] in worst]
        others = [one for one in pictures if one not in shown]
        pictures = tuple(shown)
    folded: list[Part] = (
        [Folded(f"Plastic hinges of the other frames ({len(others)})", tuple(others))] if others else []
    )
    tables = (*hinge_tables(source.groups), *ground_tables(source.groups))
    judged = {one.name.removesuffix(JUDGED) for one in pictures if one.name.endswith(JUDGED)}
    plain = [one for one in pictures if one.name.rpartition("_")[0] in judged and not one.name.endswith(JUDGED)]
    pictures = tuple(one for one in pictures if one not in plain)
    if plain:
        folded.append(
            Folded(f"Plastic rotations in mrad, mean and largest of the records ({len(plain)})", tuple(plain))
        )
    axial = source.pictures(axial_figures)
    more = [one for one in axial if "_others" in one.name]
    axial = tuple(one for one in axial if one not in more)
    if more:
        folded.append(Folded(f"Axial forces of the other column lines ({len(more)})", tuple(more)))
    parts = (*tables, *headed((*pictures, *axial), source.levels), *folded)
    return Section("hinges", "Plastic hinges and columns", (), parts)


def _worst_frames(histories: Iterable[Group]) -> set[str]:
    """The plane frames along x and along y of a building whose members rotate most."""
    largest: dict[str, float] = {}
    for group in histories:
        for (member, _), value in plastic_rotations(group).items():
            for frame in frames_of_member(member):
                largest[frame] = max(value, largest.get(frame, 0.0))
    of = [[frame for frame in largest if frame.startswith(axis)] for axis in "XY"]
    return {max(frames, key=largest.__getitem__) for frames in of if frames}
