"""Small files of the formats of networks, made here by their documentation around a motion known in closed form."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from strong_motion_samples import fixed


def peak_of(values: np.ndarray) -> float:
    """The value of largest size, with its sign."""
    return float(values[np.argmax(np.abs(values))])


def smc_file(
    values: np.ndarray,
    kind: str = "2 CORRECTED ACCELEROGRAM",
    rate: float | None = 200.0,
    count: int | None = None,
    largest: float | None = None,
    times: np.ndarray | None = None,
    bearing: int | None = 360,
) -> str:
    """An SMC file of values in cm/s2: 11 lines of text, 48 integers, 50 reals, two comments, samples (8E10.4).

    Without a rate the samples are pairs of `times` and values.
    """
    null, unknown = -32768, 1.7e38
    numbers = values if rate is not None else np.column_stack((times, values)).ravel()
    integers, reals = np.full(48, null), np.full(50, unknown)
    integers[12] = 90 if bearing is not None else 0
    integers[13] = null if bearing is None else bearing
    integers[15], integers[16] = 2, numbers.size if count is None else count
    reals[1] = unknown if rate is None else rate
    reals[28:32] = (1.0, values.max() if largest is None else largest, 2.0, values.min())
    return (
        f"{kind}\n*\nXXX\n     1989  10  18    0004 Nowhere, CA\nMoment Mag=      6.9 Ms=      7.1 Ml=      7.0\n"
        "station = Some Street 1                  component=    360\nepicentral dist =     89.0       pk     =\n"
        "inst type=SMA-1      data source = none\n*\n*\n*\n"
        + "".join("".join(f"{v:10d}" for v in integers[k : k + 8]) + "\n" for k in range(0, 48, 8))
        + "".join("".join(f"{v:15.7E}" for v in reals[k : k + 5]) + "\n" for k in range(0, 50, 5))
        + "|\n|no real record\n"
        + _short_exponents(numbers)
    )


def _short_exponents(numbers: np.ndarray, digits: int = 4, width: int = 10) -> str:
    """Lines of eight numbers with an exponent of one digit, so that neighbours touch: ` 1.5057E+0-2.2223E+0`."""
    words = []
    for value in numbers:
        mantissa, exponent = f"{value:.{digits}E}".split("E")
        words.append(f"{mantissa}E{int(exponent):+d}".rjust(width))
    return "".join("".join(words[k : k + 8]) + "\n" for k in range(0, len(words), 8))


def geonet_component(
    values: np.ndarray, name: str = "N10E", bearing: int = 10, corrected: bool = True, peak: float | None = None
) -> str:
    """A component of a GeoNet file of values in mm/s2: text, 40 integers, 60 reals, samples, velocities and so on."""
    word = "Corrected" if corrected else "Uncorrected"
    taken = (
        "Instrument corrected data at 0.020 sec intervals"
        if corrected
        else ("Raw readings in units of 1.00 mm/s/s  at intervals of 0.020 s")
    )
    integers, reals = np.zeros(40), np.zeros(60)
    integers[27], integers[30] = bearing, values.size
    integers[33] = values.size
    integers[34:36] = values.size if corrected else 0
    reals[24], reals[25] = 0.005, 0.02
    peak = peak_of(values) if peak is None else peak
    return (
        f"{word} accelerogram 20180212_211554_XXXX_20 GNS Science\n"
        "Site XXXX      39 56 38S  176 35 04E     Basalt file:  20180212_211557_XXXX\nSome Council\n"
        "Instrument Basalt_1\nResolution: 24-bit   Instr Period: 0.0050 s   Damping: 0.700\n"
        "Accelerogram 20180212_211554_XXXX_20                 Processed 2018 February 21\n6 km south of Nowhere\n"
        "2018 February 12         21:15:54 UT\n"
        "Epicentre  40 03 27S 176 32 45E  Bearing S15W  Dist   13km  Depth    9km M  4.17\n"
        f"Number of points  {values.size}    Duration 0.40 sec\n{taken}\nFilter\nComponent {name}\n"
        f"Acceleration:  peak {peak:9.1f} mm/s/s at   0.02 sec     rms      2.2 mm/s/s\n"
        "Velocity:      peak     1.65 mm/s   at  43.56 sec     rms     0.09 mm/s\nDisplacement\n"
        + "".join("".join(f"{int(v):8d}" for v in integers[k : k + 10]) + "\n" for k in range(0, 40, 10))
        + fixed(reals, 10, 8, 3)
        + fixed(values, 10, 8, 1)
        + (fixed(values / 10.0, 10, 8, 2) * 2 if corrected else "")
    )


def volume_one_channel(
    values: np.ndarray,
    number: int = 1,
    orientation: str = "EW",
    times: np.ndarray | None = None,
    peak: float | None = None,
    count: int | None = None,
) -> str:
    """A channel of volume 1 as RENADIC and CSMIP write it: values in g/10 behind their times (10F7.3)."""
    times = 0.005 * np.arange(values.size) if times is None else times
    peak = 0.1 * peak_of(values) if peak is None else peak
    return (
        "UNCORRECTED ACCELEROGRAM DATA              PROCESSED: 06/30/2011\nNOWHERE 2010\n"
        "02/27/2010 2:45:26 (GMT)\nX\nSTATION NO.          0.000N    0.000E  SMA-1     S/N  456\nSOMEWHERE\n"
        f"CHAN {number:2d}: {orientation}        (STA CHN:  {number})\nUNIVERSIDAD DE CHILE - RENADIC\n"
        "HYPOCENTER:   0.000N    0.000E  H=   0.0KM   ML= 0.00\n"
        "INSTR PERIOD = 0.0400 SEC,  DAMPING =0.6000,  SENSITIVITY =1.000 VDC/G\n"
        f"NO. OF POINTS =  {values.size if count is None else count:5d}  RECORD LENGTH ={times[-1]:7.3f} SEC\n"
        f"UNITS OF UNCOR ACCEL ARE SEC AND G/10.     MAX  = {peak:6.3f} G, AT  11.895 SEC\n"
        "RMS ACCEL OF COMPLETE RECORD = 0.021 G\n"
        + "    0    0\n" * 7
        + "     0.000     0.000\n" * 7
        + fixed(np.column_stack((times, values)).ravel(), 10, 7, 3)
        + f"/&  ----------  END OF DATA FOR CHANNEL {number}  ----------\n"
    )


def bhrc_component(values: np.ndarray, name: str = "L1") -> str:
    """A component of a BHRC volume 1 file: values in g/10 at 200 a second (10E13.6, no zero before the point)."""
    words = [_pointed(value).rjust(13) for value in values]
    return (
        "* VOL1DS FILE:  5520/01\nInst Type = SSA-2\nOrigin Time : 2012/08/11   12:23:16\n\nL\n\n"
        f"COMP {name}\nNowhere                   Station   38.474 N 47.059 E   Altitude 1360m   Azimuth L 352   T 82\n"
        "Epicenter 38.520 N 46.860 E   FD 12 Km mb      Ms      Mw6.1   M        ML   (BHRC   )\n"
        f"INSTR PERIOD =  .019 SEC   DAMPING =  .640\nNO. OF POINTS =  {values.size:5d}      "
        f"DURATION = {0.005 * values.size:7.3f}\nUNITS ARE SECONDS AND G/10\n\n"
        + "    0    0\n" * 7
        + "  .000000E+00  .00\n" * 7
        + "".join("".join(words[k : k + 10]) + "\n" for k in range(0, len(words), 10))
        + "/&\n"
    )


def _pointed(value: float) -> str:
    """Six digits behind the point, none before it: .854257E-03."""
    exponent = int(np.floor(np.log10(abs(value)))) + 1 if value else 0
    return f"{value / 10.0**exponent:.6f}".replace("0.", ".", 1) + f"E{exponent:+03d}"


def csmip_volume_one(values: np.ndarray, peak: float | None = None) -> str:
    """A CSMIP volume 1 file of values in g at 200 a second (8F9.6)."""
    peak = peak_of(values) if peak is None else peak
    return (
        "Uncorrected Accelerogram Data             Processed: 02/13/12, CGS  146be002\nRecord of Mon Feb 13, 2012\n"
        "X\nX\nStation No. 00000   40.941N, 123.633W      Etna  s/n 2500\nSome Creek                CGS\n"
        "Chan  1: 360 Deg\nRecord of Mon Feb 13, 2012 13:06:45.0 PST\nHypocenter\nInstr Period\n"
        f"No. of Points =  {values.size}  Record Length = 0.100 sec   at 200 Samples/sec\n"
        f"Units of uncor data are sec and g .        Max  = {peak:6.3f} g , at  30.590 sec.\nRMS\n"
        + "    1  100\n" * 7
        + "  .0108814  .6700000\n" * 7
        + f"{values.size:6d} Accelerogram points at 200 pts/sec in units of g .      Format: (8f9.6)\n"
        + fixed(values, 8, 9, 6)
        + "/&  ----------  End of Data for Channel  1  ----------\n"
    )


def cwb_file(columns: Sequence[np.ndarray], peaks: Sequence[tuple[float, float]] | None = None, rate: int = 50) -> str:
    """A file of Taiwan's Central Weather Bureau, columns U, N and E in gal (4F10.3)."""
    peaks = [(float(c.max()), float(c.min())) for c in columns] if peaks is None else peaks
    times = np.arange(columns[0].size) / rate
    return (
        "#Earthquake Information\n#Origin Time(GMT+08): 2018/02/06-23:50:42\n#Magnitude(Ml): 6.0\n\n"
        "#Station Information\n#StationCode: XXX\n#StationName: Nowhere\n#StartTime(GMT+08): 2018/02/06-23:50:29.000\n"
        f"#RecordLength(sec): {columns[0].size / rate:g}\n#SampleRate(Hz): {rate}\n"
        "#AmplitudeUnit:  gal. DCoffset(corr)\n"
        + "".join(
            f"#AmplitudeMAX. {name}: {high:8.3f}~ {low:8.3f}\n" for name, (high, low) in zip("UNE", peaks, strict=True)
        )
        + "#DataSequence: Time U(+); N(+); E(+)\n#Data: 4F10.3\n"
        + fixed(np.column_stack((times, *columns)).ravel(), 4, 10, 3)
    )


