"""A frame model as SAP2000 describes it, in SI: joints, frames with their local axes, links, loads, masses."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field

import numpy as np

from edesign.errors import InputError
from edesign.exchange.sap2000.tables import Row

RELEASES = ("P", "V2", "V3", "T", "M2", "M3")
"""What may be released at an end of a frame, in the order of SAP2000's table."""
DIRECTIONS = ("U1", "U2", "U3", "R1", "R2", "R3")
"""Degrees of a joint, along and about the global axes X, Y, Z."""
Vector = tuple[float, float, float]
Six = tuple[float, float, float, float, float, float]
SixFlags = tuple[bool, bool, bool, bool, bool, bool]
FREE: SixFlags = (False,) * 6
PINNED: SixFlags = (False, False, False, False, True, True)


@dataclass(frozen=True)
class Material:
    """A material; Pa, N/m3, kg/m3. `fy` is None where the file has no data of a steel."""

    name: str
    kind: str
    E: float
    nu: float
    weight: float = 0.0
    density: float = 0.0
    fy: float | None = None
    row: Row | None = None


@dataclass(frozen=True)
class Section:
    """A prismatic section; m.

    Attributes:
        catalogue: name of the section in the file of sections that it comes from, or its own name.
        shape: of SAP2000: `General`, `I/Wide Flange`.
        area: m2.
        J, I33, I22: torsion constant and second moments of area, m4; 3 is the axis of I sections that is strong.
        AS2, AS3: shear areas, m2; 0: no shear deformation.
        depth, width, flange, web: t3, t2, tf, tw; 0: not known.
        equal_flanges: whether both flanges are alike.
        axial_share: factor on the area in the stiffness (`AMod`).
    """

    name: str
    material: str
    area: float
    J: float
    I33: float
    I22: float
    AS2: float = 0.0
    AS3: float = 0.0
    shape: str = "General"
    catalogue: str = ""
    depth: float = 0.0
    width: float = 0.0
    flange: float = 0.0
    web: float = 0.0
    equal_flanges: bool = True
    axial_share: float = 1.0
    row: Row | None = None


@dataclass(frozen=True)
class FrameObject:
    """A straight member from joint `i` to joint `j`.

    Attributes:
        angle: of its local axes about local 1, degrees.
        released: at i and at j, in the order of `RELEASES`.
        springs: of what is released, N/m and N m/rad; 0: nothing holds it.
    """

    name: str
    i: str
    j: str
    section: str
    angle: float = 0.0
    released: tuple[SixFlags, SixFlags] = (FREE, FREE)
    springs: tuple[Six, Six] = ((0.0,) * 6, (0.0,) * 6)
    row: Row | None = None


@dataclass(frozen=True)
class LinkProperty:
    """What a link does along its axis.

    Attributes:
        kind: `Linear` or `Damper - Exponential`.
        stiffness, damping: of a linear link, N/m and N s/m; of a damper in linear cases.
        k, c, exponent: of a damper: spring in series with a dashpot, N/m, N (s/m)^exponent.
        nonlinear: whether `k`, `c` and `exponent` count.
    """

    name: str
    kind: str
    stiffness: float = 0.0
    damping: float = 0.0
    k: float = 0.0
    c: float = 0.0
    exponent: float = 1.0
    nonlinear: bool = False
    row: Row | None = None

    @property
    def stands(self) -> bool:
        """True if it is a spring that carries gravity loads too."""
        return not self.nonlinear and self.stiffness > 0.0


@dataclass(frozen=True)
class Link:
    """A link between two joints."""

    name: str
    i: str
    j: str
    property: str
    row: Row | None = None


@dataclass(frozen=True)
class LoadPattern:
    """A load pattern: its `DesignType`, and the factor of the self weight in it."""

    name: str
    kind: str
    self_weight: float = 0.0
    row: Row | None = None


@dataclass(frozen=True)
class JointLoad:
    """Forces and moments on a joint, global, N and N m."""

    joint: str
    pattern: str
    forces: Six
    row: Row | None = None


@dataclass(frozen=True)
class FrameLoad:
    """A load on a part of a frame, N/m, linear between `start` and `end` (0 to 1), along a global unit vector."""

    frame: str
    pattern: str
    along: Vector
    start: float
    end: float
    at_start: float
    at_end: float
    row: Row | None = None


