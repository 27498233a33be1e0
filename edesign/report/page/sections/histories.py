"""Response over time, with and without dampers, and where the energy went."""

from __future__ import annotations

from edesign.report.drawing.captions import file_name
from edesign.report.html.section import Folded, Part, Picture, Section
from edesign.report.page.source import Source, by_level, level_heading
from edesign.report.response.energy_figures import energy_figures
from edesign.report.response.histories import history_of
from edesign.report.response.response_figures import response_figures

MANY = 6  # pictures of one level, beyond which only those of the governing records are shown at once


def histories(source: Source) -> Section:
    """Return the section on histories kept over time: ground, roof, base shear, and energy balance."""
    parts: list[Part] = []
    sorted_pictures = by_level(source.pictures(response_figures, energy_figures), source.levels)
    for level, pictures in sorted_pictures.items():
        parts += [level_heading(level, source.levels)] if len(sorted_pictures) > 1 else []
        shown = [picture for picture in pictures if picture.name.endswith(tuple(governing(source, level)))]
        if len(pictures) <= MANY or not shown:
            parts += pictures
            continue
        parts += shown
        parts.append(Folded(f"The other records{f', {level}' if level else ''}", _others(pictures, shown)))
    intro = "Shown are the records with the largest interstorey drift of each variant."
    folded = any(isinstance(part, Folded) for part in parts)
    return Section("histories", "Response over time", (intro,) if folded else (), tuple(parts), aside=True)


def governing(source: Source, level: str) -> list[str]:
    """Return the endings of names of figures of the records with the largest drift of each variant at a level.

    Args:
        source: archive and settings of the report.
        level: name of the hazard level; "" without levels.
    """
    found = []
    for histories, statistics in source.statistics:
        name = statistics["interstorey_drift"].governing
        if histories.level == level and name:
            ending = f"_{file_name(history_of(name, histories.histories[name].attributes).shaken_by)}"
            found += [ending, f"{ending}_x", f"{ending}_y"]  # of a building in each direction
    return found


def _others(pictures: list[Picture], shown: list[Picture]) -> tuple[Picture, ...]:
    return tuple(picture for picture in pictures if picture not in shown)
