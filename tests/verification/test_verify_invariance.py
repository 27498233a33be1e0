"""What must not change results: order of nodes, elements and fibres, units, threads, shortcuts."""

from __future__ import annotations

from concurrent.futures import ThreadPoolExecutor
from typing import Any

import numpy as np
import pytest
from verification.shaken_portal import SI, Units, ground, shake

from edesign.core import Response


def assert_close(one: Response, other: Response, tolerance: float) -> None:
    for name, values in one.values.items():
        scale = np.abs(values).max()
        np.testing.assert_allclose(other.values[name], values, atol=tolerance * scale, rtol=0, err_msg=name)


@pytest.fixture(scope="module")
def plain() -> Response:
    """Default settings but for a tolerance that leaves only rounding. It yields: the invariance is not that of a
    linear frame."""
    r, _ = shake(tolerance=1e-11)
    assert r.energy["hysteretic"][-1] > 0.1 * r.energy["input"][-1]
    return r


@pytest.mark.parametrize("nodes", [(3, 2, 1, 0), (2, 0, 3, 1)])
def test_node_order(plain: Response, nodes: tuple[int, ...]) -> None:
    """The numbering changes sums and pivots: rounding, grown over 300 yielding steps (1e-8)."""
    assert_close(plain, shake(nodes=nodes, tolerance=1e-11)[0], 1e-8)


@pytest.mark.parametrize("members", [(3, 2, 1, 0), (2, 0, 3, 1)])
def test_element_order(plain: Response, members: tuple[int, ...]) -> None:
    assert_close(plain, shake(members=members, tolerance=1e-11)[0], 1e-8)


def test_fibre_order_bitwise() -> None:
    """Fibres are sorted and merged: the order in which they are given leaves no trace, not even in rounding."""
    one, one_state = shake(fibres=np.random.default_rng(1))
    two, two_state = shake(fibres=np.random.default_rng(2))
    np.testing.assert_array_equal(one_state, two_state)
    for name in one.values:
        np.testing.assert_array_equal(one.values[name], two.values[name])


def test_merged_fibres_equal_layers(plain: Response) -> None:
    assert_close(plain, shake(fibres=np.random.default_rng(3), tolerance=1e-11)[0], 1e-8)


def scale_of(name: str, units: Units) -> float:
    force = units.force * (units.length if name in ("m", "beam") else 1.0)
    return {"u": units.length, "r": 1.0}.get(name, force)


COUNTS = ("steps", "substeps", "iterations", "factorisations", "refactorisations", "element_iterations", "fallbacks")


@pytest.mark.parametrize("curved", [False, True], ids=["bilinear", "curved"])
def test_units_by_powers_of_two_bitwise(curved: bool) -> None:
    """Powers of two scale without rounding: every number and every decision must be the same, bit for bit."""
    units = Units(length=2.0**10, force=2.0**-10, time=2.0)
    one, _ = shake(curved=curved)
    two, _ = shake(units, curved=curved)
    assert {k: one.statistics[k] for k in COUNTS} == {k: two.statistics[k] for k in COUNTS}
    for name, values in one.values.items():
        np.testing.assert_array_equal(two.values[name] / scale_of(name, units), values, err_msg=name)


@pytest.mark.parametrize(
    "units",
    [Units(1e3, 1e-3, 1.0), Units(1 / 0.0254, 1 / 4448.2216, 1.0), Units(1e3, 1.0, 1e3)],
    ids=["mm-kN-t", "in-kip", "mm-N-ms"],
)
def test_units(units: Units) -> None:
    """m, N, kg, s and others: the same path (iterations), the same results to rounding (1e-8)."""
    one, two = shake(SI)[0], shake(units)[0]
    assert {k: one.statistics[k] for k in COUNTS} == {k: two.statistics[k] for k in COUNTS}
    for name, values in one.values.items():
        np.testing.assert_allclose(two.values[name] / scale_of(name, units), values, atol=1e-8 * np.abs(values).max())


def test_threads_bitwise() -> None:
    """Two analyses at a time give what one after the other gives. Several rounds, since threads meet differently."""
    motions = [ground(200, 8.0, f) for f in (1.3, 1.9, 2.6, 3.4)]
    alone = [shake(motion=g) for g in motions]
    for _ in range(2):
        with ThreadPoolExecutor(2) as pool:
            together = list(pool.map(lambda g: shake(motion=g), motions))
        for (r1, s1), (r2, s2) in zip(alone, together, strict=True):
            np.testing.assert_array_equal(s1, s2)
            for name in r1.values:
                np.testing.assert_array_equal(r1.values[name], r2.values[name])


def test_repeated_runs_bitwise() -> None:
    np.testing.assert_array_equal(shake()[1], shake()[1])


@pytest.mark.parametrize("setting", ["fast_elastic", "reuse_factors", "energy"])
def test_shortcuts(plain: Response, setting: str) -> None:
    """Switched off, a shortcut changes nothing but the time it takes: tolerance of the equilibrium 1e-11, grown to
    1e-7."""
    settings: dict[str, Any] = {"tolerance": 1e-11, setting: 0.0}
    off = shake(**settings)[0]
    assert_close(plain, off, 1e-7)
    if setting == "fast_elastic":
        assert off.statistics["elastic_updates"] == 0 < plain.statistics["elastic_updates"]


def test_default_tolerance_is_tight_enough(plain: Response) -> None:
    """The default 1e-6 changes displacement and forces by less than 1e-4 of their peaks."""
    assert_close(plain, shake()[0], 1e-4)
