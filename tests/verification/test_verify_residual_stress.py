"""Residual stresses: equilibrium, the first step, columns by another computation and by print, a frame by print."""

from __future__ import annotations

import math

import numpy as np
import pytest
from scipy.optimize import brentq

from edesign.codes.ec3.buckling import reduction_factor, rolled_i_curve
from edesign.core import Analysis, Bilinear, Channel, Elastic, Model
from edesign.core.errors import CoreError
from edesign.frame.sections.profiles import profile
from edesign.frame.sections.residual_stress import eccs_stresses, stressed_layers
from edesign.frame.sections.section import rolled_section
from edesign.frame.sections.space_section import space_section
from edesign.project.frame.sections import Fibres

E, FY, G = 2.1e11, 235e6, 8.1e10
PARTS = 16


@pytest.mark.parametrize("name", ["HEB200", "IPE300", "HEM300"])
def test_stresses_have_no_force_and_no_moment(name: str) -> None:
    """To rounding, whatever fibres; the largest are 0.5 or 0.3 of 235 MPa, with what fillets take off in plane."""
    rolled = profile(name)
    largest = 235e6 * (0.3 if name == "IPE300" else 0.5)
    for weak in (False, True):
        for fillets in (False, True):
            shape = rolled_section(rolled, Fibres(fillets=fillets), weak)
            depth, area, stress = stressed_layers(rolled, shape, weak)
            np.testing.assert_allclose(np.unique(depth), shape.layers[0], atol=1e-15)
            assert area.sum() == pytest.approx(shape.area, rel=1e-12)
            for lever in (np.ones(depth.size), depth):
                assert abs(stress @ (area * lever)) < 1e-12 * np.abs(stress * area * lever).sum()
            if not fillets:  # the outermost fibres stand half of their width inside
                assert stress.max() == pytest.approx(largest * (1.0 - 1.0 / 8.0), rel=1e-9)
                assert stress.min() == pytest.approx(-stress.max(), rel=1e-9)
    s = space_section(name)
    stress = eccs_stresses(rolled, s.y, s.z, s.area)
    for lever in (np.ones(s.y.size), s.y, s.z):
        assert abs(stress @ (s.area * lever)) < 1e-12 * np.abs(stress * s.area * lever).sum()


def stub(name: str, stress: bool = True) -> tuple[Model, int]:
    """A short bar in space that is compressed."""
    s, model = space_section(name), Model(3)
    steel = model.material(Bilinear(E, FY, 1e-6))
    stresses = eccs_stresses(profile(name), s.y, s.z, s.area) if stress else None
    section = model.fibre_section(s.y, s.area, steel, s.z, G * s.I_t, stresses)
    model.node("a", 0.0, 0.0, 0.0)
    model.node("b", 1.0, 0.0, 0.0)
    for node in (0, 1):
        model.fix(node, uy=True, uz=True, rx=True, ry=True, rz=True, ux=node == 0)
    model.beam_column("m", 0, 1, section, 3, "linear", web=(0.0, 0.0, 1.0))
    pattern = model.pattern()
    model.nodal_load(pattern, 1, -1.0)
    return model, pattern


def test_a_stub_loses_stiffness_where_tips_yield() -> None:
    """N = sum A max(E e + stress, -fy), to the hardening; nothing is stored without load, and energy is balanced."""
    name = "HEB200"
    s = space_section(name)
    stress = eccs_stresses(profile(name), s.y, s.z, s.area)
    model, pattern = stub(name)
    force = Channel("N", ((1.0, "load_factor", pattern, 0),))
    r = Analysis(model, tolerance=1e-12).pushover(pattern, 1, "ux", -2.0 * FY / E, 200, [force])
    strain = r.time
    kept = np.clip(E * strain[:, None] + stress, -FY, FY) @ s.area  # H / E = 1e-6
    np.testing.assert_allclose(r.values["N"], -kept, rtol=2e-6, atol=1e-6 * FY * s.area.sum())
    assert r.values["N"][0] == pytest.approx(0.0, abs=1e-6)
    tangent = np.diff(r.values["N"]) / np.diff(-strain)
    first = (FY + stress.min()) / E  # where tips begin to yield
    assert tangent[strain[:-1] > -first + 1e-5] == pytest.approx(E * s.area.sum(), rel=1e-9)
    assert tangent[np.searchsorted(-strain, first) + 2] < 0.95 * E * s.area.sum()
    assert abs(r.energy["elastic"][0]) < 1e-9 * r.energy["elastic"].max()
    assert r.statistics["energy_error"] < 1e-3


