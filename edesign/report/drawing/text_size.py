"""How large a text is before it is drawn, and how it is broken into lines."""

from __future__ import annotations

import textwrap
from functools import lru_cache

INCH = 72.0  # points


@lru_cache(maxsize=4096)
def text_size(words: str, size: float) -> tuple[float, float]:
    """Return width and height of a line of text, inches.

    Args:
        size: of the type, points.
    """
    from matplotlib.backend_bases import RendererBase
    from matplotlib.font_manager import FontProperties

    font, renderer = FontProperties(size=size), RendererBase()
    wide, _, _ = renderer.get_text_width_height_descent(words, font, False)
    _, high, _ = renderer.get_text_width_height_descent("lp", font, False)
    return wide / INCH, high / INCH


def wrapped(words: str, room: float, size: float) -> list[str]:
    """Return a text in lines that are not wider than a room.

    Args:
        room: width, inches.
        size: of the type, points.
    """
    wide = text_size(words, size)[0]
    if wide <= room:
        return [words]
    for letters in range(int(len(words) * room / wide * 1.15), 8, -2):
        lines = textwrap.wrap(words, letters)
        if all(text_size(line, size)[0] <= room for line in lines):
            return lines
    return [words]
