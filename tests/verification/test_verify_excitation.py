"""Ground motion along x and y, total accelerations, massless degrees in histories, reactions, every-nth samples,
stopping."""

from __future__ import annotations

import tracemalloc
from dataclasses import replace

import numpy as np
import pytest
from verification.structures import Structure, cantilever, channel, oscillator, steel_portal

from edesign.core import ENERGIES, Bilinear, Elastic, GeneralisedAlpha, Model, Newmark, Response
from edesign.core.recording import PIECE

T = np.arange(401) * 0.005
GROUND = 2.0 * np.sin(11.0 * T) * np.sin(np.pi * T / 2.0)


def hanging(k: float, mass: float) -> Structure:
    """The oscillator turned upright: free along y only."""
    m = Model()
    a, b = m.node("ground", 0.0, 0.0), m.node("mass", 0.0, 1.0)
    m.fix(a, True, True, True)
    m.fix(b, True, False, True)
    bar = m.truss("bar", a, b, m.material(Elastic(k)), 1.0)
    m.mass(b, 0.0, mass)
    return Structure(m, [a, b], [bar], m.pattern())


@pytest.mark.parametrize("method", [Newmark(), GeneralisedAlpha(0.7)])
def test_vertical_equals_horizontal(method: Newmark | GeneralisedAlpha) -> None:
    """The same oscillator along y under vertical motion: the same numbers."""
    k, mass = 4e5, 1e3
    h, v = oscillator(k, mass), hanging(k, mass)
    one = h.analysis().history(
        GROUND,
        0.005,
        method,
        [
            channel("displacement", 1, 0, "u"),
            channel("total_acceleration", 1, 0, "a"),
            channel("ground_acceleration", 0, 0, "g"),
        ],
    )
    two = v.analysis().history(
        np.zeros(401),
        0.005,
        method,
        [
            channel("displacement", 1, 1, "u"),
            channel("total_acceleration", 1, 1, "a"),
            channel("ground_acceleration", 0, 1, "g"),
        ],
        vertical=GROUND,
    )
    for name in ("u", "a", "g"):
        np.testing.assert_allclose(two.values[name], one.values[name], atol=1e-12 * np.abs(one.values[name]).max())
    np.testing.assert_array_equal(one.values["g"], GROUND)


def test_horizontal_motion_does_not_move_along_y() -> None:
    s = hanging(4e5, 1e3)
    r = s.analysis().history(GROUND, 0.005, channels=[channel("displacement", 1, 1, "u")])
    assert not r.values["u"].any()


def test_total_acceleration_balances_the_spring() -> None:
    """Undamped: m (a + ag) = -k u at every step; at a support the total acceleration is that of the ground."""
    k, mass = 4e5, 1e3
    s = oscillator(k, mass)
    r = s.analysis(tolerance=1e-11).history(
        GROUND,
        0.005,
        channels=[
            channel("total_acceleration", 1, 0, "a"),
            channel("axial_force", 0, 0, "f"),
            channel("acceleration", 1, 0, "rel"),
            channel("total_acceleration", 0, 0, "base"),
            channel("reaction", 0, 0, "h"),
        ],
    )
    v = r.values
    np.testing.assert_allclose(mass * v["a"], -v["f"], atol=1e-8 * np.abs(v["f"]).max())
    np.testing.assert_allclose(v["a"] - v["rel"], GROUND, atol=1e-12)
    np.testing.assert_array_equal(v["base"], GROUND)
    np.testing.assert_allclose(v["h"], -v["f"], rtol=1e-12, atol=1e-9)


def test_massless_degrees_follow_statically() -> None:
    """A cantilever with a mass along x at its tip: rotation = 3/(2L) of the displacement at every step, and the
    motion is that of the oscillator with k = 3EI/L^3."""
    L, EI, mass = 4.0, 3e7, 2e4
    c = cantilever(L, 1e9, EI)
    c.model.mass(c.nodes[1], mass)
    tip = c.nodes[1]
    r = c.analysis(tolerance=1e-11).history(
        GROUND, 0.005, channels=[channel("displacement", tip, d, str(d)) for d in range(3)]
    )
    o = oscillator(3 * EI / L**3, mass)
    reference = o.analysis(tolerance=1e-11).history(GROUND, 0.005, channels=[channel("displacement", 1, 0, "u")])
    scale = np.abs(reference.values["u"]).max()
    np.testing.assert_allclose(r.values["0"], reference.values["u"], atol=1e-8 * scale)
    np.testing.assert_allclose(r.values["2"], -1.5 / L * r.values["0"], atol=1e-8 * scale)
    assert np.abs(r.values["1"]).max() < 1e-10 * scale


