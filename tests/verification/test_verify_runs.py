"""What follows from one run to the next: abscissa, first samples, states that are restored, load factors."""

from __future__ import annotations

import numpy as np
import pytest
from verification.structures import FY, E, Structure, channel, i_layers, steel_cantilever, steel_portal

from edesign.core import Bilinear


def column() -> tuple[Structure, int, int]:
    """An elastic-plastic cantilever with a vertical and a lateral pattern."""
    s = steel_cantilever(4.0, i_layers(4, 16), Bilinear(E, FY), "p_delta")
    s.model.nodal_load(s.pattern, s.nodes[1], fy=-300e3)
    lateral = s.model.pattern()
    s.model.nodal_load(lateral, s.nodes[1], fx=1e3)
    return s, s.pattern, lateral


def test_abscissa_of_static_and_pushover() -> None:
    """Load factors of the pattern, and the controlled displacement, from the first row on. Rounding only."""
    s, gravity, lateral = column()
    a = s.analysis()
    np.testing.assert_allclose(a.static(gravity, 1.0, 4).time, [0, 0.25, 0.5, 0.75, 1], atol=1e-14)
    first = a.pushover(lateral, s.nodes[1], "ux", 0.02, 4)
    np.testing.assert_allclose(first.time, [0, 0.005, 0.01, 0.015, 0.02], atol=1e-14)
    second = a.pushover(lateral, s.nodes[1], "ux", -0.02, 2)
    np.testing.assert_allclose(second.time, [0.02, 0.0, -0.02], atol=1e-14)
    third = a.static(gravity, 2.0, 2)
    np.testing.assert_allclose(third.time, [1.0, 1.5, 2.0], atol=1e-14)


def samples(s: Structure) -> list:
    return [
        channel("reaction", s.nodes[0], 0, "h"),
        channel("reaction", s.nodes[0], 2, "m"),
        channel("end_force", s.elements[0], 2, "end"),
        channel("global_force", s.elements[0], 3, "global"),
        channel("axial_force", s.elements[0], 0, "n"),
        channel("displacement", s.nodes[1], 0, "u"),
    ]


def test_first_sample_after_a_failed_run() -> None:
    """What a new run records first is the state that the failed one was returned to, forces and reactions included."""
    s, gravity, lateral = column()
    a = s.analysis(halvings=2)
    good = a.static(lateral, 50.0, 2, samples(s))
    assert good.status == "completed"
    failed = a.static(lateral, 150.0, 1)
    assert failed.status == "failed"
    after = a.static(lateral, 50.0, 1, samples(s))
    assert after.status == "completed"
    for name, value in good.final.items():
        assert after.values[name][0] == pytest.approx(value, rel=1e-12, abs=1e-9), name


def test_first_sample_after_restore() -> None:
    """The same for a state that was taken and set again."""
    s, gravity, lateral = column()
    a = s.analysis()
    there = a.static(lateral, 50.0, 2, samples(s))
    state = a.state()
    assert a.pushover(lateral, s.nodes[1], "ux", 0.2, 10).status == "completed"
    a.restore(state)
    after = a.static(lateral, 50.0, 1, samples(s))
    for name, value in there.final.items():
        assert after.values[name][0] == pytest.approx(value, rel=1e-12, abs=1e-9), name


def test_restored_state_repeats_the_path_bitwise() -> None:
    """Everything that matters for what follows is in the state: path, energies and final state are the same bits."""
    s, gravity, lateral = column()
    a = s.analysis(reuse_factors=0)
    assert a.static(gravity, 1.0, 2).status == "completed"
    assert a.pushover(lateral, s.nodes[1], "ux", 0.05, 10).status == "completed"
    state = a.state()
    runs = []
    for _ in range(2):
        a.restore(state)
        r = a.pushover(lateral, s.nodes[1], "ux", -0.1, 25, samples(s))
        runs.append((r, a.state()))
    (one, after_one), (two, after_two) = runs
    np.testing.assert_array_equal(after_one, after_two)
    for name in one.energy:
        np.testing.assert_array_equal(one.energy[name][1:], two.energy[name][1:], err_msg=name)


def test_energy_after_a_failed_run() -> None:
    """A load step that fails after some of its halves succeeded leaves no trace in the work counted later."""
    inputs = []
    for fail in (False, True):
        s, gravity, lateral = column()
        a = s.analysis(halvings=4)
        assert a.static(lateral, 50.0, 2).status == "completed"
        before = a.state()
        if fail:
            assert a.static(lateral, 150.0, 1).status == "failed"  # capacity is 103: a half of the step succeeds
            np.testing.assert_array_equal(a.state()[2:], before[2:])
        r = a.static(lateral, 80.0, 2)
        inputs.append(r.energy["input"][-1])
    assert inputs[0] == pytest.approx(inputs[1], rel=1e-9)


def test_load_that_stays() -> None:
    """A pattern keeps its factor in later runs: base shear of both after the second."""
    s = steel_portal()
    m = s.model
    m.nodal_load(s.pattern, s.nodes[2], fx=10e3)
    other = m.pattern()
    m.nodal_load(other, s.nodes[3], fx=5e3)
    a = s.analysis(tolerance=1e-9)
    assert a.static(s.pattern).status == "completed"
    base = [channel("reaction", n, 0, str(n)) for n in s.nodes[:2]]
    r = a.static(other, channels=base)
    assert sum(r.final.values()) == pytest.approx(-15e3, rel=1e-7)


@pytest.mark.parametrize("pieces", [1, 7])
def test_cutting_a_run_into_several(pieces: int) -> None:
    """A pushover in one run or in several visits the same points: to the tolerance of the equilibrium."""
    s, gravity, lateral = column()
    a = s.analysis(tolerance=1e-10)
    for k in range(pieces):
        r = a.pushover(
            lateral, s.nodes[1], "ux", 0.21 * (k + 1) / pieces, 21 // pieces, [channel("load_factor", lateral, 0, "f")]
        )
    reference = (
        column()[0]
        .analysis(tolerance=1e-10)
        .pushover(lateral, s.nodes[1], "ux", 0.21, 21, [channel("load_factor", lateral, 0, "f")])
    )
    assert r.final["f"] == pytest.approx(reference.final["f"], rel=1e-8)
