"""How far equations of one effect are from each other: what the search takes for the discrepancy of an equation.

Each form of an effect is left out of the list in turn. What it does at a start, beside what parameters of the law make
of it, is fitted by the other forms of the effect at their starts: by the nearest one alone, and by all of them
together. What they leave, as a share (root mean square), is how wrong an equation may be that the list has in the place
of the true one: `shared_discrepancy` and `own_discrepancy` of edesign/calibration/search/settings.py.

Usage: python -m benchmarks.effect_equations CAMPAIGN.yaml [...]
"""

from __future__ import annotations

import argparse
from collections import defaultdict
from pathlib import Path

import numpy as np

from edesign.calibration.dampers.from_campaign import damper_problem
from edesign.calibration.search.models import Fitter
from edesign.calibration.search.problem import Problem
from edesign.calibration.search.settings import SETTINGS
from edesign.damper.testing.campaign import load_campaign
from edesign.estimation.model import PredictionError
from edesign.estimation.noise import Noise

LEAST = 0.05  # of what a form does: less that the law cannot make is not compared
NEGLIGIBLE = 0.03  # singular value, of the largest, of differences between equations: as the search has it

Left = list[tuple[float, float]]
"""What the nearest other form leaves of one, and what all others leave."""


def main() -> None:
    """Print the median and the quartiles of each effect, and of all."""
    parser = argparse.ArgumentParser(prog="python -m benchmarks.effect_equations", description=__doc__)
    parser.add_argument("campaigns", nargs="+", type=Path, help="campaign files")
    found = defaultdict[str, Left](list)
    for path in parser.parse_args().campaigns:
        for name, left in left_of(damper_problem(load_campaign(path))).items():
            found[name] += left
    print("what is left of a form of an effect (first quartile, median, third)")
    print("effect                  starts  by the nearest other form  by all other forms")
    for name, left in [*sorted(found.items()), ("all", [one for each in found.values() for one in each])]:
        nearest, every = np.quantile(np.array(left), (0.25, 0.5, 0.75), axis=0).T
        print(f"{name:22}  {len(left):6}  {_row(nearest)}           {_row(every)}")


def _row(values: np.ndarray) -> str:
    return "  ".join(f"{one:4.2f}" for one in values)


def left_of(problem: Problem) -> dict[str, Left]:
    """Return what is left of each form at each start, by the name of its effect.

    Args:
        problem: of a campaign.
    """
    fitter = Fitter(problem, SETTINGS)
    base = fitter.fit((), np.array(problem.start), Noise.of_first_fit(problem.deviations, problem.sizes))
    if base is None:
        return {}
    weight = np.repeat([base.noise.weight(i) for i in range(len(base.left))], [one.size for one in base.left])
    of_law, _ = np.linalg.qr(weight[:, np.newaxis] * np.vstack(base.fit.slopes))
    beside = defaultdict[str, dict[str, list[np.ndarray]]](lambda: defaultdict(list))
    for effect in problem.effects:
        if effect.own or not effect.parameters:
            continue
        starts = np.array([[*base.fit.values, *start] for start in effect.starts])
        for there in problem.model((effect,)).predict(starts):
            if isinstance(there, PredictionError):
                continue
            change = weight * np.concatenate([a - b for a, b in zip(there, base.fit.predicted, strict=True)])
            own = change - of_law @ (of_law.T @ change)
            size = float(np.linalg.norm(own))
            if np.isfinite(size) and size > LEAST * float(np.linalg.norm(change)):
                beside[effect.name][effect.form].append(own / size)
    return {name: _left_out(forms) for name, forms in beside.items() if len(forms) > 1}


def _left_out(forms: dict[str, list[np.ndarray]]) -> Left:
    found: Left = []
    for form, own in forms.items():
        others = np.column_stack([one for name, each in forms.items() if name != form for one in each])
        u, s, _ = np.linalg.svd(others, full_matrices=False)
        u = u[:, s > NEGLIGIBLE * s[0]]
        for one in own:
            nearest = float(np.max((others.T @ one) ** 2))
            found.append((max(1.0 - nearest, 0.0) ** 0.5, float(np.linalg.norm(one - u @ (u.T @ one)))))
    return found


if __name__ == "__main__":
    main()
