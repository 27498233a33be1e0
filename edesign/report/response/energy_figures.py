"""The energy balance over time."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from typing import TYPE_CHECKING

import numpy as np

from edesign.archive.reader import Archive
from edesign.assess.energy import energies, share_of_input
from edesign.report.drawing.captions import at_level, file_name, plain
from edesign.report.drawing.style import MEAN, grid_figure, label_outer, legend_below, styled
from edesign.report.response.histories import by_motion, histories, missing_text, with_results

if TYPE_CHECKING:
    from matplotlib.figure import Figure

PARTS = {
    "hysteretic": ("yielding", "#c8452f"),
    "dampers": ("dampers", "#3aa08f"),
    "damping": ("inherent damping", "#b4bac3"),
    "stored": ("kinetic and elastic", "#fbd9a0"),
}
"""Shares of the input from the bottom up: label and color."""
_STORED = ("kinetic", "elastic", "p_delta")
COLUMNS = 2
POINTS = 1500  # of an area, about
Energy = tuple[np.ndarray, Mapping[str, np.ndarray]]


def energy_figures(archive: Archive) -> Iterator[tuple[str, str, Figure]]:
    """Yield the energy of each motion whose energy was kept, a panel for each variant.

    Yields:
        Name of the file, caption and figure.
    """
    own = [history for history in histories(archive) if history.temperature is None]
    for (level, record), chosen in by_motion(own).items():
        found: dict[str, Energy] = {}
        for history, group in with_results(archive, chosen, "energy"):
            terms = energies(group)
            if terms is not None:
                found[history.variant] = (group.coords["time"].values, terms)
        if found:
            caption = f"Energy since the start of {chosen[0].motion}{at_level(level)}. {_numbers(found)}"
            yield file_name("energy", level, record), f"{caption}{missing_text(chosen)}", energy_figure(found)


@styled
def energy_figure(histories: Mapping[str, Energy]) -> Figure:
    """Draw the input energy over time as dissipated and stored parts, one upon the other.

    Args:
        histories: by title of the panel: time (s), and terms of the balance (J) as in archives.
    """
    figure, cells = grid_figure(len(histories), COLUMNS, 3.1 if len(histories) > 1 else 5.5, 2.4)
    tallest = 1.08e-3 * max(float(np.max(terms["input"])) for _, terms in histories.values())
    for axis, (title, (time, terms)) in zip(cells, histories.items(), strict=True):
        every = max(1, time.size // POINTS)  # a filled area keeps all its points in the file
        kept = np.unique(np.append(np.arange(0, time.size, every), time.size - 1))
        below = np.zeros(kept.size)
        for part, (label, color) in PARTS.items():
            above = below + 1e-3 * share(terms, part)[kept]
            axis.fill_between(time[kept], below, above, color=color, lw=0.0, label=label)
            axis.plot(time[kept], above, color="white", lw=0.4)
            below = above
        axis.plot(time[kept], 1e-3 * terms["input"][kept], color=MEAN, lw=0.9, label="input")
        axis.set_title(title, loc="left")
        axis.set_xlim(0.0, float(time[-1]))
        axis.set_ylim(0.0, tallest or 1.0)
    label_outer(cells, COLUMNS, "time (s)", "energy (kJ)")
    handles, labels = cells[0].get_legend_handles_labels()
    legend_below(figure, handles, labels, 5 if len(histories) > 1 else 3)
    return figure


def share(terms: Mapping[str, np.ndarray], part: str) -> np.ndarray:
    """Return a part of `PARTS` over time, (n,) J.

    Args:
        terms: terms of the energy balance over time, (n,) J, by name.
        part: a key of `PARTS`.
    """
    if part != "stored":
        return terms[part]
    return np.asarray(np.sum([terms[name] for name in _STORED], axis=0))


def _numbers(histories: Mapping[str, Energy]) -> str:
    texts = []
    for title, (_, terms) in histories.items():
        final = {term: float(values[-1]) for term, values in terms.items()}
        shares = {
            label: share_of_input(final, final[part])
            for part, (label, _) in PARTS.items()
            if part != "stored" and np.any(terms[part])
        }
        parts = [f"{label} {100.0 * value:.0f} %" for label, value in shares.items() if value is not None]
        numbers = ", ".join([f"input {plain(1e-3 * final['input'])} kJ", *parts])
        texts.append(f"{title}: {numbers}".strip(": "))
    return f"At the end {'; '.join(texts)}."
