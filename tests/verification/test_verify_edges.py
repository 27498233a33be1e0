"""Edges of the core: small motions, axial member loads, ties in any order, units of length, late switches."""

from __future__ import annotations

import numpy as np
import pytest

from edesign.core import Analysis, Bilinear, Channel, CoreError, MenegottoPinto, Model


def column(load_along: float, upwards: bool, geometry: str, scale: float = 1.0) -> float:
    """Sway of a pinned column that leans on a lateral spring, under a load along it; lengths times `scale`, N."""
    m = Model()
    height, spring, push = 4.0 * scale, 2e5 / scale, 1e3
    column_base, top, wall = m.node("base", 0, 0), m.node("top", 0, height), m.node("wall", 1.0 * scale, height)
    m.fix(column_base, True, True, False)
    m.fix(wall, True, True, True)
    section = m.elastic_section(1e12, 1e12 * scale**2)
    ends = (column_base, top) if upwards else (top, column_base)
    e = m.beam_column("column", *ends, section, geometry=geometry)
    m.link("spring", top, wall, (spring, 0.0, 0.0))
    g = m.pattern()
    m.nodal_load(g, top, fx=push)
    m.uniform_load(g, e, axial=(-load_along if upwards else load_along) / height)
    a = Analysis(m, tolerance=1e-12)
    r = a.static(g, steps=1, channels=[Channel("u", ((1.0, "displacement", top, 0),))])
    assert r.status == "completed", r.reason
    return r.final["u"]


@pytest.mark.parametrize("upwards", [True, False])
@pytest.mark.parametrize("geometry", ["p_delta", "corotational"])
def test_load_along_a_leaning_column(upwards: bool, geometry: str) -> None:
    """Moment about the base: (k h - W/2) u = H h whichever end comes first; corotational differs by (u/h)^2 = 3e-6."""
    weight = 4e5
    assert column(weight, upwards, geometry) == pytest.approx(1e3 * 4.0 / (2e5 * 4.0 - weight / 2), rel=1e-5)


def test_small_motion_under_large_gravity() -> None:
    """A linear oscillator that carries gravity answers in proportion to the shaking, however weak."""
    peaks = []
    for factor in (1.0, 1e-6):
        m = Model()
        base, top = m.node("base", 0, 0), m.node("top", 0, 3)
        m.fix(base, True, True, True)
        m.beam_column("c", base, top, m.elastic_section(1e9, 9e6), geometry="linear")
        m.mass(top, 1e4)
        g = m.pattern()
        m.nodal_load(g, top, fy=-1e7)
        a = Analysis(m)
        assert a.static(g).status == "completed"
        shaking = factor * np.sin(np.arange(300) * 0.05)
        r = a.history(shaking, 0.01, channels=[Channel("u", ((1.0, "displacement", top, 0),))])
        peaks.append(r.peak("u") / factor)
    assert peaks[1] == pytest.approx(peaks[0], rel=1e-6)


def test_ties_make_one_group_in_any_order() -> None:
    """Three nodes tied in pairs share one equation whichever pairs are named."""
    for pairs in ([(1, 0), (2, 1)], [(2, 0), (2, 1)], [(0, 2), (1, 2)], [(2, 1), (1, 0), (0, 2)]):
        m = Model()
        section = m.elastic_section(1e9, 1e7)
        tops = [m.node(f"t{i}", 4.0 * i, 3.0) for i in range(3)]
        for i, top in enumerate(tops):
            column_base = m.node(f"f{i}", 4.0 * i, 0.0)
            m.fix(column_base, True, True, True)
            m.beam_column(f"c{i}", column_base, top, section)
        for node, master in pairs:
            m.tie(tops[node], tops[master], ux=True)
        assert len({int(e) for e in Analysis(m).equations[tops, 0]}) == 1


def test_sharp_menegotto_pinto_keeps_its_plateau() -> None:
    """R0 = 500 is the bilinear law: (1 - b) fy + b E e far beyond yield (|x|^R is beyond floating point there)."""
    m = Model()
    i, j = m.node("i", 0, 0), m.node("j", 1, 0)
    m.fix(i, True, True, True)
    m.fix(j, False, True, True)
    bar = m.truss("bar", i, j, m.material(MenegottoPinto(2e11, 2e8, 0.01, 500.0)), 1.0)
    g = m.pattern()
    m.nodal_load(g, j, fx=1.0)
    force = Channel("N", ((1.0, "axial_force", bar, 0),))
    for strain in (10e-3, 100e-3):
        r = Analysis(m).pushover(g, j, "ux", strain, 20, [force])
        assert r.final["N"] == pytest.approx(0.99 * 2e8 + 0.01 * 2e11 * strain, rel=1e-6)


@pytest.mark.parametrize("scale", [1e-3, 1.0, 1e3, 1e6, 1e9])
def test_critical_load_in_any_unit_of_length(scale: float) -> None:
    """From kilometres to nanometres a column at 0.9 of its critical load stands and at 1.1 it is refused."""
    for share, stands in ((0.9, True), (1.1, False)):
        m = Model()
        length, EI = 3.0 * scale, 1e6 * scale**2
        column_base, top = m.node("base", 0, 0), m.node("top", 0, length)
        m.fix(column_base, True, True, True)
        m.beam_column("c", column_base, top, m.elastic_section(1e9, EI))
        g = m.pattern()
        m.nodal_load(g, top, fx=1.0, fy=-share * 3 * EI / length**2)  # one member: 3 EI / L^2
        assert (Analysis(m).static(g).status == "completed") is stands


def test_energy_switched_on_later_starts_balanced() -> None:
    """Gravity without the balance, then a history with it: what is stored counts as put in (elastic: exact)."""
    m = Model()
    column_base, top = m.node("base", 0, 0), m.node("top", 0, 3)
    m.fix(column_base, True, True, True)
    steel = m.material(Bilinear(2.1e11, 1e12))
    m.beam_column("c", column_base, top, m.fibre_section(np.linspace(-0.2, 0.2, 16), np.full(16, 1e-3), steel))
    m.mass(top, 2e4)
    g = m.pattern()
    m.nodal_load(g, top, fy=-2e5)
    a = Analysis(m, energy=0)
    a.static(g)
    a.set("energy", 1)
    r = a.history(3.0 * np.sin(np.arange(400) * 0.1), 0.005)
    assert r.statistics["energy_error"] < 1e-5


def test_pushover_that_cannot_move_its_degree_is_refused_at_once() -> None:
    """A lateral load on a cantilever does not lift its top: said before the first step."""
    m = Model()
    column_base, top = m.node("base", 0, 0), m.node("top", 0, 3)
    m.fix(column_base, True, True, True)
    m.beam_column("c", column_base, top, m.elastic_section(1e9, 1e7), geometry="linear")
    g = m.pattern()
    m.nodal_load(g, top, fx=1.0)
    with pytest.raises(CoreError, match="do not move the controlled degree"):
        Analysis(m).pushover(g, top, "uy", 0.1, 5)


def test_channel_names_are_unique() -> None:
    """Two channels of one name would overwrite each other."""
    m = Model()
    column_base, top = m.node("base", 0, 0), m.node("top", 0, 3)
    m.fix(column_base, True, True, True)
    m.beam_column("c", column_base, top, m.elastic_section(1e9, 1e7))
    g = m.pattern()
    twice = [Channel("u", ((1.0, "displacement", top, d),)) for d in (0, 1)]
    with pytest.raises(ValueError, match="same name: u"):
        Analysis(m).static(g, channels=twice)
