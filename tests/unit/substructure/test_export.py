"""Exported compensators: they compile as strict C99, command the same to the last bit, and spare files of others."""

from __future__ import annotations

import shutil
import subprocess
from pathlib import Path
from typing import get_args

import numpy as np
import pytest

from edesign.core.compensator import (
    MEMORY,
    AdaptiveTimeSeries,
    Compensator,
    DifferenceEquation,
    LiveDelay,
    Term,
    run_compensator,
)
from edesign.core.compensator_source import HEADER, header_text, hexadecimal, least_sizes
from edesign.core.errors import CoreError
from edesign.errors import InputError
from edesign.project.substructure import compensators as kinds
from edesign.substructure.compensation import compensators
from edesign.substructure.compensation.compensator_matrices import INPUTS, OUTPUTS, state_space
from edesign.substructure.compensation.export import FILES, MATRICES, export, identifier

STEP = 1e-3  # s
FLAGS = ["-std=c99", "-pedantic", "-Wall", "-Wextra", "-Werror", "-O2"]
ADAPTIVE = AdaptiveTimeSeries(
    initial=(1.0, 0.01, 6e-5),
    least=(0.7, 0.0, 0.0),
    largest=(1.3, 0.04, 8e-4),
    rate=(2.0, 0.05, np.inf),
    threshold=1e-4,
    sections=compensators.butterworth(6, 20.0, STEP),
    differences=True,
)
# the command counts in the correction of the force too
BOTH = DifferenceEquation(
    (Term("target", 0, 1.5), Term("velocity", 2, 0.01), Term("command", 1, -0.5), Term("measured", 3, 0.1)),
    (Term("command", 1, 1e6), Term("command", 4, -2e5), Term("acceleration", 1, 30.0), Term("measured", 0, 1e5)),
)
LINEAR: dict[str, DifferenceEquation] = {
    "none": compensators.none(),
    "cubic": compensators.polynomial(3, 10.2e-3, STEP),
    "least_squares": compensators.least_squares_polynomial(2, 12, 10.2e-3, STEP),
    "linear_acceleration": compensators.linear_acceleration(10.2e-3, STEP),
    "inverse": compensators.inverse(10.2e-3, STEP),
    "lead": compensators.phase_lead(0.02, 0.004, STEP),
    "alpha": compensators.fixed_alpha((1.0, 0.01, 5e-5, 2e-7), STEP),
    "smith": compensators.smith(10.2e-3, 0.99, 1e6, 1e4, STEP),
    "pi_lead": compensators.pi_phase_lead(1.0, 30.0, 6e-3, 1e-3, STEP),
    "both": BOTH,
    "nothing": DifferenceEquation(()),
}
ALL: dict[str, Compensator] = {
    **LINEAR,
    "live": LiveDelay(3, 8e-3, 0.0, 0.05, 0.3, 1e-4),
    "live_at_rest": LiveDelay(0, 0.0, 0.0, 0.0, 1.0, 0.0),
    "ats": compensators.ats(0.5, 16, STEP, ADAPTIVE),
    "modified": compensators.modified_ats(0.996, ADAPTIVE),
}

PROGRAM = """
#include "compensator.h"
#include <stdio.h>
static NAME_state state;
int main(int argc, char **argv)
{
  double in[4], out[2];
  FILE *from = argc > 2 ? fopen(argv[1], "rb") : 0, *to = argc > 2 ? fopen(argv[2], "wb") : 0;
  if (!from || !to)
    return 1;
  NAME_start(&state);
  while (fread(in, sizeof in, 1, from) == 1) {
    out[0] = NAME_step(&state, in[0], in[1], in[2], in[3]);
    out[1] = NAME_force(&state);
    fwrite(out, sizeof out, 1, to);
  }
  fclose(to);
  return 0;
}
"""


