"""Texts of figures as WeasyPrint sets them without loss: from their beginning, wherever they are aligned."""

from __future__ import annotations

import html
import re

from edesign.report.pdf.fit import text_width

_TEXT = re.compile(r"<text ([^>]*)>(.*?)</text>", re.DOTALL)
_ANCHOR = re.compile(r"text-anchor:(middle|end);?")
_SIZE = re.compile(r"font-size:([\d.]+)px")
_INDEX = re.compile(r'<tspan[^>]*font-size="75%">(.*?)</tspan>')
_TAG = re.compile(r"<[^>]*>")
_PLACE = re.compile(r'\bx="(-?[\d.]+)"')


def begun_at_left(text: str) -> str:
    """Return a page whose figures have no text that is aligned at its middle or end; all stand where they stood.

    WeasyPrint draws a text with another anchor than its start as a picture of its own, of which viewers of PDF cut the
    first letter ("PE400"). The fonts are those that the figures were laid out with, so widths are known.

    Args:
        text: the page, as HTML.
    """
    return _TEXT.sub(_begun, text)


def _begun(found: re.Match[str]) -> str:
    attributes, content = found.groups()
    anchor, size = _ANCHOR.search(attributes), _SIZE.search(attributes)
    if anchor is None or size is None:
        return found[0]
    bold = "font-weight:bold" in attributes or "font-weight:700" in attributes
    indices = "".join(_INDEX.findall(content))
    words = (_plain(_INDEX.sub("", content)), _plain(indices))
    width = float(size[1]) * sum(share * text_width(part, bold) for part, share in zip(words, (1.0, 0.75), strict=True))
    back = 0.5 * width if anchor[1] == "middle" else width
    attributes = _ANCHOR.sub("", attributes)
    if _PLACE.search(attributes):
        attributes = _PLACE.sub(lambda place: f'x="{float(place[1]) - back:.0f}"', attributes, count=1)
    else:  # turned about its anchor
        attributes = f'x="{-back:.0f}" {attributes}'
    return f"<text {attributes}>{content}</text>"


def _plain(content: str) -> str:
    return html.unescape(_TAG.sub("", content)).replace("\N{ZERO WIDTH SPACE}", "")
