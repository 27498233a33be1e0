"""Files of a campaign, and the truth beside."""

import json

import numpy as np
from scipy.signal import butter, sosfiltfilt

from . import effects as fx
from .laws import declared, with_unit
from .noise import white
from .response import nrms, simulate
from .sim import PARAMETERS


def write(out, number, category, rng, camp, effects, unlisted, f, left, ref, accept):
    name = f"{number:03d}_{category}"
    folder = out / name
    folder.mkdir(parents=True, exist_ok=True)
    for old in folder.glob("test_*.csv"):
        old.unlink()
    law, noise, sc = camp["law"], camp["noise"], camp["sc"]
    if unlisted or any(e["name"] in ("hum", "play", "friction") for e in effects):
        noise["signal_filtered"] = False
    dec = declared(rng, law, camp["P"])
    fine = simulate(camp, camp["P"], effects, (), unlisted, coarse=False)
    plain = simulate(camp, camp["P"], [])
    lines = [f"title: Harbour laboratory, campaign {number}"]
    if camp["spec"]:
        s = camp["spec"]
        lines.append(
            f"specimen: {{name: H{number:03d}, layers: {s['layers']}, layer_area_mm2: {s['layer_area_mm2']:g}, "
            f"layer_thickness_mm: {s['layer_thickness_mm']:g}}}"
        )
    else:
        lines.append(f"specimen: {{name: H{number:03d}}}")
    lines += [
        "law:",
        f"  type: {law}",
        "  refit: true",
        "  parameters: {" + ", ".join(f"{p}: {with_unit(law, dec, p)}" for p in PARAMETERS[law]) + "}",
        "tests:",
    ]
    motion, say = [], rng.random() < 0.5
    for i, (t, D, F) in enumerate(fine):
        os = camp["tests"][i]["os"]
        t, D, F = t[::os], D[::os], F[::os]
        if noise["signal_filtered"]:  # not where it would round corners or take a tone away
            sos = butter(3, noise["cut"], fs=camp["fs"], output="sos")
            D, F = sosfiltfilt(sos, D), sosfiltfilt(sos, F)
        D = D + white(rng, t.size, noise["displacement"], noise["cut"], camp["fs"])
        F = F + white(rng, t.size, noise["force"][i], noise["cut"], camp["fs"])
        if noise["quantised"]:
            D, F = np.round(D / noise["lsb_D"]) * noise["lsb_D"], np.round(F / noise["lsb_F"]) * noise["lsb_F"]
        extra = ""
        if i in camp["cut"]:
            j = int(camp["cut"][i] * camp["fs"])
            t, D, F = t[:-j] if j else t, D[j:], F[j:]
            motion.append(f"test_{i + 1:02d}.csv")
            extra = ", start: in_motion" if say else ""
        assert np.isfinite(D).all() and np.isfinite(F).all()
        np.savetxt(
            folder / f"test_{i + 1:02d}.csv",
            np.column_stack([t, D * 1e3, F / 1e3]),
            fmt=["%.7g", "%.7g", "%.6g"],
            delimiter=",",
            header="time_s,displacement_mm,force_kN",
            comments="",
        )
        use = "validate" if i in camp["validate"] else "fit"
        lines.append(
            f'  - {{file: test_{i + 1:02d}.csv, title: "{camp["tests"][i]["title"]}", temperature_C: {sc["T"][i]:g}, '
            f"use: {use}{extra}}}"
        )
    (folder / "campaign.yaml").write_text("\n".join(lines) + "\n")
    listed = [
        dict(
            name=e["name"],
            kind=fx.KIND[e["name"]],
            form=e["form"],
            equation=fx.EQUATION[f"{e['name']}{e['form']}"],
            parameters=e["par"],
            accept=a,
        )
        for e, a in zip(effects, accept, strict=False)
    ]
    if unlisted:
        listed.append(
            dict(
                name=unlisted["title"],
                kind=unlisted["kind"],
                form=1,
                equation=unlisted["equation"],
                parameters=unlisted["par"],
                accept=[],
            )
        )
    r = {k: v for k, v in noise.items() if k != "force"}
    truth = dict(
        category=category,
        law=law,
        group=("F" if law in ("mgmm", "kelvin_voigt") else "H"),
        effects=listed,
        nrms_effect=(nrms(ref, plain, camp["fit"]) if listed else 0.0),
        nrms_after_refit=(left[0][0] if len(left) == 1 else [a for a, b in left]) if left else 0.0,
        nrms_after_refit_validate=[b for a, b in left],
        noise_floor_validate=f,
        nrms_is="root: rms error over rms force",
        tests_in_motion=motion,
        extremes="lasting" if camp["lasting"] else "fresh",
        gaps_s=camp["gaps"],
        noise=r,
        sampling_Hz=camp["fs"],
        law_true=camp["P"],
        law_declared=dec,
    )
    (out / f"{name}.truth.json").write_text(json.dumps(truth, indent=1, default=float))