def asa_file(columns: Sequence[np.ndarray], peaks: Sequence[float] | None = None, unit: str = "Gal (cm/s/s)") -> str:
    """A Mexican standard acceleration file (ASA 2.0) of three channels, V, N00E and N90E, in gal (3F10.4)."""
    peaks = [peak_of(c) for c in columns] if peaks is None else peaks
    count, stated = columns[0].size, "/".join(f"{peak:.4f}" for peak in peaks)
    ruler = "---------+" * 8 + "\n"
    return (
        "*" * 86 + "\n                       INSTITUTO DE INGENIERIA, UNAM\n" + "*" * 86 + "\n"
        "ARCHIVO ESTANDAR DE ACELERACION:\nVERSION DEL FORMATO                    : 2.0\n\n\n" + "=" * 80 + "\n"
        "DATOS DE LA ESTACION:\nNOMBRE DE LA ESTACION                  : EN NINGUNA PARTE\n"
        "CLAVE DE LA ESTACION                   : XXXX\nNUMERO DE CANALES                      : 3\n"
        "ORIENTACION C1-C6 (rumbo;orientacion)  : /V/N00E/N90E\nORIENTACION C7-C12 (rumbo;orientacion) :\n"
        "INTERVALO DE MUESTREO, C1-C6 (s)       : /0.005/0.005/0.005\nINTERVALO DE MUESTREO, C7-C12 (s)      :\n"
        "FECHA DEL SISMO [GMT]                  : 2017/09/19\nHORA EPICENTRO (GMT)                   : 18:14:40\n"
        "MAGNITUD(ES)                           : /M=7.1\n"
        f"NUM. TOTAL DE MUESTRAS, C1-C6          : /{count}/{count}/{count}\nNUM. TOTAL DE MUESTRAS, C7-C12         :\n"
        f"ACEL. MAX.(Gal), C1-C6                 : /{stated}\nACEL. MAX.(Gal), C7-C12                :\n"
        f"UNIDADES DE LOS DATOS                  : {unit}\nFACTOR DE DECIMACION                   : 1\n"
        "FORMATO DATOS (FORTRAN,10 campos/dato) : 3F10.4\nCOMENTARIOS:\n\n\nDATOS DE ACELERACION:\n"
        + ruler
        + "   CANAL-1   CANAL-2   CANAL-3\n         V      N00E      N90E\n"
        + ruler
        + fixed(np.column_stack(columns).ravel(), 3, 10, 4)
    )


