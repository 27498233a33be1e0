"""A folder of small record files, for tests of what is chosen out of it."""

from __future__ import annotations

from pathlib import Path

import numpy as np

STEP = 0.01  # s


def motion(seed: int, peak: float = 0.2, seconds: float = 8.0) -> np.ndarray:
    """Ground acceleration in g: waves from 0.5 to 8 Hz with random phases under a smooth envelope."""
    rng = np.random.default_rng(seed)
    t = np.arange(round(seconds / STEP)) * STEP
    frequency = np.geomspace(0.5, 8.0, 40)
    phase, size = rng.uniform(0.0, 2.0 * np.pi, 40), rng.uniform(0.3, 1.7, 40)
    waves = size @ np.sin(2.0 * np.pi * np.outer(frequency, t) + phase[:, None])
    wave = waves * np.sin(np.pi * t / seconds) ** 2
    return peak * wave / np.max(np.abs(wave))


def write_at2(path: Path, acceleration: np.ndarray, title: str = "Somewhere") -> Path:
    """Write a file of PEER; `title` is its second line: earthquake, date, station, azimuth."""
    path.parent.mkdir(parents=True, exist_ok=True)
    head = f"PEER NGA STRONG MOTION DATABASE RECORD\n{title}\nACCELERATION TIME SERIES IN UNITS OF G\n"
    rows = "\n".join(f"{value:.9e}" for value in acceleration)
    path.write_text(f"{head}NPTS= {acceleration.size}, DT= {STEP} SEC\n{rows}\n", encoding="ascii")
    return path
