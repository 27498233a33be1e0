"""Beams under uniform and point loads against closed forms of elastic bending (e.g. Roark, table 8.1).

One member is exact: the elastic section in closed form, the force-based member because Gauss-Lobatto integrates the
polynomials of its bending moments. Tolerance 1e-11: only rounding of a few hundred operations is allowed for.
"""

from __future__ import annotations

import pytest
from verification.structures import FY, E, Structure, channel, final, i_layers, plastic_moment

from edesign.core import Bilinear, CoreError, Elastic, Model

L = 6.0
W = -25e3  # N/m, downwards
P = -80e3  # N
ROUNDING = 1e-11


def beam(
    kind: str,
    fix_i: tuple[bool, bool, bool],
    fix_j: tuple[bool, bool, bool],
    n: int = 1,
    release: tuple[bool, bool] = (False, False),
    breaks: tuple[float, ...] = (),
) -> tuple[Structure, float]:
    """A beam of n members with its EI; kind "elastic" or "force"."""
    m = Model()
    y, area = i_layers(4, 16)
    EI = E * float(area @ y**2)
    section = (
        m.elastic_section(E * float(area.sum()), EI)
        if kind == "elastic"
        else m.fibre_section(y, area, m.material(Elastic(E)))
    )
    nodes = [m.node(f"N{k}", L * k / n, 0.0) for k in range(n + 1)]
    elements = [
        m.beam_column(
            f"B{k}",
            nodes[k],
            nodes[k + 1],
            section,
            geometry="linear",
            release=(release[0] and k == 0, release[1] and k == n - 1),
            breaks=breaks,
        )
        for k in range(n)
    ]
    m.fix(nodes[0], *fix_i)
    m.fix(nodes[-1], *fix_j)
    return Structure(m, nodes, elements, m.pattern()), EI


KINDS = ["elastic", "force"]
PIN, ROLLER, CLAMP, GUIDED = (True, True, False), (False, True, False), (True, True, True), (False, True, True)


@pytest.mark.parametrize("kind", KINDS)
def test_simply_supported_uniform(kind: str) -> None:
    b, EI = beam(kind, PIN, ROLLER)
    b.model.uniform_load(b.pattern, b.elements[0], transverse=W)
    i, j = b.nodes
    got = final(
        b,
        [
            channel("displacement", i, 2, "ri"),
            channel("displacement", j, 2, "rj"),
            channel("reaction", i, 1, "vi"),
            channel("reaction", j, 1, "vj"),
            channel("end_force", b.elements[0], 2, "mi"),
            channel("end_force", b.elements[0], 5, "mj"),
        ],
    )
    assert got["ri"] == pytest.approx(W * L**3 / (24 * EI), rel=ROUNDING)
    assert got["rj"] == pytest.approx(-W * L**3 / (24 * EI), rel=ROUNDING)
    assert got["vi"] == pytest.approx(-W * L / 2, rel=ROUNDING)
    assert got["vj"] == pytest.approx(-W * L / 2, rel=ROUNDING)
    assert abs(got["mi"]) + abs(got["mj"]) < ROUNDING * abs(W) * L**2


@pytest.mark.parametrize("kind", KINDS)
def test_midspan_deflection_of_two_members(kind: str) -> None:
    b, EI = beam(kind, PIN, ROLLER, n=2)
    for element in b.elements:
        b.model.uniform_load(b.pattern, element, transverse=W)
    got = final(b, [channel("displacement", b.nodes[1], 1, "u"), channel("end_force", b.elements[0], 5, "m")])
    assert got["u"] == pytest.approx(5 * W * L**4 / (384 * EI), rel=ROUNDING)
    assert abs(got["m"]) == pytest.approx(-W * L**2 / 8, rel=ROUNDING)


