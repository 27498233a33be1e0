"""Write docs/results/figures/thesis_damper_*: Tables A.1-A.4 of the thesis against its law, as printed and refitted.

    python -m tools.thesis_damper_tables [FOLDER]

Takes some seconds. Prints the figures that docs/results/thesis_damper_tables.md quotes.
"""

from __future__ import annotations

import sys
from pathlib import Path

import numpy as np
from scipy.optimize import least_squares

from edesign.damper.damper import Damper
from edesign.damper.laws import law
from edesign.damper.parameters import write_parameters
from edesign.damper.temperature import GammaT
from edesign.damper.testing.steady_state import PropertyRows
from edesign.damper.thesis_tables import (
    PROTOTYPE,
    measured,
    pointedness,
    predicted,
    prototype_damper,
    residual_csv,
    residuals,
)
from edesign.report.damper.property_figures import property_figure, residual_figure
from edesign.report.drawing.style import save
from tools.mgmm_steady import Arrangement, steady_loops, steady_moduli

NAMES = [p.name for p in law("mgmm").parameters if p.fitted]
TEMPERATURES = (20.0, 25.0, 30.0, 35.0)
PRINTED_GAMMA = (0.935, 0.875, 0.820)


def fourier(values: dict[str, float], gamma_T: GammaT, arrangement: Arrangement) -> PropertyRows:
    """The 120 rows in closed form."""
    rows, mgmm = measured(), law("mgmm")
    moduli = np.empty((3, rows.strain.size))
    for T in TEMPERATURES:
        here = rows.temperature_C == T
        at_T, _ = gamma_T.shifted(mgmm, values, T)
        loops = steady_loops(
            at_T, rows.strain[here] * PROTOTYPE.layer_thickness, rows.frequency[here], arrangement=arrangement
        )
        moduli[:, here] = steady_moduli(loops) / (PROTOTYPE.area * rows.strain[here])
    G_storage, G_eq, G_loss = moduli
    return PropertyRows(rows.strain, rows.frequency, rows.temperature_C, G_storage, G_eq, G_loss, G_loss / G_storage)


def fit(arrangement: Arrangement, free_gamma: bool, starts: int = 4) -> tuple[dict[str, float], GammaT]:
    """Least squares of the relative residuals of G', G_eq and n over all rows; the best of several starts."""
    rng, best = np.random.default_rng(1), None
    first = np.log([prototype_damper().values[name] for name in NAMES])

    def unpack(x: np.ndarray) -> tuple[dict[str, float], GammaT]:
        gammas = x[len(NAMES) :] if free_gamma else PRINTED_GAMMA
        values = dict(zip(NAMES, np.exp(x[: len(NAMES)]).tolist(), strict=True)) | {"consistent": 0.0}
        return values, GammaT(tuple(zip(TEMPERATURES, (1.0, *map(float, gammas)), strict=True)))

    def misfit(x: np.ndarray) -> np.ndarray:
        r = residuals(fourier(*unpack(x), arrangement), measured())
        return np.concatenate((r.G_storage, r.G_eq, r.loss_factor))

    width = np.full(len(NAMES), np.log(1e3))
    lower, upper = first - width, first + width
    upper[NAMES.index("alpha")] = np.log(2.0)
    for start in range(starts):
        x = first + (0.5 * rng.standard_normal(first.size) if start else 0.0)
        bounds = (lower, upper)
        if free_gamma:
            x, bounds = np.r_[x, PRINTED_GAMMA], (np.r_[lower, [0.5] * 3], np.r_[upper, [0.999] * 3])
        found = least_squares(misfit, x, bounds=bounds, x_scale="jac", max_nfev=200)
        if best is None or found.cost < best.cost:
            best = found
    assert best is not None
    return unpack(best.x)


