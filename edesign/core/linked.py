"""Histories of a linear structure with dampers as links between its floors, in the C core."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from edesign.core._edcore import ffi, lib
from edesign.core.damper import METHODS, TOLERANCE, CoreDamper
from edesign.core.errors import CoreError, status_name
from edesign.core.stop import raise_if_stopped

_REST = 1e6
"""s between tests: what relaxes has done so, what has broken stays."""


@dataclass(frozen=True, eq=False)
class LinkedTest:
    """A test of a linear structure: x1 = a x0 + pushed + links0 f0 + links1 f1 from sample to sample.

    Attributes:
        pushed: (t - 1, n) what the motion of the ground adds to the state in each step.
        step: s between samples.
        a: (n, n) of the state x.
        of_links: (n, links) twice, of forces f of links at the beginning and at the end of a step.
    """

    pushed: np.ndarray
    step: float
    a: np.ndarray
    of_links: tuple[np.ndarray, np.ndarray]


def linked_histories(
    links: Sequence[CoreDamper],
    seen: np.ndarray,
    tests: Sequence[LinkedTest],
    carry: bool = False,
) -> tuple[list[np.ndarray], list[np.ndarray]]:
    """Return the states and the forces of the links in tests of one structure, each from rest.

    Args:
        seen: (2 links, n) rows that give their deformations, then their velocities, of the state.
        tests: in the order in which they were made.
        carry: whether what effects of the links remember goes on from test to test.

    Returns:
        States (t, n) and forces (t, links) of each test.

    Raises:
        CoreError: the forces of the links are not found, or what is found is not finite.
    """
    n, m = seen.shape[1], len(links)
    kept: list[np.ndarray] = []

    def given(values: np.ndarray, *shape: int) -> Any:
        array = np.ascontiguousarray(values, dtype=float)
        if array.shape != shape:
            raise ValueError(f"an array of shape {array.shape} in place of {shape}")
        kept.append(array)
        return ffi.from_buffer("double[]", array)

    for_core = ffi.new("ed_linked_test[]", len(tests))
    for one, test in zip(for_core, tests, strict=True):
        one.n, one.h = len(test.pushed) + 1, test.step
        one.pushed, one.a = given(test.pushed, len(test.pushed), n), given(test.a, n, n)
        one.from_links = [given(values, n, m) for values in test.of_links]
    ends = np.cumsum([len(test.pushed) + 1 for test in tests])
    state, force, end = np.empty((ends[-1], n)), np.empty((ends[-1], m)), ffi.new("ed_campaign_end *")
    handles = ffi.new("ed_damper *[]", [link.handle for link in links])
    status = lib.ed_linked_history(
        n,
        m,
        handles,
        given(seen, 2 * m, n),
        len(tests),
        for_core,
        lib.ED_CARRY_EFFECTS if carry else lib.ED_CARRY_NOTHING,
        _REST,
        METHODS["best"],
        TOLERANCE,
        ffi.from_buffer("double[]", state),
        ffi.from_buffer("double[]", force),
        end,
    )
    raise_if_stopped(status)
    if status != lib.ED_OK:
        text = ffi.string(lib.ed_status_text(status)).decode()
        raise CoreError(status_name(status), f"links: {text} in test {end.test + 1} at sample {end.sample + 1}")
    return np.split(state, ends[:-1]), np.split(force, ends[:-1])
