"""Structures and inputs that cannot be analysed are refused by name; loads beyond the capacity end in a clear
failure."""

from __future__ import annotations

import numpy as np
import pytest
from verification.structures import FY, E, channel, i_layers, oscillator, plastic_moment, steel_cantilever

from edesign.core import HHT, Analysis, Bilinear, CoreError, Elastic, Model, Newmark


def test_mechanism_is_named() -> None:
    """A beam on two rollers slides: both of its ux, and no other degree."""
    m = Model()
    a, b = m.node("A1", 0, 0), m.node("B1", 5, 0)
    m.beam_column("B", a, b, m.elastic_section(1e9, 1e7))
    m.fix(a, uy=True)
    m.fix(b, uy=True)
    with pytest.raises(CoreError) as info:
        Analysis(m)
    assert info.value.status == "ED_E_MECHANISM"
    text = str(info.value)
    assert "A1.ux" in text and "B1.ux" in text
    assert ".uy" not in text and "rz" not in text


def test_hinged_portal_sways() -> None:
    """Four hinges: the tops move sideways."""
    m = Model()
    section = m.elastic_section(1e9, 1e7)
    a0, b0, a1, b1 = m.node("A0", 0, 0), m.node("B0", 5, 0), m.node("A1", 0, 3), m.node("B1", 5, 3)
    m.fix(a0, True, True, False)
    m.fix(b0, True, True, False)
    m.beam_column("C_A_1", a0, a1, section)
    m.beam_column("C_B_1", b0, b1, section)
    m.beam_column("B_1_1", a1, b1, section, release=(True, True))
    with pytest.raises(CoreError, match=r"A1\.ux.*B1\.ux|B1\.ux.*A1\.ux"):
        Analysis(m)


def test_free_rotation_between_trusses_is_named() -> None:
    m = Model()
    a, b = m.node("a", 0, 0), m.node("tip", 3, 4)
    c = m.node("c", 6, 0)
    steel = m.material(Elastic(E))
    for n in (a, c):
        m.fix(n, True, True, True)
    m.truss("l", a, b, steel, 1e-3)
    m.truss("r", b, c, steel, 1e-3)
    with pytest.raises(CoreError, match=r"tip\.rz"):
        Analysis(m)


def test_disconnected_nodes_are_named() -> None:
    m = Model()
    section = m.elastic_section(1e9, 1e7)
    a, b = m.node("A0", 0, 0), m.node("A1", 0, 3)
    c, d = m.node("C4", 9, 0), m.node("C5", 9, 3)
    m.beam_column("one", a, b, section)
    m.beam_column("two", c, d, section)
    m.fix(a, True, True, True)
    with pytest.raises(CoreError) as info:
        Analysis(m)
    assert info.value.status == "ED_E_DISCONNECTED"
    assert "C4" in str(info.value) and "C5" in str(info.value)
    assert "A1" not in str(info.value)


def test_all_fixed() -> None:
    m = Model()
    a, b = m.node("a", 0, 0), m.node("b", 1, 0)
    m.beam_column("e", a, b, m.elastic_section(1e9, 1e7))
    for n in (a, b):
        m.fix(n, True, True, True)
    with pytest.raises(CoreError, match="no free degree"):
        Analysis(m)


@pytest.mark.parametrize("times", [1.01, 1.3, 2.0, 3.0, 4.5, 7.0, 10.0, 45.0, 1000.0])
@pytest.mark.parametrize("steps", [1, 7])
def test_beyond_collapse_under_load_control(times: float, steps: int) -> None:
    """A perfectly plastic cantilever cannot carry more than Mp / L, however the load is applied: the run fails,
    says where, and the state is that of the last good step."""
    layers = i_layers(4, 16)
    collapse = plastic_moment(*layers) / 4.0
    s = steel_cantilever(4.0, layers, Bilinear(E, FY))
    s.model.nodal_load(s.pattern, s.nodes[1], fx=collapse)
    a = s.analysis()
    channels = [channel("displacement", s.nodes[1], 0, "u"), channel("reaction", s.nodes[0], 2, "m")]
    half = a.static(s.pattern, 0.5, 1, channels)
    assert half.status == "completed"
    before = a.state()
    r = a.static(s.pattern, times, steps, channels)
    assert r.status == "failed", f"carries {times} times the collapse load at u = {r.final['u']:.3g} m"
    done = int(r.statistics["steps"])
    assert f"step {done + 1}" in r.reason
    assert "L1.ux" in r.reason or "L1.rz" in r.reason
    assert 0.5 + (times - 0.5) * done / steps <= 1.0 + 1e-6
    if done == 0:
        np.testing.assert_array_equal(a.state(), before)
        assert r.final == half.final
    again = a.static(s.pattern, 0.4, 1, channels)  # and the analysis goes on from there
    assert again.status == "completed"