def signals(n: int = 6000) -> np.ndarray:
    """Target, its velocity and acceleration at the ends of steps, and what is measured at their beginnings: (n, 4).

    Sines of 0.7 to 3.8 Hz, measured 12 ms late, 1 % too small, with noise of 1 um.
    """
    t = STEP * np.arange(1, n + 1)
    found = np.zeros((n, 4))
    for amplitude, frequency, phase in ((3e-3, 0.7, 0.1), (2e-3, 1.9, 1.0), (1e-3, 3.8, 2.0)):
        omega = 2.0 * np.pi * frequency
        angle = omega * t + phase
        found[:, :3] += amplitude * np.column_stack([np.sin(angle), omega * np.cos(angle), -(omega**2) * np.sin(angle)])
        found[:, 3] += 0.99 * amplitude * np.sin(angle - omega * (STEP + 12e-3))
    found[:, 3] += 1e-6 * np.random.default_rng(1).standard_normal(n)
    return found


def forces(equation: DifferenceEquation, inputs: np.ndarray, command: np.ndarray) -> np.ndarray:
    """Corrections of the force, (n,) N, by the sum as it is defined."""
    found = np.zeros(len(command))
    for k in range(len(command)):
        for term in equation.force_terms:
            if k >= term.lag:
                of = command[k - term.lag] if term.of == "command" else inputs[k - term.lag, INPUTS.index(term.of)]
                found[k] += term.coefficient * of
    return found


def compiled(folder: Path, *sources: str) -> Path:
    """Compile sources of a folder as strict C99 without warnings, and return the program."""
    compiler = shutil.which("cc")
    if compiler is None:
        pytest.skip("no C compiler")
    program = folder / sources[0].removesuffix(".c")
    command = [compiler, *FLAGS, "-o", str(program), *(str(folder / source) for source in sources), "-lm"]
    result = subprocess.run(command, capture_output=True, text=True, check=False)
    assert result.returncode == 0, result.stderr
    return program


@pytest.mark.parametrize("name", ALL)
def test_exported_code_commands_the_same_to_the_last_bit(name: str, tmp_path: Path) -> None:
    """As run_compensator; corrections of the force as their sum."""
    files = export(ALL[name], STEP, tmp_path, name)
    assert all(path.is_file() for path in files)
    assert {path.name for path in files} == {*FILES, *([MATRICES] if name in LINEAR else [])}
    (tmp_path / "main.c").write_text(PROGRAM.replace("NAME", name), encoding="utf-8")
    program, inputs = compiled(tmp_path, "main.c", "compensator.c"), signals()
    (tmp_path / "in").write_bytes(inputs.tobytes())
    subprocess.run([str(program), str(tmp_path / "in"), str(tmp_path / "out")], check=True)
    found = np.fromfile(tmp_path / "out").reshape(-1, 2)
    command = run_compensator(ALL[name], STEP, inputs[:, :3], inputs[:, 3])
    assert np.array_equal(found[:, 0], command)
    expected = forces(LINEAR[name], inputs, command) if name in LINEAR else np.zeros(len(command))
    assert np.array_equal(found[:, 1], expected)


@pytest.mark.parametrize("name", ["smith", "live", "ats", "modified"])
def test_self_test_passes_and_prints_the_size_of_the_state(name: str, tmp_path: Path) -> None:
    export(ALL[name], STEP, tmp_path, name)
    program = compiled(tmp_path, "self_test.c", "compensator.c")
    result = subprocess.run([str(program), str(tmp_path / "self_test.csv")], capture_output=True, text=True, check=True)
    size = least_sizes(ALL[name], STEP).state
    assert result.stdout.startswith(f"state: {size} bytes\n2048 of 2048 steps compared, 0 of them differ")
    assert f"| state | {size} bytes" in (tmp_path / "README.md").read_text(encoding="utf-8")


def test_self_test_fails_where_a_command_differs(tmp_path: Path) -> None:
    """In the last bit of one step, or where steps are missing."""
    export(ALL["cubic"], STEP, tmp_path, "cubic")
    program = compiled(tmp_path, "self_test.c", "compensator.c")
    lines = (tmp_path / "self_test.csv").read_text(encoding="utf-8").splitlines()
    cells = lines[100].split(",")
    cells[4] = float(np.nextafter(float.fromhex(cells[4]), 1.0)).hex()
    for wrong in ([*lines[:100], ",".join(cells), *lines[101:]], lines[:-1]):
        (tmp_path / "wrong.csv").write_text("\n".join(wrong) + "\n", encoding="utf-8")
        assert subprocess.run([str(program), str(tmp_path / "wrong.csv")], capture_output=True).returncode == 1
    assert subprocess.run([str(program), str(tmp_path / "missing.csv")], capture_output=True).returncode == 2


