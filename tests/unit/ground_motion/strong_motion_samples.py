"""Complete small files of strong-motion formats, composed here around a motion known in closed form."""

from __future__ import annotations

import re
from collections.abc import Sequence

import numpy as np


def motion(count: int = 20, amplitude: float = 123.456) -> np.ndarray:
    """A damped sine, without unit: amplitude exp(-t/5) sin(t) at t = 0, 1, 2, ..."""
    t = np.arange(count)
    return amplitude * np.exp(-t / 5.0) * np.sin(t)


def fixed(values: Sequence[float] | np.ndarray, fields: int, width: int, decimals: int) -> str:
    """Lines of a Fortran format (fields F width.decimals); with no decimals, of integers."""
    words = [f"{value:{width}.{decimals}f}" for value in values]
    assert all(len(word) == width for word in words)
    return "".join("".join(words[k : k + fields]) + "\n" for k in range(0, len(words), fields))


def cosmos_channel(
    values: np.ndarray,
    number: int = 1,
    orientation: str = "340 deg",
    step_ms: float = 5.0,
    seconds: float | None = None,
    quantity: str = "acceleration",
    unit: str = "cm/sec2(04)",
    layout: tuple[int, int, int] = (8, 10, 3),
    count: int | None = None,
) -> str:
    """One channel of a COSMOS v1.20 file: 13 lines of text, integer and real header, comments, data, end."""
    fields, width, decimals = layout
    count = values.size if count is None else count
    seconds = count * step_ms / 1000.0 if seconds is None else seconds
    real = np.full(100, -999.0)
    real[33] = 0.02  # s, of the recorder: not that of these data
    real[61] = step_ms
    whole = np.full(100, -999)
    return (
        "Corrected acceleration    (Format v01.20 with 13 text lines) Src: none\n"
        "Record of Nowhere Earthquake of Fri Nov 30, 2018 17:29 UTC\n"
        "Hypocenter: 61.3464 -149.9552 H= 46km Mw=7.0, ML=6.8(XX)\n"
        "Origin: 2018/11/30 17:29:29    UTC\n"
        "Statn No: 01-23075  Code:CE-J2236  CDMG Yucaipa - Bryant & Oak Glen\n"
        "Coords: 34.0460 -117.0350  Site Geology:\n"
        "Recorder: SSA-2  s/n 1238 ( 1 Chns of 12  at Sta) Sensor:FBA-11  s/n 1889\n"
        "Rcrd start time:06/16/2005, 20:53:04.400 UTC (Q=2) RcrdId: 23075-L1889-05167.06\n"
        f"Sta Chan {number:3d}: {orientation} (Rcrdr Chan  1) Location: base\n"
        "Raw record length = 70.000  sec, Uncor max =   -.167 g  at   27.850 sec\n"
        "Processed: 06/17/2005, 12:01:00 PDT      Max =  -161.962 cm/sec2  at  27.850 sec\n"
        "Record filtered below 0.30  Hz (periods over  14.5 secs), and above 40.0 Hz\n"
        "Values used when parameter or data value is unknown/unspecified:   -999, -999.0\n"
        " 100 Integer-header values follow on  10 lines, Format= (10I8)\n"
        + fixed(whole, 10, 8, 0)
        + " 100 Real-header values follow on  17 lines, Format= (6F13.6)\n"
        + fixed(real, 6, 13, 6)
        + '   2 Comment line(s) follow, each starting with a "|":\n'
        + f"| no real record\n|<SCNL>J2236.HN{number}.CE.--    <AUTH> 2019/02/01\n"
        + f"{count:7d} {quantity} pts, approx {seconds:4.0f} secs, units={unit},Format=({fields}F{width}.{decimals})\n"
        + fixed(values, fields, width, decimals)
        + f"End-of-data for Chan {number:2d} {quantity}\n"
    )


def csmip_channel(values: np.ndarray, number: int = 1, orientation: str = "360 Deg", step: str = ".005") -> str:
    """One channel of a CSMIP volume 2 file: acceleration, velocity and displacement of equal length."""
    announced = f"{values.size:6d} points of {{}} data equally spaced at  {step} sec, in {{}} (8f10.6)    \n"
    texts = [f"Corrected accelerogram   00001-X0001-00001.01       Chan  {number}: {orientation}     from   "]
    texts += ["Uncorrected Accelerogram Data             Processed: 02/13/12, CGS", "", "", "", ""]
    texts += ["Nowhere                                   CGS", f"Chan  {number}: {orientation}"]
    texts += ["Nowhere Earthquake", "Hypocenter: somewhere   H= 9km   ML: 5.6"]
    block = fixed(values, 8, 10, 6)
    return (
        "\n".join(texts)
        + "\n"
        + announced.format("accel", "cm/sec2.")
        + block
        + announced.format("veloc", "cm/sec. ")
        + block
        + announced.format("displ", "cm.     ")
        + block
        + f"/&  ----------  End of data for channel {number:2d}  ----------\n"
    )


