"""A campaign without effects: specimen, programme, sampling rate and noise that fit each other."""

import numpy as np

from .laboratory import loguni, lowpass, make_motion, measure, predict, record_part, upsampled
from .laws import draw_law


def programme(rng, A, f, fs, law, several_T, servo, rising, motion_share, n_least):
    n = int(rng.integers(n_least, 9))
    kinds = []
    osc = ["sine", "sine", "stepped", "sweep", "triangle", "bursts"]
    for i in range(n):  # random and earthquake motions as often as sines
        kinds.append(str(rng.choice(["quake", "quake", "random"])) if i % 2 else str(rng.choice(osc)))
    rng.shuffle(kinds)
    nv = {5: 2, 6: 2, 7: 2, 8: 3}[n]
    use = ["fit"] * n
    while True:
        val = sorted(rng.choice(np.arange(1 if rising else 0, n), nv, replace=False))
        if len({kinds[j] in ("quake", "random") for j in val}) == 2 or rng.random() < 0.3:
            break
    for j in val:
        use[j] = "validate"
    amps = A * np.where(rng.random(n) < 0.3, 1.0, rng.uniform(0.25, 1.0, n))
    amps[rng.integers(n)] = A
    if rising:
        amps[: n - 1] = np.sort(amps[: n - 1])
        amps[0] = min(amps[0], 0.45 * A)
    moving = [None] * n
    if motion_share:
        for j in rng.choice(np.arange(n), max(1, int(round(n / 3))), replace=False):
            moving[j] = str(rng.choice(["cut", "late", "ramp", "transient"]))
    T = [float(np.round(rng.uniform(18, 24), 1))] * n
    if several_T:
        lv = np.round(np.array([20, rng.uniform(8, 14), rng.uniform(27, 35)]), 1)
        T = [float(lv[(j + int(i0)) % 3]) for j, i0 in zip(range(n), np.repeat(rng.integers(3), n), strict=False)]
        fitT = {T[j] for j in range(n) if use[j] == "fit"}
        if len(fitT) < 3:
            ff = [j for j in range(n) if use[j] == "fit"]
            for a, j in enumerate(ff):
                T[j] = float(lv[a % 3])
    mots = []
    for j in range(n):
        ff = float(np.clip(f * loguni(rng, 0.4, 2.2), 0.08, 3.0))
        if kinds[j] == "quake":
            ff = max(ff, 0.5)
        D = float(np.round(max(loguni(rng, 6, 40), min(3.2 / ff, 38)), 1))
        ff = min(ff, 400 / (2 * np.pi * amps[j]))
        mots.append(make_motion(kinds[j], amps[j], ff, D, fs, rng, servo, moving[j]))
    return mots, use, T


def pooled(errs, Fs):
    return float(np.sqrt(sum(np.sum(e**2) for e in errs) / sum(np.sum(F**2) for F in Fs)))


def context(camp, rec):
    u = [m["u"][m["npre"] :] for m in camp["motions"]]
    h = [m["h"] for m in camp["motions"]]
    v = [np.gradient(x, d) for x, d in zip(u, h, strict=False)]
    R = record_part(camp, rec)
    W = [abs(np.sum(0.5 * (F[1:] + F[:-1]) * np.diff(x))) for x, F in R]
    return {
        "A": max(np.abs(x).max() for x in u),
        "V": max(np.abs(x).max() for x in v),
        "F": max(np.abs(F).max() for _, F in R),
        "acc": max(np.percentile(np.abs(np.gradient(x, d)), 99.5) for x, d in zip(v, h, strict=False)),
        "W": sum(W),
        "Wmax": max(W),
        "path": sum(np.abs(np.diff(x)).sum() for x in u),
    }


def base(law, rng, several_T, rising, want_hum, motion_share, n_least):
    """Campaign without effects: specimen, programme, sampling rate and noise that fit each other."""
    p, A, f, layers = draw_law(law, rng)
    rates = [50, 100, 128, 200, 250, 256, 400, 500]
    i = int(rng.integers(0, 7))
    seed = int(rng.integers(1 << 30))
    noise = {
        "force": loguni(rng, 0.001, 0.01),
        "of": str(rng.choice(["campaign", "test"])),
        "disp": 0.0
        if rng.random() < 0.25
        else loguni(rng, 2e-5, 1e-3)
        * (0.3 if law in ("viscous_power", "maxwell_power", "kelvin_voigt", "mgmm") else 1),
        "filter": float(rng.choice([0.15, 0.2, 0.3])) if rng.random() < 0.5 else None,
        "bits": int(rng.choice([0, 11, 12, 14])) if rng.random() < 0.6 else 0,
    }
    noise["bits_u"] = max(
        noise["bits"], 14 if law in ("viscous_power", "maxwell_power", "kelvin_voigt", "mgmm") else 12
    )
    if want_hum:
        i = max(i, 2)
    while i < len(rates):
        fs = rates[i]
        r2 = np.random.default_rng(seed)
        servo = min(12.0, fs / 10, 8 * max(f, 0.5))
        mots, use, T = programme(r2, A, f, fs, law, several_T, servo, rising, motion_share, n_least)
        camp = {
            "law": law,
            "p": p,
            "motions": mots,
            "use": use,
            "T": T,
            "noise": noise,
            "rest": float(rng.choice([300, 900, 1800])),
            "layers": layers,
            "fs": fs,
        }
        rec = measure(camp, [])
        R = record_part(camp, rec)
        pr = predict(camp, upsampled(camp, [u for u, _ in rec]), p)
        err = np.sqrt(np.mean(np.concatenate([F - q for (_, F), q in zip(R, pr, strict=False)]) ** 2))
        sF = noise["force"] * max(np.abs(F).max() for _, F in R)
        if err < 0.4 * sF:
            break
        i += 1
    else:
        return None
    camp["sampling_error"] = err / np.sqrt(np.mean(np.concatenate([F for _, F in R]) ** 2))
    return camp, rec


def noise_nrms(camp, rec, noisy, which):
    """Share of the rms force that noise makes: of the force, and of the displacement below 20 Hz through the law."""
    R, N = record_part(camp, rec), record_part(camp, noisy)
    w = [j for j in range(len(R)) if camp["use"][j] == which]
    a = [N[j][1] - R[j][1] for j in w]
    fs = camp["fs"]
    lp = [u + lowpass(x - u, 20.0, fs, 2) for (u, _), (x, _) in zip(rec, noisy, strict=False)]
    p0 = predict(camp, upsampled(camp, [u for u, _ in rec]), camp["p"], None, w)
    p1 = predict(camp, upsampled(camp, lp), camp["p"], None, w)
    b = [p1[j] - p0[j] for j in w]
    F = [R[j][1] for j in w]
    return float(np.hypot(pooled(a, F), pooled(b, F))), pooled(b, F)