def test_timing_prints_mean_and_percentile(tmp_path: Path) -> None:
    """What it says depends on the machine, and is not judged."""
    export(ALL["modified"], STEP, tmp_path, "modified")
    program = compiled(tmp_path, "timing.c", "compensator.c")
    reported = subprocess.run([str(program)], capture_output=True, text=True, check=True).stdout
    assert "p99.9" in reported and "main step: 1000.0 us" in reported and "nan" not in reported


def test_a_second_compensator_of_other_sizes_is_refused_by_the_compiler(tmp_path: Path) -> None:
    """In one source file; its state would not fit."""
    export(ALL["cubic"], STEP, tmp_path / "a", "cubic")
    export(ALL["none"], STEP, tmp_path / "b", "none")
    (tmp_path / "main.c").write_text(
        '#include "a/compensator.h"\n#include "b/compensator.h"\nint main(void) { return 0; }\n', encoding="utf-8"
    )
    compiler = shutil.which("cc")
    if compiler is None:
        pytest.skip("no C compiler")
    command = [compiler, "-fsyntax-only", str(tmp_path / "main.c")]
    result = subprocess.run(command, capture_output=True, text=True, check=False)
    assert result.returncode != 0
    assert "other sizes" in result.stderr


@pytest.mark.parametrize("name", LINEAR)
def test_matrices_are_the_difference_equation(name: str, tmp_path: Path) -> None:
    """To 1e-12 of the largest output: only the order of sums differs. Read back from the file, in all digits."""
    export(LINEAR[name], STEP, tmp_path, name)
    lines = [line.split(",") for line in (tmp_path / MATRICES).read_text(encoding="utf-8").splitlines()[1:]]
    found = state_space(LINEAR[name])
    block = np.array([[float(cell) for cell in line[1:]] for line in lines[1:]])
    assert np.array_equal(block, np.block([[found.A, found.B], [found.C, found.D]]))
    assert lines[0][found.states + 1 :] == list(INPUTS)
    assert [line[0] for line in lines[found.states + 1 :]] == list(OUTPUTS)
    inputs = signals(2000)
    outputs = found.run(inputs)
    command = run_compensator(LINEAR[name], STEP, inputs[:, :3], inputs[:, 3])
    force = forces(LINEAR[name], inputs, command)
    assert np.max(np.abs(outputs[:, 0] - command)) <= 1e-12 * np.max(np.abs(command))
    assert np.max(np.abs(outputs[:, 1] - force)) <= 1e-12 * np.max(np.abs(force))


@pytest.mark.parametrize("name", ["cubic", "inverse", "lead", "linear_acceleration", "smith", "pi_lead"])
def test_no_state_can_be_spared(name: str) -> None:
    """Controllable and observable: of full rank at each eigenvalue, by Popov, Belevitch and Hautus."""
    found = state_space(LINEAR[name])
    n = found.states
    B, C = found.B / np.max(np.abs(found.B)), found.C / np.max(np.abs(found.C))
    for eigenvalue in np.linalg.eigvals(found.A):
        rest = found.A - eigenvalue * np.eye(n)
        assert np.linalg.matrix_rank(np.hstack([rest, B]), tol=1e-6) == n
        assert np.linalg.matrix_rank(np.vstack([rest, C]), tol=1e-6) == n


def test_readme_names_units_signs_and_order(tmp_path: Path) -> None:
    export(ALL["smith"], STEP, tmp_path, "Smith's  predictor")
    text = (tmp_path / "README.md").read_text(encoding="utf-8")
    for expected in (
        "# Smith's predictor",
        "m, m/s, m/s2",
        "N | for the force that is measured at its end",
        "F = k x",
        "Smith_s_predictor_step(&state, x, v, a, measured)",
        "0.001 s (1000 Hz)",
        "does not look at `a` and `measured`",
        "no safety system",
    ):
        assert expected in text
    assert "$" not in text