def csmip_channel_of_1983(
    values: np.ndarray, number: int = 1, orientation: str = "90 DEG", unit: str = "CM/SEC/SEC"
) -> str:
    """One channel of a CSMIP volume 2 file as in 1983: no format of the numbers is announced."""
    announced = f"{values.size:5d} POINTS OF {{}} DATA EQUALLY SPACED AT  .020 SEC.  (UNITS: {{}})\n"
    texts = [f"CORRECTED ACCELEROGRAM   00001-S0001-83001.01       CHAN  {number}: {orientation}     FROM"]
    texts += ["UNCORRECTED ACCELEROGRAM DATA              PROCESSED:  6/06/83, CDMG", "NOWHERE EARTHQUAKE"]
    texts += ["MAY 2, 1983 16:42 PDT", "00001-S0001-83001.01", "STATION NO. 00001", "NOWHERE FAULT ZONE 14"]
    texts += [f"CHAN  {number}: {orientation}", "NOWHERE EARTHQUAKE     MAY 2, 1983 16:42 PDT"]
    texts += ["HYPOCENTER(BRK): 36.25N,120.28W, H=9KM. PRELIMINARY SOLUTION.  ML=6.5(BRK)"]
    block = fixed(values, 8, 10, 3)
    return (
        "\n".join(texts)
        + "\n"
        + announced.format("ACCEL", unit)
        + block
        + announced.format("VELOC", "CM/SEC")
        + block
        + announced.format("DISPL", "CM")
        + block
        + f"/&  ----------  END OF DATA FOR CHANNEL {number:2d}  ----------\n"
    )


def afad_file(values: np.ndarray, **changed: str | None) -> bytes:
    """A file of AFAD: N-S, E-W and U-D are 1, -2 and 0.5 times the values; keys by their first word."""
    columns = np.outer(values, [1.0, -2.0, 0.5])
    peaks = np.max(np.abs(columns), axis=0)
    header = {
        "PLACE": "AYDIN GERMENCIK".replace("I", "\u0131", 1),
        "EARTHQUAKE DATE": "2017/07/20 22:31:09 (GMT)",
        "EPICENTER COORDINATES": "36.91980N-27.44350E",
        "EARTHQUAKE DEPTH (km)": "19.44",
        "EARTHQUAKE MAGNITUDE": "6.5 Mw",
        "STATION ID": "0921",
        "RECORD TIME": "20/07/2017 22:30:58.000000 (GMT)",
        "NUMBER OF DATA": str(values.size),
        "SAMPLING INTERVAL (sec)": "0.01",
        "RAW PGA VALUES (gal)": f"(N-S) {peaks[0]:.6f} (E-W) {peaks[1]:.6f} (U-D) {peaks[2]:.6f}",
    }
    lines = ["STRONG GROUND MOTION RECORDS OF TURKIYE"]
    for key, value in header.items():
        new = changed.get(key.split()[0], value)
        if new is not None:
            lines.append(f"{key:<24}: {new}")
    lines += ["Copyright EARTHQUAKE DEPARTMENT", "DISASTER AND EMERGENCY MANAGEMENT PRESIDENCY"]
    lines += ["       N-S          E-W          U-D", *(f"{a:12.6f} {b:13.6f} {c:12.6f}" for a, b, c in columns)]
    return ("\r\n".join(lines) + "\r\n").encode("iso-8859-9")


