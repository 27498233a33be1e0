"""How the processor time of a calibration is shared."""

from __future__ import annotations

from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest

from edesign.calibrate import run
from edesign.calibrate.dampers.readings import Reading
from edesign.damper.testing.campaign_blocks import LawChoice


@pytest.mark.parametrize(
    ("spent", "readings", "given"),
    [
        (0.0, 1, [60.0]),
        (10.0, 1, [50.0]),
        (55.0, 1, [30.0]),  # half of the time is for the search, come what may
        (10.0, 2, [37.5, 12.5]),  # a quarter for the second reading, as the first search takes all it may
    ],
)
def test_how_the_law_is_read_counts_in_the_time(
    spent: float, readings: int, given: list[float], monkeypatch: pytest.MonkeyPatch
) -> None:
    now, seconds, begun = [0.0], [], []

    def likely(*_: object) -> tuple[Reading, ...]:
        now[0] += spent
        return tuple(Reading(SimpleNamespace(number=i), np.array([float(i)])) for i in range(readings))  # type: ignore[arg-type]

    class Loop:
        def __init__(
            self, problem: object, noise: object, refit: object, workers: int, tell: object, limit: float
        ) -> None:
            seconds.append(limit)

        def run(self, about: np.ndarray) -> Any:
            now[0] += seconds[-1]
            begun.append(about.tolist())
            final = SimpleNamespace(at_floor=False)
            return SimpleNamespace(final=final, ending="out_of_time")

    monkeypatch.setattr(run, "taken", lambda: now[0])
    monkeypatch.setattr(run, "likely_readings", likely)
    monkeypatch.setattr(run, "Loop", Loop)
    monkeypatch.setattr(run, "simplest", lambda models: models[0])
    law = LawChoice("mgmm", "thesis_table_4_2")
    _, problem = run._searched(None, law, (1.0,), 2, lambda _: None, 60.0)  # type: ignore[arg-type]
    assert seconds == given and problem.number == 0  # type: ignore[attr-defined]
    assert begun == [[float(i)] for i in range(readings)]  # the fit of the reading is where the refit begins