def test_files_of_others_are_left_as_they_are(tmp_path: Path) -> None:
    """One that edesign did not write, one of another compensator; nothing else is written then."""
    (tmp_path / "timing.c").write_text("int mine;\n", encoding="utf-8")
    with pytest.raises(InputError, match=r"timing\.c: .*E-FILE-07"):
        export(ALL["cubic"], STEP, tmp_path, "cubic")
    assert [path.name for path in tmp_path.iterdir()] == ["timing.c"]
    export(ALL["cubic"], STEP, tmp_path, "cubic", overwrite=True)
    before = {path.name: path.read_bytes() for path in tmp_path.iterdir()}
    with pytest.raises(InputError, match="`cubic`.*E-FILE-07"):
        export(ALL["ats"], STEP, tmp_path, "ats")
    assert {path.name: path.read_bytes() for path in tmp_path.iterdir()} == before


def test_a_new_export_replaces_the_last_one(tmp_path: Path) -> None:
    """Of the same name, with matrices or without; the same export is the same files."""
    export(ALL["cubic"], STEP, tmp_path, "mine")
    first = {path.name: path.read_bytes() for path in tmp_path.iterdir()}
    export(ALL["ats"], STEP, tmp_path, "mine")
    assert {path.name for path in tmp_path.iterdir()} == set(FILES)
    export(ALL["cubic"], STEP, tmp_path, "mine")
    assert {path.name: path.read_bytes() for path in tmp_path.iterdir()} == first


def test_state_is_as_small_as_the_compensator_allows() -> None:
    """A power of 2 above the furthest lag; the window of ATS; at most the sizes of the core."""
    furthest = DifferenceEquation((Term("target", MEMORY - 1, 1.0),))
    assert least_sizes(furthest, STEP).memory == MEMORY
    assert least_sizes(DifferenceEquation((Term("target", 31, 1.0),)), STEP).memory == 32
    assert least_sizes(DifferenceEquation((Term("target", 32, 1.0),)), STEP).memory == 64
    assert least_sizes(ALL["ats"], STEP).window == 500
    assert least_sizes(ALL["modified"], STEP).state < 500


def test_wrong_parameters_write_nothing(tmp_path: Path) -> None:
    with pytest.raises(CoreError):
        export(DifferenceEquation((Term("command", 0, 1.0),)), STEP, tmp_path / "new", "loop")
    assert not (tmp_path / "new").exists()


def test_every_kind_has_a_section_of_the_documentation() -> None:
    """docs/theory/compensators.md, with a weakness each, and every key of the file but those explained once."""
    page = (Path(__file__).parents[3] / "docs" / "theory" / "compensators.md").read_text(encoding="utf-8")
    sections = {text.split("\n", 1)[0]: text for text in page.split("\n## ")[1:]}
    for model in get_args(get_args(kinds.Compensator)[0]):
        (kind,) = get_args(model.model_fields["kind"].annotation)
        assert "**Weakness**" in sections[kind]
        shared = {"kind", *(kinds.AtsCompensator.model_fields if kind == "modified_ats" else ())}
        for key in set(model.model_fields) - shared:
            assert f"`{key}`" in sections[kind], f"{kind}: {key}"


def test_header_is_the_one_that_the_core_was_built_from() -> None:
    """In the source tree; an installed package has a copy, made when it was built."""
    source = Path(__file__).parents[3] / "core_c" / "include" / HEADER
    assert header_text() == source.read_text(encoding="utf-8")


@pytest.mark.parametrize(
    ("name", "expected"),
    [
        ("cubic", "cubic"),
        ("modified ATS, 0.996", "modified_ATS_0_996"),
        ("3rd order", "compensator_3rd_order"),
        ("ed_compensator", "compensator_ed_compensator"),
        ("Ausgleich */ für", "Ausgleich_f_r"),
        ("", "compensator"),
    ],
)
def test_names_stand_in_c(name: str, expected: str) -> None:
    assert identifier(name) == expected


def test_numbers_keep_their_bits() -> None:
    rng = np.random.default_rng(1)
    for value in (*(rng.standard_normal(50) * 10.0 ** rng.integers(-300, 300, 50)), 0.0, -0.0, 5e-324):
        assert np.float64(float.fromhex(hexadecimal(value))).tobytes() == np.float64(value).tobytes()
    assert (hexadecimal(np.inf), hexadecimal(-np.inf)) == ("INFINITY", "-INFINITY")
    with pytest.raises(ValueError, match="not a number"):
        hexadecimal(np.nan)
