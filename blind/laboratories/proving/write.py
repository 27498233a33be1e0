"""Files of a campaign, and the truth beside."""

import json

import numpy as np
from scipy.signal import butter, sosfiltfilt

from . import effects as fx
from .laws import declared, named, text
from .motions import recorded
from .response import Fit, law_only, noise_floor, simulate


def write(folder, name, category, info, seed, number, motion):
    law, P, c, effs, noise, fresh, q = (info[k] for k in ("law", "P", "c", "effs", "noise", "fresh", "q"))
    tests = c["tests"]
    n = len(tests)
    mrng = np.random.default_rng([seed, number, 31])
    kinds = [None] * n
    if motion:
        can = [i for i in range(1, n)]
        pick = sorted(mrng.choice(can, size=round(n / 3), replace=False))
        ways = mrng.permutation(["cut", "mean", "transient", "cut"])
        for j, i in enumerate(pick):
            kinds[i] = str(ways[j % 4])
            if tests[i]["kind"] == "hold" and kinds[i] == "cut":
                kinds[i] = "mean"
    M = [recorded(t, c["dt"], c["fmax"], k, mrng, c["v0"], c["u0"]) for t, k in zip(tests, kinds, strict=False)]
    sim, _ = simulate(law, P, effs, M, c, fresh)
    coarse = simulate(law, P, effs, M, c, fresh, q)[0]
    floors = {u: noise_floor(law, P, effs, M, c, fresh, noise, u, q, coarse) for u in ("fit", "validate")}
    fit = Fit(law, P, c, fresh, coarse, M, q)
    after = fit.solve(6 if effs else 1)
    plain = law_only(law, P, [m[0][::q] for m in M], c, fresh, fit.dt)
    eff = float(np.linalg.norm(fit.cat([s[1] for s in coarse]) - fit.cat(plain)))
    d = folder / name
    d.mkdir(parents=True, exist_ok=True)
    nrng = np.random.default_rng([noise["seed"], int(motion)])
    lines = []
    moving = []
    for i, (t, (x, F), (_, i0, _mean)) in enumerate(zip(tests, sim, M, strict=False)):
        x, F = x[i0 :: c["m"]], F[i0 :: c["m"]]
        k = len(x)
        e1, e2 = nrng.standard_normal(k + 400), nrng.standard_normal(k + 400)
        if noise["filter"]:
            sos = butter(4, noise["filter"], output="sos")
            e1, e2 = sosfiltfilt(sos, e1), sosfiltfilt(sos, e2)
        x = x + noise["disp"] * e1[200:-200]
        F = F + noise["force"] * e2[200:-200]
        if noise["bits"]:
            F = np.round(F / noise["step"]) * noise["step"]
            s = 2 * 1.5 * c["u0"] / 2 ** max(noise["bits"], 14)
            x = np.round(x / s) * s
        file = f"test_{i + 1:02d}.csv"
        assert np.all(np.isfinite(x)) and np.all(np.isfinite(F))
        np.savetxt(
            d / file,
            np.column_stack([np.arange(k) / c["fs"], x * 1e3, F / 1e3]),
            delimiter=",",
            fmt=["%.4f", "%.6g", "%.7g"],
            header="time_s,displacement_mm,force_kN",
            comments="",
        )
        title = f"{t['kind']} {t['amplitude'] * 1e3:.1f} mm, {t['frequency']:.2f} Hz"
        say = ""
        if motion and number % 2:
            say = ", start: " + ("in_motion" if kinds[i] else "at_rest")
        lines.append(f"  - {{file: {file}, title: '{title}', temperature_C: {t['T']}, use: {t['use']}{say}}}")
        if kinds[i]:
            moving.append(file)
    D = declared(law, P, c, np.random.default_rng([seed, number, 13]))
    spec = {"name": f"D{number:03d}"} | info["spec"]
    ex = ""
    if law == "mgmm" and (number % 3 == 0 or any(e["name"] in ("mullins", "payne") for e in effs)):
        ex = f", extremes: {'fresh' if fresh else 'lasting'}"
    par = ", ".join(f"{a}: {b}" for a, b in text(law, D).items())
    (d / "campaign.yaml").write_text(
        f"title: Proving ground, campaign {number:03d}\nspecimen: "
        f"{{{', '.join(f'{a}: {b}' for a, b in spec.items())}}}\n"
        f"law:\n  type: {law}\n  parameters: {{{par}}}\n  refit: true\n"
        + (f"  extremes: {ex.split(': ')[1]}\n" if ex else "")
        + "tests:\n"
        + "\n".join(lines)
        + "\n"
    )
    truth = dict(
        category=category,
        law=law,
        group="F" if law in ("kelvin_voigt", "mgmm") else "H",
        effects=[
            dict(name=e["name"], kind=e["kind"], equation=e["eq"], parameters=fx.parameters(e, c), accept=a)
            for e, a in zip(effs, info["accept"], strict=False)
        ],
        nrms_effect=eff,
        nrms_after_refit=after,
        nrms_each_after_refit=info.get("each", []),
        noise_floor_fit=floors["fit"],
        noise_floor_validate=floors["validate"],
        nrms_is="root of the mean over tests of (squared error / squared force), share of the rms force",
        tests_in_motion=moving,
        motion={f"test_{i + 1:02d}.csv": k for i, k in enumerate(kinds) if k},
        starts_declared=bool(motion and number % 2),
        law_true=named(law, P),
        law_declared=named(law, D),
        extremes=("fresh" if fresh else "lasting") if law == "mgmm" else None,
        noise={k: noise[k] for k in ("force", "disp", "filter", "bits", "force_eff")},
        sampling_rate=c["fs"],
        several_temperatures=info["several"],
        confounded_leave_share=info["near"],
        draws=info["attempt"] + 1,
    )
    (folder / f"{name}.truth.json").write_text(
        json.dumps(truth, indent=1, default=lambda o: o.item() if hasattr(o, "item") else str(o))
    )
    return truth
