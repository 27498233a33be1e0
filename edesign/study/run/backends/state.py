"""What must be the same wherever a part of a study is computed, so that results of two states never mix."""

from __future__ import annotations

from collections.abc import Mapping
from functools import cache

from edesign.study.run.provenance import code_checksum, libraries


@cache
def program_state() -> Mapping[str, str]:
    """Return what the results of this process depend on beside the input: edesign's code, and libraries."""
    return {"edesign": code_checksum(), **libraries()}


def difference(wanted: Mapping[str, str], found: Mapping[str, str]) -> str:
    """Return what is not the same, as a clause; "" if nothing differs."""
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
    """Return the message on a worker of another state, "" if it is of the same."""
    what = difference(wanted, found)
    return what and f"the worker {worker} would give results of another program: {what}; install the same everywhere"