def report(title: str, rows: PropertyRows) -> None:
    """Mean and rms residuals, and their pattern by strain, frequency and temperature."""
    r = residuals(rows, measured())
    everything = np.sqrt(np.mean(np.concatenate((r.G_storage, r.G_eq, r.loss_factor)) ** 2))
    print(f"\n{title}: all {100 * everything:.1f} %")
    for name, values, mean, rms in zip(("G'", "G_eq", "n"), vars(r).values(), r.mean(), r.rms(), strict=True):
        print(f"  {name:5} mean {100 * mean:+6.1f} %   rms {100 * rms:5.1f} %")
        for key, unit in (("strain", 0.01), ("frequency", 1.0), ("temperature_C", 1.0)):
            levels = getattr(rows, key)
            means = [f"{x / unit:g}: {100 * np.mean(values[levels == x]):+.1f}" for x in np.unique(levels)]
            print(f"        by {key:14} {', '.join(means)}")
    shape = pointedness(rows)
    print(f"  G_eq / (G' sqrt(1 + n^2)): {shape.min():.3f} to {shape.max():.3f}, mean {shape.mean():.3f}")


def main(folder: Path) -> None:
    rows = measured()
    shape, corner = pointedness(rows), (1.0 + np.pi * rows.loss_factor / 4.0) / np.sqrt(1.0 + rows.loss_factor**2)
    print(f"measured G_eq / (G' sqrt(1 + n^2)): {shape.min():.3f} to {shape.max():.3f}, mean {shape.mean():.3f}")
    over = shape / corner
    print(f"  over that of a spring and a constant force with the same n: {over.min():.3f} to {over.max():.3f}")
    printed = predicted()
    report("Tables 4.2 and 4.4", printed)
    by_the_letter = predicted(temperature_model=GammaT(of="by_the_letter"))
    report("Tables 4.2 and 4.4, k_mod,T by the letter of Eq. 4.34", by_the_letter)
    fits: dict[tuple[Arrangement, bool], PropertyRows] = {}
    kinds: tuple[tuple[Arrangement, bool], ...] = (("printed", False), ("printed", True), ("beside", False))
    for arrangement, free_gamma in kinds:
        values, gamma_T = fit(arrangement, free_gamma)
        fits[arrangement, free_gamma] = fourier(values, gamma_T, arrangement)
        title = f"refitted, arrangement {arrangement}, gamma_T {'free' if free_gamma else 'of Table 4.4'}"
        report(title, fits[arrangement, free_gamma])
        print(" ", write_parameters(law("mgmm"), values))
        print("  gamma_T", [round(gamma, 3) for _, gamma in gamma_T.table])
        if arrangement == "printed" and not free_gamma:  # the same by simulation
            report("  the same, simulated", predicted(Damper(law("mgmm"), values), gamma_T))
    folder.mkdir(parents=True, exist_ok=True)
    save(
        property_figure(rows, printed, title="Tables A.1-A.4 and the MGMM of Tables 4.2 and 4.4"),
        folder / "thesis_damper_properties.svg",
    )
    chosen = rows.strain == 0.4
    save(
        property_figure(_of(rows, chosen), _of(printed, chosen), by="temperature_C"),
        folder / "thesis_damper_temperature.svg",
    )
    save(
        property_figure(rows, fits["printed", False], title="Tables A.1-A.4 and the MGMM fitted to them"),
        folder / "thesis_damper_refitted.svg",
    )
    for name, some in (("printed", printed), ("refitted", fits["printed", False])):
        r = residuals(some, rows)
        save(residual_figure(vars(r), rows), folder / f"thesis_damper_residuals_{name}.svg")
        (folder / f"thesis_damper_{name}.csv").write_text(residual_csv(some, rows), encoding="utf-8")


def _of(rows: PropertyRows, chosen: np.ndarray) -> PropertyRows:
    return PropertyRows(*(column[chosen] for column in list(vars(rows).values())[:7]))


if __name__ == "__main__":
    main(Path(sys.argv[1] if len(sys.argv) > 1 else "docs/results/figures"))