@pytest.mark.parametrize("kind", KINDS)
def test_fixed_uniform(kind: str) -> None:
    """Clamped at both ends, one member: only the axial degree is free."""
    b, _ = beam(kind, CLAMP, GUIDED)
    b.model.uniform_load(b.pattern, b.elements[0], transverse=W)
    got = final(
        b,
        [
            channel("reaction", b.nodes[0], 2, "mi"),
            channel("reaction", b.nodes[1], 2, "mj"),
            channel("reaction", b.nodes[0], 1, "vi"),
        ],
    )
    assert got["mi"] == pytest.approx(-W * L**2 / 12, rel=ROUNDING)
    assert got["mj"] == pytest.approx(W * L**2 / 12, rel=ROUNDING)
    assert got["vi"] == pytest.approx(-W * L / 2, rel=ROUNDING)


@pytest.mark.parametrize("kind", KINDS)
def test_propped_uniform(kind: str) -> None:
    b, EI = beam(kind, CLAMP, ROLLER)
    b.model.uniform_load(b.pattern, b.elements[0], transverse=W)
    got = final(
        b,
        [
            channel("reaction", b.nodes[0], 2, "mi"),
            channel("reaction", b.nodes[1], 1, "vj"),
            channel("displacement", b.nodes[1], 2, "rj"),
        ],
    )
    assert got["mi"] == pytest.approx(-W * L**2 / 8, rel=ROUNDING)
    assert got["vj"] == pytest.approx(-3 * W * L / 8, rel=ROUNDING)
    assert got["rj"] == pytest.approx(-W * L**3 / (48 * EI), rel=ROUNDING)


@pytest.mark.parametrize("kind", KINDS)
@pytest.mark.parametrize("end", [0, 1])
def test_release_makes_a_propped_beam(kind: str, end: int) -> None:
    """Clamped at both supports, one end released: the propped beam again; the node beyond the hinge does not turn."""
    b, _ = beam(kind, CLAMP, GUIDED, release=(end == 0, end == 1))
    b.model.uniform_load(b.pattern, b.elements[0], transverse=W)
    got = final(b, [channel("end_force", b.elements[0], 2, "mi"), channel("end_force", b.elements[0], 5, "mj")])
    hinge, clamp = (got["mi"], got["mj"]) if end == 0 else (got["mj"], got["mi"])
    assert abs(hinge) < ROUNDING * abs(W) * L**2
    assert abs(clamp) == pytest.approx(-W * L**2 / 8, rel=ROUNDING)


@pytest.mark.parametrize("kind", KINDS)
def test_both_ends_released(kind: str) -> None:
    b, _ = beam(kind, CLAMP, GUIDED, n=1, release=(True, True))
    b.model.uniform_load(b.pattern, b.elements[0], transverse=W)
    got = final(
        b,
        [
            channel("reaction", b.nodes[0], 2, "mi"),
            channel("reaction", b.nodes[0], 1, "vi"),
            channel("reaction", b.nodes[1], 1, "vj"),
        ],
    )
    assert abs(got["mi"]) < ROUNDING * abs(W) * L**2
    assert got["vi"] == pytest.approx(-W * L / 2, rel=ROUNDING)
    assert got["vj"] == pytest.approx(-W * L / 2, rel=ROUNDING)


def test_plastic_rotation_of_an_elastic_beam_with_a_hinge_is_zero() -> None:
    """A released end turns, but nothing yields."""
    m = Model()
    y, area = i_layers(4, 16)
    section = m.fibre_section(y, area, m.material(Bilinear(E, FY)))
    nodes = [m.node(f"N{k}", L * k / 2, 0.0) for k in range(3)]
    elements = [
        m.beam_column(f"B{k}", nodes[k], nodes[k + 1], section, geometry="linear", release=(False, k == 0))
        for k in range(2)
    ]
    m.fix(nodes[0], *CLAMP)
    m.fix(nodes[2], *CLAMP)
    b = Structure(m, nodes, elements, m.pattern())
    m.nodal_load(b.pattern, nodes[1], fy=P / 4)
    got = final(b, [channel("plastic_rotation", e, k) for e in elements for k in range(2)])
    assert max(map(abs, got.values())) < 1e-12  # rad, of chord rotations of some 1e-3


