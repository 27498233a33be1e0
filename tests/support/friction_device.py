"""Tests of a friction damper behind a soft clearance of its pins, made by numpy alone: the element slips where its
spring is stretched by the slip force (return mapping), and nothing of edesign takes part.

The clearance is soft (rubber liners), beyond it the pins are stiff. The slip force differs from test to test by some
per cent and falls a little with the speed, as pads do.
"""

from __future__ import annotations

from pathlib import Path

import numpy as np

SLIP, PLAY, SOFT, STIFF = 50.0, 1.6, 8.0, 120.0  # kN, mm end to end, kN/mm within it, kN/mm beyond
NOISE, READING = 0.2, 0.002  # kN, mm
Programme = tuple[tuple[float, float, str], ...]
"""Amplitude, mm, frequency, Hz, and use of each test."""
THREE: Programme = ((20.0, 0.25, "fit"), (12.0, 0.5, "fit"), (16.0, 0.8, "fit"), (18.0, 0.4, "validate"))


def spring(stretch: float) -> float:
    """Force, kN, of the pins at a stretch, mm."""
    inside = min(abs(stretch), 0.5 * PLAY)
    return float(np.sign(stretch)) * (SOFT * inside + STIFF * (abs(stretch) - inside))


def force(displacement: np.ndarray, slip: float) -> np.ndarray:
    """Force (n,) kN under a displacement (n,) mm: the element moves on where the pins would carry more than `slip`."""
    longest = 0.5 * PLAY + (slip - 0.5 * SOFT * PLAY) / STIFF
    at, found = 0.0, np.empty_like(displacement)
    for i, u in enumerate(displacement):
        at = min(max(at, u - longest), u + longest)
        found[i] = spring(u - at)
    return found


def campaign(folder: Path, seed: int = 1, programme: Programme = THREE, scatter: float = 0.02) -> Path:
    """Write the tests and the campaign file: sines of eight cycles with a cycle of ramp at both ends.

    Args:
        folder: for them.
        seed: of noise and scatter.
        programme: the tests.
        scatter: standard deviation of the slip force from test to test, as a share.

    Returns:
        The campaign file, in which the law is declared a tenth too weak and without clearance.
    """
    random = np.random.default_rng(seed)
    folder.mkdir(parents=True, exist_ok=True)
    rows = []
    for number, (amplitude, frequency, use) in enumerate(programme, start=1):
        end = 8.0 / frequency
        t = np.arange(0.0, end, 0.005)
        u = amplitude * np.clip(np.minimum(t, end - t) * frequency, 0.0, 1.0) * np.sin(2.0 * np.pi * frequency * t)
        slower = 1.0 - 0.03 * np.abs(np.gradient(u, t)) / 80.0
        f = force(u, SLIP * (1.0 + scatter * random.standard_normal())) * slower + NOISE * random.standard_normal(
            t.size
        )
        u = u + READING * random.standard_normal(t.size)
        lines = [f"{a:.3f},{b:.4f},{c:.4f}" for a, b, c in zip(t, u, f, strict=True)]
        text = "\n".join(["time_s,displacement_mm,force_kN", *lines, ""])
        (folder / f"test_{number}.csv").write_text(text, encoding="utf-8")
        rows.append(f"  - {{file: test_{number}.csv, title: {amplitude:g} mm, temperature: 20 degC, use: {use}}}")
    head = [
        "title: friction device",
        "specimen: {name: F1, layers: 1, layer_area: 1000 mm^2, layer_thickness: 100 mm}",
        "law: {type: friction, parameters: {mu: 0.3, N: 150 kN, k: 100 kN/mm}}",
        "tests:",
    ]
    path = folder / "campaign.yaml"
    path.write_text("\n".join([*head, *rows, ""]), encoding="utf-8")
    return path
