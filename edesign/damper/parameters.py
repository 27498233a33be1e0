"""Parameters of damper laws as people write them: `0.515 kN/mm`, `1.585 kN*(s/mm)^0.374`, the name of a set."""

from __future__ import annotations

import math
import re
from collections.abc import Iterable, Mapping, Sequence

from pydantic_core import PydanticCustomError

from edesign.damper.law import Law, Parameter
from edesign.damper.parameter_sets import PARAMETER_SETS, ParameterSet
from edesign.errors import InputError, split_code
from edesign.project.notation.quantities import Kind
from edesign.project.notation.temperature import parse_temperature
from edesign.project.notation.units import parse_quantity, parse_ratio
from edesign.project.reading.problems import MOST_SHOWN, did_you_mean, listed

__all__ = [
    "PARAMETER_SETS",
    "ParameterError",
    "ParameterSet",
    "coefficient_in_words",
    "parameter_set",
    "read_parameters",
    "write_parameters",
]

_EXPONENT = re.compile(r"\^([A-Za-z_]\w*)")  # a parameter as exponent in the unit of another
_BASE = re.compile(r"\b(?:N|m|Pa)\b")
_PRACTICAL = {"N": "kN", "m": "mm", "Pa": "MPa"}
_CELSIUS = "degC"
_DIGITS = 15  # of numbers written; they read back to 1e-14
_EXPONENT_TOLERANCE = 1e-9  # of the exponent in a unit against the parameter it stands for


class ParameterError(InputError):
    """Error: parameters of a law are wrong; the message lists all problems.

    Attributes:
        problems: name of the parameter and what is wrong with it.
    """

    def __init__(self, law: Law, problems: Sequence[tuple[str, str]]) -> None:
        self.problems = tuple(problems)
        super().__init__(
            "\n".join(f"{law.kind} {law.name}: parameter `{name}`: {message}" for name, message in problems)
        )


def _laws_with(names: Iterable[str]) -> str:
    """The laws that have all parameters of some names, as a clause; those with the fewest parameters alone."""
    from edesign.damper.laws import LAWS

    asked = set(names)
    found = [law for law in LAWS.values() if asked <= {parameter.name for parameter in law.parameters}]
    fewest = min((len(law.parameters) for law in found), default=0)
    shown = [law.name for law in found if len(law.parameters) == fewest]
    return f"; the law {listed(shown)} has them all" if len(shown) == 1 else ""


def read_parameters(law: Law, values: Mapping[str, object] | str) -> dict[str, float]:
    """Read the parameters of a law.

    Args:
        values: by name, text with unit (`0.515 kN/mm`), a plain number where there is no dimension; or the name of a
            set in PARAMETER_SETS. An exponent in a unit is that of the law: a number, or the name of the parameter
            (`kN*(s/mm)^0.374`, `kN*(s/mm)^alpha`). A parameter of branches may be given for all of them: `k: [3 kN/mm,
            1 kN/mm]` is k1 and k2, and `k: 3 kN/mm` is k1.

    Returns:
        All parameters in the order of the core, SI units, with defaults.

    Raises:
        ParameterError: a name is unknown, or a value cannot be read; names all of them.
        InputError: a parameter is missing or out of its bounds, or there is no such set for this law.
    """
    if isinstance(values, str):
        values = parameter_set(law, values).values
    values, problems, given_as = _branches_apart(law, values)
    if problems:
        raise ParameterError(law, problems)
    known = {parameter.name: parameter for parameter in law.all_parameters(dict.fromkeys(values, 0.0))}
    unknown = [name for name in values if name not in known][:MOST_SHOWN]
    laws = _laws_with(values) if unknown else ""
    there = f"(there are: {', '.join(known)}){laws}"
    problems += [
        (name, f"there is no such parameter{did_you_mean(str(name), known)} {there} [E-LAW-02]") for name in unknown
    ]
    found: dict[str, float] = {}
    given = [parameter for parameter in known.values() if parameter.name in values]
    for parameter in sorted(given, key=lambda parameter: bool(parameter.unit)):  # exponents before units with them
        try:
            found[parameter.name] = _read(parameter, values[parameter.name], found)
        except PydanticCustomError as error:
            problems.append((parameter.name, error.message()))
        except KeyError:
            pass  # the exponent of its unit is missing or wrong, which is reported there
    if set(values) <= set(known):  # else the one that is missing is likely the one that is misspelt
        missing = [p for p in known.values() if p.default is None and p.name not in values]
        problems += [(p.name, f"this parameter ({p.meaning}) is missing [E-LAW-02]") for p in missing]
    problems += [
        (p.name, f"{p.written(found[p.name])} is out of range: {p.allowed} is allowed [E-LAW-03]")
        for p in given
        if p.name in found and not p.allows(found[p.name])
    ]
    if problems:
        raise ParameterError(law, [(given_as.get(name, name), message) for name, message in problems])
    return law.complete(found)


