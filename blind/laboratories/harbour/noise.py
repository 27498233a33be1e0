"""Noise of the channels, and the floor that it makes."""

import numpy as np
from scipy.interpolate import CubicSpline
from scipy.signal import butter, sosfiltfilt

from . import effects as fx
from .response import nrms, simulate


def draw_noise(rng, camp, peaks):
    fs = camp["fs"]
    level = float(np.exp(rng.uniform(np.log(0.001), np.log(0.01))))
    top = max(peaks)
    sharp = camp["law"] in fx.STEEL + fx.FLUID
    per_test = bool(rng.random() < 0.5)
    filtered = fs >= 200 and rng.random() < 0.4
    cut = float(rng.uniform(max(30, 0.22 * fs), 0.42 * fs)) if filtered else None
    ul = max(np.abs(t["u"]).max() for t in camp["tests"])
    disp = 0.0 if rng.random() < 0.15 else float(np.exp(rng.uniform(np.log(5e-5), np.log(1e-3))))
    return dict(
        force_share=level,
        per_test=per_test,
        force=[level * (p if per_test else top) for p in peaks],
        displacement=disp * ul,
        cut=cut,
        signal_filtered=bool(filtered and not sharp),
        quantised=bool(rng.random() < 0.3),
        lsb_F=2.4 * top / 2 ** int(rng.choice([13, 14, 16])),
        lsb_D=2.4 * ul / 2 ** int(rng.choice([14, 16])),
    )


def white(rng, n, std, cut, fs):
    x = rng.standard_normal(n)
    if cut:
        x = sosfiltfilt(butter(3, cut, fs=fs, output="sos"), x)
    return std * x / max(x.std(), 1e-12)


def floor_of(rng, camp, noise, effects, unlisted=None):
    """NRMS that pure channel noise makes in the validate tests: of the force, and of the displacement (smoothed at four
    times the largest frequency of the programme, as anybody must who differentiates it) through the true law and
    effects."""
    fs, splines = camp["fs"], []
    fc = min(max(4 * camp["fmax"], 12.0), 0.4 * fs)
    for test in camp["tests"]:
        ts = test["t"][:: test["os"]]
        x = sosfiltfilt(
            butter(4, fc, fs=fs, output="sos"), white(rng, ts.size, noise["displacement"], noise["cut"], fs)
        )
        splines.append(CubicSpline(ts, x))
    ref = simulate(camp, camp["P"], effects, (), unlisted)
    noisy = simulate(camp, camp["P"], effects, (), unlisted, noise=splines) if noise["displacement"] > 0 else ref
    v = camp["validate"]
    d = nrms(noisy, ref, v)
    f = np.sqrt(sum(noise["force"][i] ** 2 * ref[i][2].size for i in v) / sum(np.sum(ref[i][2] ** 2) for i in v))
    return float(np.hypot(d, f)), ref
