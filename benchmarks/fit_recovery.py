"""Fit every damper law to forces that it made itself, with 1 % noise: what comes back, how surely, and how fast.

python benchmarks/fit_recovery.py [LAW ...]
"""

from __future__ import annotations

import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).parents[1] / "tests" / "support"))
from damper_examples import EXAMPLES  # noqa: E402
from fit_campaign import measured  # noqa: E402

from edesign.damper.fitting import fit_forces  # noqa: E402
from edesign.damper.fitting.identifiable import FIXED  # noqa: E402
from edesign.damper.laws import LAWS  # noqa: E402


def main() -> None:
    print("| law | fitted | fixed | NRMS % | worst error / std. error | least sure | starts | seconds |")
    print("|---|---|---|---|---|---|---|---|")
    for name in sys.argv[1:] or LAWS:
        truth = EXAMPLES[name]
        fixed = {key: truth[key] for key in FIXED.get(name, {})}
        branches = sum(key.startswith("c") for key in truth) if LAWS[name].branch else 1
        fit = fit_forces(LAWS[name], measured(name, truth), fixed=fixed, branches=branches)
        errors = {key: abs(fit.values[key] - truth.get(key, 0.0)) / fit.standard_error_white[key] for key in fit.free}
        shares = {key: fit.standard_error_white[key] / abs(fit.values[key]) for key in fit.free}
        worst, least = max(errors, key=errors.__getitem__), max(shares, key=shares.__getitem__)
        at_bound = "".join(f", {key} at {value:g}" for key, value in fit.at_bound.items())
        print(
            f"| {name} | {len(fit.free)}{at_bound} | {', '.join(fixed) or '-'} | {100 * fit.nrms_overall:.3f} | "
            f"{errors[worst]:.1f} ({worst}) | {least} {100 * shares[least]:.2g} % | "
            f"{fit.same_minimum}/{len(fit.starts)} | {fit.seconds:.1f} |"
        )


if __name__ == "__main__":
    main()
