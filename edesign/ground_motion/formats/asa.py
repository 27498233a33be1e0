"""Reader of Mexico's standard acceleration file (ASA 2.0) of UNAM, CIRES and the national base: channels in gal.

Source: Sociedad Mexicana de Ingenieria Sismica, Base Mexicana de Datos de Sismos Fuertes, `Archivo Estandar de
Aceleracion`: lines `KEY : VALUE`, the values of channels divided by `/`, then one column for each channel.
"""

from __future__ import annotations

import re
from pathlib import Path

import numpy as np

from edesign.errors import InputError
from edesign.ground_motion.formats.channels import Channel, RecordFormat
from edesign.ground_motion.formats.fixed_width import read_rows
from edesign.ground_motion.formats.header_peak import check_peak
from edesign.ground_motion.formats.text import read_lines
from edesign.ground_motion.formats.time_steps import check_step
from edesign.project.reading.problems import listed
from edesign.tables.text import number

_TITLE = re.compile(r"\s*ARCHIVO\s+EST.NDAR\s+DE\s+ACELERACI.N", re.IGNORECASE)
_DATA = re.compile(r"\s*DATOS\s+DE\s+ACELERACI.N", re.IGNORECASE)
_KEY = re.compile(r"\s*([^:]+?)\s*:\s?(.*?)\s*$")
_ORIENTATION, _STEP, _COUNT = "ORIENTACION C1-C6", "INTERVALO DE MUESTREO, C1-C6", "NUM. TOTAL DE MUESTRAS, C1-C6"
_PEAK, _UNIT, _DECIMATION = "ACEL. MAX.(GAL), C1-C6", "UNIDADES DE LOS DATOS", "FACTOR DE DECIMACION"
_SECOND = ("C1-C6", "C7-C12")  # channels 7 to 12 have lines of their own
_RULER = re.compile(r"\s*-+\+?[-+]*\s*$")
_Header = dict[str, tuple[int, str]]


def has_title(lines: list[str]) -> bool:
    """Say whether lines have the title of such a file."""
    return any(_TITLE.match(line) for line in lines)


def channels_of(path: Path) -> list[Channel]:
    """Read all channels; step, number, orientation and peak of each come from the header.

    A channel is called by its orientation as in the file (`N00E`, `V`, `N90W`) or its number.

    Raises:
        InputError: a key is missing, another unit than gal, decimated data, not as many samples as the header says,
            something else than finite numbers, or peaks that are not those of the header.
    """
    lines = read_lines(path)
    data = next((i for i, line in enumerate(lines) if _DATA.match(line)), None)
    if data is None:
        raise InputError(f"{path}: no line `DATOS DE ACELERACION:` announces the samples [E-REC-03]")
    header: _Header = {}
    for i, line in enumerate(lines[:data], 1):
        if match := _KEY.match(line):
            header.setdefault(" ".join(match[1].upper().split()), (i, match[2]))
    at, unit = _value(path, header, _UNIT)
    if not re.match(r"(gal|cm/s)", unit, re.IGNORECASE):
        raise InputError(f"{path}:{at}: {_UNIT}: `{unit}`; Gal (cm/s/s) is expected [E-REC-10]")
    decimation = next((value for key, (_, value) in header.items() if key.startswith(_DECIMATION)), "")
    if decimation not in ("", "1", "1.0", "0"):
        raise InputError(
            f"{path}: {_DECIMATION} is {decimation}; it would change the interval, so it is not read [E-REC-09]"
        )
    labels, steps = _channels(path, header, _ORIENTATION), _channels(path, header, _STEP)
    counts, peaks = _channels(path, header, _COUNT), _channels(path, header, _PEAK, needed=False)
    rulers = [i for i, line in enumerate(lines[data + 1 : data + 9], data + 1) if _RULER.match(line) and "-" in line]
    first = (rulers[-1] if rulers else data + 4) + 1
    each = f"one of each of the {len(labels)} channels"
    rows, places = read_rows(enumerate(lines[first:], first + 1), len(labels), path, each, len(lines))
    digit = min(places)
    if min(len(steps), len(counts)) < len(labels):
        raise InputError(f"{path}: the header has the interval or the number of samples of too few channels [E-REC-03]")
    at, _ = _value(path, header, _STEP)
    intervals = [number(text, path, at, "the interval of the samples in s") for text in steps]
    for interval in intervals:
        check_step(f"{path}:{at}", interval)
    at, _ = _value(path, header, _COUNT)
    totals = [int(number(text, path, at, "the number of samples")) for text in counts[: len(labels)]]
    # published files may repeat the last sample beyond the number
    if len(rows) < max(totals) or min(totals) < 2 or np.any(rows[max(totals) :] != rows[max(totals) - 1]):
        raise InputError(
            f"{path}:{len(lines)}: {len(rows)} lines of samples, but {listed(counts)} in line {at} [E-REC-05]"
        )
    about = _about(header)
    channels = []
    for k, label in enumerate(labels):
        values = rows[: totals[k], k]
        if k < len(peaks) and peaks[k]:
            at, _ = _value(path, header, _PEAK)
            check_peak(f"{path}:{at}", peaks[k], float(np.abs(values).max()), f"gal for {label}", digit)
        names = (str(k + 1), f"CANAL-{k + 1}")
        channels.append(Channel(label, names, (0.01 * values).tolist(), intervals[k], about))
    return channels


def _value(path: Path, header: _Header, key: str) -> tuple[int, str]:
    found = next((value for name, value in header.items() if name.startswith(key)), None)
    if found is None:
        raise InputError(
            f"{path}:{len(header) or 1}: the header has no line `{key}` (it has {listed(header, 4)}) [E-REC-03]"
        )
    return found


def _channels(path: Path, header: _Header, key: str, *, needed: bool = True) -> list[str]:
    """The values of all channels of a key; those of channels 7 to 12 stand in a second line."""
    values: list[str] = []
    for part in _SECOND:
        name = key.replace(_SECOND[0], part)
        stated = next((value for known, (_, value) in header.items() if known.startswith(name)), "")
        # files begin each value with `/`; some end with one too
        words = [word.strip() for word in stated.strip("/").split("/")] if stated.strip(" /") else []
        values += words
    if needed and not values:
        raise InputError(f"{path}:{_value(path, header, key)[0]}: `{key}` has no value [E-REC-03]")
    return values


def _about(header: _Header) -> str:
    def said(key: str) -> str:
        return next((value for name, (_, value) in header.items() if name.startswith(key)), "").strip(" /")

    station = " ".join(part for part in (said("CLAVE DE LA ESTACION"), said("NOMBRE DE LA ESTACION")) if part)
    event = " ".join(part for part in (said("FECHA DEL SISMO"), said("HORA EPICENTRO")) if part)
    parts = ("ASA (Mexico), unprocessed", event, said("MAGNITUD").replace("/", " "), station)
    return ", ".join(part for part in parts if part)


FORMAT = RecordFormat("ASA (Mexico) standard file", has_title, channels_of, keeps_suffix=True)