def csmnc_file(values: np.ndarray, peak: float | None = None, quantity: str = "UNCORRECTED ACCELERATION") -> str:
    """A file of the China Strong Motion Network Centre: values in cm/s2, eight a line."""
    peak = peak_of(values) if peak is None else peak
    words = _short_exponents(values, 6, 13)
    return (
        "051XXX130420080201\n0130420080246 2013-04-20 8:2:46 BTM\nNOWHERE EARTHQUAKE, NOWHERE,CHN\n"
        "EPICENTER  30.300N 103.000E DEPTH 13 KM\nMAGNITUDE  7.0(Ms)\nSTATION: 51XXX 30.400N 102.800E\n"
        "SITE CONDITION: ROCK\nINSTRUMENT TYPE: MR2002/SLJ-100\nOBSERVING POINT: GROUND\nCOMP. EW\n"
        f"{quantity}          UNIT: CM/SEC/SEC\n"
        f"NO. OF POINTS:  {values.size}  EQUALLY SPACED INTERVALS OF:  0.005  SEC\n"
        f"PEAK VALUE:    {peak:.3f}   AT   26.35 SEC    DURATION:  60 SEC\nPRE-EVENT TIME:  20  SEC\nCSMNC\n\n" + words
    )


def jma_file(columns: Sequence[np.ndarray], unit: str = "gal(cm/s/s)") -> str:
    """A table of the Japan Meteorological Agency, columns NS, EW and UD, with the empty cells at the end of lines."""
    rows = "".join(",".join(f"{value:.3f}" for value in row) + ",,,,,\n" for row in np.column_stack(columns))
    return (
        "SITE CODE= 999Nowhere,35.0,139.0,10.0,5.0\n LAT.=   35.0000,,,,,,,\n LON.=  139.0000,,,,,,,\n"
        f" SAMPLING RATE= 100Hz,,,,,,,\n UNIT  = {unit},,,,,,,\nINITIAL TIME = 2024 01 01 16 10 00,,,,,,,\n"
        " NS,EW,UD,,,,,\n" + rows
    )


def isesd_file(values: np.ndarray, block: str = "corrected acceleration", count: int | None = None) -> str:
    """A file of the European strong-motion database: accelerations in m/s2, six a line, then velocities."""
    words = "".join(f"{value:12.5E}" + "\n" * (k % 6 == 5) for k, value in enumerate(values)).rstrip("\n")
    return (
        "file:                         002727xa.cor\nearthquake code:                 990\n"
        "station code:                    694\nwaveform code:                  2727\ntotal number of channels:     3\n"
        "orientation of transducer:    NS\ninstrument type:              SMACH SM2\n"
        "time of first sample:         31.12.1999 04:55:53.671UTC\nsampling period:               0.010000s\n"
        f"number of samples:             {values.size if count is None else count}\n"
        "units:                        m/s*s, m/s & s\nreference:\nNobody (2000): no real record.\n"
        f"comments & processing history:\n%- processed\n-> {block} time histories\n{words}\n"
        f"-> corrected velocity time histories\n{words}\nSTOP\n"
    )
