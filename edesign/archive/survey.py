"""Find which groups of an archive can be read, in a process of its own.

HDF5 can fail or loop without end on a file whose parts do not belong together, although each has the right checksum: as
when a power failure has left pages of two states of a file. A process that does the reading beforehand bears that.
"""

from __future__ import annotations

import json
import subprocess
import sys
from collections.abc import Container, Iterator
from dataclasses import dataclass, field
from pathlib import Path
from types import ModuleType

from edesign.archive.opening import open_file
from edesign.archive.tree import Damaged

resource: ModuleType | None
try:
    import resource
except ImportError:  # not on this platform; the time is then that of a clock
    resource = None

AT_LEAST = 20  # s of CPU time
PER_SECOND = 1e7  # bytes that are read in a second at least; a tenth of what a slow computer does
FAILURES = 5  # of the process, each in another group, after which nothing is read
_START = """
import sys
sys.path[:] = {path!r}
from edesign.archive.survey import main
main({file!r}, {without!r}, {limit})
"""


@dataclass
class Survey:
    """The result of reading every group of a file once.

    Attributes:
        readable: places of groups that can be read, "" for the root.
        damage: why each other group cannot be, by its place; what lies below such a group cannot be read either.
    """

    readable: list[str] = field(default_factory=list)
    damage: dict[str, str] = field(default_factory=dict)


def survey(path: Path) -> Survey:
    """Read every group of a file once.

    Raises:
        OSError: the system cannot read it.
        Damaged: nothing of it can be read.
    """
    limit = AT_LEAST + path.stat().st_size / PER_SECOND
    damage: dict[str, str] = {}
    for _ in range(FAILURES):
        found, last, failure = _asked(path, list(damage), limit)
        found.damage |= damage
        if not failure:
            return found
        if not last:
            raise Damaged("", failure)
        damage[last] = failure
    raise Damaged("", f"HDF5 fails in {FAILURES} of its groups")


def _asked(path: Path, without: list[str], limit: float) -> tuple[Survey, str, str]:
    """Let a process read the file; return what it found, the group where it ended, and how it failed."""
    code = _START.format(path=sys.path, file=str(path), without=without, limit=limit)
    found, last = Survey(), ""
    try:
        ended = subprocess.run([sys.executable, "-c", code], capture_output=True, timeout=10 * limit, check=False)
        output, status = ended.stdout, ended.returncode
        if status == 1:  # what Python itself can tell of is no fault of the file
            raise RuntimeError(ended.stderr.decode("utf-8", "replace"))
    except subprocess.TimeoutExpired as error:
        output, status = error.stdout or b"", -1
    for line in output.decode("ascii", "replace").splitlines():
        try:
            place, why = json.loads(line)
        except ValueError:  # cut off
            break
        if why is None:
            last = place
        elif why:
            found.damage[place] = why
        else:
            found.readable.append(place)
    if status == 0:
        return found, last, ""
    return found, last, "HDF5 fails on it, or does not come to an end"


def main(file: str, without: Container[str], limit: float) -> None:
    """Print a line of JSON for each group before it is read, [place, null], and after, [place, error or ""].

    Args:
        file: path of the file.
        without: places of groups that are not read.
        limit: seconds of processor time after which the process ends.
    """
    if resource is not None:
        for kind, most in ((resource.RLIMIT_CPU, int(limit)), (resource.RLIMIT_CORE, 0)):
            _, hard = resource.getrlimit(kind)
            resource.setrlimit(kind, (most if hard == resource.RLIM_INFINITY else min(most, hard), hard))
    for place, why in _read(Path(file), without):
        print(json.dumps([place, why]), flush=True)


def _read(path: Path, without: Container[str]) -> Iterator[tuple[str, str | None]]:
    try:
        opened = open_file(path, sealed=False, mend=True)
    except Damaged as error:
        yield error.place, error.why
        return
    for place in opened.tree.places(without) if opened.tree.layout is not None else ():
        yield place, None
        try:
            opened.tree.group(place)
        except Damaged as error:
            yield place, error.why
        else:
            yield place, ""
    opened.close()
