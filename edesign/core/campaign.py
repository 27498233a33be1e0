"""Forces of many dampers in the tests of one campaign, by single calls of the C core in several threads."""

from __future__ import annotations

import os
from collections.abc import Sequence
from dataclasses import dataclass
from itertools import pairwise
from typing import Any, Literal

import numpy as np
from numpy.typing import ArrayLike

from edesign.core._edcore import ffi, lib
from edesign.core.damper import METHODS, TOLERANCE, CoreDamper, Method, fineness
from edesign.core.errors import CoreError, status_name
from edesign.core.rig import SeriesRig
from edesign.core.stop import raise_if_stopped

Carry = bool | Literal["effects"]
"""Whether what a specimen remembers goes on from test to test: all of it, or that of effects alone."""


@dataclass(frozen=True)
class CampaignTest:
    """A test of a damper: the motion that it makes, and what stands beside and in series with it.

    The force of the test is factor F + added + spring u_d, with F the damper's under its own deformation u_d: all of
    the deformation, less the stretch of a rig.

    Attributes:
        time: (n,) s, ascending.
        deformation: (n,) m.
        velocity: (n,) m/s; between samples the cubic through deformation and velocity.
        factor: (n,), at least 0; None: 1.
        added: (n,) N; None: 0.
        spring: (n,) N/m, at least 0; None: 0.
        rig: None: the damper alone.
        dampers: those that make this test in place of the campaign's, as many and of the same law and effects, with
            other values: at another temperature, say; None: the campaign's.
        rest: s since the test before, above 0; of the first test, and without carrying over, it does not matter.
    """

    time: ArrayLike
    deformation: ArrayLike
    velocity: ArrayLike
    factor: ArrayLike | None = None
    added: ArrayLike | None = None
    spring: ArrayLike | None = None
    rig: SeriesRig | None = None
    rest: float = 0.0
    dampers: Sequence[CoreDamper] | None = None


@dataclass(frozen=True)
class CampaignForces:
    """Forces of some dampers in some tests.

    Attributes:
        force: of each test (n_dampers, n), N; not a number from where a damper failed on.
        own: the damper's own deformation in each test (n_dampers, n), m; None: not asked for.
        failed: by damper, what the core says and where.
    """

    force: tuple[np.ndarray, ...]
    own: tuple[np.ndarray, ...] | None
    failed: dict[int, str]


