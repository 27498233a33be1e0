"""Figures of the records of an archive."""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING

import numpy as np

from edesign.archive.dataset import Group
from edesign.archive.reader import Archive
from edesign.ground_motion.component_pairs import NAMES
from edesign.ground_motion.sources import is_simulated
from edesign.report.drawing.captions import file_name, record_label
from edesign.report.ground_motion.match_figure import match_figure
from edesign.report.ground_motion.spectra_figure import spectra_figure
from edesign.study.results.kinds import RECORDS

if TYPE_CHECKING:
    from matplotlib.figure import Figure


def record_figures(archive: Archive) -> Iterator[tuple[str, str, Figure]]:
    """Yield the spectra of each suite, and the histories of each fitted record.

    Yields:
        Name of the file, caption and figure.
    """
    for name in archive.names(RECORDS):
        place = f"{RECORDS}/{name}"
        if not archive.group_attributes(place).get("suite"):
            group = archive.view(place)
            if _is_fitted(group):
                yield file_name(name), _match_caption(group), match_figure(group)
            continue
        members = {member: archive.view(f"{place}/{member}") for member in archive.names(place)}
        yield from _suite_figures(name, archive.view(place), members)
        for member, group in members.items():
            if _is_fitted(group):
                yield file_name(member), _match_caption(group), match_figure(group)


def _suite_figures(name: str, suite: Group, members: dict[str, Group]) -> Iterator[tuple[str, str, Figure]]:
    fitted = {member: group for member, group in members.items() if _is_fitted(group)}
    if not fitted:
        spectra = {member: group.variables["psa"].values for member, group in members.items()}
        period = next(iter(members.values())).coords["period"].values
        title = f"{name}: {_origins(members)}, {_damping(members)}"
        yield file_name(name, "spectra"), f"Elastic spectra of {title}.", spectra_figure(period, spectra, title=title)
        return
    period, target = suite.coords["period"].values, suite.variables["target"].values
    goal, damping = {str(suite.attributes["target"]): target}, _damping(fitted)
    recorded = {
        member: group.variables["psa_before"].values / float(group.attributes["match_scale"])
        for member, group in fitted.items()
    }
    matched = {member: group.variables["psa_after"].values for member, group in fitted.items()}
    kinds = f"{_origins(fitted)}, {damping}"
    how = "scaled" if all(group.attributes["match_method"] == "scale" for group in fitted.values()) else "matched"
    against = f"their mean, and the target {suite.attributes['target']}"
    if "pair" in suite.attributes:
        about = suite.attributes["pair"]
        label = NAMES[about["spectrum"]]
        spectra = dict(matched)
        spectra[label] = suite.variables["combined_psa"].values
        title = f"{name}: both components times {float(about['factor']):.3g}, {damping}"
        caption = f"Spectra of the scaled components of {name} ({kinds}), their {label}, and the target."
        yield file_name(name, "after"), caption, spectra_figure(period, spectra, goal, title, mean=False)
        return
    before, after = f"{name}: {kinds}", f"{name}: {how}, {damping}"
    caption = f"Spectra of {name} as recorded ({kinds}), {against}."
    yield file_name(name, "before"), caption, spectra_figure(period, recorded, goal, before)
    caption = f"Spectra of {name}, {how} ({damping}), {against}."
    yield file_name(name, "after"), caption, spectra_figure(period, matched, goal, after)
    means = {
        "mean, unscaled": np.mean(list(recorded.values()), axis=0),
        f"mean, {how}": np.mean(list(matched.values()), axis=0),
    }
    title = f"{name}: means, {kinds}"
    caption = f"Mean spectra of {name} as recorded and {how} ({kinds})."
    yield file_name(name, "mean"), caption, spectra_figure(period, means, goal, title, mean=False)


def _match_caption(group: Group) -> str:
    name, method, scale = (group.attributes[key] for key in ("name", "match_method", "match_scale"))
    kind = "simulated" if is_simulated(group.attributes["origin"]) else "recorded"
    return f"{record_label(str(name))}, {kind}, times {float(scale):.3g}, before and after matching ({method})."


def _origins(members: dict[str, Group]) -> str:
    """How many are recordings, and how many simulated in their place."""
    simulated = sum(is_simulated(group.attributes["origin"]) for group in members.values())
    texts = [f"{len(members) - simulated} recorded", f"{simulated} simulated"]
    return ", ".join(text for text in texts if not text.startswith("0 "))


def _damping(members: dict[str, Group]) -> str:
    return f"{100 * float(next(iter(members.values())).attributes['damping']):g} % damping"


def _is_fitted(group: Group) -> bool:
    return "matched_acceleration" in group.variables
