"""Write names, order and bounds of the parameters of damper laws and their effects for the core.

The one table of laws is edesign/damper/laws.py, that of effects edesign/damper/effect_forms.py. Of each the core
has a header, which gives the places of parameters their names, and a table of bounds:

    core_c/src/damper/law_parameters.h, law_parameters.c
    core_c/src/damper/effect_parameters.h, effect_parameters.c

tests/unit/damper/test_law_parameters.py fails when these files are of another table.

Usage: python -m tools.law_parameters
"""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path

from edesign.damper.effect_forms import parameters_in_core
from edesign.damper.law import Parameter
from edesign.damper.laws import LAWS

FOLDER = Path(__file__).resolve().parents[1] / "core_c" / "src" / "damper"


@dataclass(frozen=True)
class Entry:
    """Parameters of a law or an effect.

    Attributes:
        parameters: in the order of the core.
        branch: those of a branch of a law that has any number of them.
        most_branches: how many branches it may have; 0: none.
    """

    parameters: tuple[Parameter, ...]
    branch: tuple[Parameter, ...] = ()
    most_branches: int = 0

    @property
    def most(self) -> int:
        """How many parameters there may be in all."""
        return len(self.parameters) + self.most_branches * len(self.branch)


def sources() -> dict[Path, str]:
    """The text of each file that is made."""
    laws = {
        f"ED_LAW_{law.name.upper()}": Entry(law.parameters, law.branch, law.most_branches if law.branch else 0)
        for law in LAWS.values()
    }
    effects = {
        f"ED_EFFECT_{name.replace('.', '_').upper()}": Entry(parameters)
        for name, parameters in parameters_in_core().items()
    }
    return {
        **_pair("law", "laws", "edesign/damper/laws.py", laws),
        **_pair("effect", "effects", "edesign/damper/effect_forms.py", effects),
    }


def _pair(stem: str, which: str, origin: str, entries: Mapping[str, Entry]) -> dict[Path, str]:
    name, made = f"{stem}_parameters", f"made by tools/law_parameters.py from\n * {origin}, where they are changed."
    guard = f"ED_{name.upper()}_H"
    header = [
        f"/* Places of the parameters of all {which}, as lists for an enum: {made} */",
        f"#ifndef {guard}",
        f"#define {guard}",
        "",
        '#include "damper/parameter.h"',
        "",
        f"extern const ed_parameters ed_{name}[]; /* by the id in eddamper.h */",
        f"enum {{ ED_MOST_{stem.upper()}_PARAMETERS = {max(entry.most for entry in entries.values())} }};",
        "",
    ]
    for id_, entry in entries.items():
        header.append(f"#define {id_}_PARAMETERS {_places(id_, entry.parameters)}")
        if entry.branch:
            header.append(f"#define {id_}_BRANCH {_places(id_, entry.branch)}")
    header += ["", "#endif", ""]
    table = [
        f"/* Names, order and bounds of the parameters of all {which}: {made} */",
        f'#include "damper/{name}.h"',
        "",
        '#include "edcore.h"',
        "",
        "#include <math.h>",
        "#include <stddef.h>",
        "",
        f"const ed_parameters ed_{name}[] = {{",
    ]
    for id_, entry in entries.items():
        table += [f"    [{id_}] =", f"        {{.n = {len(entry.parameters)},"]
        table += _rows("parameter", entry.parameters, "," if entry.branch else "},")
        if entry.branch:
            table.append(f"         .n_branch = {len(entry.branch)},")
            table.append(f"         .most_branches = {entry.most_branches},")
            table += _rows("branch", entry.branch, "},")
    return {FOLDER / f"{name}.h": "\n".join(header), FOLDER / f"{name}.c": "\n".join([*table, "};", ""])}


def _places(id_: str, parameters: Sequence[Parameter]) -> str:
    names = [parameter.name.upper() for parameter in parameters]
    if len(set(names)) < len(names):
        raise ValueError(f"{id_}: names of parameters differ by the case of letters alone: {', '.join(names)}")
    return ", ".join(names)


def _rows(field: str, parameters: Sequence[Parameter], end: str) -> list[str]:
    start = f"         .{field} = (const ed_parameter[]){{"
    text = [f"{start if k == 0 else ' ' * len(start)}{_row(one)}," for k, one in enumerate(parameters)]
    return [*text[:-1], f"{text[-1][:-1]}}}{end}"]


def _row(one: Parameter) -> str:
    bounds = f'"{one.name}", {_number(one.lower)}, {_number(one.upper)}, {one.lower_allowed:d}, {one.upper_allowed:d}'
    choices = f"(const double[]){{{', '.join(map(_number, one.choices))}}}" if one.choices else "NULL"
    return f"{{{bounds}, {len(one.choices)}, {choices}}}"


def _number(value: float) -> str:
    if math.isinf(value):
        return "-INFINITY" if value < 0.0 else "INFINITY"
    return repr(float(value))


if __name__ == "__main__":
    for path, text in sources().items():
        path.write_text(text, encoding="utf-8")
