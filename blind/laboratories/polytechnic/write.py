"""Files of a campaign, and the truth beside."""

import json

import numpy as np

from .laboratory import record_part
from .laws import P_NAMES, unit_of


def write(folder, name, camp, noisy, q, truth, rng):
    d = folder / name
    d.mkdir(parents=True, exist_ok=True)
    law = camp["law"]
    al = round(float(q[P_NAMES[law].index("alpha")]), 5) if "alpha" in P_NAMES[law] else 1.0
    lines = [f"title: Campaign {name[:3]}, polytechnic"]
    if camp["layers"]:
        L = camp["layers"]
        lines.append(
            f"specimen: {{name: S{name[:3]}, layers: {L['layers']}, layer_area_mm2: {L['layer_area_mm2']}, "
            f"layer_thickness_mm: {L['layer_thickness_mm']}}}"
        )
    else:
        lines.append(f"specimen: {{name: S{name[:3]}}}")
    lines += ["law:", f"  type: {law}", "  refit: true", "  parameters:"]
    for n, x in zip(P_NAMES[law], q, strict=False):
        u = unit_of(law, n, al)[0]
        x = al if n == "alpha" else float(f"{x:.6g}")
        lines.append(f"    {n}: {x:.6g}{' ' + u if u else ''}")
    lines.append("tests:")
    for j, (m, (u, F)) in enumerate(zip(camp["motions"], record_part(camp, noisy), strict=False)):
        extra = ", start: in_motion" if camp["declared_start"] and m["moving"] else ""
        lines.append(
            f'  - {{file: test_{j + 1:02d}.csv, title: "{m["title"]}", temperature_C: {camp["T"][j]}, '
            f"use: {camp['use'][j]}{extra}}}"
        )
        t = np.arange(u.size) / m["fs"]
        np.savetxt(
            d / f"test_{j + 1:02d}.csv",
            np.column_stack([t, u, F]),
            fmt=["%.6g", "%.6f", "%.6f"],
            delimiter=",",
            header="time_s,displacement_mm,force_kN",
            comments="",
        )
    (d / "campaign.yaml").write_text("\n".join(lines) + "\n")
    (folder / f"{name}.truth.json").write_text(json.dumps(truth, indent=1))