def campaign_forces(
    dampers: Sequence[CoreDamper],
    tests: Sequence[CampaignTest],
    method: Method = "best",
    tolerance: float = TOLERANCE,
    length: float | None = None,
    carry: Carry = False,
    own: bool = False,
    threads: int | None = None,
) -> CampaignForces:
    """Return the forces of dampers in all tests: to the last bit those of `CoreDamper`, for any number of threads.

    With `carry` the tests are those of one specimen in this order. Extremes that soften the MGMM and the modified
    Bouc-Wen law, and the states of effects, go on from one test to the next: over its rest the envelope, network,
    heat and what relaxes fade, and Mullins' forms regain their share `recovery`. Friction that builds up over a way
    begins anew, and so does everything else of the law, at rest and held at the first deformation.

    Args:
        dampers: e.g. of one law with many sets of parameters; one that fails does not stop the others.
        tests: the same for all dampers.
        method: as in `CoreDamper.force`.
        tolerance: relative, of SUNDIALS; in series with a rig it has its own.
        length: of the method "fixed", m.
        carry: whether one specimen went through all tests; "effects": what effects remember goes on alone.
        own: whether the damper's own deformations are wanted.
        threads: at most so many; None: as many as there are processors.

    Returns:
        Forces, deformations and which dampers failed.

    Raises:
        CoreError: a test that is not allowed, or "fixed" without length.
        ValueError: no test, or samples of one that are not equally many, or none.
    """
    if not tests:
        raise ValueError("a campaign without tests")
    fine = fineness(method, tolerance, length)
    kept: list[Any] = []
    samples = [_for_core(i, test, kept) for i, test in enumerate(tests)]
    for i, test in enumerate(tests):
        if test.dampers is not None and len(test.dampers) != len(dampers):
            raise ValueError(f"test {i + 1}: {len(test.dampers)} dampers in place of {len(dampers)}")
    offsets = np.cumsum([0, *(one["n"] for one in samples)])
    force = np.empty((len(dampers), offsets[-1]))
    deformation = np.empty_like(force) if own else None
    ends = ffi.new("ed_campaign_end[]", max(len(dampers), 1))

    def run(first: int, last: int) -> None:
        of_tests = [_handles(dampers if one.dampers is None else one.dampers, first, last) for one in tests]
        given = ffi.new("ed_test[]", [{**one, "damper": of} for one, of in zip(samples, of_tests, strict=True)])
        status = lib.ed_damper_campaign(
            last - first,
            _handles(dampers, first, last),
            len(tests),
            given,
            METHODS[method],
            fine,
            lib.ED_CARRY_EFFECTS if carry == "effects" else lib.ED_CARRY_ALL if carry else lib.ED_CARRY_NOTHING,
            ffi.from_buffer("double[]", force[first:last]),
            ffi.NULL if deformation is None else ffi.from_buffer("double[]", deformation[first:last]),
            ends + first,
        )
        raise_if_stopped(status)
        if status != lib.ED_OK:
            raise CoreError(status_name(status), f"damper campaign: {_where(status, ends[first], tests, carry)}")

    workers = max(1, min(len(dampers), threads or os.cpu_count() or 1))
    bounds = [round(i * len(dampers) / workers) for i in range(workers + 1)]
    if workers == 1 and dampers:
        run(0, len(dampers))
    elif dampers:
        from concurrent.futures import ThreadPoolExecutor

        with ThreadPoolExecutor(workers) as pool:
            list(pool.map(run, bounds[:-1], bounds[1:]))
    failed = {
        i: f"{_text(ends[i].status)} in test {ends[i].test + 1} at sample {ends[i].sample + 1}"
        for i in range(len(dampers))
        if ends[i].status != lib.ED_OK
    }
    pieces = [slice(*bound) for bound in pairwise(offsets)]
    return CampaignForces(
        tuple(force[:, piece] for piece in pieces),
        None if deformation is None else tuple(deformation[:, piece] for piece in pieces),
        failed,
    )


def _handles(dampers: Sequence[CoreDamper], first: int, last: int) -> Any:
    return ffi.new("ed_damper *[]", [damper.handle for damper in dampers[first:last]])


def _for_core(index: int, test: CampaignTest, kept: list[Any]) -> dict[str, Any]:
    """Return the fields of a test for the core; what they point to goes to `kept`."""
    found: dict[str, Any] = {"rest": test.rest}
    names = {
        "time": "time",
        "deformation": "u",
        "velocity": "v",
        "factor": "factor",
        "added": "added",
        "spring": "spring",
    }
    size = np.size(test.time)
    for name, field in names.items():
        values = getattr(test, name)
        if values is None:
            found[field] = ffi.NULL
            continue
        array = np.ascontiguousarray(values, dtype=float).ravel()
        if array.size != size or size == 0:
            raise ValueError(f"test {index + 1}: {size} times, {array.size} values of {name}")
        kept.append(ffi.from_buffer("double[]", array))
        found[field] = kept[-1]
    kept.append(ffi.NULL if test.rig is None else test.rig.for_core())
    return {**found, "n": size, "rig": kept[-1]}


def _where(status: int, end: Any, tests: Sequence[CampaignTest], carry: Carry) -> str:
    test = tests[end.test]
    if carry and end.test > 0 and not (test.rest > 0.0 and np.isfinite(test.rest)):
        return f"test {end.test + 1}: rest = {test.rest:g} s is not allowed: finite and above 0"
    return f"test {end.test + 1}: {_text(status)} at sample {end.sample + 1} of {np.size(test.time)}"


def _text(status: int) -> str:
    return str(ffi.string(lib.ed_status_text(status)).decode())
