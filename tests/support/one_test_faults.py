"""Campaigns of three dampers by numpy alone, with a fault of an instrument in one test; nothing of edesign takes part.

Forces follow closed forms (Kelvin-Voigt, power of the velocity) or small steps of the equation (Bouc-Wen, Wen 1976).
"""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

import numpy as np

RATE = 100.0  # Hz
NOISE, READING = 0.004, 2e-4  # of the largest force and displacement
LAWS = {
    "kelvin_voigt": "{k: 2.2 kN/mm, c: 0.25 kN*s/mm}",
    "bouc_wen": "{Fy: 44 kN, Y: 3.3 mm, alpha: 0.11, n: 1.8}",
    "viscous_power": "{c: 8.5 kN*(s/mm)^0.45, alpha: 0.45}",
}
"""As declared: some 10 % off."""
MOTIONS = ((20.0, 0.3), (12.0, 0.8), (25.0, 0.5), (8.0, 1.5), (16.0, 1.1), (22.0, 0.4), (14.0, 0.6), (18.0, 0.9))
"""Amplitude, mm, and frequency, Hz, of each test."""
Columns = tuple[np.ndarray, np.ndarray, np.ndarray]
"""Time, s, displacement, mm, force, kN."""
Fault = Callable[[Columns], Columns]


def motion(amplitude: float, frequency: float, phase: float) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Time, s, displacement, mm, and velocity, mm/s, of two sines that come and go; it rests at both ends."""
    end = 9.0 / frequency
    t = np.arange(0.0, end + 1.0, 1.0 / RATE)
    s = np.clip((t - 0.5) / end, 0.0, 1.0)
    w, w2 = 2.0 * np.pi * frequency, 2.0 * np.pi * 1.37 * frequency
    envelope, rate = np.sin(np.pi * s) ** 2, np.pi / end * np.sin(2.0 * np.pi * s)
    wave = 0.75 * np.sin(w * t) + 0.35 * np.sin(w2 * t + phase)
    slope = 0.75 * w * np.cos(w * t) + 0.35 * w2 * np.cos(w2 * t + phase)
    return t, amplitude * envelope * wave, amplitude * (rate * wave + envelope * slope)


def force(law: str, u: np.ndarray, v: np.ndarray) -> np.ndarray:
    """Force, kN, of a displacement, mm, and velocity, mm/s, at the samples."""
    if law == "kelvin_voigt":
        return 2.0 * u + 0.27 * v
    if law == "viscous_power":
        return 9.0 * np.abs(v) ** 0.45 * np.sign(v)
    z, steps = np.zeros_like(u), 40
    for i in range(1, u.size):
        z[i], du = z[i - 1], (u[i] - u[i - 1]) / steps
        for _ in range(steps):
            z[i] += du / 3.0 * (1.0 - (0.5 + 0.5 * np.sign(du * z[i])) * abs(z[i]) ** 1.6)
    return 0.1 * 40.0 / 3.0 * u + 0.9 * 40.0 * z


def none(columns: Columns) -> Columns:
    """Change nothing."""
    return columns


def more_force(share: float) -> Fault:
    return lambda of: (of[0], of[1], (1.0 + share) * of[2])


def more_displacement(share: float) -> Fault:
    return lambda of: (of[0], (1.0 + share) * of[1], of[2])


def slow_clock(share: float) -> Fault:
    return lambda of: ((1.0 + share) * of[0], of[1], of[2])


def late_force(lag: float) -> Fault:
    return lambda of: (of[0], of[1], np.interp(of[0] - lag, of[0], of[2]))


def campaign(
    folder: Path, law: str, fault: Fault, faulty: int, tests: int = 6, validation: int = 2, seed: int = 1
) -> Path:
    """Write tests and the campaign file.

    Args:
        folder: for them.
        fault: in one test.
        faulty: number of that test, from 1; 0: in none.
        tests, validation: how many there are, and how many of them, the last ones, validate.
        seed: of noise and phases.

    Returns:
        The campaign file.
    """
    random = np.random.default_rng(seed)
    folder.mkdir(parents=True, exist_ok=True)
    rows = []
    for number in range(1, tests + 1):
        amplitude, frequency = MOTIONS[(number - 1) % len(MOTIONS)]
        t, u, v = motion(amplitude, frequency, 2.0 * np.pi * random.random())
        t, u, f = (fault if number == faulty else none)((t, u, force(law, u, v)))
        u = u + READING * np.max(np.abs(u)) * random.standard_normal(u.size)
        f = f + NOISE * np.max(np.abs(f)) * random.standard_normal(f.size)
        name = f"run_{number:02d}.csv"
        np.savetxt(
            folder / name,
            np.column_stack((t, u, f)),
            "%.7g",
            ",",
            header="time_s,displacement_mm,force_kN",
            comments="",
        )
        use = "fit" if number <= tests - validation else "validate"
        rows.append(f"  - {{file: {name}, title: test {number}, temperature_C: 20, use: {use}}}\n")
    path = folder / "campaign.yaml"
    path.write_text(f"specimen: {{name: D}}\nlaw: {{type: {law}, parameters: {LAWS[law]}}}\ntests:\n{''.join(rows)}")
    return path
