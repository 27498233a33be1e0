"""Files of a campaign, and the truth beside."""

import json
import math

from .laws import si, yaml_parameters


def write(folder, name, category, g):
    d = folder / name
    d.mkdir(parents=True, exist_ok=True)
    number = name[:3]
    lines = [
        f"title: Specimen {number}",
        f"specimen: {{name: F{number}}}",
        "law:",
        f"  type: {g['law']}",
        "  parameters:",
        yaml_parameters(g["law"], g["declared"]),
        "tests:",
    ]
    for t, (time, u, f) in zip(g["tests"], g["records"], strict=True):
        file = csv(t)
        with open(d / file, "w") as out:
            out.write("time_s,displacement_mm,force_kN\n")
            out.writelines(f"{a:.6f},{b:.7g},{c:.7g}\n" for a, b, c in zip(time, u, f, strict=True))
        item = f'  - {{file: {file}, title: "{t["title"]}", temperature_C: {t["T"]:.1f}, use: {t["use"]}'
        if t["start"]:
            item += f", start: {t['start']}"
        if g["Q"]:
            what, lo, hi = g["Q"]
            item += f", conditions: {{{what}: {lo + (hi - lo) * t['Q']:g}}}"
        lines.append(item + "}")
    (d / "campaign.yaml").write_text("\n".join(lines) + "\n")
    moving = {csv(t): t["cut"] for t in g["tests"] if t["cut"]}
    truth = {
        "category": category,
        "law": g["law"],
        "group": group(g["law"]),
        "effects": [
            {
                "name": e.name,
                "accept": e.accept,
                "form": e.form,
                "parameters": {k: float(x) for k, x in e.par.items()},
                **size,
            }
            for e, size in zip(g["effects"], g["sizes"], strict=True)
        ],
        "noise_floor_validate": math.sqrt(g["floor"] + g["floor_u"]),
        "noise_floor_force": math.sqrt(g["floor"]),
        "noise_floor_displacement": math.sqrt(g["floor_u"]),
        "nrms_is": "root: rms error over rms force",
        "tests_in_motion": list(moving),
        "cut_at_s": moving,
        "law_true": si(g["law"], g["p"]),
        "law_declared": si(g["law"], g["declared"]),
        "noise": {"force_kN": g["noise"]["F"], "displacement_mm": g["noise"]["U"], "sampling_Hz": g["fs"]},
    }
    (folder / f"{name}.truth.json").write_text(json.dumps(truth, indent=1) + "\n")


def csv(test):
    return f"test_{test['index'] + 1:02d}.csv"


def group(law):
    return "F" if law in ("kelvin_voigt", "mgmm") else "H"
