"""Write core_c/src/damper/law_parameters.h: names, order and bounds of the parameters of all laws, for the core.

edesign/damper/laws.py is the one table of them; tests/unit/damper/test_law_parameters.py fails when the header is of
another table.

Usage: python -m tools.law_parameters
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from pathlib import Path

from edesign.damper.law import Parameter
from edesign.damper.laws import LAWS

HEADER = Path(__file__).resolve().parents[1] / "core_c" / "src" / "damper" / "law_parameters.h"


def header() -> str:
    """The text of the header."""
    most = max(len(law.parameters) for law in LAWS.values())
    most_of_branch = max(len(law.branch) for law in LAWS.values())
    lines = [
        "/* Names, order and bounds of the parameters of all laws: made by tools/law_parameters.py from",
        " * edesign/damper/laws.py, where they are changed. */",
        "#ifndef ED_LAW_PARAMETERS_H",
        "#define ED_LAW_PARAMETERS_H",
        "",
        '#include "edcore.h"',
        "",
        "#include <math.h>",
        "",
        "typedef struct {",
        "  const char *name;",
        "  double lower, upper;",
        "  int lower_allowed, upper_allowed; /* the bound itself */",
        "} ed_parameter;",
        "",
        "/* n parameters, then n_branch of each of 1 to most_branches branches, whose number follows their names. */",
        "typedef struct {",
        "  int n, n_branch, most_branches;",
        f"  ed_parameter parameter[{most}];",
        f"  ed_parameter branch[{most_of_branch}];",
        "} ed_parameters;",
        "",
        "static const ed_parameters ed_law_parameters[] = {",
    ]
    for law in LAWS.values():
        lines.append(f"    [ED_LAW_{law.name.upper()}] =")
        lines.append(f"        {{.n = {len(law.parameters)},")
        lines += _rows("parameter", law.parameters, "}," if not law.branch else ",")
        if law.branch:
            lines.append(f"         .n_branch = {len(law.branch)},")
            lines.append(f"         .most_branches = {law.most_branches},")
            lines += _rows("branch", law.branch, "},")
    return "\n".join([*lines, "};", "", "#endif", ""])


def _rows(field: str, parameters: Sequence[Parameter], end: str) -> list[str]:
    rows = [
        f'{{"{one.name}", {_number(one.lower)}, {_number(one.upper)}, {one.lower_allowed:d}, {one.upper_allowed:d}}}'
        for one in parameters
    ]
    start = f"         .{field} = {{"
    text = [f"{start if k == 0 else ' ' * len(start)}{row}," for k, row in enumerate(rows)]
    return [*text[:-1], f"{text[-1][:-1]}}}{end}"]


def _number(value: float) -> str:
    if math.isinf(value):
        return "-INFINITY" if value < 0.0 else "INFINITY"
    return repr(float(value))


if __name__ == "__main__":
    HEADER.write_text(header(), encoding="utf-8")
