"""Start values of every law from the data alone."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

import numpy as np

from edesign.damper.fitting.coordinates import Axis, Coordinates
from edesign.damper.fitting.moduli import LINEAR_LAWS, complex_stiffness
from edesign.damper.fitting.observed import Observed
from edesign.damper.fitting.solve import ErrorModel
from edesign.damper.law import Law, Parameter
from edesign.errors import InputError
from edesign.estimation.least_squares import Settings, fit

# In the sizes of the tests (scales.py): 1 for a stiffness is the rms force over the rms deformation, and so on.
_RELATIVE: dict[str, dict[str, float]] = {
    "kelvin_voigt": {"k": 0.8, "c": 0.5},
    "zener": {"k0": 0.6, "k1": 1.0, "c1": 0.5},
    "generalised_maxwell": {"k0": 0.6},
    "fractional_kelvin": {"k0": 0.5, "c": 1.0, "alpha": 0.4},
    "fractional_zener": {"k0": 0.5, "a": 0.1, "b": 1.0, "alpha": 0.5},
    "viscous": {"c": 1.0},
    "viscous_power": {"c": 1.0, "alpha": 0.5},
    "asymmetric_viscous": {"c_plus": 1.0, "c_minus": 1.0, "alpha": 0.5},
    "bilinear_oil": {"c": 2.0, "F_r": 0.8, "p": 0.1},
    "maxwell": {"c0": 1.0, "lambda": 0.3},
    "maxwell_power": {"c": 1.0, "alpha": 0.5, "k": 5.0},
    "fractional_maxwell": {"c0": 1.5, "lambda": 0.5, "nu": 0.6},
    "friction": {"mu": 0.9, "N": 1.0, "k": 8.0},
    "elastic_plastic": {"k": 4.0, "Fy": 0.7, "b": 0.05},
    "lead_rubber": {"Q": 0.6, "K_d": 0.4, "Y": 0.15},
    "friction_pendulum": {"W": 10.0, "R": 25.0, "f_slow": 0.04, "f_fast": 0.08, "a": 1.0, "Y": 0.1},
    "self_centring": {"k": 4.0, "Fy": 0.7, "b": 0.1, "beta": 0.7},
    "buckling_restrained": {"alpha": 0.002},
    "gap": {"k": 2.0, "gap": 0.5, "d": 0.1},
    "ramberg_osgood": {"k": 4.0, "Fy": 0.7, "a": 1.0, "n": 5.0},
    "chaboche": {"k": 4.0, "Fy": 0.5, "C1": 2.0, "gamma1": 8.0, "C2": 0.2, "gamma2": 1.0, "Q": 0.1, "b": 0.2},
    "bouc_wen": {"Fy": 0.8, "Y": 0.3, "alpha": 0.1, "A": 1.0, "beta": 0.5, "gamma": 0.5, "n": 1.5},
    "modified_bouc_wen": {
        "k1": 1.0,
        "k2": 1.0,
        "u_ref": 1.0,
        "Y": 0.5,
        "alpha": 0.3,
        "A": 1.0,
        "beta": 0.5,
        "gamma": 0.5,
        "n": 1.2,
        "C": 0.3,
        "alpha_d": 0.5,
    },
    "asymptote": {"f0": 0.3, "k1": 0.7, "k2": 0.0, "k3": 0.0, "kappa": 3.0, "n": 1.3, "c": 0.05},
    "linearised": {"k_eff": 0.8, "zeta_eff": 0.25, "omega": 1.0},
    "mgmm": {
        "k1": 4.0,
        "c1": 0.2,
        "k0": 0.0,
        "c_NL": 0.3,
        "alpha": 0.5,
        "k_a": 0.5,
        "k_b": 0.5,
        "u_ref": 0.7,
        "c_a": 0.2,
        "c_b": 0.0,
        "v_ref": 0.5,
    },
}
_SPREAD = 8.0  # of positive parameters about the start, up and down
_LARGEST_EXPONENT = 2.0
_CLOSED_FORM = Settings(steps=100, enough=1e-30, relative=1e-8)


def start_values(
    law: Law, observed: Observed, given: Mapping[str, float] | None = None, branches: int = 1
) -> dict[str, float]:
    """Start values of all parameters, SI.

    Args:
        given: values that are taken as they are, SI.
        branches: of a law with branches; more if `given` names more.

    Raises:
        InputError: strains of a buckling-restrained brace are missing.
    """
    known = dict(given or {})
    parameters = law.with_branches(branches_of(law, known, branches))
    relative = {**_RELATIVE.get(law.name, {}), **_branch_starts(law, observed, len(parameters))}
    values = {p.name: known[p.name] for p in parameters if p.name in known}
    if law.name == "buckling_restrained":
        unknown = [p.name for p in parameters if p.name.startswith("strain") and p.name not in values]
        if unknown:
            why = "it is where omega and beta of its number are asked for"
            raise InputError(f"fit of law {law.name}: `{unknown[0]}` is needed from you: {why} [E-FIT-02]")
        values = {**_start_of_brace(values, observed), **values}  # identifiable.py wants what it needs
    for parameter in sorted(parameters, key=lambda p: bool(p.unit)):  # exponents before units with them
        if parameter.name not in values:
            size = observed.scales.of(parameter.unit, values)
            values[parameter.name] = _inside(parameter, relative.get(parameter.name, parameter.default or 1.0) * size)
    return {parameter.name: values[parameter.name] for parameter in parameters}


def _start_of_brace(known: Mapping[str, float], observed: Observed) -> dict[str, float]:
    """Start of a brace whose core and strains are known.

    The rms force of full loops is near the yield force times omega; the stiffness factor lies between that of a core
    all along and that of rigid ends; hardening grows with the strain.
    """
    strains = {name.removeprefix("strain"): value for name, value in known.items() if name.startswith("strain")}
    most = max(strains.values())
    return {
        "F_ysc": 0.8 * observed.scales.force / known["A_sc"],
        "KF": 0.5 * (1.0 + known["L_wp"] / known["L_y"]),
        **{f"omega{i}": 1.1 + 0.25 * strain / most for i, strain in strains.items()},
        **dict.fromkeys((f"beta{i}" for i in strains), 1.1),
    }


def branches_of(law: Law, given: Mapping[str, float], branches: int) -> int:
    """Return the number of branches: as many as asked for, or as `given` names; 0 of a law without."""
    if not law.branch:
        return 0
    named = 0
    while f"{law.branch[0].name}{named + 1}" in given:
        named += 1
    return max(named, branches, 1)


def linear_start(law: Law, coordinates: Coordinates, observed: Observed, seed: int) -> list[np.ndarray]:
    """Return coordinates fitted to the complex stiffness of the tests in closed form; [] for laws that are not linear.

    Args:
        coordinates: of the fit.

    Returns:
        Coordinates (n,) of the best starts.
    """
    if law.name not in LINEAR_LAWS:
        return []
    size = np.maximum(np.abs(observed.complex_stiffness), 1e-300)
    own = {parameter.name for parameter in law.all_parameters(coordinates.start)}

    def errors(x: np.ndarray) -> list[np.ndarray]:
        values = {name: value for name, value in coordinates.values(x).items() if name in own}
        error = (complex_stiffness(law.name, values, observed.omega) - observed.complex_stiffness) / size
        return [np.concatenate((error.real, error.imag))]

    model = ErrorModel(coordinates, errors, (2 * observed.omega.size,))
    points = [coordinates.at(coordinates.start), *spread(coordinates, 8, seed)]
    found = [fit(model, model.noise, x, settings=_CLOSED_FORM).z for x in points if np.isfinite(model.cost(x))]
    return sorted(found, key=model.cost)[:3]


def spread(coordinates: Coordinates, count: int, seed: int) -> list[np.ndarray]:
    """Return coordinates (n,) in a Latin hypercube about the start, log-uniform and within the bounds.

    Args:
        coordinates: of the fit.
        count: number of points.
    """
    if count < 1 or not coordinates.axes:
        return []
    from scipy.stats import qmc  # takes a second of every start of a calibration

    centre = coordinates.at(coordinates.start)
    sample = qmc.LatinHypercube(len(coordinates.axes), rng=np.random.default_rng(seed)).random(count)
    points = []
    for row in sample:
        x = [
            _spread(axis, float(at), float(low), float(high), float(share))
            for axis, at, low, high, share in zip(
                coordinates.axes, centre, coordinates.lower, coordinates.upper, row, strict=True
            )
        ]
        points.append(np.clip(x, coordinates.lower, coordinates.upper))
    return points


def _spread(axis: Axis, at: float, low: float, high: float, share: float) -> float:
    width = np.log(_SPREAD)
    if axis.logarithmic:
        return at + (2.0 * share - 1.0) * width
    if np.isfinite(low) and np.isfinite(high):
        top = min(high, max(_LARGEST_EXPONENT, low))
        return low + (0.05 + 0.9 * share) * (top - low)
    if np.isfinite(low):
        return low + max(at - low, 0.1) * float(np.exp((2.0 * share - 1.0) * width))
    return at + (2.0 * share - 1.0) * max(abs(at), 0.5)


def _branch_starts(law: Law, observed: Observed, count: int) -> dict[str, float]:
    """Relaxation times evenly in their logarithm, from the fastest test's 1/omega to the slowest's."""
    number = (count - len(law.parameters)) // max(len(law.branch), 1)
    if not number:
        return {}
    fastest, slowest = 0.5 / observed.omega.max(), 1.0 / observed.omega.min()
    times: Sequence[float] = np.geomspace(fastest, max(slowest, 4.0 * fastest), number + 2)[1:-1].tolist()
    found = {}
    for i, time in enumerate(times, start=1):
        found[f"k{i}"] = 1.0 / number
        found[f"c{i}"] = found[f"k{i}"] * time / observed.scales.time
    return found


def _inside(parameter: Parameter, value: float) -> float:
    if parameter.allows(value):
        return value
    if np.isfinite(parameter.upper) and value >= parameter.upper:
        return parameter.upper if parameter.upper_allowed else 0.5 * (parameter.lower + parameter.upper)
    return parameter.lower if parameter.lower_allowed else parameter.lower + abs(value) + 1e-3
