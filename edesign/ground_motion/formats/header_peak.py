"""The peak that the header of a record file states, against the peak of its samples."""

from __future__ import annotations

import re

from edesign.errors import InputError

_DIGITS = 6  # of an exponent, whose number is zero or infinite long before
_NUMBER = re.compile(r"[-+]?[0-9]*(?:\.([0-9]*))?(?:[EeDd]([-+]?[0-9]+))?$")


def last_place(word: str) -> float:
    """Return what one unit in the last digit of a number is worth as it is written: 0.001 of `-.167`, 10 of `1.2E2`."""
    match = _NUMBER.match(word.strip())
    if match is None:
        return 0.0
    return float(f"1e{int((match[2] or '0')[:_DIGITS]) - len(match[1] or '')}")


def check_peak(where: str, stated: str, found: float, unit: str, rounding: float = 0.0) -> None:
    """Check that samples have the peak that their header states; signs don't count, as networks print either.

    Args:
        where: file and line of the header.
        stated: the number as the header writes it, in `unit`.
        found: the peak of the samples, in `unit`.
        unit: for the message.
        rounding: one unit in the last digit of the samples, in `unit`; the header may come from samples with more.

    Raises:
        InputError: they differ by more than one unit in the last digit of the header plus `rounding`.
    """
    try:
        peak = abs(float(stated))
    except ValueError:
        raise InputError(
            f"{where}: `{stated.strip()[:40]}` is not a number; the peak in {unit} is expected here [E-REC-04]"
        ) from None
    # some networks cut the digits that they don't print, others round them: so a whole unit of the last digit
    if abs(peak - abs(found)) > (last_place(stated) + rounding) * (1.0 + 1e-9):
        raise InputError(
            f"{where}: the header has a peak of {stated.strip()} {unit}, the samples {abs(found):g}; "
            "the file is damaged, or its samples are not what the header says [E-REC-22]"
        )
