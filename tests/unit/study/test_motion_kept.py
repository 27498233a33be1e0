"""What `motion` keeps of a history: nodes and hinges at the times of pictures, the values of the other variables."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from unit.study.test_history import made, run

from edesign.study.results.motion import FINENESS, MOST_PICTURES, as_seen, picture_stride


def test_pictures_are_samples_of_the_history(tmp_path: Path) -> None:
    group = run(made(tmp_path, outputs="{histories: [floors, motion]}"))
    time, pictures = group.coords["time"].values, group.coords["motion_time"].values
    np.testing.assert_array_equal(pictures, time[::4])  # of 0.01 s: 25 pictures a second
    nodes = [str(name) for name in group.coords["node"].values]
    moved = group.variables["node_displacement"].values
    assert moved.shape == (pictures.size, len(nodes), 3)
    roof = [i for i, name in enumerate(nodes) if name.endswith("1")]
    expected = group.variables["floor_displacement"].values[::4, 0]
    # the mean over the nodes of a floor is the floor's; a step is at most 1/FINENESS of the largest, the error half
    assert moved[:, roof, 0].mean(axis=1) == pytest.approx(
        expected, abs=0.5 / FINENESS * float(np.abs(moved[..., :2]).max())
    )
    assert np.all(moved[:, [i for i, name in enumerate(nodes) if name.endswith("0")]] == 0.0)


def test_motion_does_not_change_the_results(tmp_path: Path) -> None:
    kept, plain = (run(made(tmp_path, outputs=f"{{histories: [{kinds}]}}")) for kinds in ("floors, motion", "floors"))
    assert "node_displacement" not in plain.variables and "motion_time" not in plain.coords
    for name, variable in plain.variables.items():
        np.testing.assert_array_equal(kept.variables[name].values, variable.values, err_msg=name)


@pytest.mark.parametrize(("step", "count", "stride"), [(0.01, 100, 4), (0.1, 100, 1), (0.01, 6001, 11), (0.05, 1, 1)])
def test_no_more_pictures_than_the_eye_sees(step: float, count: int, stride: int) -> None:
    found = picture_stride(step * np.arange(count))
    assert found == stride and count / found <= MOST_PICTURES


@pytest.mark.parametrize("largest", [1e-3, 0.37, 1.0, 250.0])
def test_rounding_for_pictures_is_finer_than_they_are(largest: float) -> None:
    values = largest * np.random.default_rng(3).uniform(-1.0, 1.0, (50, 6, 3))
    values[0, 0, 0], values[..., 2] = largest, 0.1 * values[..., 2]
    seen = as_seen(values, 2)
    assert np.abs(seen - values).max() <= 0.5 / FINENESS * largest
    step = np.diff(np.unique(seen)).min()
    assert np.log2(step) % 1.0 == 0.0 and step > 0.25 / FINENESS * largest  # else nothing is saved
    np.testing.assert_array_equal(seen, seen.astype(np.float32))
    assert not np.any(as_seen(np.zeros((4, 2, 3)), 2))
