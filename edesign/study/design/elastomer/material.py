"""Properties of the elastomer at the strain, frequency and temperature of a design."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from functools import partial
from pathlib import Path

from edesign.damper.harmonic import complex_stiffness
from edesign.damper.temperature import REFERENCE_C
from edesign.damper.testing.property_table import PropertyTable, property_table_content, read_property_table
from edesign.damper.thesis_tables import measured
from edesign.errors import InputError
from edesign.frame.devices import DeviceLaw
from edesign.project.analysis_file import AnalysisFile
from edesign.project.dampers.designs import ElastomerDesign, FileProperties, FixedProperties
from edesign.project.reading.file_bytes import is_file
from edesign.study.design.building import law_at


@dataclass(frozen=True)
class Moduli:
    """Storage modulus (Pa) and loss factor of an elastomer at one frequency, with the warnings about them."""

    G_storage: float
    loss_factor: float
    warnings: tuple[str, ...] = ()


_NOTHING = 1e-9  # of the stiffness: rounding of a law that stores or dissipates nothing

Elastomer = Callable[[float], Moduli]
"""Properties at a frequency in Hz, for one strain and temperature."""
Material = Callable[[float], Elastomer]
"""The elastomer at a strain, for one temperature."""


def material(
    project: AnalysisFile, name: str, spec: ElastomerDesign, folder: Path, temperature_C: float | None
) -> Material:
    """Return the elastomer of a design at a temperature as a function of strain and frequency.

    Two frequencies of the design stand for the mean of the properties at both; one is taken whatever the frequency.

    Args:
        project: with the law.
        name: of the design, for messages.
        folder: that property files are relative to.
        temperature_C: degC; None: that of the law or of the reference.

    Returns:
        The function that gives the properties at a strain, as a function of the frequency in Hz.

    Raises:
        InputError: the table cannot be read, or the law has no parameters at this temperature.
    """
    at = _at(project, name, spec, folder, temperature_C)
    given = spec.frequency
    if given is None:
        return lambda strain: partial(at, strain)
    frequencies = given if isinstance(given, tuple) else (given,)

    def mean_at(strain: float) -> Elastomer:
        ends = [at(strain, frequency) for frequency in frequencies]
        mean = Moduli(
            sum(m.G_storage for m in ends) / len(ends),
            sum(m.loss_factor for m in ends) / len(ends),
            tuple(dict.fromkeys(warning for m in ends for warning in m.warnings)),
        )
        return lambda frequency: mean

    return mean_at


def _at(
    project: AnalysisFile, name: str, spec: ElastomerDesign, folder: Path, temperature_C: float | None
) -> Callable[[float, float], Moduli]:
    """Properties at a strain and a frequency in Hz."""
    chosen = spec.properties
    if isinstance(chosen, FixedProperties):
        fixed = Moduli(chosen.G_storage, chosen.loss_factor)
        return lambda strain, frequency: fixed
    if chosen == "law":
        return partial(law_moduli, law_at(project, spec.law, temperature_C))
    if isinstance(chosen, FileProperties):
        path = folder / chosen.file
        if not is_file(path):
            raise InputError(f"designs.{name}.properties.file: there is no file `{path}` [E-FILE-01]")
        table = read_property_table(path, property_table_content(project, path))
    else:
        rows = measured()
        columns = (rows.temperature_C, rows.strain, rows.frequency, rows.G_storage, rows.G_eq, rows.loss_factor)
        table = PropertyTable(*columns, source="thesis Tables A.1-A.4")
    temperature = REFERENCE_C if temperature_C is None else temperature_C
    return lambda strain, frequency: _of_table(table, strain, frequency, temperature)


def law_moduli(law: DeviceLaw, strain: float, frequency: float) -> Moduli:
    """Return the moduli of a law in steady vibration of its prototype, by the first harmonic of its force.

    Args:
        law: the law with the layers of its prototype.
        strain: amplitude of the shear strain.
        frequency: Hz.

    Raises:
        InputError: the law stores or dissipates nothing.

    Source: thesis Eqs. 2.47-2.50.
    """
    assert law.layers is not None and law.layer_area is not None and law.layer_thickness is not None
    stiffness = complex_stiffness(law.law, strain * law.layer_thickness, frequency)
    if min(stiffness.real, stiffness.imag) <= _NOTHING * abs(stiffness):
        raise InputError(
            f"law {law.law.law} at {100.0 * strain:.4g} % strain and {frequency:.4g} Hz has K' = {stiffness.real:.4g} "
            f"N/m and K'' = {stiffness.imag:.4g} N/m; dampers that are sized here store and dissipate energy"
            " [E-DESIGN-03]"
        )
    modulus = stiffness.real * law.layer_thickness / (law.layers * law.layer_area)
    return Moduli(modulus, stiffness.imag / stiffness.real)


def _of_table(table: PropertyTable, strain: float, frequency: float, temperature_C: float) -> Moduli:
    found = table.interpolate(strain, frequency, temperature_C, outside="edge")
    warnings: tuple[str, ...] = ()
    if not bool(found.inside):
        warnings = (
            f"{100.0 * strain:.4g} % strain, {frequency:.4g} Hz, {temperature_C:.4g} degC is outside {table.source}; "
            "the values at its edge are taken",
        )
    return Moduli(float(found.G_storage), float(found.loss_factor), warnings)
