"""What is found in the table of a test of a damper, and the campaign that reads it."""

from __future__ import annotations

from pathlib import Path

import numpy as np

from edesign.damper.testing.clipping import clipping_text
from edesign.damper.testing.measured_files import EXAMPLE, rest_before
from edesign.errors import InputError
from edesign.report.inspection.account import OPEN, Account, Column, Sampling, ends, quoted, table_keys
from edesign.tables.columns import places_of, unit_of
from edesign.tables.quantities import QUANTITIES, names_quantity
from edesign.tables.table import Table, read_table


def damper_test_account(path: Path) -> Account | None:
    """Inspect a table as a test of a damper; None: no header names a displacement or a force.

    Raises:
        InputError: the table is one of a test, and cannot be read.
    """
    try:
        table = read_table(path, "table", EXAMPLE, names_quantity)
    except InputError:
        if _names_test(path):
            raise
        return None
    places = places_of(table)
    if not {"displacement", "force"} & set(places) and not table.form.says_itself:
        return None
    names = {at: quantity for quantity, at in places.items()}
    units = {quantity: unit_of(table, at, quantity) for quantity, at in places.items()}
    questions = []
    for quantity in ("time", "displacement", "force"):
        if quantity not in places:
            also = ", or the sampling by `time_step`" if quantity == "time" else ""
            questions.append(f"Which column is the {quantity}? Say it by `columns`{also}.")
        elif units[quantity] is None:
            questions.append(f"What is the unit of the {quantity} (column {places[quantity] + 1})?")
    if "temperature" not in places:
        questions.append("What was the ambient temperature?")
    columns = tuple(
        Column(
            i + 1,
            header,
            names.get(i, ""),
            (units.get(names[i]) or "") if i in names else "",
            float(np.min(table.rows[:, i])),
            float(np.max(table.rows[:, i])),
        )
        for i, header in enumerate(table.headers)
    )
    first, last = ends(table.rows, table.lines)
    time = _in_si(table, places, units, "time")
    sampling = Sampling.of(time, table.lines) if time is not None and time.size > 1 else None
    remarks = _remarks(table, places, units, time)
    text = _yaml(table, places, units)
    return Account(
        *(path, "test of a damper", table.form, columns, table.rows.shape[0], first, last, sampling, text),
        tuple(remarks),
        tuple(questions),
    )


def _names_test(path: Path) -> bool:
    """Whether words of a file that cannot be read name displacement and force."""
    from edesign.tables.form import cells
    from edesign.tables.quantities import name_and_unit, other_quantity_of, quantity_of
    from edesign.tables.text import table_text

    for line in table_text(path, "table").lines[:100]:
        for sign in ("comma", "semicolon", "tab"):
            names = [name_and_unit(cell)[0] for cell in cells(line, sign)]
            found = {quantity_of(name) or other_quantity_of(name) for name in names}
            if {"displacement", "force"} <= found:
                return True
    return False


def _in_si(table: Table, places: dict[str, int], units: dict[str, str | None], quantity: str) -> np.ndarray | None:
    unit = units.get(quantity)
    if quantity not in places or unit is None:
        return None
    factor, zero = QUANTITIES[quantity][unit]
    values: np.ndarray = factor * table.rows[:, places[quantity]] + zero
    return values


def _remarks(table: Table, places: dict[str, int], units: dict[str, str | None], time: np.ndarray | None) -> list[str]:
    """What is to be told of the beginning of the displacement, and of a load cell that shows nothing."""
    found = []
    if "displacement" in places:
        values = table.rows[:, places["displacement"]]
        unit = units["displacement"] or "(no unit)"
        span = float(np.ptp(values))
        if span == 0.0:
            found.append("the displacement is the same in all rows; nothing moved")
        else:
            share = 100.0 * abs(float(values[0])) / span
            first = f"displaced by {values[0]:.4g} {unit}, {share:.2g} % of the range" if values[0] else "not displaced"
            found.append(f"the first sample is {first}")
            samples = rest_before(values)
            long = f" ({time[samples] - time[0]:.3g} s)" if time is not None else ""
            found.append(
                f"{samples} samples{long} of rest before the motion" if samples else "no rest before the motion"
            )
    if "force" in places and np.ptp(table.rows[:, places["force"]]) == 0.0:
        found.append("the force is the same in all rows; was the load cell connected?")
    elif "force" in places:
        text = clipping_text(table.rows[:, places["force"]], units["force"] or "(no unit)", time)
        found += [text] if text else []
    return found


def _yaml(table: Table, places: dict[str, int], units: dict[str, str | None]) -> str:
    """The entry of a campaign that reads the table; `OPEN` where something must be said."""
    lines = [f"file: {quoted(table.path.name)}"]
    if "temperature" not in places:
        lines.append(f"temperature: {OPEN} degC")
    if keys := table_keys(table.form):
        lines.append(f"table: {keys}")
    missing = [quantity for quantity in ("time", "displacement", "force") if quantity not in places]
    if missing:
        order = ("time", "displacement", "force", "temperature")
        said = {q: str(places[q] + 1) if q in places else OPEN for q in order if q in places or q in missing}
        lines.append(f"columns: {{{', '.join(f'{key}: {value}' for key, value in said.items())}}}")
    unsaid = [quantity for quantity in (*places, *missing) if units.get(quantity) is None]
    if unsaid:
        lines.append(f"units: {{{', '.join(f'{quantity}: {OPEN}' for quantity in unsaid)}}}")
    return "tests:\n" + "".join(("  - " if i == 0 else "    ") + line + "\n" for i, line in enumerate(lines))
