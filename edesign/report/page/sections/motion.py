"""The motion of the frame or building over time, for a record of each hazard level."""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING

from edesign.archive.reader import Archive
from edesign.report.drawing.captions import file_name
from edesign.report.html.section import Heading, Part, Section, Viewer
from edesign.report.page.source import Source

if TYPE_CHECKING:
    from matplotlib.figure import Figure

    from edesign.report.motion.scenes import Scene

LARGEST = (
    100_000  # characters of the data of a variant, beyond which there is every second picture only, every third, ...
)
LEAST = 400_000  # of a viewer, that few variants may have together


def motion(source: Source) -> Section:
    """Return the section with a viewer of the deformed frame or building for one record of each level.

    It needs histories whose floors were kept over time.
    """
    found: dict[str, Scene] = {}

    def motion_of_the_frame(archive: Archive) -> Iterator[tuple[str, str, Figure]]:
        from edesign.report.motion.scenes import scenes
        from edesign.report.motion.still import motion_caption, still_figure
        from edesign.report.motion.still_building import building_still

        for scene in scenes(archive):
            name = file_name("motion", scene.level)
            found[f"figure-{name}"] = scene
            still = building_still(scene) if scene.in_space else still_figure(scene)
            yield name, motion_caption(scene), still

    parts: list[Part] = []
    for picture in source.pictures(motion_of_the_frame):
        scene = found[picture.name]
        parts += [Heading(scene.level or "All levels")] if len(found) > 1 else []
        parts.append(Viewer(picture, _text(scene), scene.in_space))
    what = "building" if any(scene.in_space for scene in found.values()) else "frame"
    return Section("motion", f"Motion of the {what}", (), tuple(parts), aside=True)


def _text(scene: Scene) -> str:
    """The data of a scene, with as many pictures as may be."""
    from edesign.report.motion.encoding import scene_text

    text, every = scene_text(scene), 1
    most = max(LEAST, LARGEST * len(scene.variants))
    while len(text) > most and every < len(scene.time) // 2:
        every += 1
        text = scene_text(scene.thinned(every))
    return text
