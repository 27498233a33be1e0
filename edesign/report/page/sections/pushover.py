"""Pushovers: capacity curves, events, target displacements, and the response at them."""

from __future__ import annotations

from edesign.report.capacity.pushover_figures import pushover_figures
from edesign.report.capacity.pushover_tables import events_table, target_tables
from edesign.report.capacity.target_hinges import hinge_figures
from edesign.report.html.section import Folded, Part, Section
from edesign.report.page.source import Source


def pushover(source: Source) -> Section:
    """Return the section on the capacity curves of the frame, and its target displacements at each level."""
    pictures = source.pictures(pushover_figures)
    events = events_table(source.groups)
    parts: list[Part] = [*pictures]
    parts += [Folded("Events along the capacity curves", (events,))] if events.rows else []
    parts += target_tables(source.base, source.groups, source.study)
    hinges = source.pictures(hinge_figures)
    parts += [Folded("Plastic rotations at the target displacements", hinges)] if hinges else []
    intro = "A push has no speed: dampers give what is left of them at rest." if _damped(source) else ""
    return Section("pushover", "Pushovers", (intro,) if intro else (), tuple(parts))


def _damped(source: Source) -> bool:
    kinds = ("pushover", "target")
    return any("damper" in group.coords for group in source.groups.values() if group.attributes.get("kind") in kinds)
