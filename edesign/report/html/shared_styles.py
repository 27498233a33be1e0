"""The figures of a page share what they have alike."""

from __future__ import annotations

import html
import re

_FIGURE = re.compile(r'<svg viewBox="[^"]*" role="img" aria-labelledby="([^"]+)-title".*?</svg>', re.DOTALL)
_TAG = re.compile(r"<[a-z][^<>]*>")
_STYLE = re.compile(r' style="([^"]*)"')


def share_styles(page: str) -> str:
    """Let the figures of a page share their styles, as classes in its style sheet, and give their parts short names.

    Args:
        page: HTML with figures as `inline_svg` returns them, and a style sheet before them.
    """
    classes: dict[str, str] = {}
    count = 0

    def with_class(style: re.Match[str]) -> str:
        return f' class="{classes.setdefault(style[1], f"v{len(classes)}")}"'

    def shorter(figure: re.Match[str]) -> str:
        nonlocal count
        count += 1
        part, short = re.compile(rf"(?<=[#\"]){re.escape(figure[1])}(?=-\d)"), f"v{count}"
        return _TAG.sub(lambda tag: part.sub(short, _STYLE.sub(with_class, tag[0])), figure[0])

    page = _FIGURE.sub(shorter, page)
    rules = "".join(f".{name}{{{html.unescape(style)}}}\n" for style, name in classes.items())
    return page.replace("</style>", f"{rules}</style>", 1)