@dataclass(frozen=True)
class FramePoint:
    """A force in a place (0 to 1) of a frame, N, along a global unit vector."""

    frame: str
    pattern: str
    along: Vector
    at: float
    force: float
    row: Row | None = None


@dataclass(frozen=True)
class MassSource:
    """Where masses come from: of the frames, of the joints, of load patterns with factors."""

    elements: bool = False
    joints: bool = True
    patterns: Mapping[str, float] = field(default_factory=dict)


@dataclass(frozen=True)
class GravityCase:
    """The loads before earthquakes: factors by pattern, and whether their P-Delta effect counts afterwards."""

    factors: Mapping[str, float]
    p_delta: bool


@dataclass(frozen=True)
class SpectrumFunction:
    """A response spectrum: periods in s, accelerations in g, damping ratio."""

    name: str
    periods: np.ndarray
    accelerations: np.ndarray
    damping: float


@dataclass
class Sap2000Model:
    """A model; all values in SI, parts by their names.

    Attributes:
        title: of the project.
        about: further lines of the project information.
        degrees: the active ones, in the order of `DIRECTIONS`.
        diaphragms: joints of each constraint, which is horizontal.
        joint_masses: along X, Y, Z, kg.
    """

    title: str
    about: list[str] = field(default_factory=list)
    degrees: SixFlags = (True,) * 6
    joints: dict[str, Vector] = field(default_factory=dict)
    materials: dict[str, Material] = field(default_factory=dict)
    sections: dict[str, Section] = field(default_factory=dict)
    frames: dict[str, FrameObject] = field(default_factory=dict)
    link_properties: dict[str, LinkProperty] = field(default_factory=dict)
    links: dict[str, Link] = field(default_factory=dict)
    restraints: dict[str, SixFlags] = field(default_factory=dict)
    springs: dict[str, Six] = field(default_factory=dict)
    diaphragms: dict[str, list[str]] = field(default_factory=dict)
    patterns: dict[str, LoadPattern] = field(default_factory=dict)
    joint_loads: list[JointLoad] = field(default_factory=list)
    frame_loads: list[FrameLoad] = field(default_factory=list)
    frame_points: list[FramePoint] = field(default_factory=list)
    joint_masses: dict[str, Vector] = field(default_factory=dict)
    mass_source: MassSource = MassSource()
    gravity: GravityCase | None = None
    spectra: list[SpectrumFunction] = field(default_factory=list)
    rows: dict[tuple[str, str], Row] = field(default_factory=dict)

    def length(self, frame: FrameObject) -> float:
        """Return the length of a frame, m."""
        return float(np.linalg.norm(np.subtract(self.joints[frame.j], self.joints[frame.i])))

    def axes(self, frame: FrameObject) -> np.ndarray:
        """Return the local axes 1, 2, 3 of a frame as rows of global components, (3, 3).

        Source: CSI Analysis Reference Manual, frame element, local coordinate system: the plane 1-2 is vertical and 2
            points upwards; of a vertical frame 2 is global X. Both are then turned about 1 by the angle.
        """
        return local_axes(self.joints[frame.i], self.joints[frame.j], frame.angle)

    def standing_links(self) -> str:
        """Names of the links that carry gravity loads, for a sentence; "": there are none."""
        return ", ".join(link.name for link in self.links.values() if self.link_properties[link.property].stands)

    def error(self, kind: str, name: str, message: str) -> InputError:
        """Return an error about a part: `joint`, `frame`, `link`, `section`."""
        row = self.rows.get((kind, name))
        message = f"{kind} {name}: {message}"
        return InputError(message) if row is None else row.error(message)


def local_axes(i: Vector, j: Vector, angle: float) -> np.ndarray:
    """Return the local axes of a frame or link between two places, see `Sap2000Model.axes`."""
    one = np.subtract(j, i)
    one = one / np.linalg.norm(one)
    level = float(np.hypot(one[0], one[1]))
    if level < 1e-3:  # SAP2000 takes a frame as vertical from here on
        two = np.array([1.0, 0.0, 0.0])
    else:
        two = np.array([0.0, 0.0, 1.0])
    two = two - (two @ one) * one
    two /= np.linalg.norm(two)
    three = np.cross(one, two)
    turn = np.deg2rad(angle)
    cos, sin = round(float(np.cos(turn)), 15), round(float(np.sin(turn)), 15)
    return np.array([one, cos * two + sin * three, cos * three - sin * two])