def test_elastic_answers_are_those_without() -> None:
    """Stresses in equilibrium cancel while nothing yields, to rounding, with elastic sections passed over or not."""
    found = []
    for stress in (True, False):
        for fast in (0.0, 1.0):
            model, pattern = stub("IPE300", stress)
            force = Channel("N", ((1.0, "load_factor", pattern, 0),))
            found.append(Analysis(model, fast_elastic=fast).pushover(pattern, 1, "ux", -3e-4, 3, [force]).values["N"])
    for other in found[1:]:
        np.testing.assert_allclose(other, found[0], rtol=1e-12, atol=1e-6)


def test_plane_and_space_yield_alike() -> None:
    """A cantilever of equal fibres bent about the strong axis under compression, in a plane and in space."""
    name, length = "HEB200", 3.0
    rolled = profile(name)
    depth, area, stress = stressed_layers(rolled, rolled_section(rolled, Fibres(flange_width=8)), False)
    side = np.where(np.arange(depth.size) % 2, 1.0, -1.0) * 0.05  # anywhere: it does not bend that way
    answers = []
    for dimension in (2, 3):
        model = Model(dimension)
        steel = model.material(Bilinear(E, FY, 0.01))
        if dimension == 2:
            section = model.fibre_section(depth, area, steel, stress=stress)
        else:
            both = [np.concatenate(of) for of in ((side, -side), (depth, depth), (area, area), (stress, stress))]
            section = model.fibre_section(both[0], both[2] / 2.0, steel, both[1], 1e6, both[3])
        model.node("a", 0.0, 0.0)
        model.node("b", 0.0, 0.0, length) if dimension == 3 else model.node("b", 0.0, length)
        if dimension == 2:
            model.fix(0, ux=True, uy=True, rz=True)
            model.beam_column("m", 0, 1, section, 5, "p_delta")
        else:
            model.fix(0, ux=True, uy=True, uz=True, rx=True, ry=True, rz=True)
            model.fix(1, uy=True, rx=True, rz=True)
            model.beam_column("m", 0, 1, section, 5, "p_delta", web=(1.0, 0.0, 0.0))
        gravity, push = model.pattern(), model.pattern()
        down = -0.4 * FY * area.sum()
        model.nodal_load(gravity, 1, fz=down) if dimension == 3 else model.nodal_load(gravity, 1, fy=down)
        model.nodal_load(push, 1, 1.0)
        analysis = Analysis(model, tolerance=1e-12)
        assert analysis.static(gravity).status == "completed"
        factor = Channel("f", ((1.0, "load_factor", push, 0),))
        answers.append(analysis.pushover(push, 1, "ux", 0.08, 40, [factor]).values["f"])
    np.testing.assert_allclose(answers[1], answers[0], rtol=1e-9, atol=1e-9 * np.abs(answers[0]).max())


