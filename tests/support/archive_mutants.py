"""Damaged and crafted archives, drawn by seed, and what a command makes of one in a process of its own."""

from __future__ import annotations

import contextlib
import io
import json
import math
import os
import signal
import time
from collections import Counter
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path

import h5py
import numpy as np
import pytest

resource = pytest.importorskip("resource")

PAGE = 4096
Random = np.random.Generator
Damage = Callable[[bytearray, Random], bytearray]
Craft = Callable[[h5py.File, Random, Path], None]


# ---- bytes ----


def flipped(content: bytearray, random: Random) -> bytearray:
    """One to eight bits anywhere."""
    for _ in range(random.integers(1, 9)):
        content[random.integers(len(content))] ^= 1 << random.integers(8)
    return content


def overwritten(content: bytearray, random: Random) -> bytearray:
    """Up to 64 bytes at a place, by others."""
    start = int(random.integers(len(content)))
    count = min(int(random.integers(1, 65)), len(content) - start)
    content[start : start + count] = random.bytes(count)
    return content


def zeroed_page(content: bytearray, random: Random) -> bytearray:
    return zero_page(content, int(random.integers(-(-len(content) // PAGE))))


def zero_page(content: bytearray, number: int) -> bytearray:
    stop = min((number + 1) * PAGE, len(content))
    content[number * PAGE : stop] = bytes(stop - number * PAGE)
    return content


def swapped_pages(content: bytearray, random: Random) -> bytearray:
    first, second = (int(number) * PAGE for number in random.integers(len(content) // PAGE, size=2))
    page = bytes(content[first : first + PAGE])
    content[first : first + PAGE] = content[second : second + PAGE]
    content[second : second + PAGE] = page
    return content


def truncated(content: bytearray, random: Random) -> bytearray:
    return content[: random.integers(len(content))]


def extended(content: bytearray, random: Random) -> bytearray:
    return content + random.bytes(int(random.integers(1, 2 * PAGE)))


DAMAGES: tuple[Damage, ...] = (flipped, overwritten, zeroed_page, swapped_pages, truncated, extended)


# ---- structures, by h5py ----


def _groups(file: h5py.File) -> list[h5py.Group]:
    found = [file["/"]]
    file.visititems(lambda name, item: found.append(item) if isinstance(item, h5py.Group) else None)
    return found


def _any_group(file: h5py.File, random: Random) -> h5py.Group:
    groups = _groups(file)
    return groups[random.integers(len(groups))]


def _any_data(file: h5py.File, random: Random) -> h5py.Dataset:
    found: list[h5py.Dataset] = []
    file.visititems(lambda name, item: found.append(item) if isinstance(item, h5py.Dataset) else None)
    return found[random.integers(len(found))]


def _replaced(file: h5py.File, random: Random, **how: object) -> None:
    """Put another dataset in the place of one, with its attributes."""
    old = _any_data(file, random)
    parent, name, attributes = old.parent, old.name.rpartition("/")[2], dict(old.attrs)
    attributes = {key: value for key, value in attributes.items() if key in ("units", "long_name")}
    del parent[name]
    new = parent.create_dataset(name, **how)
    for key, value in attributes.items():
        new.attrs[key] = value


def soft_loop(file: h5py.File, random: Random, folder: Path) -> None:
    group = _any_group(file, random)
    group["loop"], group["back"] = h5py.SoftLink(f"{group.name}/back"), h5py.SoftLink(f"{group.name}/loop")


def hard_cycle(file: h5py.File, random: Random, folder: Path) -> None:
    _any_group(file, random)["circle"] = _any_group(file, random)


def second_name(file: h5py.File, random: Random, folder: Path) -> None:
    _any_group(file, random)["alias"] = _any_data(file, random)


def external_link(file: h5py.File, random: Random, folder: Path) -> None:
    _any_group(file, random)["elsewhere"] = h5py.ExternalLink("/etc/hostname", "/")


def external_group(file: h5py.File, random: Random, folder: Path) -> None:
    """The analyses are in another file."""
    with h5py.File(folder / "other.h5", "w") as other:
        file.copy("analyses", other)
    del file["analyses"]
    file["analyses"] = h5py.ExternalLink(str(folder / "other.h5"), "/analyses")


def data_for_group(file: h5py.File, random: Random, folder: Path) -> None:
    groups = _groups(file)[1:]
    name = groups[random.integers(len(groups))].name
    del file[name]
    file[name] = np.arange(3.0)


def group_for_data(file: h5py.File, random: Random, folder: Path) -> None:
    name = _any_data(file, random).name
    del file[name]
    file.create_group(name)


def huge_data(file: h5py.File, random: Random, folder: Path) -> None:
    """24 GB of which nothing is stored."""
    _replaced(
        file, random, shape=(3_000_000_000,), dtype="f8", **({"chunks": (1 << 20,)} if random.random() < 0.5 else {})
    )


def bomb(file: h5py.File, random: Random, folder: Path) -> None:
    """64 MB in a few kB."""
    _replaced(file, random, data=np.zeros(1 << 23), compression="gzip", chunks=(1 << 20,))


def external_storage(file: h5py.File, random: Random, folder: Path) -> None:
    (folder / "raw").write_bytes(bytes(80))
    _replaced(file, random, shape=(10,), dtype="f8", external=[(str(folder / "raw"), 0, 80)])


def virtual_data(file: h5py.File, random: Random, folder: Path) -> None:
    layout = h5py.VirtualLayout(shape=(10,), dtype="f8")
    layout[:] = h5py.VirtualSource("/etc/hostname", "x", shape=(10,))
    old = _any_data(file, random)
    parent, name = old.parent, old.name.rpartition("/")[2]
    del parent[name]
    parent.create_virtual_dataset(name, layout)


def other_type(file: h5py.File, random: Random, folder: Path) -> None:
    lists = np.empty(2, h5py.vlen_dtype("f8"))
    lists[:] = [np.zeros(3), np.zeros(2)]
    kinds = [
        np.zeros(3, [("a", "f8"), ("b", "i4")]),
        np.zeros(3, "V16"),
        np.zeros(3, "c16"),
        np.zeros(3, h5py.enum_dtype({"a": 0})),
        np.array([file.ref] * 2, h5py.ref_dtype),
        lists,
        h5py.Empty("f8"),
    ]
    kind = kinds[int(random.integers(len(kinds)))]
    if random.random() < 0.5:
        _any_group(file, random).attrs["status"] = kind
    else:
        _replaced(file, random, data=kind) if isinstance(kind, np.ndarray) else _replaced(
            file, random, shape=None, dtype="f8"
        )


def many_axes(file: h5py.File, random: Random, folder: Path) -> None:
    _replaced(file, random, data=np.zeros((1,) * 32))


def other_shape(file: h5py.File, random: Random, folder: Path) -> None:
    _replaced(file, random, data=np.zeros([(), (1,), (0,), (2, 5), (7,)][random.integers(5)]))


def huge_attribute(file: h5py.File, random: Random, folder: Path) -> None:
    _any_group(file, random).attrs["events"] = np.zeros(random.integers(1, 1 << 18))


def other_attribute(file: h5py.File, random: Random, folder: Path) -> None:
    group = _any_group(file, random)
    names = list(group.attrs)
    if names:
        values = [
            -1,
            1e300,
            "",
            "json:{",
            "json:[[[",
            "json:[1]",
            "\ud83d".encode("utf-8", "surrogatepass"),
            np.zeros((2, 2)),
        ]
        name = names[random.integers(len(names))]
        del group.attrs[name]
        group.attrs[name] = values[random.integers(len(values))]


def other_mark(file: h5py.File, random: Random, folder: Path) -> None:
    """What gives the layout, and whether the archive is complete."""
    name = ("edesign_archive", "complete")[random.integers(2)]
    values = (0, 1, 3, 2.5, "2", np.arange(3), 1 << 62)
    file.attrs[name] = values[int(random.integers(len(values)))]


def lost_attribute(file: h5py.File, random: Random, folder: Path) -> None:
    groups = [group for group in _groups(file) if len(group.attrs)]
    group = groups[random.integers(len(groups))]
    del group.attrs[list(group.attrs)[random.integers(len(group.attrs))]]


def lost_data(file: h5py.File, random: Random, folder: Path) -> None:
    item = _any_data(file, random)
    del item.parent[item.name]


def lost_group(file: h5py.File, random: Random, folder: Path) -> None:
    groups = _groups(file)[1:]
    del file[groups[random.integers(len(groups))].name]


def foreign_name(file: h5py.File, random: Random, folder: Path) -> None:
    group = _any_group(file, random)
    h5py.h5g.create(group.id, [b"\xff\xfe", b" ", b".hidden", b"x" * 5000][random.integers(4)])


def deep(file: h5py.File, random: Random, folder: Path) -> None:
    group = _any_group(file, random)
    for _ in range(200):
        group = group.create_group("g")


def named_type(file: h5py.File, random: Random, folder: Path) -> None:
    _any_group(file, random)["kind"] = np.dtype("f8")


CRAFTS: tuple[Craft, ...] = (
    soft_loop,
    hard_cycle,
    second_name,
    external_link,
    external_group,
    data_for_group,
    group_for_data,
    huge_data,
    bomb,
    external_storage,
    virtual_data,
    other_type,
    many_axes,
    other_shape,
    huge_attribute,
    other_attribute,
    other_mark,
    lost_attribute,
    lost_data,
    lost_group,
    foreign_name,
    deep,
    named_type,
)


def damaged_copy(source: Path, target: Path, damage: Damage, random: Random) -> None:
    """Write a damaged copy that differs."""
    content = spoilt = source.read_bytes()
    while spoilt == content:
        spoilt = bytes(damage(bytearray(content), random))
    target.write_bytes(spoilt)


def crafted_copy(source: Path, target: Path, craft: Craft, random: Random) -> None:
    target.write_bytes(source.read_bytes())
    with h5py.File(target, "r+", libver=("v108", "latest")) as file:
        craft(file, random, target.parent)


# ---- processes ----


@dataclass(frozen=True)
class Ended:
    """How a command ended.

    Attributes:
        code: exit code, or "hung" or "crashed".
        seconds: that it took.
        output, errors: what it printed.
    """

    code: int | str
    seconds: float
    output: str
    errors: str


def command(words: Sequence[str], limit: float = 10.0) -> Ended:
    """Run a command of edesign in a fork of this process; see `in_fork`."""

    def work() -> str:
        from edesign.cli.main import main

        output, errors = io.StringIO(), io.StringIO()
        with contextlib.redirect_stdout(output), contextlib.redirect_stderr(errors):
            code = main(words)
        return json.dumps([code, output.getvalue(), errors.getvalue()])

    started = time.monotonic()
    said = in_fork(work, limit)
    seconds = time.monotonic() - started
    if said in FAILURES:
        return Ended(said, seconds, "", "")
    code, output, errors = json.loads(said)
    return Ended(code, seconds, output, errors)


FAILURES = ("hung", "crashed")
STUCK = 480  # s, by the clock: a fork that waits for a lock of a thread that it has not takes no CPU time


def in_fork(work: Callable[[], str], limit: float, memory: int = 1 << 30) -> str:
    """Return what a function returns in a fork of this process, or "hung" or "crashed".

    Args:
        work: may run into loops without end, and into faults of libraries.
        limit: CPU time after which it counts as hung, s: of the fork, so that a busy machine does not matter.
        memory: that the fork may take beyond that of this process, bytes.
    """
    read, write = os.pipe()
    child = os.fork()
    if child == 0:
        code = 1
        try:
            os.close(read)
            used = int(Path("/proc/self/statm").read_text(encoding="ascii").split()[0]) * os.sysconf("SC_PAGE_SIZE")
            resource.setrlimit(resource.RLIMIT_AS, (used + memory, used + memory))
            resource.setrlimit(resource.RLIMIT_CPU, (math.ceil(limit), math.ceil(limit) + 1))
            signal.signal(signal.SIGALRM, signal.SIG_DFL)
            signal.alarm(STUCK)
            with os.fdopen(write, "wb") as pipe:
                pipe.write(work().encode("utf-8", "backslashreplace"))
            code = 0
        finally:
            os._exit(code)
    os.close(write)
    with os.fdopen(read, "rb") as pipe:
        said = pipe.read().decode("utf-8")
    _, status = os.waitpid(child, 0)
    if os.WIFSIGNALED(status) and os.WTERMSIG(status) in (signal.SIGXCPU, signal.SIGALRM, signal.SIGKILL):
        return "hung"
    return said if status == 0 else "crashed"


def counted(ends: Mapping[str, Sequence[Ended]]) -> str:
    """Return a line for each kind of damage: how many commands ended with which code, and the longest time."""
    lines = []
    for kind, found in sorted(ends.items()):
        codes = Counter(str(end.code) for end in found)
        counts = ", ".join(f"{number} x {code}" for code, number in sorted(codes.items()))
        lines.append(f"{kind:24} {counts}; longest {max(end.seconds for end in found):.2f} s")
    return "\n".join(lines)
