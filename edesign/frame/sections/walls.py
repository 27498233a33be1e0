"""The rectangles of I sections and of hollow sections in their plane, y across the web and z along it."""

from __future__ import annotations

from dataclasses import dataclass

from edesign.errors import InputError


@dataclass(frozen=True)
class Wall:
    """A rectangle of a section: `width` along y, `depth` along z, and the place of its centre from the centroid; m."""

    width: float
    depth: float
    y: float = 0.0
    z: float = 0.0


def i_walls(height: float, width: float, flange: float, web: float, radius: float = 0.0) -> tuple[Wall, Wall, Wall]:
    """Return the lower flange, the web and the upper flange of a doubly symmetric I section.

    Args:
        height: overall, m.
        width: of the flanges, m.
        flange: thickness of a flange, m.
        web: thickness of the web, m.
        radius: of the fillets, which are no part of the walls but need room between them, m.

    Raises:
        InputError: the flanges leave no web, the web is wider than the flange, or the fillets do not fit.
    """
    clear = height - 2.0 * flange
    if clear <= 0.0:
        raise InputError(f"two flanges of {flange:g} m leave no web in a height of {height:g} m [E-SECT-04]")
    if web > width:
        raise InputError(f"the web ({web:g} m) is thicker than the flange is wide ({width:g} m) [E-SECT-04]")
    if radius < 0.0 or 2.0 * radius > clear or 2.0 * radius + web > width:
        raise InputError(f"fillets of radius {radius:g} m do not fit between web and flanges [E-SECT-04]")
    arm = 0.5 * (height - flange)
    return Wall(width, flange, z=-arm), Wall(web, clear), Wall(width, flange, z=arm)


def hollow_walls(depth: float, width: float, t: float, r_o: float) -> tuple[tuple[Wall, ...], tuple[Wall, ...]]:
    """Return the flat walls of a rectangular hollow section along y, and those along z, between the corners.

    Args:
        depth: of the section, along z, m.
        width: of the section, along y, m.
        t: thickness of the wall, m.
        r_o: outer radius of the corners, m.

    Returns:
        The walls below and above, and those left and right; none where the corners leave no flat.
    """
    flat, clear = width - 2.0 * r_o, depth - 2.0 * r_o
    along_y = tuple(Wall(flat, t, z=side * 0.5 * (depth - t)) for side in (-1.0, 1.0) if flat > 0.0)
    along_z = tuple(Wall(t, clear, y=side * 0.5 * (width - t)) for side in (-1.0, 1.0) if clear > 0.0)
    return along_y, along_z