def _branches_apart(
    law: Law, values: Mapping[str, object]
) -> tuple[Mapping[str, object], list[tuple[str, str]], dict[str, str]]:
    """The values with those that stand for all branches as k1, k2 ...; what is wrong; where these were given."""
    own = {parameter.name for parameter in law.parameters}
    found: dict[str, object] = {}
    problems, given_as = [], {}
    shared = {p.name: values[p.name] for p in law.branch if p.name in values and p.name not in own}
    lists = {name: value if isinstance(value, (list, tuple)) else (value,) for name, value in shared.items()}
    for name, value in values.items():
        if name not in lists:
            found[name] = value
            continue
        if len(lists[name]) > law.most_branches or not lists[name]:
            problems.append((name, f"{len(lists[name])} values; 1 to {law.most_branches} are allowed [E-VALUE-04]"))
        for i, one in enumerate(lists[name], start=1):
            if f"{name}{i}" in values:
                problems.append((f"{name}{i}", f"`{name}` gives this too; leave one of them out [E-KEY-03]"))
            found[f"{name}{i}"], given_as[f"{name}{i}"] = one, name
    counts = {name: len(several) for name, several in lists.items()}
    if len(set(counts.values())) > 1:
        counted = ", ".join(f"{count} of `{name}`" for name, count in counts.items())
        problems.append(
            (next(iter(counts)), f"as many values of each are needed, and there are {counted} [E-VALUE-04]")
        )
    return found, problems, given_as


def parameter_set(law: Law, name: str) -> ParameterSet:
    """Return a published set of parameters.

    Raises:
        InputError: there is none of that name, or it is of another law.
    """
    if name not in PARAMETER_SETS:
        hint = did_you_mean(name, PARAMETER_SETS)
        raise InputError(f"there is no parameter set `{name}`{hint} (there are: {listed(PARAMETER_SETS)}) [E-LAW-01]")
    found = PARAMETER_SETS[name]
    if found.law != law.name:
        raise InputError(f"the parameter set `{name}` is of law {found.law}, not of {law.name} [E-LAW-01]")
    return found


def write_parameters(law: Law, values: Mapping[str, float]) -> dict[str, str]:
    """Return parameters in kN, mm and s as text that `read_parameters` reads back to a relative 1e-12.

    Args:
        values: by name, SI units.

    Raises:
        InputError: a parameter is unknown, missing or out of its bounds.
    """
    complete = law.complete(values)
    return {
        name: f"{complete[name] / one:.{_DIGITS}g} {unit}".rstrip()
        for name, (one, unit) in practical_units(law, complete).items()
    }


DASHPOTS = ("viscous", "viscous_power")
"""Laws whose size is their coefficient c."""


