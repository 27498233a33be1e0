"""What a table without the marks of a record format is taken for: properties, a test of a damper, or a record.

A test is read as campaigns read it, a record as projects do. What campaigns alone read is a test of unknown names.
"""

from __future__ import annotations

from pathlib import Path

from edesign.errors import InputError
from edesign.ground_motion.formats.read import detect
from edesign.report.inspection.account import Account
from edesign.report.inspection.damper_test import has_unit_of_test, is_test, names_test, read_test_table, test_account
from edesign.report.inspection.property_table import property_table_account
from edesign.report.inspection.record import record_account
from edesign.tables.text import like_number, table_text


def table_account(path: Path) -> Account:
    """Inspect a table.

    Raises:
        InputError: it cannot be read as what its headers name, or as anything.
    """
    if (properties := property_table_account(path)) is not None:
        return properties
    try:
        table = read_test_table(path)
    except InputError as error:
        if names_test(path):
            raise
        detect(path)  # says what a file is not
        try:
            return record_account(path)
        except InputError as of_record:
            raise (of_record if _begins_with_a_number(path) else error) from None
    if is_test(table) or has_unit_of_test(table):
        return test_account(table)
    try:
        return record_account(path)
    except InputError:
        return test_account(table)


def _begins_with_a_number(path: Path) -> bool:
    lines = table_text(path, "table").lines
    return bool(lines) and like_number(lines[0].replace(",", " ").replace(";", " ").split()[0])
