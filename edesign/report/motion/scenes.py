"""Motions of frames over time, read from an archive: one record of each hazard level, variants in step."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace

import numpy as np

from edesign.archive.dataset import Group
from edesign.archive.reader import Archive
from edesign.assess.acceptance import ELASTIC_ROTATION
from edesign.assess.envelopes import peak
from edesign.assess.members import VariantMembers, compressions
from edesign.codes.fema356.drift import PERFORMANCE_LEVELS
from edesign.project.building.building import Building
from edesign.project.project import Project
from edesign.report.archived import archived_building, archived_project, archived_study
from edesign.report.drawing.captions import record_label
from edesign.report.motion.building_geometry import moving_building
from edesign.report.motion.frame_geometry import moving_frame
from edesign.report.motion.moving import Moving, nearest, read_moving
from edesign.report.response.frame_figures import ACCEPTANCE, ROTATION, End, Scale, plastic_rotations
from edesign.report.response.histories import (
    History,
    by_level,
    histories,
    names_of,
    variant_colors,
    with_results,
)
from edesign.study.results.motion import MOST_PICTURES, SHORTEST


@dataclass(frozen=True)
class Scene:
    """A record at a hazard level.

    Attributes:
        level: "" without one.
        record: its history, in words.
        of: how many records there are.
        among: of how many of them as much was kept as of this one.
        time: of the pictures, s.
        ground: acceleration at each picture, m/s2; of a building along x and y, (pictures, 2).
        scale: classes of the hinges.
        variants: in step.
    """

    level: str
    record: str
    of: int
    among: int
    time: np.ndarray
    ground: np.ndarray
    scale: Scale
    variants: tuple[Moving, ...]

    @property
    def peak(self) -> int:
        """The number of the picture with the largest storey drift."""
        drifts = [np.abs(one.drift).reshape(len(self.time), -1).max(axis=1) for one in self.variants]
        return int(np.argmax(np.max(drifts, axis=0)))

    @property
    def in_space(self) -> bool:
        """Whether it shows a building."""
        return self.variants[0].geometry.in_space

    def thinned(self, every: int) -> Scene:
        """Return the scene with one in several pictures; largest values are still those of all samples."""
        variants = tuple(one.at(np.arange(0, len(self.time), every)) for one in self.variants)
        return replace(self, time=self.time[::every], ground=self.ground[::every], variants=variants)


def scenes(archive: Archive) -> Iterator[Scene]:
    """Yield a scene for each hazard level of an archive whose histories keep the displacements of floors over time.

    The record is one of those of which most was kept, and of these the one whose peak drifts are nearest to the means
    of all records.
    """
    levels = by_level(histories(archive))
    file = (archived_project(archive) or archived_building(archive)) if levels else None
    if file is None:
        return
    colors = variant_colors(archive)
    of = VariantMembers(file, archived_study(archive)) if isinstance(file, Project) else None
    for level, variants in levels.items():
        found = {
            variant: {_motion(one, group): (one, group) for one, group in with_results(archive, chosen, *NEEDED)}
            for variant, chosen in variants.items()
        }
        found = {variant: records for variant, records in found.items() if records}
        if not found:
            continue
        record, counts = _record(found)
        shown = {variant: records[record] for variant, records in found.items() if record in records}
        first = list(shown.items())
        time = _pictures([group for _, (_, group) in first])
        rotations = [
            {e: r for e, r in plastic_rotations(group).items() if r > ELASTIC_ROTATION} for _, (_, group) in first
        ]
        tables = [{} if of is None else _accepted(of, variant, group) for variant, (_, group) in first]
        judged = of is not None and all(e in t for r, t in zip(rotations, tables, strict=True) for e in r)
        scale = ACCEPTANCE if judged else ROTATION
        moving = []
        for (variant, (history, group)), ends, table in zip(first, rotations, tables, strict=True):
            limits = tuple(table[end] if scale is ACCEPTANCE else ROTATION.limits for end in ends)
            masses = tuple(names_of(group, "tuned_mass")) if "tuned_mass_displacement" in group.variables else ()
            dampers, own = tuple(names_of(group, "damper")), file if of is None else of.project(variant)
            own = own.with_halves(names_of(group, "beam"))
            if isinstance(own, Project):
                geometry = moving_frame(own.frame, dampers, masses)
            else:
                assert isinstance(own, Building)
                geometry = moving_building(own, dampers, masses)
            moving.append(read_moving(history, group, colors[variant], geometry, ends, limits, time))
        group = first[0][1][1]
        ground = group.variables["ground_acceleration"].values[nearest(group, "time", time)]
        alone = first[0][1][0].record
        label = f"{record_label(alone)}{record.removeprefix(alone)}"
        yield Scene(level, label, *counts, time, ground, scale, tuple(moving))


NEEDED = ("floor_displacement", "ground_acceleration", "storey_height", "storey_drift_max", "storey_drift_min")


def _motion(history: History, group: Group) -> str:
    """The record; of a building with the angle and the place of the masses, of which there may be several."""
    angle, place = (group.attributes.get(name) for name in ("angle_deg", "eccentricity"))
    turned = f", turned by {float(str(angle)):g}°" if angle else ""
    return f"{history.record}{turned}" + f", masses shifted to {place}" * (place not in (None, "", "0"))


def _record(found: dict[str, dict[str, tuple[History, Group]]]) -> tuple[str, tuple[int, int]]:
    """The record that is shown, of how many, and of how many of which as much was kept."""
    peaks: dict[str, dict[str, float]] = {}
    kept: dict[str, int] = {}
    for variant, records in found.items():
        for record, (_, group) in records.items():
            largest = peak(group, "storey_drift")
            assert largest is not None, "it is needed"
            peaks.setdefault(record, {})[variant] = float(np.max(largest))
            more = sum(name in group.variables for name in ("node_displacement", "damper_force"))
            kept[record] = kept.get(record, 0) + 1 + 100 * more
    means = {variant: np.mean([of[variant] for of in peaks.values() if variant in of]) for variant in found}

    def off(record: str) -> float:
        return float(np.mean([abs(value / means[variant] - 1.0) for variant, value in peaks[record].items()]))

    most = max(kept.values())
    among = [record for record in peaks if kept[record] == most]
    return min(among, key=off), (len(peaks), len(among))


def _pictures(groups: Sequence[Group]) -> np.ndarray:
    """Times of the pictures to the end of the longest history; where motions were kept, theirs."""
    times = [np.asarray(group.coords["time"].values, dtype=float) for group in groups]
    longest = max(times, key=lambda time: float(time[-1]))
    step = max(SHORTEST, float(longest[-1] - longest[0]) / (MOST_PICTURES - 1), float(longest[1] - longest[0]))
    own = float(longest[1] - longest[0])
    stride = max(1, int(np.ceil(step / own - 1e-9)))
    kept = [group.coords["motion_time"].values for group in groups if "motion_time" in group.coords]
    if kept:
        best = max(kept, key=len)
        return np.asarray(best[:: max(1, int(np.ceil(len(best) / MOST_PICTURES)))], dtype=float)
    return longest[::stride]


def _accepted(of: VariantMembers, variant: str, group: Group) -> dict[End, tuple[float, ...]]:
    """Plastic rotations from which an end is in each class of `ACCEPTANCE` but the first, rad."""
    compression, found = compressions(group), {}
    for name, member in of(variant).items():
        allowed = [member.allowed(level, compression.get(name, 0.0)) for level in PERFORMANCE_LEVELS]
        for end in (0, 1):
            found[name, end] = (ELASTIC_ROTATION, *(max(ELASTIC_ROTATION, limit) for limit in allowed))
    return found
