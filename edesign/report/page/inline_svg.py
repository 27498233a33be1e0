"""An SVG file of matplotlib as an element of an HTML page: small, without clashes, readable to all."""

from __future__ import annotations

import html
import re
import xml.etree.ElementTree as ElementTree

import numpy as np

from edesign.report.thin_out import thin_out

TOLERANCE = 0.2  # points (1/72 inch); with roundings half a pixel, as the page shows a point as 1.24 pixels
MANY = 12  # vertices, from which a curve is thinned out
_LINK = "{http://www.w3.org/1999/xlink}href"
_NUMBER = r"[-+]?(?:\d+\.?\d*|\.\d+)(?:[eE][-+]?\d+)?"
_LONG_NUMBER = re.compile(r"-?\d+\.\d{3,}(?:[eE][-+]?\d+)?")
_REFERENCE = re.compile(r"url\(#([^)]+)\)")
_FONT_FAMILY = re.compile(r"font-family:[^;]*;?\s*")  # the page's own, which are narrower than that of the drawing
_NO_ROTATION = re.compile(r"\s*rotate\(-?0 [^)]*\)")
_FIGURE = re.compile(r'<svg viewBox="[^"]*" role="img" aria-labelledby="([^"]+)-title".*?</svg>', re.DOTALL)
_TAG = re.compile(r"<[a-z][^<>]*>")
_STYLE = re.compile(r' style="([^"]*)"')
_ROUNDED = ("x", "y", "width", "height", "transform", "style", "d", "points", "cx", "cy", "r")


def inline_svg(text: str, name: str, title: str, description: str = "") -> tuple[str, float]:
    """Make an SVG file fit to stand in a page with others.

    Header, metadata and the file's own style sheet, which would rule the whole page, are taken out; names of elements
    begin with `name`; curves lose the points that nobody can see; coordinates are rounded to 0.01 points, those of
    curves to 0.1.

    Args:
        text: the file, as matplotlib writes it.
        name: unique on the page, letters, digits, `_`, `-`, `.`.
        title, description: for those who cannot see the figure.

    Returns:
        The element, and its width in points.
    """
    root = ElementTree.fromstring(text)
    for child in [child for child in root if _tag(child) in ("metadata", "title", "desc")]:
        root.remove(child)
    _drop_styles(root)
    box = [float(value) for value in root.attrib["viewBox"].split()]
    _unique_names(root, name)
    for element in root.iter():
        element.tag = _tag(element)  # inside a page the names need no name space
        _lighten(element)
    _unwrap(root)
    root.attrib = {"viewBox": root.attrib["viewBox"], "role": "img", "aria-labelledby": f"{name}-title"}
    if description:
        root.attrib["aria-describedby"] = f"{name}-desc"
        _label(root, "desc", f"{name}-desc", description)
    _label(root, "title", f"{name}-title", title)
    found = ElementTree.tostring(root, encoding="unicode")
    return re.sub(r">\s+<", "><", found).replace(" />", "/>"), box[2]


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


def _unwrap(element: ElementTree.Element) -> None:
    """Take out groups that say nothing of what is in them."""
    children: list[ElementTree.Element] = []
    for child in element:
        _unwrap(child)
        children += list(child) if child.tag == "g" and not child.attrib else [child]
    element[:] = children


def _tag(element: ElementTree.Element) -> str:
    return element.tag.rpartition("}")[2]


def _label(root: ElementTree.Element, tag: str, name: str, text: str) -> None:
    label = ElementTree.Element(tag, {"id": name})
    label.text = text
    root.insert(0, label)


def _drop_styles(root: ElementTree.Element) -> None:
    for parent in list(root.iter()):
        for child in [child for child in parent if _tag(child) == "style"]:
            parent.remove(child)


def _unique_names(root: ElementTree.Element, prefix: str) -> None:
    """Number the elements that others refer to, and take the names of all the others away."""
    used: dict[str, str] = {}

    def new(old: str) -> str:
        return used.setdefault(old, f"{prefix}-{len(used)}")

    for element in root.iter():
        link = element.attrib.pop(_LINK, None) or element.attrib.get("href")
        if link and link.startswith("#"):
            element.attrib["href"] = "#" + new(link[1:])
        for key, value in element.attrib.items():
            if "url(#" in value:
                element.attrib[key] = _REFERENCE.sub(lambda found: f"url(#{new(found[1])})", value)
    for element in root.iter():
        name = element.attrib.pop("id", None)
        if name in used:
            element.attrib["id"] = used[name]


def _lighten(element: ElementTree.Element) -> None:
    if "d" in element.attrib:
        element.attrib["d"] = _thinner(element.attrib["d"])
    for key in _ROUNDED:
        if key in element.attrib:
            element.attrib[key] = _LONG_NUMBER.sub(_rounded, element.attrib[key])
    if "style" in element.attrib:
        style = _FONT_FAMILY.sub("", element.attrib["style"])
        element.attrib["style"] = style.replace("; ", ";").replace(": ", ":")
    if "transform" in element.attrib:
        element.attrib["transform"] = _NO_ROTATION.sub("", element.attrib["transform"])
        if not element.attrib["transform"]:
            del element.attrib["transform"]


def _rounded(found: re.Match[str]) -> str:
    return _short(float(found[0]))


def _short(value: float) -> str:
    text = f"{value:.2f}".rstrip("0").rstrip(".")
    return "0" if text in ("-0", "") else text


def _thinner(path: str) -> str:
    """A path of straight lines without its invisible points, in steps from point to point; other paths as they are."""
    if set(re.findall(r"[A-Za-z]", path)) - set("MLze"):
        return path
    pieces = []
    for piece in path.replace("\n", " ").split("M")[1:]:
        closed = piece.rstrip().endswith("z")
        numbers = np.array(re.findall(_NUMBER, piece), dtype=float).reshape(-1, 2)
        digits = 2
        if len(numbers) >= MANY:
            numbers, digits = thin_out(numbers, TOLERANCE), 1
        pieces.append(_steps(numbers, digits) + ("z" if closed else ""))
    return "".join(pieces)


def _steps(points: np.ndarray, digits: int) -> str:
    """Relative coordinates are shorter; they are differences of rounded ones, so errors do not add up."""
    hundredths = 10 ** (2 - digits) * np.rint(10**digits * points).astype(int)
    first = f"M{_short(hundredths[0, 0] / 100)} {_short(hundredths[0, 1] / 100)}"
    steps = np.diff(hundredths, axis=0)
    return first + "".join(
        f"l{_hundredth(x)}{_hundredth(y) if y < 0 else ' ' + _hundredth(y)}" for x, y in steps.tolist()
    )


def _hundredth(value: int) -> str:
    sign, size = ("-" if value < 0 else ""), abs(value)
    whole, rest = divmod(size, 100)
    if not rest:
        return f"{sign}{whole}"
    return f"{sign}{whole or ''}.{rest:02d}".rstrip("0")
