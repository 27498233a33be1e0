"""Tables of measured properties: G', G_eq and loss factor over strain, frequency and temperature."""

from __future__ import annotations

import itertools
import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path
from typing import Literal

import numpy as np
from numpy.typing import ArrayLike

from edesign.archive.csv_files import write_csv_file
from edesign.damper.testing.properties import Properties
from edesign.errors import InputError
from edesign.project.analysis_file import AnalysisFile
from edesign.project.reading.file_bytes import read_file
from edesign.project.reading.problems import did_you_mean
from edesign.tables.table import read_table

COLUMNS = {  # header: attribute, and its SI unit in that of the header
    "temperature_C": ("temperature_C", 1.0),
    "shear_strain_percent": ("strain", 1e2),
    "frequency_Hz": ("frequency", 1.0),
    "G_storage_MPa": ("G_storage", 1e-6),
    "G_eq_MPa": ("G_eq", 1e-6),
    "loss_factor": ("loss_factor", 1.0),
}
_EXAMPLE = ",".join(COLUMNS)
_WHAT = "property table"
SAME_LEVEL = 0.03
"""Relative difference up to which measured strains, or frequencies, count as one level of the grid."""
SAME_TEMPERATURE = 1.0  # degC
_ROUNDING = 1e-9  # relative, at the edge of the range


@dataclass(frozen=True)
class Interpolated:
    """Properties at points, arrays of the points' shape.

    Attributes:
        G_storage, G_eq: Pa.
        loss_factor: n.
        inside: whether the point is inside the range of the table; if not, the values are those at its edge.
    """

    G_storage: np.ndarray
    G_eq: np.ndarray
    loss_factor: np.ndarray
    inside: np.ndarray

    @property
    def G_loss(self) -> np.ndarray:
        """Loss modulus G'' = n G', Pa."""
        return self.loss_factor * self.G_storage


