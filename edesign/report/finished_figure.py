"""Let matplotlib compute the ticks of a figure that nobody changes any more once for each place of its axes.

To lay a figure out and draw it, matplotlib asks every axis five times over where its ticks are and how large their
labels: for the extent of the axis, for the place of its label, for that of the title. A finished figure answers alike
until its axes move, so that the first answer is kept; the drawing is the same to the last character.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from contextlib import contextmanager
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

_KEPT = ("_update_ticks", "_get_ticklabel_bboxes", "get_tightbbox")
"""Methods of an axis whose answer depends on nothing else than the place of its axes; a version of matplotlib that has
others asks these."""


@contextmanager
def finished(figure: Figure) -> Iterator[None]:
    """Keep the answers of a figure's axes while it is laid out and drawn; nothing of it may be changed meanwhile."""
    kept = [
        (axis, name)
        for axes in figure.axes
        for axis in (axes.xaxis, axes.yaxis)
        for name in _KEPT
        if hasattr(axis, name)
    ]
    for axis, name in kept:
        setattr(axis, name, _keeping(getattr(axis, name), axis.axes))
    try:
        yield
    finally:
        for axis, name in kept:
            delattr(axis, name)


def _keeping(ask: Callable[..., Any], axes: Axes) -> Callable[..., Any]:
    """The method, which is asked again only when the axes stand elsewhere, or for something else."""
    last: Any = None
    answer: Any = None

    def kept(*args: Any, **kwargs: Any) -> Any:
        nonlocal last, answer
        now = (axes.bbox.bounds, kwargs)
        if now != last:
            last, answer = now, ask(*args, **kwargs)
        return answer

    return kept
