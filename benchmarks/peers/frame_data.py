"""A regular plane steel moment frame as plain numbers, known neither to edesign nor to any peer program.

Verification and benchmarks describe a frame once here and hand it to both sides. Values are in SI units
(m, N, kg, Pa).
"""

from __future__ import annotations

from dataclasses import dataclass

FIBRES_FLANGE_THICKNESS = 4
MENEGOTTO_PINTO = (20.0, 0.925, 0.15)  # R0, cR1, cR2
FIBRES_WEB_HEIGHT = 16


@dataclass(frozen=True)
class ISection:
    """Doubly symmetric I section of three rectangles (no fillets), bent about its strong axis.

    name: label; h: overall depth, m; b: flange width, m; tw: web thickness, m; tf: flange thickness, m.
    """

    name: str
    h: float
    b: float
    tw: float
    tf: float

    @property
    def area(self) -> float:
        """Area, m2."""
        return 2.0 * self.b * self.tf + self.tw * (self.h - 2.0 * self.tf)

    @property
    def inertia(self) -> float:
        """Second moment of area about the strong axis, exact for the three rectangles, m4."""
        hw = self.h - 2.0 * self.tf
        return (self.b * self.h**3 - (self.b - self.tw) * hw**3) / 12.0

    def layers(
        self, flange: int = FIBRES_FLANGE_THICKNESS, web: int = FIBRES_WEB_HEIGHT
    ) -> tuple[tuple[float, ...], tuple[float, ...]]:
        """Depths (m) and areas (m2) of the layers, bottom to top.

        In plane bending all fibres at one depth share one strain, so fibres across a flange's width or a web's
        thickness are one layer: `flange` layers in each flange and `web` in the web.
        """
        hw = self.h - 2.0 * self.tf
        plates = (
            (-0.5 * self.h, self.tf, self.b, flange),
            (-0.5 * hw, hw, self.tw, web),
            (0.5 * hw, self.tf, self.b, flange),
        )
        depths = tuple(y0 + (i + 0.5) * d / n for y0, d, _, n in plates for i in range(n))
        areas = tuple(width * d / n for _, d, width, n in plates for _ in range(n))
        return depths, areas


@dataclass(frozen=True)
class PeerFrame:
    """Regular plane frame with fixed bases and centreline members.

    bay_widths: (n_bays,), m; storey_heights: (n_storeys,), m; columns: section of each storey, (n_storeys,);
    beams: section of each floor from 1, (n_storeys,); masses: horizontal nodal mass of each line, alike on
    all floors, (n_bays + 1,), kg; gravity: line load on all beams, downwards, N/m; E: Pa; fy: Pa;
    hardening: ratio; flange_fibres, web_fibres: (across the plate's other side, through the section's depth);
    points: Gauss-Lobatto points of a member.
    """

    title: str
    bay_widths: tuple[float, ...]
    storey_heights: tuple[float, ...]
    columns: tuple[ISection, ...]
    beams: tuple[ISection, ...]
    masses: tuple[float, ...]
    gravity: float
    E: float = 210e9
    fy: float = 275e6
    hardening: float = 0.0
    flange_fibres: tuple[int, int] = (16, FIBRES_FLANGE_THICKNESS)
    web_fibres: tuple[int, int] = (2, FIBRES_WEB_HEIGHT)
    points: int = 5

    def __post_init__(self) -> None:
        if not len(self.storey_heights) == len(self.columns) == len(self.beams):
            raise ValueError("one column and one beam section is needed for each storey")
        if len(self.masses) != len(self.bay_widths) + 1:
            raise ValueError("one mass is needed for each column line")

    @property
    def n_bays(self) -> int:
        """Number of bays."""
        return len(self.bay_widths)

    @property
    def n_storeys(self) -> int:
        """Number of storeys."""
        return len(self.storey_heights)

    @property
    def n_lines(self) -> int:
        """Number of column lines."""
        return len(self.bay_widths) + 1

    @property
    def n_members(self) -> int:
        """Number of columns and beams."""
        return self.n_storeys * (self.n_lines + self.n_bays)

    @property
    def height(self) -> float:
        """Height of the roof over the base, m."""
        return float(sum(self.storey_heights))

    @property
    def x(self) -> tuple[float, ...]:
        """Coordinates of the lines, (n_lines,), m."""
        return tuple(float(sum(self.bay_widths[:i])) for i in range(self.n_lines))

    @property
    def y(self) -> tuple[float, ...]:
        """Levels of the floors from the base up, (n_storeys + 1,), m."""
        return tuple(float(sum(self.storey_heights[:i])) for i in range(self.n_storeys + 1))