@dataclass(frozen=True)
class PropertyTable:
    """Rows of properties, (n,) each.

    Attributes:
        temperature_C: degC.
        strain: amplitude of the shear strain.
        frequency: Hz.
        G_storage, G_eq: Pa.
        loss_factor: n.
        source: where it comes from.
    """

    temperature_C: np.ndarray
    strain: np.ndarray
    frequency: np.ndarray
    G_storage: np.ndarray
    G_eq: np.ndarray
    loss_factor: np.ndarray
    source: str = "property table"

    def __post_init__(self) -> None:
        sizes = set()
        for name, _ in COLUMNS.values():
            values = np.array(getattr(self, name), dtype=float, ndmin=1)
            if name != "temperature_C" and not np.all(values > 0.0):
                raise InputError(f"{self.source}: {name}: all values must be greater than zero [E-PROPS-01]")
            values.setflags(write=False)
            object.__setattr__(self, name, values)
            sizes.add(values.shape)
        if len(sizes) != 1 or len(next(iter(sizes))) != 1 or self.strain.size == 0:
            raise InputError(f"{self.source}: columns of one length with at least one row are needed [E-PROPS-02]")

    def __len__(self) -> int:
        return self.strain.size

    @property
    def G_loss(self) -> np.ndarray:
        """Loss modulus G'' = n G', (n,) Pa."""
        return self.loss_factor * self.G_storage

    @cached_property
    def levels(self) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
        """Temperatures (degC), strains and frequencies (Hz) of the grid; measured values near each other are one."""
        return tuple(levels for levels, _ in self._sorted)  # type: ignore[return-value]

    @cached_property
    def _sorted(self) -> list[tuple[np.ndarray, np.ndarray]]:
        return [
            _grouped(self.temperature_C, SAME_TEMPERATURE, 0.0),
            _grouped(self.strain, 0.0, SAME_LEVEL),
            _grouped(self.frequency, 0.0, SAME_LEVEL),
        ]

    @cached_property
    def _grid(self) -> np.ndarray:
        """(3, temperatures, strains, frequencies); rows of the same levels are averaged.

        Raises:
            InputError: a combination is missing.
        """
        shape = tuple(levels.size for levels in self.levels)
        at = tuple(index for _, index in self._sorted)
        count = np.zeros(shape)
        np.add.at(count, at, 1.0)
        if not count.all():
            t, g, f = (int(i) for i in np.argwhere(count == 0)[0])
            temperatures, strains, frequencies = self.levels
            raise InputError(
                f"{self.source}: no row for {100 * strains[g]:.4g} % strain, {frequencies[f]:.4g} Hz and "
                f"{temperatures[t]:.4g} degC ({int((count == 0).sum())} of {count.size} combinations are missing); "
                "interpolation needs all of them [E-PROPS-02]"
            )
        grid = np.zeros((3, *shape))
        for values, column in zip(grid, (self.G_storage, self.G_eq, self.loss_factor), strict=True):
            np.add.at(values, at, column)
        return grid / count

    def interpolate(
        self,
        strain: ArrayLike,
        frequency: ArrayLike,
        temperature_C: ArrayLike,
        outside: Literal["refuse", "edge"] = "refuse",
    ) -> Interpolated:
        """Interpolate properties between the rows, linearly in strain, logarithm of frequency, and temperature.

        Args:
            strain: amplitude of the shear strain, a scalar or an array; all three broadcast.
            frequency: Hz.
            temperature_C: degC.
            outside: what becomes of points outside the table: "refuse", or "edge" takes the nearest value inside and
                says so in `inside`.

        Returns:
            The properties, and whether each point lies inside the table.

        Raises:
            InputError: a point is outside, or the rows make no complete grid.
        """
        asked = np.broadcast_arrays(*(np.asarray(v, dtype=float) for v in (temperature_C, strain, frequency)))
        inside = np.ones(asked[0].shape, dtype=bool)
        points, axes = [], []
        names = (("temperature", 1.0, "degC"), ("strain", 1e2, "%"), ("frequency", 1.0, "Hz"))
        slack = (SAME_TEMPERATURE, 0.0, 0.0)
        for values, levels, (name, scale, unit), near in zip(asked, self.levels, names, slack, strict=True):
            margin = _ROUNDING * levels[-1] if levels.size > 1 else max(near, SAME_LEVEL * abs(float(levels[0])))
            good = (values >= levels[0] - margin) & (values <= levels[-1] + margin)
            if outside == "refuse" and not good.all():
                low, high = scale * levels[0], scale * levels[-1]
                reach = f"{low:.4g} {unit} only" if low == high else f"{low:.4g} to {high:.4g} {unit}"
                raise InputError(
                    f"{self.source}: {name} {scale * float(values[~good].flat[0]):.4g} {unit} is outside the table, "
                    f"which has {reach} [E-PROPS-03]"
                )
            inside = inside & good
            if levels.size > 1:
                clipped = np.clip(values, levels[0], levels[-1])
                points.append(np.log(clipped) if name == "frequency" else clipped)
                axes.append(np.log(levels) if name == "frequency" else levels)
        single = tuple(i + 1 for i, levels in enumerate(self.levels) if levels.size == 1)
        grid = np.moveaxis(np.squeeze(self._grid, axis=single), 0, -1)
        found = np.broadcast_to(_multilinear(axes, grid, points), (*asked[0].shape, 3))
        return Interpolated(found[..., 0], found[..., 1], found[..., 2], inside)


def _multilinear(axes: Sequence[np.ndarray], grid: np.ndarray, points: Sequence[np.ndarray]) -> np.ndarray:
    """Interpolate linearly along each axis of a grid; scipy's interpolator takes long to load.

    Args:
        axes: rising coordinates of the grid, of each axis (n_i,), two at least.
        grid: values (n_1, n_2, ..., k).
        points: coordinates along each axis, of one shape, within the grid.

    Returns:
        Values of the shape of the points and (k,).
    """
    corners = []
    for axis, values in zip(axes, points, strict=True):
        left = np.clip(np.searchsorted(axis, values, side="right") - 1, 0, axis.size - 2)
        share = (values - axis[left]) / (axis[left + 1] - axis[left])
        corners.append(((left, 1.0 - share), (left + 1, share)))
    found = np.zeros(grid.shape[-1])
    for corner in itertools.product(*corners):
        weight = math.prod(share for _, share in corner)
        found = found + grid[tuple(index for index, _ in corner)] * np.asarray(weight)[..., None]
    return found


