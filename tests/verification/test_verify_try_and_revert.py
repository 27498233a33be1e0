"""An attempt that is taken back leaves nothing: state, and all that follows, bit for bit as if it had never been
tried."""

from __future__ import annotations

import numpy as np
import pytest
from edesign.core._edcore import ffi, lib
from hypothesis import given, settings
from hypothesis import strategies as st
from verification.shaken_portal import DT, SI, ground, portal, prepare
from verification.structures import channel

from edesign.core import Analysis

STEPS = 120


def begin(kind: str, curved: bool = False, **settings_: float) -> Analysis:
    """A run that has begun: "history", "static" (further gravity) or "pushover"."""
    m, n, _, g = portal(curved=curved)
    lateral = m.pattern()
    m.nodal_load(lateral, n[2], fx=1e3)
    a = prepare(m, g, SI, "current", **settings_)
    if kind == "history":
        motion = ground(STEPS)
        status = lib.ed_history_begin(
            a._c, STEPS, DT, ffi.from_buffer("double[]", motion), ffi.NULL, ffi.NULL, lib.ED_NEWMARK, [0.5, 0.25]
        )
    elif kind == "static":
        status = lib.ed_static_begin(a._c, g, 3.0, STEPS)
    else:
        status = lib.ed_pushover_begin(a._c, lateral, n[2], 0, 0.12, STEPS)
    assert status == lib.ED_OK
    return a


def advance(a: Analysis, steps: int) -> None:
    assert lib.ed_run_advance(a._c, steps) == lib.ED_OK


KINDS = ["history", "static", "pushover"]


@pytest.mark.parametrize("curved", [False, True], ids=["bilinear", "curved"])
@pytest.mark.parametrize("kind", KINDS)
@settings(max_examples=15, deadline=None, derandomize=True)
@given(st.lists(st.tuples(st.integers(1, 25), st.floats(1e-3, 1.0)), min_size=1, max_size=4))
def test_state_is_the_same_bits(kind: str, curved: bool, attempts: list[tuple[int, float]]) -> None:
    """After any number of steps, an attempt at any fraction of the next one."""
    a = begin(kind, curved)
    for steps, fraction in attempts:
        advance(a, steps)
        before = a.state()
        lib.ed_try_and_revert(a._c, fraction)
        np.testing.assert_array_equal(a.state(), before)
    lib.ed_run_end(a._c)


@pytest.mark.parametrize("fractions_tried", [[1.0], [0.3, 0.5]], ids=["whole", "parts"])
@pytest.mark.parametrize("reuse", [0.0, 1.0], ids=["new-factors", "kept-factors"])
@pytest.mark.parametrize("kind", KINDS)
def test_what_follows_is_the_same_bits(kind: str, reuse: float, fractions_tried: list[float]) -> None:
    """A run with attempts between its steps ends in the same state as one without."""
    final = []
    for fractions in ([], fractions_tried):
        a = begin(kind, reuse_factors=reuse)
        for step in range(STEPS):
            if step % 7 == 3:
                for fraction in fractions:
                    lib.ed_try_and_revert(a._c, fraction)
            advance(a, 1)
        lib.ed_run_end(a._c)
        final.append(a.state())
    np.testing.assert_array_equal(final[0], final[1])


@pytest.mark.parametrize("kind", KINDS)
def test_failed_step_is_undone(kind: str) -> None:
    """Steps that all fail (one iteration, a tolerance out of reach, halvings) leave the state as it was."""
    a = begin(kind)
    lib.ed_run_end(a._c)
    a.set("tolerance", 1e-15)
    a.set("max_iterations", 1)
    a.set("halvings", 3)
    before = a.state()
    m = a.model
    if kind == "history":
        r = a.history(ground(10, 50.0), 0.05)
    elif kind == "static":
        r = a.static(0, 9.0)
    else:
        r = a.pushover(1, 2, "ux", 0.5, 1)
    assert r.status == "failed"
    assert r.reason
    assert len(r.events) > 3
    assert m is a.model
    after = a.state()
    if kind == "history":  # the first acceleration and the clock are set by the start of the run
        assert r.time.size == 1 + int(r.statistics["steps"])
    else:
        np.testing.assert_array_equal(after, before)


def test_extremes_and_samples_ignore_attempts() -> None:
    """Channels are sampled at commits only."""
    finals = []
    for attempts in (0, 3):
        a = begin("history", reuse_factors=0.0)
        a._add_channels([channel("reaction", 0, 0, "h"), channel("end_force", 2, 2, "m")])
        for _ in range(60):
            for _ in range(attempts):
                lib.ed_try_and_revert(a._c, 1.0)
            advance(a, 1)
        values = [np.zeros(2) for _ in range(5)]
        lib.ed_extremes(a._c, *(ffi.from_buffer("double[]", v) for v in values))
        lib.ed_run_end(a._c)
        finals.append(np.concatenate(values))
    np.testing.assert_array_equal(finals[0], finals[1])