@pytest.mark.parametrize("kind", KINDS)
@pytest.mark.parametrize("position", [0.0, 0.2, 0.5, 0.83, 1.0])
def test_fixed_beam_point_load(kind: str, position: float) -> None:
    """Fixed-end moments P a b^2 / L^2 and P a^2 b / L^2 at any position; layers are integrated up to it."""
    b, _ = beam(kind, CLAMP, GUIDED, breaks=(position,) if kind == "force" and 0.0 < position < 1.0 else ())
    b.model.point_load(b.pattern, b.elements[0], position, transverse=P)
    got = final(
        b,
        [
            channel("reaction", b.nodes[0], 2, "mi"),
            channel("reaction", b.nodes[1], 2, "mj"),
            channel("reaction", b.nodes[0], 1, "vi"),
            channel("reaction", b.nodes[1], 1, "vj"),
        ],
    )
    a, c = position * L, (1 - position) * L
    scale = abs(P) * L * ROUNDING
    assert got["mi"] == pytest.approx(-P * a * c**2 / L**2, abs=scale)
    assert got["mj"] == pytest.approx(P * a**2 * c / L**2, abs=scale)
    assert got["vi"] == pytest.approx(-P * c**2 * (3 * a + c) / L**3, abs=scale)
    assert got["vj"] == pytest.approx(-P * a**2 * (a + 3 * c) / L**3, abs=scale)


@pytest.mark.parametrize("kind", KINDS)
@pytest.mark.parametrize(
    ("start", "end", "at_start", "at_end", "moment_i", "moment_j"),
    [
        (0.0, 1.0, 1.0, 1.0, 1 / 12, 1 / 12),
        (0.0, 1.0, 0.0, 1.0, 1 / 30, 1 / 20),
        (0.0, 0.5, 1.0, 1.0, 11 / 192, 5 / 192),
        (0.25, 0.75, 1.0, 1.0, 11 / 192, 11 / 192),
        (0.0, 0.5, 0.0, 1.0, 1 / 30, 3 / 160),
    ],
)
def test_fixed_beam_partial_load(
    kind: str, start: float, end: float, at_start: float, at_end: float, moment_i: float, moment_j: float
) -> None:
    """Fixed-end moments over w L^2 of partial and triangular loads: integrals of w x (1 - x)^2 and w x^2 (1 - x)."""
    inside = tuple(at for at in (start, end) if 0.0 < at < 1.0)
    b, _ = beam(kind, CLAMP, GUIDED, breaks=inside if kind == "force" else ())
    b.model.partial_load(b.pattern, b.elements[0], start, end, W * at_start, W * at_end)
    ends = [channel("reaction", b.nodes[k], d, f"{k}{d}") for k in (0, 1) for d in (1, 2)]
    got = final(b, ends)
    total, about_i = _resultant(start, end, W * at_start, W * at_end)
    assert got["02"] == pytest.approx(-moment_i * W * L**2, rel=ROUNDING)
    assert got["12"] == pytest.approx(moment_j * W * L**2, rel=ROUNDING)
    assert got["01"] + got["11"] == pytest.approx(-total, rel=ROUNDING)
    assert got["02"] + got["12"] + got["11"] * L == pytest.approx(-about_i, rel=ROUNDING)


def _resultant(start: float, end: float, at_start: float, at_end: float) -> tuple[float, float]:
    """Sum of a linear load and its moment about the beam's start: a rectangle and a triangle."""
    a, part = start * L, (end - start) * L
    rectangle, triangle = at_start * part, 0.5 * (at_end - at_start) * part
    return rectangle + triangle, rectangle * (a + part / 2) + triangle * (a + 2 * part / 3)