def esm_file(values: np.ndarray, **changed: str | None) -> str:
    """A file of the Engineering Strong Motion database, 64 lines of header; `None` leaves a key out."""
    header = dict.fromkeys(
        (
            "EVENT_NAME EVENT_ID EVENT_DATE_YYYYMMDD EVENT_TIME_HHMMSS EVENT_LATITUDE_DEGREE EVENT_LONGITUDE_DEGREE "
            "EVENT_DEPTH_KM HYPOCENTER_REFERENCE MAGNITUDE_W MAGNITUDE_W_REFERENCE MAGNITUDE_L MAGNITUDE_L_REFERENCE "
            "FOCAL_MECHANISM NETWORK STATION_CODE STATION_NAME STATION_LATITUDE_DEGREE STATION_LONGITUDE_DEGREE "
            "STATION_ELEVATION_M LOCATION SENSOR_DEPTH_M VS30_M/S SITE_CLASSIFICATION_EC8 MORPHOLOGIC_CLASSIFICATION "
            "EPICENTRAL_DISTANCE_KM EARTHQUAKE_BACKAZIMUTH_DEGREE DATE_TIME_FIRST_SAMPLE_YYYYMMDD_HHMMSS "
            "DATE_TIME_FIRST_SAMPLE_PRECISION SAMPLING_INTERVAL_S NDATA DURATION_S STREAM UNITS INSTRUMENT "
            "INSTRUMENT_ANALOG/DIGITAL INSTRUMENTAL_FREQUENCY_HZ INSTRUMENTAL_DAMPING FULL_SCALE_G "
            "N_BIT_DIGITAL_CONVERTER PGA_CM/S^2 TIME_PGA_S BASELINE_CORRECTION FILTER_TYPE FILTER_ORDER "
            "LOW_CUT_FREQUENCY_HZ HIGH_CUT_FREQUENCY_HZ LATE/NORMAL_TRIGGERED DATABASE_VERSION HEADER_FORMAT DATA_TYPE "
            "PROCESSING DATA_TIMESTAMP_YYYYMMDD_HHMMSS DATA_LICENSE DATA_CITATION DATA_CREATOR "
            "ORIGINAL_DATA_MEDIATOR_CITATION ORIGINAL_DATA_MEDIATOR ORIGINAL_DATA_CREATOR_CITATION "
            "ORIGINAL_DATA_CREATOR USER1 USER2 USER3 USER4 USER5"
        ).split(),
        "",
    )
    assert len(header) == 64
    header |= {
        "EVENT_NAME": "NOWHERE",
        "EVENT_DATE_YYYYMMDD": "20161030",
        "MAGNITUDE_W": "6.5",
        "NETWORK": "IT",
        "STATION_CODE": "NRC",
        "STATION_NAME": "NORCIA",
        "SAMPLING_INTERVAL_S": "0.005000",
        "NDATA": str(values.size),
        "STREAM": "HGE",
        "UNITS": "cm/s^2",
        "DATA_TYPE": "ACCELERATION",
        "DATA_TIMESTAMP_YYYYMMDD_HHMMSS": "20161107_10:13:00",
        "DATA_CITATION": "Luzi L. et al., https://doi.org/10.13127/ESM.2",
    }
    kept = {**header, **changed}
    lines = [f"{key}: {value}" for key, value in kept.items() if value is not None]
    return "\n".join(lines + [f"{value:.6f}" for value in values]) + "\n"


def knet_file(counts: Sequence[int] | np.ndarray, **changed: str | None) -> str:
    """A K-NET file: 17 lines of header with values from column 19, counts eight a line; keys by their first word."""
    scale = re.match(r"([0-9.]+)\(gal\)/([0-9.]+)", changed.get("Scale") or "3920(gal)/6182761")
    factor = float(scale[1]) / float(scale[2]) if scale and float(scale[2]) else 0.0
    gal = factor * (np.asarray(counts) - np.mean(counts))
    header = {
        "Origin Time": "2011/03/11 14:46:00",
        "Lat.": "38.103",
        "Long.": "142.860",
        "Depth. (km)": "24",
        "Mag.": "9.0",
        "Station Code": "MYG004",
        "Station Lat.": "38.7292",
        "Station Long.": "141.0217",
        "Station Height(m)": "40",
        "Record Time": "2011/03/11 14:46:51",
        "Sampling Freq(Hz)": "100Hz",
        "Duration Time(s)": f"{len(counts) / 100:g}",
        "Dir.": "E-W",
        "Scale Factor": "3920(gal)/6182761",
        "Max. Acc. (gal)": f"{np.abs(gal).max():.3f}",
        "Last Correction": "2011/03/11 14:46:36",
        "Memo.": "",
    }
    lines = []
    for key, value in header.items():
        new = changed.get(key.split()[0].strip("."), value)
        if new is not None:
            lines.append(f"{key:<18}{new}")
    return "\n".join(lines) + "\n" + fixed(counts, 8, 9, 0)