def strut(name: str, axis: str, slenderness: float) -> tuple[float, float]:
    """chi of a column with a bow of L/1000 and residual stresses: by the core, and by integration in numpy."""
    s = space_section(name, 8)
    stress = eccs_stresses(profile(name), s.y, s.z, s.area)
    depth, A = (s.z if axis == "y" else s.y), s.area.sum()
    length = slenderness * math.pi * math.sqrt(E * (s.area @ depth**2) / (A * FY))
    bow = length / 1000.0
    model = Model(3)
    steel = model.material(Bilinear(E, FY, 1e-4))
    section = model.fibre_section(s.y, s.area, steel, s.z, G * s.I_t, stress)
    x = np.linspace(0.0, length, PARTS + 1)
    places = np.stack([x, np.zeros(x.size), bow * np.sin(math.pi * x / length)], axis=1)
    for k, place in enumerate(places.tolist()):
        model.node(f"n{k}", *place)
        model.fix(k, uy=True, rx=True, rz=True, ux=k == 0, uz=k in (0, PARTS))
    for k in range(PARTS):
        along = places[k + 1] - places[k]
        across = np.cross(along / np.linalg.norm(along), (0.0, 1.0, 0.0))
        web = tuple(across.tolist()) if axis == "y" else (0.0, 1.0, 0.0)
        model.beam_column(f"m{k}", k, k + 1, section, 5, "corotational", web=web)
    pattern = model.pattern()
    model.nodal_load(pattern, PARTS, -A * FY)
    factor = Channel("f", ((1.0, "load_factor", pattern, 0),))
    r = Analysis(model, tolerance=1e-9).pushover(pattern, PARTS // 2, "uz", length / 60.0, 240, [factor])
    assert r.status == "completed", r.reason

    curvatures = np.linspace(0.0, 8.0 * FY / (E * np.abs(depth).max()), 60)

    def moments(N: float) -> np.ndarray:
        """Moments of the curvatures under compression, strains by bisection."""
        low, high = np.full(curvatures.size, -20.0 * FY / E), np.full(curvatures.size, 20.0 * FY / E)
        for _ in range(45):
            middle = 0.5 * (low + high)
            of = np.clip(E * (middle[:, None] + curvatures[:, None] * depth) + stress, -FY, FY) * s.area
            low, high = (np.where(of.sum(axis=1) < -N, at, other) for at, other in ((middle, low), (high, high)))
            high = np.where(of.sum(axis=1) < -N, high, middle)
        return np.asarray(of @ depth)

    def end(N: float, w: float) -> float:
        """Deflection at the end of a column that starts with w in its middle, Heun's method."""
        of_curvature, steps = moments(N), 40
        h, v, slope = 0.5 * length / steps, w, 0.0

        def bend(x: float, v: float) -> float:
            return float(np.interp(N * (v + bow * math.cos(math.pi * x / length)), of_curvature, curvatures))

        for k in range(steps):
            first = bend(k * h, v)
            second = bend((k + 1) * h, v + h * slope)
            v, slope = v + h * slope - 0.5 * h**2 * first, slope - 0.5 * h * (first + second)
        return v

    deflections = np.geomspace(length / 1000.0, length / 60.0, 12)
    whole = A * FY
    found = [brentq(lambda N, w=w: end(N, w), 1e-3 * whole, 0.999 * whole, xtol=1e-4 * whole) for w in deflections]
    return float(r.values["f"].max()), max(found) / whole


@pytest.mark.parametrize(("name", "axis"), [("HEB200", "y"), ("HEB200", "z"), ("IPE300", "y"), ("IPE300", "z")])
def test_columns_with_bow_follow_the_buckling_curves(name: str, axis: str) -> None:
    """EN 1993-1-1, Table 6.2: curve b of HEB about y, c about z; a and b of IPE. And integration in numpy.

    The curves are lower bounds of tests, from which analyses with a bow of L/1000 scatter: -3.7 % to +7.9 % were seen,
    the largest of HEB about y beyond a slenderness of 1. In numpy, where fibres do not unload and twelve deflections
    are tried, up to 1.2 % less were seen.
    """
    rolled = profile(name)
    curve = rolled_i_curve(rolled.h, rolled.b, rolled.tf, axis, FY)
    for slenderness in (0.4, 0.7, 1.0, 1.5):
        core, other = strut(name, axis, slenderness)
        chi = reduction_factor(slenderness, curve)
        assert core == pytest.approx(other, rel=0.015)
        assert 0.96 * chi < core < (1.05 if slenderness < 1.0 or axis == "z" else 1.08) * chi


def six_storeys(stressed: bool) -> float:
    """Largest factor of the loads of Vogel's frame of six storeys."""
    lean, steps, top = 1.0 / 450.0, 65, 1.3
    model = Model(2)
    steel = model.material(Bilinear(2.05e11, FY, 1e-4))
    beams = ("IPE400", "IPE360", "IPE330", "IPE300", "IPE300", "IPE240")
    outer, inner = ("HEB220",) * 4 + ("HEB160",) * 2, ("HEB260",) * 3 + ("HEB240",) + ("HEB200",) * 2
    sections = {}
    for name in dict.fromkeys((*beams, *outer, *inner)):
        rolled = profile(name)
        depth, area, stress = stressed_layers(rolled, rolled_section(rolled, Fibres(fillets=True)), False)
        sections[name] = model.fibre_section(depth, area, steel, stress=stress if stressed else None)
    node = {
        (floor, line): model.node(f"{line}.{floor}", 6.0 * line + lean * 3.75 * floor, 3.75 * floor)
        for floor in range(7)
        for line in range(3)
    }

    def member(name: str, ends: tuple[tuple[int, int], tuple[int, int]], section: str, parts: int) -> list[int]:
        a, b = (np.array(model.node_places[node[end]][:2]) for end in ends)
        inside = [model.node(f"{name}.{k}", *(a + (b - a) * k / parts).tolist()) for k in range(1, parts)]
        chain = [node[ends[0]], *inside, node[ends[1]]]
        return [
            model.beam_column(f"{name}_{k}", chain[k], chain[k + 1], sections[section], 5, "corotational")
            for k in range(parts)
        ]

    for line in range(3):
        model.fix(node[0, line], ux=True, uy=True, rz=True)
        for storey in range(6):
            section = (inner if line == 1 else outer)[storey]
            member(f"C{line}{storey}", ((storey, line), (storey + 1, line)), section, 2)
    of_beams = [
        (floor, member(f"B{line}{floor}", ((floor, line), (floor, line + 1)), beams[floor - 1], 4))
        for floor in range(1, 7)
        for line in range(2)
    ]
    pattern = model.pattern()
    for floor, elements in of_beams:
        for element in elements:
            model.uniform_load(pattern, element, 0.0, -31.7e3 if floor == 6 else -49.1e3)
    for floor in range(1, 7):
        model.nodal_load(pattern, node[floor, 0], 10.23e3 if floor == 6 else 20.44e3)
    factor = Channel("f", ((1.0, "load_factor", pattern, 0),))
    r = Analysis(model).static(pattern, top, steps, [factor])
    assert r.status == "failed"  # no equilibrium beyond the limit
    return float(r.values["f"].max())


def test_the_frame_of_six_storeys_by_vogel() -> None:
    """Vogel, Calibrating frames, Stahlbau 54 (1985): plastic zones carry 1.11, plastic hinges 1.12 times the loads.

    Sections, loads and steel as others print them (two bays of 6 m, storeys of 3.75 m, lean 1/450). The text was not
    at hand: the factors are those that papers quote. The last step in equilibrium is 0.02 below the next one.
    """
    assert 1.09 < six_storeys(True) <= six_storeys(False) < 1.14


def test_what_is_no_state_of_a_section_is_refused() -> None:
    y, area = np.array([-0.1, 0.1]), np.full(2, 1e-3)
    for law, stress, said in (
        (Bilinear(E, FY), [1e6, 2e6], "force"),
        (Bilinear(E, FY), [1e6, -1e6], "moment"),
        (Bilinear(E, FY), [FY, -FY], "below yield"),
        (Elastic(E), [0.0, 0.0], "bilinear"),
    ):
        model = Model(2)
        with pytest.raises(CoreError, match=said):
            model.fibre_section(y, area, model.material(law), stress=stress)
    with pytest.raises(ValueError, match="areas"):
        model.fibre_section(y, area, 0, stress=[0.0])