@pytest.mark.parametrize("position", [1 / 3, 0.6])
def test_fixed_beam_collapses_under_a_point_load(position: float) -> None:
    """Three hinges, one of them under the load: P a b / L = 2 M_p. Without a break the third has no place to form.

    A static run up to the load p P_c ends where equilibrium is lost; 0.1 % on each side of the collapse load.
    """
    y, area = i_layers(4, 16)
    largest = 2.0 * plastic_moment(y, area) / (position * (1.0 - position) * L)
    status = {}
    for share in (0.999, 1.001):
        m = Model()
        section = m.fibre_section(y, area, m.material(Bilinear(E, FY)))
        nodes = [m.node("i", 0.0, 0.0), m.node("j", L, 0.0)]
        element = m.beam_column("e", *nodes, section, geometry="linear", breaks=(position,))
        m.fix(nodes[0], *CLAMP)
        m.fix(nodes[1], *GUIDED)
        g = m.pattern()
        m.point_load(g, element, position, transverse=-share * largest)
        status[share] = Structure(m, nodes, [element], g).analysis().static(g, 1.0, steps=20).status
    assert status[0.999] == "completed"
    assert status[1.001] != "completed"


def test_breaks_are_checked() -> None:
    """Breaks rise inside the member, and there is room for the points of all pieces."""
    for breaks in ((0.0,), (0.6, 0.4), (1.0,), tuple(k / 40 for k in range(1, 40))):
        with pytest.raises(CoreError, match="break"):
            beam("force", CLAMP, GUIDED, breaks=breaks)


def test_point_load_on_a_force_based_member_is_in_equilibrium() -> None:
    """Quadrature of a kinked moment is approximate, equilibrium is not: reactions and the moments at the sections."""
    b, _ = beam("force", CLAMP, ROLLER)
    b.model.point_load(b.pattern, b.elements[0], 0.3, transverse=P)
    got = final(
        b,
        [
            channel("reaction", b.nodes[0], 1, "vi"),
            channel("reaction", b.nodes[1], 1, "vj"),
            channel("reaction", b.nodes[0], 2, "mi"),
            channel("section_force", b.elements[0], 2 * 2 + 1, "mid"),
        ],
    )
    assert got["vi"] + got["vj"] == pytest.approx(-P, rel=ROUNDING)
    assert got["mi"] + got["vj"] * L == pytest.approx(-P * 0.3 * L, rel=ROUNDING)
    assert got["mid"] == pytest.approx(got["vj"] * L / 2, rel=ROUNDING)  # sagging right of the load


@pytest.mark.parametrize("kind", KINDS)
def test_axial_loads_along_a_bar(kind: str) -> None:
    """Elongation w L^2 / 2 EA of a bar fixed at i under a load along it."""
    b, _ = beam(kind, CLAMP, GUIDED)
    b.model.uniform_load(b.pattern, b.elements[0], axial=1e5)
    _, area = i_layers(4, 16)
    got = final(b, [channel("displacement", b.nodes[1], 0, "u"), channel("reaction", b.nodes[0], 0, "h")])
    assert got["u"] == pytest.approx(1e5 * L**2 / (2 * E * area.sum()), rel=ROUNDING)
    assert got["h"] == pytest.approx(-1e5 * L, rel=ROUNDING)


@pytest.mark.parametrize("kind", KINDS)
def test_inclined_cantilever(kind: str) -> None:
    """A tip force in global axes on an inclined cantilever: PL^3/3EI across, PL/EA along."""
    m = Model()
    y, area = i_layers(4, 16)
    EA, EI = E * float(area.sum()), E * float(area @ y**2)
    section = m.elastic_section(EA, EI) if kind == "elastic" else m.fibre_section(y, area, m.material(Elastic(E)))
    c, s = 0.6, 0.8
    i, j = m.node("i", 1.0, -2.0), m.node("j", 1.0 + 5.0 * c, -2.0 + 5.0 * s)
    m.beam_column("e", i, j, section, geometry="linear")
    m.fix(i, *CLAMP)
    g = m.pattern()
    m.nodal_load(g, j, fx=1e4)
    got = final(Structure(m, [i, j], [0], g), [channel("displacement", j, d, str(d)) for d in range(3)])
    along, across = 1e4 * c * 5.0 / EA, -1e4 * s * 125.0 / (3 * EI)
    assert got["0"] == pytest.approx(c * along - s * across, rel=ROUNDING)
    assert got["1"] == pytest.approx(s * along + c * across, rel=ROUNDING)
    assert got["2"] == pytest.approx(-1e4 * s * 25.0 / (2 * EI), rel=ROUNDING)
