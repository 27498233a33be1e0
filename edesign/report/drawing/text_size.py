"""How large a text is before it is drawn, and how it is broken into lines."""

from __future__ import annotations

import re
from functools import lru_cache

INCH = 72.0  # points
_BLANK = re.compile("(?<! =) (?!= )")


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
    """Return a text in lines that are not wider than a room: broken at blanks, and long names after `_` too.

    The value of a symbol, `L_wp = 5 m`, stands on the line of the symbol.

    Args:
        room: width, inches.
        size: of the type, points.
    """
    if text_size(words, size)[0] <= room:
        return [words]
    lines = [""]
    for word in _BLANK.split(words):
        if lines[-1] and text_size(f"{lines[-1]} {word}", size)[0] <= room:
            lines[-1] += f" {word}"
            continue
        parts = [word] if text_size(word, size)[0] <= room else re.findall("[^_]+_?|_", word)
        lines.append("")
        for part in parts:
            if lines[-1] and text_size(lines[-1] + part, size)[0] > room:
                lines.append("")
            lines[-1] += part
    return lines[1:] if lines[0] == "" and len(lines) > 1 else lines