@pytest.mark.parametrize("geometry", ["linear", "p_delta"])
def test_no_load_beyond_collapse_is_carried(geometry: str) -> None:
    """The same over many loads, each in one step from 0.45: how an iteration diverges must never look like
    equilibrium."""
    layers = i_layers(4, 16)
    collapse = plastic_moment(*layers) / 4.0
    s = steel_cantilever(4.0, layers, Bilinear(E, FY), geometry)
    s.model.nodal_load(s.pattern, s.nodes[1], fx=collapse)
    a = s.analysis(halvings=1)
    assert a.static(s.pattern, 0.45).status == "completed"
    state, carried = a.state(), []
    for times in np.linspace(1.05, 13.0, 240):
        r = a.static(s.pattern, float(times), 1, [channel("displacement", s.nodes[1], 0, "u")])
        if r.status == "completed":
            carried.append((round(float(times), 3), r.final["u"]))
        a.restore(state)
    assert not carried, (
        f"{len(carried)} of 240 loads were carried, for instance (times collapse load, m): {carried[:3]}"
    )


def test_record_with_nan_is_refused() -> None:
    s = oscillator(1e6, 1e3)
    a = s.analysis()
    motion = np.zeros(50)
    motion[20] = np.nan
    before = a.state()
    with pytest.raises(CoreError, match="sample 21"):
        a.history(motion, 0.01)
    with pytest.raises(CoreError, match="sample 21"):
        a.history(np.zeros(50), 0.01, vertical=motion)
    motion[20] = np.inf
    with pytest.raises(CoreError, match="not a finite"):
        a.history(motion, 0.01)
    np.testing.assert_array_equal(a.state(), before)
    assert a.history(np.zeros(50), 0.01).status == "completed"


@pytest.mark.parametrize("dt", [0.0, -0.01, np.nan, np.inf])
def test_time_step(dt: float) -> None:
    with pytest.raises(CoreError):
        oscillator(1e6, 1e3).analysis().history(np.zeros(5), dt)


def test_no_masses() -> None:
    with pytest.raises(CoreError, match="masses"):
        oscillator(1e6, 0.0).analysis().history(np.zeros(5), 0.01)
    with pytest.raises(ValueError, match="mass"):
        oscillator(1e6, 0.0).analysis().modes(1)


@pytest.mark.parametrize("method", [Newmark(0.5, 0.0), Newmark(0.0, 0.25), HHT(0.3)])
def test_integration_parameters(method: Newmark | HHT) -> None:
    with pytest.raises(CoreError, match="parameters"):
        oscillator(1e6, 1e3).analysis().history(np.zeros(5), 0.01, method)


def test_channel_that_does_not_exist() -> None:
    """Before the run starts, by its name, and the analysis can be used afterwards."""
    s = oscillator(1e6, 1e3)
    a = s.analysis()
    for bad in (
        channel("displacement", 7, 0, "roof"),
        channel("end_force", 0, 6, "roof"),
        channel("section_force", 0, 0, "roof"),
        channel("displacement", 0, 3, "roof"),
    ):
        with pytest.raises(CoreError, match="roof"):
            a.history(np.zeros(5), 0.01, channels=[bad])
    assert a.history(np.zeros(5), 0.01).status == "completed"


def test_pushover_without_effect() -> None:
    s = oscillator(1e6, 1e3)
    a = s.analysis()
    with pytest.raises(CoreError, match="no load"):
        a.pushover(s.pattern, s.nodes[1], "ux", 0.1, 5)
    with pytest.raises(CoreError, match="fixed"):
        a.pushover(s.pattern, s.nodes[1], "uy", 0.1, 5)


@pytest.mark.parametrize("values", [{"EA": 0.0}, {"EA": -1.0}, {"EI": 0.0}, {"EI": np.nan}, {"EA": np.inf}])
def test_sections_without_stiffness(values: dict[str, float]) -> None:
    with pytest.raises(CoreError, match="must be positive"):
        Model().elastic_section(**({"EA": 1e9, "EI": 1e7} | values))


def test_members_without_length_and_unknown_ids() -> None:
    m = Model()
    section = m.elastic_section(1e9, 1e7)
    a, b = m.node("a", 1, 1), m.node("b", 1, 1)
    with pytest.raises(CoreError, match="no length"):
        m.beam_column("e", a, b, section)
    with pytest.raises(CoreError, match="no node 9"):
        m.beam_column("e", a, 9, section)
    with pytest.raises(CoreError, match="no section"):
        m.beam_column("e", a, m.node("c", 2, 2), 5)
    with pytest.raises(CoreError, match="not finite"):
        m.node("d", np.nan, 0.0)
    with pytest.raises(CoreError, match="tied to itself"):
        m.tie(a, a, ux=True)


def test_structure_that_loses_stability() -> None:
    """A column under 1.5 times its Euler load, with a small force across. Either the far equilibrium of the
    elastica on the side of the force is found, or the run says that stability was lost. The straight unstable
    path, which bends against the force, is no answer."""
    m = Model()
    section = m.elastic_section(1e9, 1e6)
    nodes = [m.node(f"N{k}", 0.0, 1.0 * k) for k in range(5)]
    for k in range(4):
        m.beam_column(f"M{k}", nodes[k], nodes[k + 1], section, geometry="corotational")
    m.fix(nodes[0], True, True, True)
    g = m.pattern()
    m.nodal_load(g, nodes[-1], fx=100.0, fy=-1.5 * np.pi**2 * 1e6 / (4 * 16.0))
    a = Analysis(m)
    r = a.static(g, steps=30, channels=[channel("displacement", nodes[-1], 0, "u")])
    if r.status == "completed":
        assert np.linalg.eigvalsh(a.stiffness().toarray()).min() > 0.0
        assert r.final["u"] > 1.0
    else:
        assert "limit load" in r.reason or "equilibrium" in r.reason