def test_both_directions_superpose() -> None:
    """A linear frame: x and y together is the sum of each alone (1e-8)."""
    found = []
    for x, y in ((GROUND, 0 * GROUND), (0 * GROUND, GROUND[::-1].copy()), (GROUND, GROUND[::-1].copy())):
        s = steel_portal("linear", Bilinear(2.1e11, 1e12))
        r = s.analysis(tolerance=1e-11).history(
            x, 0.005, vertical=y, channels=[channel("displacement", s.nodes[2], d, str(d)) for d in range(3)]
        )
        found.append(np.array([r.values[str(d)] for d in range(3)]))
    np.testing.assert_allclose(found[0] + found[1], found[2], atol=1e-8 * np.abs(found[2]).max())


def test_gravity_state_stays_without_motion() -> None:
    """A frame under gravity, then a history without motion: nothing moves (the tolerance of the gravity state,
    1e-9)."""
    s = steel_portal()
    s.model.uniform_load(s.pattern, s.elements[2], transverse=-30e3)
    a = s.analysis(tolerance=1e-9)
    gravity = a.static(s.pattern, channels=[channel("displacement", s.nodes[2], 1, "v")])
    r = a.history(np.zeros(201), 0.01, channels=[channel("displacement", s.nodes[2], 1, "v")])
    np.testing.assert_allclose(r.values["v"], gravity.final["v"], rtol=1e-6)


@pytest.mark.parametrize("every", [1, 3, 10, 0])
def test_samples_and_extremes(every: int) -> None:
    """Every nth step is kept, extremes count all steps."""
    s = steel_portal()
    full = s.analysis().history(GROUND, 0.005, channels=[channel("displacement", s.nodes[2], 0, "u")])
    r = s.analysis().history(GROUND, 0.005, channels=[channel("displacement", s.nodes[2], 0, "u")], every=every)
    step = every or 401
    np.testing.assert_array_equal(r.values["u"], full.values["u"][::step])
    np.testing.assert_allclose(r.time, T[::step], atol=1e-12)
    for result in (full, r):
        assert result.maximum["u"] == full.values["u"].max()
        assert result.minimum["u"] == full.values["u"].min()
        assert result.time_of_maximum["u"] == pytest.approx(T[full.values["u"].argmax()], abs=1e-12)
        assert result.time_of_minimum["u"] == pytest.approx(T[full.values["u"].argmin()], abs=1e-12)
        assert result.final["u"] == full.values["u"][-1]
        assert result.peak("u") == np.abs(full.values["u"]).max()


def test_stop_and_progress() -> None:
    """Asked to stop, a run ends between steps with what it has; progress counts up to the end."""
    s = steel_portal()
    seen: list[tuple[int, int]] = []
    full = s.analysis().history(
        GROUND,
        0.005,
        channels=[channel("displacement", s.nodes[2], 0, "u")],
        progress=lambda done, total: seen.append((done, total)),
    )
    assert full.status == "completed" and seen[-1] == (400, 400)
    assert [d for d, _ in seen] == sorted({d for d, _ in seen})
    part = s.analysis().history(
        GROUND, 0.005, channels=[channel("displacement", s.nodes[2], 0, "u")], stop=lambda: True
    )
    assert part.status == "interrupted"
    n = part.values["u"].size
    assert 1 < n < 401
    np.testing.assert_array_equal(part.values["u"], full.values["u"][:n])


def test_what_is_kept_of_a_long_run() -> None:
    """Taken over in pieces, a run gives the same bits as kept whole, and needs no memory for what is not kept."""
    n = 2 * PIECE + 1000
    ground = np.sin(0.05 * np.arange(n + 1))

    def run(history: bool, **kept: object) -> Response:
        s = steel_portal()
        one = replace(channel("displacement", s.nodes[2], 0, "u"), history=history, tail=True)
        return s.analysis().history(ground, 0.005, channels=[one], **kept)

    whole, thin = run(True), run(True, every=7, tail=500)
    np.testing.assert_array_equal(thin.time, whole.time[::7])
    np.testing.assert_array_equal(thin.values["u"], whole.values["u"][::7])
    for term, values in whole.energy.items():
        np.testing.assert_array_equal(thin.energy[term], values[::7])
        assert thin.energy_final[term] == values[-1]
    tracemalloc.start()
    none = run(False, tail=500, energies=False)
    peak = tracemalloc.get_traced_memory()[1]
    tracemalloc.stop()
    for found in (thin, none):
        np.testing.assert_array_equal(found.tail["u"], whole.values["u"][-500:])
        assert found.statistics["energy_error"] == whole.statistics["energy_error"]
        assert (found.maximum, found.minimum, found.final) == (whole.maximum, whole.minimum, whole.final)
        assert found.end == whole.time[-1]
    assert not none.values and not none.energy["input"].size
    rows = PIECE + 1  # a piece has abscissa, one value and the energies; the time of all steps is kept
    assert peak < 8 * (2 * rows * (2 + len(ENERGIES)) + 2 * n) + 1e6