# Dimensions of the profiles by EN 10365, mm -> m
HEB450 = ISection("HEB450", 0.450, 0.300, 0.0140, 0.0260)
HEB360 = ISection("HEB360", 0.360, 0.300, 0.0125, 0.0225)
HEB320 = ISection("HEB320", 0.320, 0.300, 0.0115, 0.0205)
IPE450 = ISection("IPE450", 0.450, 0.190, 0.0094, 0.0146)
IPE400 = ISection("IPE400", 0.400, 0.180, 0.0086, 0.0135)
IPE360 = ISection("IPE360", 0.360, 0.170, 0.0080, 0.0127)

THESIS_DEAD = 23.0e3  # N/m
THESIS_LIVE = 9.6e3  # N/m
MASS_INTERIOR = 29.5e3  # kg
MASS_CORNER = 19.35e3  # kg


def _masses(bays: int) -> tuple[float, ...]:
    return (MASS_CORNER, *(MASS_INTERIOR for _ in range(bays - 1)), MASS_CORNER)


def thesis_frame(bays: int = 4) -> PeerFrame:
    """Ten-storey interior frame of the thesis: Table 5.2 (X axis), loads and masses of sections 5.2 and 5.3.2.

    bays: 3 or 4, the two readings of the plan.
    """
    return PeerFrame(
        title=f"thesis frame, 10 storeys, {bays} bays",
        bay_widths=(7.2,) * bays,
        storey_heights=(3.5,) * 10,
        columns=(HEB450,) * 4 + (HEB360,) * 3 + (HEB320,) * 3,
        beams=(IPE450,) * 4 + (IPE400,) * 3 + (IPE360,) * 3,
        masses=_masses(bays),
        gravity=THESIS_DEAD + 0.3 * THESIS_LIVE,
    )


# Built-up and rolled sections of the tall frame; the rolled ones by EN 10365, mm -> m
HEM600 = ISection("HEM600", 0.620, 0.305, 0.0210, 0.0400)
HEM1000 = ISection("HEM1000", 1.008, 0.302, 0.0210, 0.0400)
HEB400 = ISection("HEB400", 0.400, 0.300, 0.0135, 0.0240)
HEB500 = ISection("HEB500", 0.500, 0.300, 0.0145, 0.0280)
HEB600 = ISection("HEB600", 0.600, 0.300, 0.0155, 0.0300)
COLUMN_1000X500X60 = ISection("C1000x500x30x60", 1.000, 0.500, 0.0300, 0.0600)
COLUMN_1000X600X80 = ISection("C1000x600x40x80", 1.000, 0.600, 0.0400, 0.0800)
COLUMN_1200X700X100 = ISection("C1200x700x60x100", 1.200, 0.700, 0.0600, 0.1000)
COLUMN_1400X800X120 = ISection("C1400x800x70x120", 1.400, 0.800, 0.0700, 0.1200)

# Storeys carried (the own one included) up to which a section is used
_TALL_COLUMNS = (
    (10, HEM600),
    (20, HEM1000),
    (30, COLUMN_1000X500X60),
    (40, COLUMN_1000X600X80),
    (60, COLUMN_1200X700X100),
    (1000, COLUMN_1400X800X120),
)
_TALL_BEAMS = ((10, HEB400), (25, HEB500), (1000, HEB600))


def _by_storeys_carried(table: tuple[tuple[int, ISection], ...], carried: int) -> ISection:
    return next(section for limit, section in table if carried <= limit)


def tall_frame(storeys: int = 40, bays: int = 8) -> PeerFrame:
    """A frame of any height with the thesis frame's bays, storeys, loads and masses.

    Members grow with the storeys they carry: columns stay below a third of their squash load under gravity up to
    80 storeys; under El Centro at 0.414 g the upper storeys yield (40 storeys, 3 bays: 1.4 % drift). Not a design.
    """
    carried = range(storeys, 0, -1)
    return PeerFrame(
        title=f"tall frame, {storeys} storeys, {bays} bays",
        bay_widths=(7.2,) * bays,
        storey_heights=(3.5,) * storeys,
        columns=tuple(_by_storeys_carried(_TALL_COLUMNS, n) for n in carried),
        beams=tuple(_by_storeys_carried(_TALL_BEAMS, n) for n in carried),
        masses=_masses(bays),
        gravity=THESIS_DEAD + 0.3 * THESIS_LIVE,
    )