def coefficient_in_words(c: float, alpha: float = 1.0) -> str:
    """Return the coefficient of a dashpot in the one unit that reports have: `649.4 kN (s/m)^0.5`.

    Args:
        c: N (s/m)^alpha.
        alpha: power of the velocity.
    """
    exponent = "" if alpha == 1.0 else f"^{alpha:g}"
    kilo = c / 1e3
    number = f"{kilo:.4g}" if abs(kilo) < 1e4 else f"{kilo:.0f}"
    return f"{number} kN (s/m){exponent}"


def practical_units(law: Law, values: Mapping[str, float]) -> dict[str, tuple[float, str]]:
    """Return the units in which `write_parameters` writes, by parameter: one of each in SI, and its name.

    Args:
        values: all parameters by name, SI.
    """
    plain = {p.name: f"{values[p.name]:.{_DIGITS}g}" for p in law.all_parameters(values) if not p.unit}
    exponents = {name: float(text) for name, text in plain.items()}
    found = {}
    for parameter in law.all_parameters(values):
        one, unit = 1.0, parameter.unit
        if unit and unit != _CELSIUS:
            unit = practical_unit(parameter, plain)
            one = parse_quantity(f"1 {unit}", _kind(parameter, exponents))
        found[parameter.name] = one, unit
    return found


def practical_unit(parameter: Parameter, exponents: Mapping[str, object] | None = None) -> str:
    """Return the unit of a parameter in kN and mm.

    Args:
        parameter: of a law.
        exponents: replace the names of parameters in the unit.
    """
    return _BASE.sub(lambda match: _PRACTICAL[match[0]], _with_exponents(parameter.unit, exponents or {}))


def _with_exponents(unit: str, exponents: Mapping[str, object]) -> str:
    return _EXPONENT.sub(lambda match: f"^{exponents.get(match[1], match[1])}", unit)


def _read(parameter: Parameter, value: object, found: Mapping[str, float]) -> float:
    if not parameter.unit:
        if isinstance(value, bool) and not parameter.fitted:
            return float(value)
        bounds = (parameter.lower, parameter.upper, parameter.lower_allowed, parameter.upper_allowed)
        return parse_ratio(value, *bounds)
    if parameter.unit == _CELSIUS:
        return parse_temperature(value)
    exponents = {name: found[name] for name in _EXPONENT.findall(parameter.unit)}
    kind = _kind(parameter, exponents)
    text = _exponents_in(value, exponents)
    try:
        result = parse_quantity(text, kind)
    except PydanticCustomError as error:
        if not exponents:
            raise
        names = ", ".join(f"{name} = {number:g}" for name, number in exponents.items())
        sentence, code = split_code(error.message())
        raise PydanticCustomError("parameter", "{m}", {"m": f"{sentence}; {names} here{code}"}) from None
    # pint takes 1 Hz as 1/s; as a circular frequency it is 2 pi rad/s
    return 2.0 * math.pi * result if parameter.unit == "rad/s" and re.search(r"Hz\b", str(text)) else result


def _exponents_in(value: object, exponents: Mapping[str, float]) -> object:
    """The text with the exponents by name, or numbers that mean the same, as the numbers themselves."""
    if not isinstance(value, str) or not exponents:
        return value

    def replace(match: re.Match[str]) -> str:
        if match[1] in exponents:
            return f"^{exponents[match[1]]!r}"
        near = [
            number for number in exponents.values() if abs(float(match[2]) - number) <= _EXPONENT_TOLERANCE * number
        ]
        return f"^{near[0]!r}" if near else match[0]

    return re.sub(r"\^\s*(?:([A-Za-z_]\w*)|([0-9.]+(?:[eE][-+]?[0-9]+)?))", replace, value.replace("**", "^"))


def _kind(parameter: Parameter, exponents: Mapping[str, float]) -> Kind:
    shown = {name: f"{value:g}" for name, value in exponents.items()}
    unit = _with_exponents(parameter.unit, {name: repr(value) for name, value in exponents.items()})
    return Kind(parameter.meaning, unit, f"1 {practical_unit(parameter, shown)}")
