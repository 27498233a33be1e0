"""What must be the same wherever a part of a study is computed, so that results of two states never mix."""

from __future__ import annotations

from collections.abc import Mapping
from functools import cache

from edesign.study.results.provenance import code_checksum, libraries


@cache
def program_state() -> Mapping[str, str]:
    """Return the versions and checksums of this process that results depend on beside the input."""
    return {"edesign": code_checksum(), **libraries()}


def difference(wanted: Mapping[str, str], found: Mapping[str, str]) -> str:
    """Return the differences of two states of programs as a clause; "" if they are equal.

    Args:
        wanted: versions and checksums by name.
        found: likewise, of the other program.
    """
    parts = []
    for name, value in wanted.items():
        other = found.get(name, "nothing")
        if other == value:
            continue
        if name == "edesign" and len(other) == len(value):
            parts.append(f"the code of edesign differs (checksum {other[:12]} there, {value[:12]} here)")
        else:
            parts.append(f"{name} is {other} there, {value[:12]} here")
    return "; ".join(parts)


def refusal(worker: str, wanted: Mapping[str, str], found: Mapping[str, str]) -> str:
    """Return the message on a worker in another state, "" if its state is equal.

    Args:
        worker: name or address of the worker.
        wanted: versions and checksums by name.
        found: likewise, of the worker.
    """
    what = difference(wanted, found)
    other = f"the worker {worker} would give results of another program: {what}; "
    return what and f"{other}install the same everywhere [E-CLUSTER-03]"