def usable(found: Mapping[str, Properties]) -> tuple[list[Properties], list[str]]:
    """Return the rows that can stand in a table, and notes on those that cannot.

    Dampers that store or dissipate nothing make such rows.

    Args:
        found: properties by name of the test.

    Returns:
        The rows; the notes, a sentence each.
    """
    rows, notes = [], []
    for name, row in found.items():
        # stiffness or loss below rounding is none
        if row.G_storage > _ROUNDING * row.G_eq > 0.0 and _ROUNDING < row.loss_factor < 1.0 / _ROUNDING:
            rows.append(row)
            continue
        hint = "; is the sign of force or displacement reversed?" if row.G_storage < -0.5 * row.G_eq else ""
        notes.append(
            f"{name}: left out of the table of properties, where all are above zero: G' = {1e-6 * row.G_storage:.4g} "
            f"MPa, n = {row.loss_factor:.4g}{hint}"
        )
    return rows, notes


def from_properties(rows: Sequence[Properties], source: str = "property table") -> PropertyTable:
    """Return the table of properties of several tests.

    Args:
        source: of the rows, for messages.
    """
    columns = {name: np.array([getattr(row, name) for row in rows]) for name, _ in COLUMNS.values()}
    return PropertyTable(**columns, source=source)


def property_table_content(project: AnalysisFile, path: Path) -> bytes:
    """Return the content of a table that a study of a project names, as a run sees it."""
    return project.content(path, lambda path: read_file(path, _WHAT))


def read_property_table(path: Path | str, content: bytes | None = None) -> PropertyTable:
    """Read a table from CSV with the columns of `COLUMNS`, in any order.

    Args:
        content: of the file, if it has been read.

    Raises:
        InputError: the file cannot be read, a column is unknown, missing or twice there, or a value is not positive.
    """
    path = Path(path)
    table = read_table(path, _WHAT, _EXAMPLE, content=content)
    columns = {}
    for i, header in enumerate(table.headers):
        if header not in COLUMNS:
            hint = did_you_mean(header, COLUMNS)
            if header.lower().startswith(("time", "displacement", "force")):
                hint = "; this is the file of a test, not a table of properties: name it in a campaign file"
            raise InputError(
                f"{table.where(i)}: the column is unknown{hint} (allowed: {', '.join(COLUMNS)}) [E-PROPS-04]"
            )
        name, factor = COLUMNS[header]
        if name in columns:
            raise InputError(f"{table.where(i)}: the column comes twice [E-PROPS-04]")
        values = table.rows[:, i]
        wrong = np.flatnonzero(values <= 0.0) if name != "temperature_C" else np.array([], dtype=int)
        if wrong.size:
            raise InputError(
                f"{table.where(i, int(wrong[0]))}: {values[wrong[0]]:g} is not greater than zero [E-PROPS-01]"
            )
        columns[name] = values / factor
    for header, (name, _) in COLUMNS.items():
        if name not in columns:
            raise InputError(f"{table.where()}: the column `{header}` is missing [E-PROPS-04]")
    return PropertyTable(**columns, source=str(path))


def write_property_table(table: PropertyTable, path: Path | str) -> None:
    """Write a table as CSV with the columns of `COLUMNS`, seven digits; the file appears when it is whole.

    Args:
        path: of the CSV file.

    Raises:
        ArchiveError: it cannot be written.
    """
    columns = [(getattr(table, name) * factor).tolist() for name, factor in COLUMNS.values()]
    write_csv_file(list(COLUMNS), zip(*columns, strict=True), Path(path), digits=7)


def _grouped(values: np.ndarray, absolute: float, relative: float) -> tuple[np.ndarray, np.ndarray]:
    """Levels (ascending means of groups of near values), and the level of each value."""
    order = np.argsort(values, kind="stable")
    index = np.empty(values.size, dtype=int)
    groups: list[list[float]] = []
    for i in order:
        value = float(values[i])
        if not groups or value - groups[-1][0] > absolute + relative * abs(groups[-1][0]):
            groups.append([])
        groups[-1].append(value)
        index[i] = len(groups) - 1
    # the mean of equal values must be that value, to the last bit
    return np.array([group[0] if group[0] == group[-1] else float(np.mean(group)) for group in groups]), index
