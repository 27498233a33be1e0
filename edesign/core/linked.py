"""Histories of a linear structure with dampers as links between its floors, in the C core."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from edesign.core._edcore import ffi, lib
from edesign.core.damper import METHODS, TOLERANCE, CoreDamper, Method, fineness
from edesign.core.errors import CoreError, status_name
from edesign.core.stop import raise_if_stopped

_REST = 1e6
"""s between tests: what relaxes has done so, what has broken stays."""


@dataclass(frozen=True, eq=False)
class LinkedTest:
    """A test of a linear structure: x1 = a x0 + ground0 g0 + ground1 g1 + links0 f0 + links1 f1 from sample to sample.

    Attributes:
        ground: (t,) motion g of the ground.
        step: s between its samples.
        a: (n, n) of the state x.
        of_ground: (n,) twice, of g at the beginning and at the end of a step.
        of_links: (n, links) twice, of forces f of links at the beginning and at the end of a step.
    """

    ground: np.ndarray
    step: float
    a: np.ndarray
    of_ground: tuple[np.ndarray, np.ndarray]
    of_links: tuple[np.ndarray, np.ndarray]


def linked_histories(
    links: Sequence[CoreDamper],
    seen: np.ndarray,
    tests: Sequence[LinkedTest],
    carry: bool = False,
    method: Method = "best",
    length: float | None = None,
) -> tuple[list[np.ndarray], list[np.ndarray]]:
    """Return the states and the forces of the links in tests of one structure, each from rest.

    Args:
        links: dampers.
        seen: (2 links, n) rows that give their deformations, then their velocities, of the state.
        tests: in the order in which they were made.
        carry: whether what amendments of the links remember goes on from test to test.
        method: as in `CoreDamper.force`.
        length: of the method "fixed", m.

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
        one.n, one.h = test.ground.size, test.step
        one.ground, one.a = given(test.ground, test.ground.size), given(test.a, n, n)
        one.from_ground = [given(values, n) for values in test.of_ground]
        one.from_links = [given(values, n, m) for values in test.of_links]
    ends = np.cumsum([test.ground.size for test in tests])
    state, force, end = np.empty((ends[-1], n)), np.empty((ends[-1], m)), ffi.new("ed_campaign_end *")
    handles = ffi.new("ed_damper *[]", [link.handle for link in links])
    status = lib.ed_linked_history(
        n,
        m,
        handles,
        given(seen, 2 * m, n),
        len(tests),
        for_core,
        lib.ED_CARRY_AMENDMENTS if carry else lib.ED_CARRY_NOTHING,
        _REST,
        METHODS[method],
        fineness(method, TOLERANCE, length),
        ffi.from_buffer("double[]", state),
        ffi.from_buffer("double[]", force),
        end,
    )
    raise_if_stopped(status)
    if status != lib.ED_OK:
        text = ffi.string(lib.ed_status_text(status)).decode()
        raise CoreError(status_name(status), f"links: {text} in test {end.test + 1} at sample {end.sample + 1}")
    return np.split(state, ends[:-1]), np.split(force, ends[:-1])
