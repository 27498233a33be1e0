"""What is found in the table of a test of a damper, and the campaign that reads it."""

from __future__ import annotations

from pathlib import Path

import numpy as np

from edesign.damper.testing.clipping import clipping_text
from edesign.damper.testing.measured_files import EXAMPLE, rest_before
from edesign.report.inspection.account import OPEN, Account, Column, Sampling, ends, extremes, quoted, table_keys
from edesign.tables.columns import Chosen, candidates, unit_of
from edesign.tables.form import cells
from edesign.tables.quantities import QUANTITIES, name_and_unit, names_quantity, spelled
from edesign.tables.table import Table, read_table
from edesign.tables.text import table_text


def read_test_table(path: Path) -> Table:
    """Read a table as campaigns do that say nothing of it.

    Raises:
        InputError: the table cannot be read.
    """
    return read_table(path, "table", EXAMPLE, names_quantity, read=Chosen().read_of)


def is_test(table: Table) -> bool:
    """Return whether a header names a displacement or a force, or the file is one of a test machine."""
    return bool({"displacement", "force"} & set(candidates(table.headers))) or table.form.says_itself


def has_unit_of_test(table: Table) -> bool:
    """Return whether a header that names nothing has a unit of displacement or force."""
    units = [spelled(unit) for header in table.headers if (unit := _unit(header)) is not None]
    return any(unit in QUANTITIES[quantity] for quantity in ("displacement", "force") for unit in units)


def names_test(path: Path) -> bool:
    """Return whether words of a file that cannot be read name displacement and force."""
    for line in table_text(path, "table").lines[:100]:
        for sign in ("comma", "semicolon", "tab"):
            if {"displacement", "force"} <= set(candidates(cells(line, sign))):
                return True
    return False


def test_account(table: Table) -> Account:
    """Return what a table is as a test of a damper; what its headers leave ambiguous is asked.

    Args:
        table: as `read_test_table` reads it.
    """
    found = candidates(table.headers)
    ambiguous = {quantity: _rivals(table, quantity, places) for quantity, places in found.items()}
    places = {quantity: at[0] for quantity, at in found.items() if len(ambiguous[quantity]) < 2}
    names = {at: quantity for quantity, at in places.items()}
    units = {quantity: unit_of(table, at, quantity) for quantity, at in places.items()}
    questions = []
    for quantity in ("time", "displacement", "force"):
        if quantity not in places:
            which = [f"{i + 1} (`{table.headers[i]}`)" for i in ambiguous.get(quantity, ())]
            among = f": {' or '.join(which)}" if which else ""
            also = ", or the sampling by `time_step`" if quantity == "time" else ""
            questions.append(f"Which column is the {quantity}{among}? Say it by `columns`{also}.")
        elif units[quantity] is None:
            questions.append(f"What is the unit of the {quantity} (column {places[quantity] + 1})?")
    if "temperature" not in places:
        questions.append("What was the ambient temperature?")
    columns = tuple(
        Column(
            i + 1,
            header,
            names.get(i, ""),
            (units.get(names[i]) if i in names else _unit(header)) or "",
            *extremes(table.rows[:, i]),
        )
        for i, header in enumerate(table.headers)
    )
    first, last = ends(table.rows, table.lines)
    time = _in_si(table, places, units, "time")
    sampling = Sampling.of(time, table.lines) if time is not None and time.size > 1 else None
    remarks = _remarks(table, places, units, time)
    text = _yaml(table, places, units)
    return Account(
        *(table.path, "test of a damper", table.form, columns, table.rows.shape[0], first, last, sampling, text),
        tuple(remarks),
        tuple(questions),
    )


def _rivals(table: Table, quantity: str, places: list[int]) -> list[int]:
    """Columns that may be a displacement or force: those by name, and of unknown names those with such a unit."""
    if quantity not in ("displacement", "force"):
        return places
    known = [i for i, header in enumerate(table.headers) if names_quantity(header)]
    others = [
        i
        for i in range(len(table.headers))
        if i not in known and (unit := _unit(table.headers[i])) is not None and spelled(unit) in QUANTITIES[quantity]
    ]
    return sorted({*places, *others})


def _unit(header: str) -> str | None:
    return name_and_unit(header)[1]


def _in_si(table: Table, places: dict[str, int], units: dict[str, str | None], quantity: str) -> np.ndarray | None:
    unit = units.get(quantity)
    if quantity not in places or unit is None:
        return None
    factor, zero = QUANTITIES[quantity][unit]
    values: np.ndarray = factor * table.rows[:, places[quantity]] + zero
    return values


def _remarks(table: Table, places: dict[str, int], units: dict[str, str | None], time: np.ndarray | None) -> list[str]:
    """What is to be noted of the beginning of the displacement, and of a load cell that shows nothing."""
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
    """The entry of a campaign that reads the table; `OPEN` where something must be said.

    Units are asked for where no header of the columns that may be meant has one.
    """
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
    free = [i for i in range(len(table.headers)) if i not in places.values()]
    said_by_headers = [q for q in missing if any(spelled(_unit(table.headers[i]) or "") in QUANTITIES[q] for i in free)]
    unsaid = [q for q in (*places, *missing) if units.get(q) is None and q not in said_by_headers]
    if unsaid:
        lines.append(f"units: {{{', '.join(f'{quantity}: {OPEN}' for quantity in unsaid)}}}")
    return "tests:\n" + "".join(("  - " if i == 0 else "    ") + line + "\n" for i, line in enumerate(lines))
